#pragma once
/// \file
/// The places of sensors: a table with the columns name and x, y, z (world space, metres), or name and room.

#include <svt/core/result.hpp>
#include <svt/field_readers/common/reading.hpp>

#include <cstdint>
#include <map>
#include <string>

namespace svt::field_readers {

struct SensorPlace {
    Vec3d at{};              ///< world space
    std::uint64_t line = 0;  ///< in the table
    std::string room;        ///< as in the table; empty: by coordinates
};

/// Reads FieldReadOptions::places. A room is the id or the name of a component, or a query that selects one. Its place is the
/// centre of the voxel of the room nearest to the centroid of the room.
/// \return the places by name of the sensor, or
///         - CannotOpen.
///         - BadField  with the line: a column is missing, a sensor has two places, a room is unknown, is not the only one
///                     of its name, or has no voxels.
/// Cost: two passes over the columns of the volume for all rooms together.
[[nodiscard]] Result<std::map<std::string, SensorPlace, std::less<>>> readPlaces(const Reading& reading);

}  // namespace svt::field_readers

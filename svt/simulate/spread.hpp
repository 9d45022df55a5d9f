#pragma once
/// \file
/// Values of sensors continued through the air of rooms. They go around walls and never through them.
///
///     +-----------+-------+
///     | a         |       |    a, b, c  sensors
///     |         b |   c   |    The room on the left has values between those of a and b, the other room that of c.
///     +-----------+-------+
///
/// A value is the mean of the sensors whose air reaches the place, weighted by 1 / distance^2 (Shepard, "A
/// two-dimensional interpolation function for irregularly-spaced data", 1968). The distance is the length of the
/// shortest way through air, so a sensor behind a corner counts less than one in sight.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/fields/field.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace svt::simulate {

struct SpreadOptions {
    std::string name = "spread";         ///< of the new field
    std::vector<std::string> open;       ///< queries of doors and other components that count as air
    double step = 0.2;                   ///< metres between nodes, rounded to whole voxels, at least one
    const Progress* progress = nullptr;  ///< stage "sensors"
};

/// The place of a sensor in the air of rooms.
struct SensorPlace {
    std::size_t point = 0;                   ///< number in the field of sensors
    std::uint32_t label = volume::kNoLabel;  ///< of its room; kNoLabel: no room within 0.25 m, so it does not count
    double volume = 0;                       ///< m3 of the air that it reaches, by voxels
};

struct SpreadResult {
    fields::Field field;               ///< kind grid, medium "air", at the times of the sensors
    std::vector<SensorPlace> sensors;  ///< in the order of the points
    std::vector<std::uint32_t> dry;    ///< rooms with voxels that no sensor reaches, ascending
    /// Rooms that touch each other without a wall, and whose air is apart nevertheless; the lower label first;
    /// ascending.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> touching;
    std::uint64_t nodes = 0;  ///< with a value at some time
};

/// Continues a field of points through the air of rooms.
///
/// Air: rooms, background that does not reach the border of the grid, such as window reveals, and the components of
/// SpreadOptions::open. Outside air has no values. Air passes from room to room through doorways and open components
/// only. Rooms that touch each other stay apart, because a model may lack a thin wall, unless SpreadOptions::open
/// selects one of them. A sensor without a value at a time does not count at this time.
///
/// Distances: fast marching of second order on the voxels (Sethian, "Fast marching methods", 1999), from the exact
/// place of the sensor. Beyond ten voxels, their error is below 3 % in sight and below 5 % around the end of a wall.
///
/// \param sensors  kind points, one component
/// \return the result, or
///         - BadField: another field, or a name that no field can have.
///         - BadQuery, NothingSelected: of a query.
///         - BadArgument: no rooms, no sensor in a room, or a step out of range.
///         - GridTooLarge: a grid of more than 2^32 voxels, a field of more than 2^31 values, or 2^28 distances.
///         - Cancelled
/// Cost: about 1 us for each voxel of air and sensor that reaches it, and 5 ns for each node, time and such sensor. One
/// thread. Memory: 9 bytes for each voxel of the grid, 4 for each value, 8 for each node and sensor that reaches it.
[[nodiscard]] Result<SpreadResult> spreadSensors(const volume::SemanticVolume& volume, const fields::Field& sensors,
                                                 const SpreadOptions& options);

}  // namespace svt::simulate

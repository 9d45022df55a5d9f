#pragma once
/// \file
/// Stairs by their treads: the line of travel, the number of risers.

#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <vector>

namespace svt::drawing {

struct StairTread {
    Vec3d center{};     ///< world space
    double height = 0;  ///< metres above the grid's lower corner
    double area = 0;    ///< m2
};

/// A stair whose treads rise one after the other.
struct StairFlight {
    std::uint32_t label = 0;
    std::vector<StairTread> treads;  ///< from below, 3 or more; landings are treads too
    double riser = 0;                ///< mean height from tread to tread, metres
    double going = 0;                ///< median horizontal distance from tread to tread, so that landings do not count

    /// The number of risers from the floor below to the floor above; a floor up to a riser and a half above the last
    /// tread adds one.
    /// \param upperFloor  of a level, metres above the grid's lower corner
    [[nodiscard]] int risersTo(double upperFloor) const noexcept;
};

/// The stair that each label is or is a part of, by class, IFC type, function or name; volume::kNoLabel for others.
[[nodiscard]] std::vector<std::uint32_t> stairOfLabels(const volume::LabelTable& table);

/// The stairs of the model, by class, IFC type, function or name, whose meshes have treads: horizontal faces that look
/// up, 8 to 30 cm apart. Faces that carry another part of the stair, such as the top of a riser, are not treads. Nor are
/// smaller faces between two treads. Stairs without treads, such as ramps, are left out.
/// Cost: O(triangles of stairs).
[[nodiscard]] std::vector<StairFlight> findStairFlights(const volume::SemanticVolume& volume);

}  // namespace svt::drawing

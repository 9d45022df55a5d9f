#pragma once
/// \file
/// The direction of true north in a model: for north arrows, names of elevations, and the sun.

#include <svt/core/vec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace svt::drawing {

/// The source of true north.
enum class NorthSource : std::uint8_t {
    Projection,  ///< the meridian at the model's place, by its CRS; the y axis is grid north
    Model,       ///< the attribute `trueNorth` of the model (IFC)
    Assumed      ///< unknown: the y axis is taken
};

struct North {
    double degrees = 0;  ///< clockwise from the y axis of world space to true north
    NorthSource source = NorthSource::Assumed;

    /// The horizontal direction with an azimuth in degrees, clockwise from true north. World space, unit length.
    [[nodiscard]] Vec3d direction(double azimuthDegrees = 0) const noexcept;
    /// The number of the nearest of compassNames() for a direction in world space.
    [[nodiscard]] std::size_t eighthOf(Vec3d direction) const noexcept;
};

/// "north", "north-east", "east", ..., clockwise.
[[nodiscard]] std::array<std::string_view, 8> compassNames() noexcept;

/// True north at the lower corner of the grid. The CRS decides if its EPSG code is known; then grid north is the y axis.
/// Cost: that of crs::frameOf().
[[nodiscard]] North northOf(const volume::SemanticVolume& volume);

}  // namespace svt::drawing

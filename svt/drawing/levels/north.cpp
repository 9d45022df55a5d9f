#include <svt/drawing/north.hpp>

#include <svt/crs/crs_name.hpp>
#include <svt/crs/globe.hpp>
#include <svt/drawing/levels/level_parts.hpp>

#include <cmath>
#include <numbers>
#include <optional>

namespace svt::drawing {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// The angle from the y axis of a projection to the meridian, clockwise, in degrees.
std::optional<double> meridianConvergence(const volume::SemanticVolume& volume) {
    const auto epsg = static_cast<int>(crs::epsgCodeOf(volume.crsName));
    if (epsg == 0) return std::nullopt;
    const Vec3d at = volume.grid.origin();
    const auto place = crs::placeOnEarth(epsg, at);
    const auto frame = crs::frameOf(epsg, at);
    if (!place || !frame) return std::nullopt;
    const crs::GlobeFrame level = crs::frameAt(*place);
    const double degrees = std::atan2(dot(level.axes[1], frame->axes[0]), dot(level.axes[1], frame->axes[1])) / kDegree;
    return std::isfinite(degrees) ? std::optional(degrees) : std::nullopt;
}

}  // namespace

Vec3d North::direction(double azimuthDegrees) const noexcept {
    const double angle = (degrees + azimuthDegrees) * kDegree;
    return {std::sin(angle), std::cos(angle), 0};
}

std::size_t North::eighthOf(Vec3d direction) const noexcept {
    const double eighth = (std::atan2(direction.x, direction.y) / kDegree - degrees) / 45;
    const double rounded = std::round(eighth - 8 * std::floor(eighth / 8));  // 0..8
    return std::isfinite(rounded) ? static_cast<std::size_t>(rounded) % 8 : 0;
}

std::array<std::string_view, 8> compassNames() noexcept {
    return {"north", "north-east", "east", "south-east", "south", "south-west", "west", "north-west"};
}

North northOf(const volume::SemanticVolume& volume) {
    if (const auto degrees = meridianConvergence(volume)) return {*degrees, NorthSource::Projection};
    for (const volume::Label& label : volume.labels.labels)
        if (const auto degrees = numberOf(label, "trueNorth"); degrees && std::isfinite(*degrees))
            return {*degrees, NorthSource::Model};
    return {};
}

}  // namespace svt::drawing

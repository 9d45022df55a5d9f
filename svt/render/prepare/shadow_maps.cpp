#include <svt/render/prepare/shadow_maps.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace svt::render {
namespace {

constexpr double kMostPixels = 2048;
constexpr double kVoxelsAPixel = 0.5;
// A point on a fitted surface of voxels may lie this many voxels below the next of them.
constexpr double kLiftVoxels = 0.75, kLiftPixels = 1.5;

struct Axes {
    Vec3d right, up;
};

Axes axesAcross(Vec3d direction) {
    const Vec3d least = std::abs(direction.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
    const Vec3d right = normalized(cross(direction, least));
    return {right, cross(right, direction)};
}

// Directions to places that share a disc evenly: on a spiral of equal areas (Vogel 1979).
std::vector<Vec3d> directionsOf(Vec3d towards, double degrees) {
    const std::size_t count = degrees <= 0 ? 1 : degrees <= 1 ? 5 : degrees <= 4 ? 9 : 16;
    const double radius = std::tan(degrees / 2 * std::numbers::pi / 180);
    const auto [right, up] = axesAcross(towards);
    std::vector<Vec3d> directions;
    for (std::size_t n = 0; n < count; ++n) {
        const double r =
            count == 1 ? 0 : radius * std::sqrt((static_cast<double>(n) + 0.5) / static_cast<double>(count));
        const double turn = static_cast<double>(n) * std::numbers::pi * (3 - std::sqrt(5.0));
        directions.push_back(normalized(towards + right * (r * std::cos(turn)) + up * (r * std::sin(turn))));
    }
    return directions;
}

// Whether a volume has more than background, and so can cast shadows.
bool isFilled(const DrawnVolume& drawn) { return drawn.bricks().scalarCount() > 1; }

// The corners of all volumes.
std::vector<Vec3d> cornersOf(std::span<const DrawnVolume> volumes) {
    std::vector<Vec3d> corners;
    for (const DrawnVolume& drawn : volumes)
        for (int c = 0; c < 8 && isFilled(drawn); ++c) {
            const Vec3i n = drawn.grid().dimension();
            corners.push_back(
                drawn.grid().worldFromIndex({(c & 1) * n.x - 0.5, ((c >> 1) & 1) * n.y - 0.5, (c >> 2) * n.z - 0.5}));
        }
    return corners;
}

// The parts that stop light: opaque parts of all passes, whatever the order of drawing.
FrameSpec makeSpec(const FrameSpec& spec) {
    FrameSpec from = spec;
    from.samplesPerPixel = 1;
    from.borders.strength = 0;
    from.hatches.strength = 0;
    from.light = Light{};
    from.light.ambientOcclusion = 0;
    for (Pass& pass : from.passes) {
        for (Style& style : pass.styles)
            if (style.opacity < 1) style.opacity = 0;
        pass.join = Pass::Join::Depth;
        pass.lines.clear();
    }
    return from;
}

}  // namespace

Result<ShadowMaps> ShadowMaps::make(std::span<const DrawnVolume> volumes, const FrameSpec& spec, Vec3d towardsLight,
                                    const CastOptions& options) {
    ShadowMaps maps;
    FrameSpec from = makeSpec(spec);
    const std::vector<Vec3d> corners = cornersOf(volumes);
    double voxel = std::numeric_limits<double>::infinity();
    double largest = 0;
    for (const DrawnVolume& drawn : volumes) {
        if (!isFilled(drawn)) continue;
        const Vec3d spacing = drawn.grid().spacing();
        voxel = std::min({voxel, spacing.x, spacing.y, spacing.z});
        largest = std::max({largest, spacing.x, spacing.y, spacing.z});
    }
    if (corners.empty()) return maps;
    CastOptions plain = options;
    plain.isAdaptive = false;
    plain.labelAt = 0;
    for (const Vec3d& towards : directionsOf(towardsLight, spec.light.size)) {
        const Vec3d forward = -towards;
        const auto [right, up] = axesAcross(forward);
        Box3d box;
        for (const Vec3d& corner : corners) box.add(Vec3d{dot(corner, right), dot(corner, up), dot(corner, forward)});
        const double width = box.max.x - box.min.x, height = box.max.y - box.min.y;
        maps.pixel_ = std::max(kVoxelsAPixel * voxel, std::max(width, height) / kMostPixels);
        const auto pixels = [&](double extent) {
            return std::max(1, static_cast<std::int32_t>(std::ceil(extent / maps.pixel_)) + 2);
        };
        from.width = pixels(width);
        from.height = pixels(height);
        Map map;
        map.forward = forward;
        map.right = right;
        map.up = up;
        map.eye =
            right * ((box.min.x + box.max.x) / 2) + up * ((box.min.y + box.max.y) / 2) + forward * (box.min.z - 1);
        from.camera = {Camera::Projection::Orthographic, map.eye, map.eye + forward, up, 35, from.height * maps.pixel_};
        SVT_TRY(frame, castRays(volumes, from, plain));
        map.depth = std::move(frame->depth);
        maps.maps_.push_back(std::move(map));
    }
    maps.lift_ = std::max(kLiftPixels * maps.pixel_, kLiftVoxels * largest);
    return maps;
}

double ShadowMaps::lightAt(Vec3d point, Vec3d normal) const noexcept {
    double sum = 0;
    for (const Map& map : maps_) {
        const Vec3d from = point + normal * lift_ - map.forward * lift_ - map.eye;
        const double x = dot(from, map.right) / pixel_ + map.depth.width() / 2.0 - 0.5;
        const double y = map.depth.height() / 2.0 - dot(from, map.up) / pixel_ - 0.5;
        const double depth = dot(from, map.forward);
        const double left = std::floor(x), top = std::floor(y);
        const auto isLit = [&](int dx, int dy) -> double {
            const double px = left + dx, py = top + dy;
            if (!(px >= 0 && py >= 0 && px < map.depth.width() && py < map.depth.height())) return 1;
            return double(map.depth.at(static_cast<std::int32_t>(px), static_cast<std::int32_t>(py))) >= depth ? 1 : 0;
        };
        const double fx = x - left, fy = y - top;
        sum +=
            (isLit(0, 0) * (1 - fx) + isLit(1, 0) * fx) * (1 - fy) + (isLit(0, 1) * (1 - fx) + isLit(1, 1) * fx) * fy;
    }
    return maps_.empty() ? 1 : sum / static_cast<double>(maps_.size());
}

}  // namespace svt::render

#include <svt/drawing/exact/mesh_cut.hpp>

#include <svt/drawing/exact/paged_array.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace svt::drawing {
namespace {

constexpr double kOnPlane = 1e-5;    // metres: rounding of coordinates, and distance of welded points
constexpr double kNearPlane = 2e-4;  // metres: edges within it should lie in the plane
constexpr double kHair = 3e-4;       // metres: how far the plane is moved from them
constexpr double kShortEdge = 1e-3;  // metres
constexpr double kCutReach = 1e-3;   // metres: triangles farther away are not cut, wherever the plane moves

class TriangleCutter {
public:
    TriangleCutter(const volume::VectorParts& parts, Vec3d origin, const PlaneAxes& axes, bool keepsAbove,
                   std::span<const MeshRun> runs)
        : parts_(parts),
          axes_(axes),
          toPoints_(origin - axes.origin),
          keepsAbove_(keepsAbove),
          heights_(parts.points.size()) {
        const double base = dot(toPoints_, axes.normal);
        for (const MeshRun& run : runs) {
            const auto [low, high] = run.rangeAlong(axes.normal);
            if (low * parts.unit + base > kCutReach || high * parts.unit + base < -kCutReach) continue;
            for (std::uint32_t t = run.first; t < run.end; ++t) {
                near_.push_back(t);
                for (const std::uint32_t corner : parts.triangles[t].corners)
                    heights_.at(corner) = dot(toDouble(parts.points[corner]), axes.normal) * parts.unit + base;
            }
        }
    }

    MeshCut run() {
        MeshCut cut;
        cut.visited = near_.size();
        bool isExact = true;
        for (const std::uint32_t t : near_)
            for (std::size_t n = 0; n < 3; ++n) {
                const auto& corners = parts_.triangles[t].corners;
                const std::uint32_t a = corners[n], b = corners[(n + 1) % 3];
                const double high = std::max(std::abs(heights_[a]), std::abs(heights_[b]));
                if (high > kNearPlane || a > b || lengthOf(a, b) < kShortEdge) continue;
                ++cut.edgesInPlane;
                isExact = isExact && high <= kOnPlane;
            }
        if (!isExact) cut.shift = kHair;
        const double raise = keepsAbove_ ? cut.shift : -cut.shift;
        heights_.forVisited([&](double& height) {
            height -= raise;
            if (std::abs(height) <= kOnPlane) height = 0;
        });
        for (const std::uint32_t t : near_) addSegment(parts_.triangles[t], cut.segments);
        return cut;
    }

private:
    [[nodiscard]] double lengthOf(std::uint32_t a, std::uint32_t b) const noexcept {
        return length(toDouble(parts_.points[b]) - toDouble(parts_.points[a])) * parts_.unit;
    }
    [[nodiscard]] bool isAbove(std::uint32_t point) const noexcept {
        return keepsAbove_ ? heights_[point] > 0 : heights_[point] >= 0;
    }

    // If the triangle is counter-clockwise from outside, the segment begins where its border goes down through the
    // plane, so the inside is to the left.
    void addSegment(const volume::VectorParts::Triangle& triangle, std::vector<CutSegment>& segments) const {
        const auto& c = triangle.corners;
        const int above = (isAbove(c[0]) ? 1 : 0) + (isAbove(c[1]) ? 1 : 0) + (isAbove(c[2]) ? 1 : 0);
        if (above == 0 || above == 3) return;
        CutSegment segment;
        segment.label = triangle.label;
        for (std::size_t n = 0; n < 3; ++n) {
            const std::uint32_t a = c[n], b = c[(n + 1) % 3];
            if (isAbove(a) == isAbove(b)) continue;
            (isAbove(a) ? segment.from : segment.to) = crossing(a, b);
        }
        segments.push_back(segment);
    }

    // Where an edge meets the plane: the same bits from both sides, and for all objects that share the edge.
    [[nodiscard]] PlanePoint crossing(std::uint32_t a, std::uint32_t b) const noexcept {
        if (parts_.points[b] < parts_.points[a]) std::swap(a, b);
        const Vec3d from = toDouble(parts_.points[a]), to = toDouble(parts_.points[b]);
        const Vec3d at = from + (to - from) * (heights_[a] / (heights_[a] - heights_[b]));
        const Vec3d place = at * parts_.unit + toPoints_;
        return {dot(place, axes_.u), dot(place, axes_.v)};
    }

    const volume::VectorParts& parts_;
    const PlaneAxes& axes_;
    Vec3d toPoints_;
    bool keepsAbove_;
    PagedArray<double> heights_;       // above the plane, metres, by point; only of triangles near it
    std::vector<std::uint32_t> near_;  // triangles that may meet the plane, in their order
};

}  // namespace

MeshCut cutMeshes(const volume::VectorParts& parts, Vec3d origin, const PlaneAxes& axes, bool keepsAbove,
                  std::span<const MeshRun> runs) {
    return TriangleCutter(parts, origin, axes, keepsAbove, runs).run();
}

}  // namespace svt::drawing

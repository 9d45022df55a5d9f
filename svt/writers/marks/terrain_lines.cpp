#include <svt/writers/marks/terrain_lines.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

// The upper side of a label: the height of its highest point below the plane of a plan.
class TopSide {
public:
    TopSide(std::uint32_t label, const drawing::PlaneAxes& axes, const volume::SemanticVolume& volume) {
        const auto& triangles = volume.vectors.triangles;
        auto triangle = std::lower_bound(triangles.begin(), triangles.end(), label,
                                         [](const auto& t, std::uint32_t l) { return t.label < l; });
        for (; triangle != triangles.end() && triangle->label == label; ++triangle) {
            std::array<Vec3d, 3> corners;
            for (std::size_t n = 0; n < 3; ++n) {
                const Vec3d p = volume.vectors.position(triangle->corners[n], volume.grid.origin());
                const PlanePoint at = axes.planeFromWorld(p);
                corners[n] = {at.u, at.v, dot(p - axes.origin, axes.normal)};
            }
            triangles_.push_back(corners);
        }
    }

    [[nodiscard]] std::size_t size() const noexcept { return triangles_.size(); }

    [[nodiscard]] std::optional<double> heightAt(PlanePoint p) const noexcept {
        std::optional<double> highest;
        for (const auto& [a, b, c] : triangles_) {
            const double twice = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
            if (std::abs(twice) < 1e-9) continue;
            const double s = ((p.u - a.x) * (c.y - a.y) - (c.x - a.x) * (p.v - a.y)) / twice,
                         t = ((b.x - a.x) * (p.v - a.y) - (p.u - a.x) * (b.y - a.y)) / twice;
            if (s < 0 || t < 0 || s + t > 1) continue;
            const double height = a.z + s * (b.z - a.z) + t * (c.z - a.z);
            if (height < 0 && (!highest || height > *highest)) highest = height;
        }
        return highest;
    }

private:
    std::vector<std::array<Vec3d, 3>> triangles_;  // u, v, height above the plane
};

bool isJoint(const drawing::BeyondLine& line, const TopSide& top) {
    constexpr double kBeside = 0.002, kSame = 0.0005;  // metres
    const double du = line.to.u - line.from.u, dv = line.to.v - line.from.v, size = std::hypot(du, dv);
    if (!(size > 0)) return false;
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        const PlanePoint at{line.from.u + share * du, line.from.v + share * dv},
            beside{-dv / size * kBeside, du / size * kBeside};
        const auto left = top.heightAt({at.u + beside.u, at.v + beside.v}),
                   right = top.heightAt({at.u - beside.u, at.v - beside.v});
        if (!left || !right || std::abs(*left - *right) > kSame) return false;
    }
    return true;
}

}  // namespace

void removeTerrainJoints(drawing::SectionDrawing& plan, const volume::SemanticVolume& volume,
                         std::span<const std::uint8_t> isAround) {
    constexpr std::size_t kMostTriangles = 5000;
    std::map<std::uint32_t, TopSide> tops;  // by label
    std::erase_if(plan.beyond, [&](const drawing::BeyondLine& line) {
        if (isAround[line.label] == 0 || line.kind == drawing::BeyondKind::Above) return false;
        const TopSide& top = tops.try_emplace(line.label, line.label, plan.axes, volume).first->second;
        return top.size() <= kMostTriangles && isJoint(line, top);
    });
}

}  // namespace svt::writers

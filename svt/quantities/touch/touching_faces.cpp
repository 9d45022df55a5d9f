#include <svt/quantities/touching_faces.hpp>

#include <svt/analyze/outside_faces.hpp>
#include <svt/core/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

namespace svt::quantities {
namespace {

constexpr int kMostSteps = 3, kMostStepsThroughSheets = 5;  // of half a voxel
constexpr double kMostPoints = 20000, kLeastPoints = 8;
// Steps of the evenly spread sequence R2: powers of the inverse of the plastic number (Roberts 2018).
constexpr double kStepA = 0.7548776662466927, kStepB = 0.5698402909980532;

class Toucher {
public:
    explicit Toucher(const volume::SemanticVolume& volume)
        : volume_(volume), labelOf_(volume.labels.labelOfScalar()), air_(volume.columns, labelOf_) {
        const Vec3d s = volume.grid.spacing();
        step_ = std::max({s.x, s.y, s.z}) / 2;
    }

    [[nodiscard]] std::vector<TouchingArea> areasOf(const ObjectQuantities& object) const {
        using Key = std::tuple<std::uint32_t, bool, Facing>;
        std::map<Key, double> areas;
        for (const std::uint32_t part : object.parts)
            for (const auto& [label, c] : volume::trianglesOf(volume_.vectors, part)) {
                const Vec3d origin = volume_.grid.origin();
                const Vec3d a = volume_.vectors.position(c[0], origin), ab = volume_.vectors.position(c[1], origin) - a,
                            ac = volume_.vectors.position(c[2], origin) - a;
                const Vec3d across = cross(ab, ac);
                const double area = 0.5 * length(across);
                if (!(area > 0)) continue;
                const Vec3d normal = across / (2 * area);
                const Facing facing = facingOf(normal);
                const double points = std::clamp(std::ceil(area / (step_ * step_)), kLeastPoints, kMostPoints);
                const auto count = static_cast<std::size_t>(points);
                for (std::size_t n = 0; n < count; ++n) {
                    double u = 0.5 + kStepA * double(n), v = 0.5 + kStepB * double(n);
                    u -= std::floor(u);
                    v -= std::floor(v);
                    if (u + v > 1) std::tie(u, v) = std::pair(1 - u, 1 - v);
                    const auto touched = touchedAt(a + ab * u + ac * v, normal, object.parts);
                    if (touched.isKnown) areas[{touched.label, touched.isOutside, facing}] += area / points;
                }
            }
        std::vector<TouchingArea> result;
        for (const auto& [key, area] : areas)
            result.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), area});
        return result;
    }

private:
    struct Touched {
        std::uint32_t label = volume::kNoLabel;
        bool isOutside = false, isKnown = false;
    };

    [[nodiscard]] Touched touchedAt(Vec3d point, Vec3d normal, std::span<const std::uint32_t> own) const {
        Touched touched;
        // A sheet of a slanted face is up to two voxels thick along the normal. The space behind it counts.
        for (int step = 1; step <= (touched.isKnown ? kMostStepsThroughSheets : kMostSteps); ++step) {
            const Vec3d place = volume_.grid.indexFromWorld(point + normal * (step_ * step));
            const Vec3i at{static_cast<std::int32_t>(std::floor(place.x + 0.5)),
                           static_cast<std::int32_t>(std::floor(place.y + 0.5)),
                           static_cast<std::int32_t>(std::floor(place.z + 0.5))};
            const Vec3i n = volume_.grid.dimension();
            if (at.x < 0 || at.y < 0 || at.z < 0 || at.x >= n.x || at.y >= n.y || at.z >= n.z)
                return {volume::kNoLabel, true, true};
            const std::uint32_t label = labelOf_[volume_.columns.scalarAt(at.x, at.y, at.z)];
            if (label == volume::kNoLabel) return {label, air_.contains(at.x, at.y, at.z), true};
            if (std::find(own.begin(), own.end(), label) != own.end()) continue;
            touched = {label, false, true};
            if (volume_.labels.labels[label].filling != volume::Filling::Surface) break;
        }
        return touched;
    }

    const volume::SemanticVolume& volume_;
    std::vector<std::uint32_t> labelOf_;
    analyze::OutsideAir air_;
    double step_ = 0;  // metres
};

}  // namespace

Facing facingOf(Vec3d normal) noexcept {
    if (normal.z > kLeastRise) return Facing::Top;
    if (normal.z < -kLeastRise) return Facing::Bottom;
    const double turns = std::atan2(normal.x, normal.y) / (2 * std::numbers::pi);  // clockwise from north
    const auto octant = static_cast<int>(std::floor(8 * turns + 0.5));
    return static_cast<Facing>((octant + 8) % 8);
}

std::vector<std::vector<TouchingArea>> findTouchingAreas(const volume::SemanticVolume& volume,
                                                         std::span<const ObjectQuantities> objects, int threads) {
    const Toucher toucher(volume);
    std::vector<std::vector<TouchingArea>> areas(objects.size());
    parallelFor(objects.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) areas[n] = toucher.areasOf(objects[n]);
    });
    return areas;
}

}  // namespace svt::quantities

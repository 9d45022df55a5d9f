#include <svt/render/ray_labels.hpp>
#include <svt/render/walk/run_walk.hpp>

#include <svt/render/voxel_ray.hpp>

#include <fmt/format.h>

namespace svt::render {
namespace {

struct Collector {
    const std::vector<std::uint32_t>& labelOf;
    std::vector<LabelInterval> intervals;

    [[nodiscard]] bool enter(volume::Scalar, double, const RunStart&) const noexcept { return false; }
    // Consecutive runs of one label (the phases of its pattern) are one interval.
    bool leave(volume::Scalar scalar, double from, double to) {
        const std::uint32_t label = labelOf[scalar];
        if (label == volume::kNoLabel || !(from < to)) return false;
        if (!intervals.empty() && intervals.back().label == label && intervals.back().leave == from)
            intervals.back().leave = to;
        else
            intervals.push_back({label, from, to});
        return false;
    }
};

}  // namespace

Result<std::vector<LabelInterval>> labelsAlong(const volume::BrickVolume& bricks, const volume::Grid& grid,
                                               const volume::LabelTable& labels, Vec3d origin, Vec3d direction) {
    if (!isFinite(origin) || !isFinite(direction) || !(length(direction) > 0))
        return Error(Code::BadArgument,
                     fmt::format("a ray from ({}, {}, {}) along ({}, {}, {}): expected finite numbers and a direction "
                                 "that is not zero",
                                 origin.x, origin.y, origin.z, direction.x, direction.y, direction.z));
    const VoxelRay ray(grid.indexFromWorld(origin) + Vec3d{0.5, 0.5, 0.5},
                       grid.indexFromWorldDirection(normalized(direction)));
    const RaySpan span = spanInVolume(ray, bricks.dimension());
    if (!(span.from < span.to)) return std::vector<LabelInterval>{};
    const std::vector<std::uint32_t> labelOf = labels.labelOfScalar();
    Collector collector{labelOf, {}};
    walkRuns(bricks, ray, span.from, span.to, collector);
    return std::move(collector.intervals);
}

}  // namespace svt::render

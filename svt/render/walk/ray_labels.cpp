#include <svt/core/parallel.hpp>
#include <svt/render/ray_labels.hpp>
#include <svt/render/walk/run_walk.hpp>

#include <svt/render/voxel_ray.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace svt::render {
namespace {

struct Collector {
    const std::vector<std::uint32_t>& labelOf;
    std::vector<LabelInterval> intervals;
    std::size_t first = 0;  // of the ray

    [[nodiscard]] bool enter(volume::Scalar, double, const RunStart&) const noexcept { return false; }
    // Consecutive runs of one label (the phases of its pattern) are one interval.
    bool leave(volume::Scalar scalar, double from, double to) {
        const std::uint32_t label = labelOf[scalar];
        if (label == volume::kNoLabel || !(from < to)) return false;
        if (intervals.size() > first && intervals.back().label == label && intervals.back().leave == from)
            intervals.back().leave = to;
        else
            intervals.push_back({label, from, to});
        return false;
    }
};

[[nodiscard]] bool isRay(Vec3d origin, Vec3d direction) noexcept {
    return isFinite(origin) && isFinite(direction) && length(direction) > 0;
}

Error badRay(std::string_view which, Vec3d origin, Vec3d direction) {
    return {Code::BadArgument, fmt::format("{} from ({}, {}, {}) along ({}, {}, {}): expected finite numbers and a "
                                           "direction that is not zero",
                                           which, origin.x, origin.y, origin.z, direction.x, direction.y, direction.z)};
}

void collect(const volume::BrickVolume& bricks, const volume::Grid& grid, Vec3d origin, Vec3d direction,
             Collector& collector) {
    const VoxelRay ray(grid.indexFromWorld(origin) + Vec3d{0.5, 0.5, 0.5},
                       grid.indexFromWorldDirection(normalized(direction)));
    const RaySpan span = spanInVolume(ray, bricks.dimension());
    if (span.from < span.to) walkRuns(bricks, ray, span.from, span.to, collector);
}

}  // namespace

Result<std::vector<LabelInterval>> labelsAlong(const volume::BrickVolume& bricks, const volume::Grid& grid,
                                               const volume::LabelTable& labels, Vec3d origin, Vec3d direction) {
    if (!isRay(origin, direction)) return badRay("a ray", origin, direction);
    const std::vector<std::uint32_t> labelOf = labels.labelOfScalar();
    Collector collector{labelOf, {}};
    collect(bricks, grid, origin, direction, collector);
    return std::move(collector.intervals);
}

Result<RayIntervals> labelsAlongRays(const volume::BrickVolume& bricks, const volume::Grid& grid,
                                     const volume::LabelTable& labels, std::span<const Vec3d> origins,
                                     std::span<const Vec3d> directions, int threads, const Progress* progress) {
    if (directions.size() != origins.size() && directions.size() != 1)
        return Error(Code::BadArgument, fmt::format("{} origins and {} directions; expected one direction for each, or "
                                                    "a single one for all",
                                                    origins.size(), directions.size()));
    const auto directionOf = [&](std::size_t r) { return directions[directions.size() == 1 ? 0 : r]; };
    for (std::size_t r = 0; r < origins.size(); ++r)
        if (!isRay(origins[r], directionOf(r))) return badRay(fmt::format("ray {}", r), origins[r], directionOf(r));
    const std::vector<std::uint32_t> labelOf = labels.labelOfScalar();
    // Rays of a block share one array, so that each does not allocate its own.
    constexpr std::size_t kBlock = 1024;
    const std::size_t blocks = (origins.size() + kBlock - 1) / kBlock;
    std::vector<std::vector<LabelInterval>> found(blocks);
    RayIntervals rays;
    rays.start.resize(origins.size() + 1);
    ProgressCounter done(progress, "rays", blocks);
    parallelFor(blocks, 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end && !Progress::isCancelled(progress); ++b) {
            Collector collector{labelOf, {}};
            for (std::size_t r = b * kBlock; r < std::min((b + 1) * kBlock, origins.size()); ++r) {
                collector.first = collector.intervals.size();
                collect(bricks, grid, origins[r], directionOf(r), collector);
                rays.start[r + 1] = collector.intervals.size() - collector.first;
            }
            found[b] = std::move(collector.intervals);
            done.add();
        }
    });
    if (Progress::isCancelled(progress)) return Error(Code::Cancelled, "the rays were stopped");
    for (std::size_t r = 0; r < origins.size(); ++r) rays.start[r + 1] += rays.start[r];
    rays.intervals.reserve(rays.start.back());
    for (std::vector<LabelInterval>& block : found) {
        rays.intervals.insert(rays.intervals.end(), block.begin(), block.end());
        block = {};
    }
    return rays;
}

}  // namespace svt::render

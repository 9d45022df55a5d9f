#include <svt/pipeline/stages/huge_objects.hpp>

#include <algorithm>
#include <numeric>

namespace svt::pipeline {
namespace {

constexpr double kHuge = 8, kMargin = 10;  // metres

double extentInPlan(const Box3d& box) noexcept { return box.isEmpty() ? 0 : std::max(box.size().x, box.size().y); }

// The objects as a core of those from number `begin` of `order`, and the huge ones before.
ModelCore coreFrom(const mesh::MeshSet& meshes, const Box3d& others, const std::vector<std::uint32_t>& order,
                   std::size_t begin) {
    ModelCore core;
    const double margin = std::max(kMargin, std::max(extentInPlan(others), others.size().z) / 2);
    core.box = {others.min - Vec3d{margin, margin, margin}, others.max + Vec3d{margin, margin, margin}};
    core.huge.assign(order.begin(), order.begin() + std::ptrdiff_t(begin));
    for (std::size_t n = begin; n < order.size(); ++n) core.area += meshes.objects[order[n]].area;
    const Vec3d size = core.box.size();
    core.area += 2 * double(begin) * size.x * size.y;
    return core;
}

}  // namespace

std::optional<ModelCore> coreOf(const mesh::MeshSet& meshes, std::span<const Box3d> boxes) {
    if (boxes.size() < 2) return std::nullopt;
    std::vector<std::uint32_t> order(boxes.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t p, std::uint32_t q) { return extentInPlan(boxes[p]) > extentInPlan(boxes[q]); });
    // The box of all objects from each number on.
    std::vector<Box3d> from(order.size());
    Box3d all;
    for (std::size_t n = order.size(); n-- > 0;) {
        if (!boxes[order[n]].isEmpty()) {
            all.add(boxes[order[n]].min);
            all.add(boxes[order[n]].max);
        }
        from[n] = all;
    }
    const std::size_t most = std::max<std::size_t>(1, order.size() / 20);
    for (std::size_t n = 1; n <= most && n < order.size(); ++n) {
        if (from[n].isEmpty()) return std::nullopt;
        if (extentInPlan(boxes[order[n - 1]]) >= kHuge * extentInPlan(from[n]))
            return coreFrom(meshes, from[n], order, n);
    }
    return std::nullopt;
}

}  // namespace svt::pipeline

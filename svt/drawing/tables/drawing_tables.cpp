#include <svt/drawing/drawing_tables.hpp>

#include <svt/drawing/dimension/part_roles.hpp>
#include <svt/drawing/hatches.hpp>
#include <svt/drawing/room_floor_areas.hpp>
#include <svt/drawing/stair_flights.hpp>
#include <svt/model/classes.hpp>
#include <svt/plane/hull.hpp>

#include <algorithm>
#include <utility>

namespace svt::drawing {
namespace {

using volume::Filling;
using volume::kNoLabel;

std::vector<LabelFacts> factsOf(const volume::LabelTable& table) {
    std::vector<LabelFacts> facts(table.labels.size());
    for (std::uint32_t l = 0; l < facts.size(); ++l) {
        const volume::Label& label = table.labels[l];
        const bool isSurface = model::isBoundarySurface(label.className);
        const model::ClassRank rank = model::classRank(label.className);
        LabelFacts& of = facts[l];
        of.isSpace = model::isSpace(label.className);
        of.isClosed = label.filling >= Filling::Solid && label.filling <= Filling::Capped;
        of.isSheet = isSurface && label.filling == Filling::Surface;
        of.isElement = rank >= model::ClassRank::Element;
        of.isBuilding = rank == model::ClassRank::Building;
        if (label.parent != kNoLabel && label.count > 0 && isSurface) facts[label.parent].hasSurfaces = true;
    }
    for (std::uint32_t l = 0; l < facts.size(); ++l) {
        std::uint32_t top = l;
        while (top != kNoLabel && !facts[top].isBuilding) top = table.labels[top].parent;
        facts[l].building = top;
    }
    const std::vector<std::uint32_t> stairs = stairOfLabels(table);
    for (std::uint32_t l = 0; l < facts.size(); ++l) facts[l].isStair = stairs[l] != kNoLabel;
    return facts;
}

std::vector<MeshRun> runsOf(const volume::VectorParts& parts) {
    std::vector<MeshRun> runs;
    for (std::uint32_t t = 0; t < parts.triangles.size(); ++t) {
        const auto& triangle = parts.triangles[t];
        const Vec3i first = parts.points[triangle.corners[0]];
        if (runs.empty() || runs.back().label != triangle.label || t - runs.back().first == MeshRun::kMostTriangles)
            runs.push_back({triangle.label, t, t, first, first});
        MeshRun& run = runs.back();
        run.end = t + 1;
        for (const std::uint32_t corner : triangle.corners)
            for (int axis = 0; axis < 3; ++axis) {
                run.low[axis] = std::min(run.low[axis], parts.points[corner][axis]);
                run.high[axis] = std::max(run.high[axis], parts.points[corner][axis]);
            }
    }
    return runs;
}

// The convex hull in plan.
std::vector<Vec3d> hullInPlan(std::vector<Vec3d> points) {
    const auto isLess = [](Vec3d a, Vec3d b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
    const auto isSame = [](Vec3d a, Vec3d b) { return a.x == b.x && a.y == b.y; };
    std::sort(points.begin(), points.end(), isLess);
    points.erase(std::unique(points.begin(), points.end(), isSame), points.end());
    if (points.size() < 3) return points;
    const auto at = [](Vec3d p) { return p; };
    std::vector<Vec3d> lower = plane::hullChain(points, 1, at), upper = plane::hullChain(points, -1, at);
    for (std::size_t n = upper.size() - 2; n > 0; --n) lower.push_back(upper[n]);
    return lower;
}

PlanHulls plansOf(const volume::SemanticVolume& volume, const std::vector<MeshRun>& runs) {
    const volume::VectorParts& parts = volume.vectors;
    const auto axes = volume.grid.axes();
    PlanHulls plans;
    plans.labels.resize(volume.labels.labels.size());
    std::vector<Vec3d> points;
    for (std::uint32_t run = 0; run < runs.size();) {
        const std::uint32_t label = runs[run].label;
        MeshPlan& plan = plans.labels[label];
        plan = {run, run, static_cast<std::uint32_t>(plans.points.size()), 0, kInfinity, -kInfinity};
        points.clear();
        for (; run < runs.size() && runs[run].label == label; ++run) {
            for (std::uint32_t t = runs[run].first; t < runs[run].end; ++t)
                for (const std::uint32_t corner : parts.triangles[t].corners) {
                    const Vec3d p = parts.position(corner, {});
                    points.push_back({dot(p, axes[0]), dot(p, axes[1]), 0});
                    plan.low = std::min(plan.low, dot(p, axes[2]));
                    plan.high = std::max(plan.high, dot(p, axes[2]));
                }
            points = hullInPlan(std::move(points));
        }
        plan.endRun = run;
        plans.points.insert(plans.points.end(), points.begin(), points.end());
        plan.endPoint = static_cast<std::uint32_t>(plans.points.size());
    }
    return plans;
}

}  // namespace

std::pair<double, double> MeshRun::rangeAlong(Vec3d direction) const noexcept {
    double from = 0, to = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = direction[axis] * low[axis], b = direction[axis] * high[axis];
        from += std::min(a, b);
        to += std::max(a, b);
    }
    return {from, to};
}

const std::vector<HatchChoice>& DrawingTables::hatchChoices() const {
    const std::lock_guard lock(mutex_);
    if (!hatchChoices_) hatchChoices_ = std::make_shared<const std::vector<HatchChoice>>(chooseHatches(volume_.labels));
    return *hatchChoices_;
}

std::shared_ptr<const std::vector<render::Hatch>> DrawingTables::hatches() const {
    const std::vector<HatchChoice>& choices = hatchChoices();
    const std::lock_guard lock(mutex_);
    if (hatches_) return hatches_;
    std::vector<render::Hatch> hatches;
    for (const HatchChoice& choice : choices) hatches.push_back(choice.hatch);
    hatches_ = std::make_shared<const std::vector<render::Hatch>>(std::move(hatches));
    return hatches_;
}

const std::vector<PartRole>& DrawingTables::roles() const {
    const std::lock_guard lock(mutex_);
    if (!roles_) roles_ = partRoles(volume_.labels);
    return *roles_;
}

const std::vector<std::optional<double>>& DrawingTables::roomAreas() const {
    const std::lock_guard lock(mutex_);
    if (!roomAreas_) roomAreas_ = roomFloorAreas(volume_);
    return *roomAreas_;
}

const std::vector<LabelFacts>& DrawingTables::facts() const {
    const std::lock_guard lock(mutex_);
    if (!facts_) facts_ = factsOf(volume_.labels);
    return *facts_;
}

const std::vector<MeshRun>& DrawingTables::runs() const {
    const std::lock_guard lock(mutex_);
    if (!runs_) runs_ = runsOf(volume_.vectors);
    return *runs_;
}

Result<const volume::BrickVolume*> DrawingTables::bricks(int threads) const {
    const std::lock_guard lock(mutex_);
    if (!bricks_) {
        SVT_TRY(made,
                volume::BrickVolume::fromColumns(volume_.columns, {.planes = volume_.planes, .threads = threads}));
        bricks_ = std::move(*made);
    }
    return &*bricks_;
}

const PlanHulls& DrawingTables::plans() const {
    const std::vector<MeshRun>& own = runs();
    const std::lock_guard lock(mutex_);
    if (!plans_) plans_ = plansOf(volume_, own);
    return *plans_;
}

}  // namespace svt::drawing

#include <svt/drawing/drawing_tables.hpp>

#include <svt/core/hash.hpp>
#include <svt/drawing/dimension/part_roles.hpp>
#include <svt/drawing/hatches.hpp>
#include <svt/drawing/room_floor_areas.hpp>
#include <svt/drawing/stair_flights.hpp>
#include <svt/model/classes.hpp>
#include <svt/plane/hull.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>
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
        of.isClosed = volume::hasClosedMesh(label.filling);
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

class PlanMaker {
public:
    PlanMaker(const volume::SemanticVolume& volume, const std::vector<MeshRun>& runs)
        : parts_(volume.vectors), axes_(volume.grid.axes()), runs_(runs) {
        plans_.labels.resize(volume.labels.labels.size());
    }

    PlanHulls run() {
        for (std::uint32_t first = 0; first < runs_.size();) {
            const std::uint32_t label = runs_[first].label;
            std::uint32_t end = first;
            while (end < runs_.size() && runs_[end].label == label) ++end;
            plans_.labels[label] = {first, end, 0, 0, kInfinity, -kInfinity, 0};
            addHeights(plans_.labels[label]);
            addShape(label);
            first = end;
        }
        return std::move(plans_);
    }

private:
    template <class Body>
    void forCorners(const MeshPlan& plan, const Body& body) const {
        for (std::uint32_t t = runs_[plan.firstRun].first; t < runs_[plan.endRun - 1].end; ++t)
            for (const std::uint32_t corner : parts_.triangles[t].corners) body(corner);
    }
    [[nodiscard]] Vec3d inPlan(std::uint32_t corner) const noexcept {
        const Vec3d p = parts_.position(corner, {});
        return {dot(p, axes_[0]), dot(p, axes_[1]), 0};
    }

    [[nodiscard]] double heightOf(std::uint32_t corner) const noexcept {
        return dot(parts_.position(corner, {}), axes_[2]);
    }

    void addHeights(MeshPlan& plan) const {
        forCorners(plan, [&](std::uint32_t corner) {
            const double height = heightOf(corner);
            plan.low = std::min(plan.low, height);
            plan.high = std::max(plan.high, height);
        });
    }

    // Finds an earlier label of the same shape, or makes the hull.
    void addShape(std::uint32_t label) {
        MeshPlan& plan = plans_.labels[label];
        std::uint64_t hash = 0;
        forCorners(plan, [&](std::uint32_t corner) {
            const Vec3d p = inPlan(corner);
            hash = mixHash(mixHash(hash, std::bit_cast<std::uint64_t>(p.x)), std::bit_cast<std::uint64_t>(p.y));
        });
        constexpr int kMostTried = 8;
        const auto [first, end] = labelsOfHash_.equal_range(hash);
        int tried = 0;
        for (auto known = first; known != end && tried < kMostTried; ++known, ++tried) {
            const MeshPlan& other = plans_.labels[known->second];
            if (!isSame(plan, other)) continue;
            plan.firstPoint = other.firstPoint;
            plan.endPoint = other.endPoint;
            plan.shape = other.shape;
            return;
        }
        labelsOfHash_.emplace(hash, label);
        plan.shape = plans_.shapes++;
        addHull(plan);
    }

    // Whether one mesh is the other one at another height.
    [[nodiscard]] bool isSame(const MeshPlan& a, const MeshPlan& b) const {
        const auto& triangles = parts_.triangles;
        const std::uint32_t first = runs_[a.firstRun].first, end = runs_[a.endRun - 1].end;
        const std::uint32_t other = runs_[b.firstRun].first;
        if (runs_[b.endRun - 1].end - other != end - first) return false;
        const double rounding = 2.5 * parts_.unit;
        for (std::uint32_t t = 0; t < end - first; ++t)
            for (std::size_t n = 0; n < 3; ++n) {
                const std::uint32_t one = triangles[first + t].corners[n], two = triangles[other + t].corners[n];
                const Vec3d p = inPlan(one), q = inPlan(two);
                if (p.x != q.x || p.y != q.y) return false;
                if (!(std::abs((heightOf(one) - a.low) - (heightOf(two) - b.low)) <= rounding)) return false;
            }
        return true;
    }

    void addHull(MeshPlan& plan) {
        std::vector<Vec3d> points;
        for (std::uint32_t run = plan.firstRun; run < plan.endRun; ++run) {
            for (std::uint32_t t = runs_[run].first; t < runs_[run].end; ++t)
                for (const std::uint32_t corner : parts_.triangles[t].corners) points.push_back(inPlan(corner));
            points = hullInPlan(std::move(points));
        }
        plan.firstPoint = static_cast<std::uint32_t>(plans_.points.size());
        plans_.points.insert(plans_.points.end(), points.begin(), points.end());
        plan.endPoint = static_cast<std::uint32_t>(plans_.points.size());
    }

    const volume::VectorParts& parts_;
    const std::array<Vec3d, 3> axes_;
    const std::vector<MeshRun>& runs_;
    PlanHulls plans_;
    std::unordered_multimap<std::uint64_t, std::uint32_t> labelsOfHash_;  // of different shapes
};

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

const std::vector<RoomShare>& DrawingTables::roomShares() const {
    const std::lock_guard lock(mutex_);
    if (!roomShares_) roomShares_ = std::make_shared<const std::vector<RoomShare>>(drawing::roomShares(volume_));
    return *roomShares_;
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
    if (!plans_) plans_ = PlanMaker(volume_, own).run();
    return *plans_;
}

}  // namespace svt::drawing

#include <svt/validate/run/indoor_checks.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

namespace svt::validate {
namespace {

using model::Feature;
using model::FeatureIndex;

std::string textOf(const Feature& feature, std::string_view name) {
    for (const Attribute& attribute : feature.attributes)
        if (attribute.name == name) return toText(attribute.value);
    return {};
}

Box3d boundsOf(const SolidBodies& cell) {
    Box3d box;
    for (const Body& body : cell.solids) box.add(body.tree().bounds());
    return box;
}

class CellChecker {
public:
    CellChecker(const model::BuildingModel& model, const Lattice& lattice, const ValidateOptions& options,
                const std::vector<SolidBodies>& cells)
        : model_(model),
          lattice_(lattice),
          cells_(cells),
          snap_(options.snap / lattice.unit()),
          overlap_(std::max({options.snap, 2 * options.overlap, 4 * lattice.unit()}) / lattice.unit()) {
        for (FeatureIndex f = 0; f < model.features.size(); ++f) byId_.emplace(model.features[f].id, f);
        for (std::size_t c = 0; c < cells.size(); ++c) cellOf_.emplace(cells[c].feature, c);
        for (const model::Membership& membership : model.memberships)
            layersOf_[membership.member].insert(membership.group);
    }

    GroupReport run() {
        compareCells();
        for (const model::Polyline& line : model_.lines)
            if (line.points.size() == 1) checkState(line.feature, line.points.front());
        for (FeatureIndex f = 0; f < model_.features.size(); ++f)
            if (model_.features[f].className == "Transition") checkTransition(f);
        for (const FeatureIndex feature : invalid_) report_.features.emplace_back(feature, false);
        return std::move(report_);
    }

private:
    Finding* add(Code code, const SolidBodies& cell, Vec3d at, std::string message) {
        invalid_.insert(cell.feature);
        if (report_.counts[code]++ >= Finding::kKeptPerCode) return nullptr;
        Finding& finding = report_.findings.emplace_back();
        finding.code = code;
        finding.feature = cell.feature;
        finding.geometry = cell.geometry;
        finding.at = at;
        finding.message = std::move(message);
        return &finding;
    }

    [[nodiscard]] bool mayOverlap(FeatureIndex a, FeatureIndex b) const {
        const auto one = layersOf_.find(a), other = layersOf_.find(b);
        if (one == layersOf_.end() || other == layersOf_.end()) return false;
        return std::none_of(one->second.begin(), one->second.end(),
                            [&](FeatureIndex layer) { return other->second.count(layer) != 0; });
    }

    // Pairs whose boxes meet.
    void compareCells() {
        std::vector<Box3d> boxes;
        for (const SolidBodies& cell : cells_) boxes.push_back(boundsOf(cell));
        const plane::BoxTree tree(boxes);
        for (std::size_t a = 0; a < cells_.size(); ++a)
            for (const std::uint32_t b : tree.findAll(boxes[a]))
                if (b > a && !mayOverlap(cells_[a].feature, cells_[b].feature)) comparePair(cells_[a], cells_[b]);
    }

    void comparePair(const SolidBodies& one, const SolidBodies& other) {
        for (const Body& a : one.solids)
            for (const Body& b : other.solids) {
                const auto conflict = findConflict(a, b, overlap_);
                if (!conflict) continue;
                const std::string& id = model_.features[other.feature].id;
                Finding* finding =
                    add(Code::CellsOverlap, one, lattice_.toWorld(conflict->at),
                        conflict->areSame ? fmt::format("the cell space is the same as '{}'", id)
                                          : fmt::format("the cell space overlaps with '{}', by {:.3f} m or more", id,
                                                        *conflict->depth * lattice_.unit()));
                if (finding == nullptr) return;
                if (conflict->depth) finding->value = *conflict->depth * lattice_.unit();
                for (const Corners& t : b.triangles())
                    if (finding->marks.size() < kLargestDefectCount)
                        finding->marks.push_back({b.points().world(t[0]), b.points().world(t[1])});
                return;
            }
    }

    [[nodiscard]] const SolidBodies* cellOfState(FeatureIndex state) const {
        const auto cell = byId_.find(textOf(model_.features[state], "duality"));
        if (cell == byId_.end()) return nullptr;
        const auto found = cellOf_.find(cell->second);
        return found == cellOf_.end() ? nullptr : &cells_[found->second];
    }

    // Distance of a point from a cell, metres; 0 inside and on its surface.
    [[nodiscard]] double distanceTo(const SolidBodies& cell, Vec3d world) const {
        const Box3d box = boundsOf(cell);
        const Vec3d low = lattice_.toWorld(box.min), high = lattice_.toWorld(box.max);
        Vec3d beyond{};
        for (int axis = 0; axis < 3; ++axis)
            beyond[axis] = std::max({low[axis] - world[axis], world[axis] - high[axis], 0.0});
        if (length(beyond) > snap_ * lattice_.unit()) return length(beyond);
        const Vec3d p = Lattice::local(lattice_.toLattice(world));
        for (const Body& body : cell.solids)
            if (body.near(p, snap_ + 1, {0, 0, 1}) || body.encloses(p)) return 0;
        const double reach = length(high - low) / lattice_.unit() + snap_;
        double nearest = reach;
        for (const Body& body : cell.solids)
            if (const auto near = body.near(p, reach, {0, 0, 1})) nearest = std::min(nearest, near->distance);
        return nearest * lattice_.unit();
    }

    void checkState(FeatureIndex state, Vec3d at) {
        if (model_.features[state].className != "State") return;
        const SolidBodies* cell = cellOfState(state);
        if (cell == nullptr) return;
        const double distance = distanceTo(*cell, at);
        if (!(distance > 0)) return;
        Finding* finding =
            add(Code::StateOutsideCell, *cell, at,
                fmt::format("its state '{}' lies {:.3f} m outside", model_.features[state].id, distance));
        if (finding != nullptr) finding->value = distance;
    }

    void checkTransition(FeatureIndex index) {
        const Feature& transition = model_.features[index];
        const auto from = byId_.find(textOf(transition, "from")), to = byId_.find(textOf(transition, "to"));
        if (from == byId_.end() || to == byId_.end()) return;
        const SolidBodies *one = cellOfState(from->second), *other = cellOfState(to->second);
        if (one == nullptr || other == nullptr || one == other) return;
        const double reach = std::ceil(snap_) + 1;
        for (const Body& a : one->solids)
            for (const Body& b : other->solids) {
                if (!plane::grown(a.tree().bounds(), reach).overlaps(b.tree().bounds())) continue;
                const Relation relation = relate(a, b, snap_);
                if (relation.haveContact || relation.shareFaces() || relation.overlap()) return;
            }
        if (one->feature > other->feature) std::swap(one, other);
        Finding* finding = add(Code::CellsNotAdjacent, *one, middleOf(index, *one),
                               fmt::format("the transition '{}' leads to the cell space '{}', which it does not touch",
                                           transition.id, model_.features[other->feature].id));
        if (finding == nullptr) return;
        for (const model::Polyline& line : model_.lines)
            for (std::size_t i = 1; line.feature == index && i < line.points.size(); ++i)
                finding->marks.push_back({line.points[i - 1], line.points[i]});
    }

    [[nodiscard]] Vec3d middleOf(FeatureIndex transition, const SolidBodies& cell) const {
        for (const model::Polyline& line : model_.lines)
            if (line.feature == transition && line.points.size() > 1)
                return (line.points[line.points.size() / 2 - 1] + line.points[line.points.size() / 2]) * 0.5;
        const Box3d box = boundsOf(cell);
        return (lattice_.toWorld(box.min) + lattice_.toWorld(box.max)) * 0.5;
    }

    const model::BuildingModel& model_;
    const Lattice& lattice_;
    const std::vector<SolidBodies>& cells_;
    double snap_, overlap_;  // units
    std::unordered_map<std::string, FeatureIndex> byId_;
    std::unordered_map<FeatureIndex, std::size_t> cellOf_;
    std::unordered_map<FeatureIndex, std::set<FeatureIndex>> layersOf_;
    std::set<FeatureIndex> invalid_;
    GroupReport report_;
};

}  // namespace

bool isCellSpace(const Feature& feature) {
    return std::any_of(feature.attributes.begin(), feature.attributes.end(),
                       [](const Attribute& attribute) { return attribute.name == "cellSpaceClass"; });
}

GroupReport checkCells(const model::BuildingModel& model, const Lattice& lattice, const ValidateOptions& options,
                       const std::vector<SolidBodies>& cells) {
    return CellChecker(model, lattice, options, cells).run();
}

}  // namespace svt::validate

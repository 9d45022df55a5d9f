#include <svt/drawing/beyond/labels_in_view.hpp>

#include <svt/drawing/beyond/covered_region.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace svt::drawing {
namespace {

constexpr double kApart = 0.01;      // metres of depth between faces and the labels that they cover
constexpr double kNearLayer = 4;     // metres of depth that are projected at once
constexpr double kMostOfNear = 0.4;  // of the faces in this layer, by area: the depth that is searched first

// A label in front of the eye.
struct LabelInDepth {
    std::uint32_t label = 0;
    std::uint32_t triangles = 0;
    double least = 0, deepest = 0;  // metres behind the plane
};

class LabelSearch {
public:
    LabelSearch(const volume::SemanticVolume& volume, const SectionDrawing& drawing, const ViewOptions& view,
                const DrawingTables& tables, MeshProjection& projection)
        : parts_(volume.vectors),
          table_(volume.labels),
          axes_(drawing.axes),
          away_(drawing.plane.normal * (view.looksAtCut ? 1.0 : -1.0)),
          base_(volume.grid.origin() - drawing.axes.origin),
          runs_(tables.runs()),
          facts_(tables.facts()),
          plans_(tables.plans()),
          projection_(projection),
          isNeeded_(volume.labels.labels.size(), 0) {}

    std::vector<std::uint8_t> run(const SectionDrawing& drawing, double depth) {
        findLabels();
        if (depth > 0) leaveOutBeyond(depth);
        leaveOutCopies();
        for (const LabelInDepth& label : labels_) isNeeded_[label.label] = 1;
        double reach = depth > 0 ? depth : kNearLayer;
        addNearer(-kInfinity, reach);
        double layer = layerOfFaces(reach), before = -1;
        CoveredRegion region(drawing, facts_);
        for (bool isFirst = true;; isFirst = false) {
            std::erase_if(labels_, [&](const LabelInDepth& label) { return label.least <= reach + kApart; });
            if (!isWorthwhile()) break;
            region.add(projection_.faces(), before, layer);
            if ((leaveOutCovered(region) == 0 && !isFirst) || depth > 0 || !isWorthwhile()) break;
            before = layer;
            layer = 2 * reach;
            addNearer(std::exchange(reach, layer), layer);
        }
        return std::move(isNeeded_);
    }

private:
    void findLabels() {
        const double base = dot(base_, away_);
        for (std::uint32_t run = 0; run < runs_.size();) {
            LabelInDepth found{runs_[run].label, 0, kInfinity, -kInfinity};
            for (; run < runs_.size() && runs_[run].label == found.label; ++run) {
                const auto [low, high] = runs_[run].rangeAlong(away_);
                found.least = std::min(found.least, low * parts_.unit + base);
                found.deepest = std::max(found.deepest, high * parts_.unit + base);
                found.triangles += runs_[run].end - runs_[run].first;
            }
            if (found.deepest >= -kApart && projection_.isShown(found.label)) labels_.push_back(found);
        }
    }

    // Lines that begin deeper are not drawn. Their faces may hide the ends of others, which begin before and reach
    // deeper.
    void leaveOutBeyond(double depth) {
        double deepest = depth;
        for (const LabelInDepth& label : labels_)
            if (label.least <= depth + kApart) deepest = std::max(deepest, label.deepest);
        std::erase_if(labels_, [&](const LabelInDepth& label) { return label.least > deepest + kApart; });
    }

    // A closed object hides its copies that lie deeper, and all that these hide: parts of equal storeys.
    void leaveOutCopies() {
        std::vector<double> nearest(plans_.shapes, kInfinity);
        const auto isWhole = [&](const LabelInDepth& label) {
            return label.least > kApart && !facts_[label.label].isSpace &&
                   table_.labels[label.label].filling == volume::Filling::Solid;
        };
        const auto nearestOf = [&](const LabelInDepth& label) -> double& {
            return nearest[plans_.labels[label.label].shape];
        };
        for (const LabelInDepth& label : labels_)
            if (isWhole(label)) nearestOf(label) = std::min(nearestOf(label), label.least);
        std::erase_if(labels_, [&](const LabelInDepth& label) { return label.least > nearestOf(label) + kApart; });
    }

    // Projects the labels that begin in the depths (from, to].
    void addNearer(double from, double to) {
        for (const LabelInDepth& label : labels_)
            if (label.least > from + kApart && label.least <= to + kApart) {
                projection_.add(label.label);
                projected_ += label.triangles;
            }
    }

    // A depth within which much of the projected area lies: that of the slab below.
    [[nodiscard]] double layerOfFaces(double reach) const {
        std::vector<std::pair<double, double>> areas;  // by depth
        double all = 0;
        for (const ViewFace& face : projection_.faces()) {
            double deepest = 0, twice = 0;
            for (std::uint32_t n = 0; n < face.cornerCount; ++n) {
                const Vec3d a = face.corners[n], b = face.corners[n + 1 < face.cornerCount ? n + 1 : 0];
                deepest = std::max(deepest, a.z);
                twice += a.x * b.y - a.y * b.x;
            }
            if (deepest > reach) continue;
            areas.emplace_back(deepest, twice);
            all += twice;
        }
        std::sort(areas.begin(), areas.end());
        double sum = 0;
        for (const auto& [deepest, twice] : areas)
            if ((sum += twice) >= kMostOfNear * all) return deepest;
        return reach;
    }

    // The faces near the eye cost more than a few labels behind them.
    [[nodiscard]] bool isWorthwhile() const {
        std::size_t behind = 0;
        for (const LabelInDepth& label : labels_) behind += label.triangles;
        return 2 * behind > projected_;
    }

    // Returns the number of labels that the region covers.
    std::size_t leaveOutCovered(CoveredRegion& region) {
        std::vector<std::optional<bool>> isShapeCovered(plans_.shapes);
        return std::erase_if(labels_, [&](const LabelInDepth& label) {
            auto& known = isShapeCovered[plans_.labels[label.label].shape];
            if (!known) known = isHullCovered(label, region);
            if (*known) isNeeded_[label.label] = 0;
            return *known;
        });
    }

    [[nodiscard]] bool isHullCovered(const LabelInDepth& label, CoveredRegion& region) const {
        const PlanePoint shift{dot(base_, axes_.u), dot(base_, axes_.v)};
        Ring ring;
        for (const Vec3d p : plans_.of(label.label)) ring.push_back({p.x + shift.u, p.y + shift.v});
        return region.contains(ring);
    }

    const volume::VectorParts& parts_;
    const volume::LabelTable& table_;
    const PlaneAxes& axes_;
    Vec3d away_, base_;  // depth; from the axes' origin to that of the points
    const std::vector<MeshRun>& runs_;
    const std::vector<LabelFacts>& facts_;
    const PlanHulls& plans_;
    MeshProjection& projection_;
    std::vector<std::uint8_t> isNeeded_;
    std::vector<LabelInDepth> labels_;  // those that may be left out
    std::size_t projected_ = 0;         // triangles
};

}  // namespace

std::vector<std::uint8_t> labelsInView(const volume::SemanticVolume& volume, const SectionDrawing& drawing,
                                       const ViewOptions& view, double depth, const DrawingTables& tables,
                                       MeshProjection& projection) {
    const bool isPlan = std::abs(dot(drawing.plane.normal, volume.grid.axes()[2])) > 1 - 1e-12;
    if (!isPlan || view.everyEdge) return {};
    return LabelSearch(volume, drawing, view, tables, projection).run(drawing, depth);
}

}  // namespace svt::drawing

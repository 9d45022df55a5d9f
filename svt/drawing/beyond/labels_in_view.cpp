#include <svt/drawing/beyond/labels_in_view.hpp>

#include <svt/drawing/beyond/line_parts.hpp>
#include <svt/drawing/beyond/plane_index.hpp>
#include <svt/plane/regions.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace svt::drawing {
namespace {

constexpr double kMeetTolerance = 8e-6;  // metres, as in exact sections
constexpr double kInsideBorder = 3e-5;   // metres: lines this near to a border of faces or of the cut are not drawn
constexpr double kAroundThin = 2e-4;     // metres: of sheets that stand upright, and where their lines would be seen
constexpr double kApart = 0.01;          // metres of depth between faces and the labels that they cover
constexpr double kLeastFacing = 0.1;     // cosine: steeper faces do not count as cover
constexpr double kNearLayer = 4;         // metres of depth that are searched for faces first
constexpr std::uint32_t kIsCovered = 1;

// The common outline of cut components and faces.
class CoveredPlan {
public:
    // \param farthest  faces that reach deeper do not count
    CoveredPlan(const SectionDrawing& drawing, const std::vector<ViewFace>& faces, double farthest,
                const std::vector<LabelFacts>& facts) {
        for (const SectionComponent& component : drawing.components) {
            if (facts[component.label].isSpace) continue;
            for (const SectionPolygon& polygon : component.polygons) {
                addRing(polygon.outer);
                for (const Ring& hole : polygon.holes) addRing(hole);
            }
        }
        for (const ViewFace& face : faces) {
            double deepest = 0;
            Ring ring;
            for (std::uint32_t n = 0; n < face.cornerCount; ++n) {
                deepest = std::max(deepest, face.corners[n].z);
                ring.push_back({face.corners[n].x, face.corners[n].y});
            }
            if (deepest <= farthest && face.normal.z > kLeastFacing) addRing(ring);
        }
        arrange();
    }

    // Whether a convex polygon lies within the outline.
    [[nodiscard]] bool contains(std::span<const Vec3d> hull, PlanePoint shift) {
        if (borders_.empty() || hull.size() < 2) return false;
        Ring ring;
        PlanePoint middle;
        for (const Vec3d p : hull) {
            ring.push_back({p.x + shift.u, p.y + shift.v});
            middle = {middle.u + ring.back().u / double(hull.size()), middle.v + ring.back().v / double(hull.size())};
        }
        const double slack = isThin(ring) ? -kAroundThin : kInsideBorder;
        if (!isWithin(ring, middle, middle, slack)) return false;
        bool isCrossed = false;
        index_->visitNear(ring, seen_, [&](std::uint32_t item) {
            isCrossed = isWithin(ring, borders_[2 * item], borders_[2 * item + 1], slack);
            return !isCrossed;
        });
        return !isCrossed && isCovered(middle);
    }

private:
    void addRing(const Ring& ring) {
        for (std::size_t n = 0; n < ring.size(); ++n) rings_.emplace_back(ring[n], ring[(n + 1) % ring.size()]);
    }

    void arrange() {
        double extent = 1e-3;
        for (const auto& [a, b] : rings_) extent = std::max({extent, std::abs(a.u), std::abs(a.v)});
        const double unit = std::ldexp(1.0, std::ilogb(extent) + 1 - 28);
        const auto placed = [&](PlanePoint p) {
            return plane::Point{std::llround(p.u / unit), std::llround(p.v / unit)};
        };
        std::vector<plane::ClaimSegment> segments;
        for (const auto& [a, b] : rings_) segments.push_back({placed(a), placed(b), kIsCovered, 1});
        const auto arranged = plane::arrangeSegments(
            segments, std::max(2, static_cast<std::int32_t>(std::lround(kMeetTolerance / unit))));
        if (!arranged) return;
        const auto sides = plane::sweepRegions(*arranged, [](std::span<const plane::ClaimCount> counts) {
            return !counts.empty() && counts.front().winding > 0 ? kIsCovered : 0u;
        });
        std::vector<std::uint32_t> starts{0};
        for (std::size_t e = 0; e < sides.size(); ++e) {
            if (sides[e].left == sides[e].right) continue;
            for (const plane::Point p : {arranged->edges[e].from, arranged->edges[e].to})
                borders_.push_back({double(p.u) * unit, double(p.v) * unit});
            starts.push_back(static_cast<std::uint32_t>(borders_.size()));
            leftmost_ = std::min(leftmost_, borders_.back().u - 1);
            leftmost_ = std::min(leftmost_, borders_[borders_.size() - 2].u - 1);
        }
        index_.emplace(borders_, starts, 2 * kAroundThin);
    }

    // Whether a line has a part within a convex ring, at least `slack` from its sides.
    [[nodiscard]] static bool isWithin(const Ring& ring, PlanePoint from, PlanePoint to, double slack) {
        LinePart part;
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
            const double eu = b.u - a.u, ev = b.v - a.v, side = std::hypot(eu, ev);
            if (!(side > 0)) continue;
            const auto distance = [&](PlanePoint p) { return (eu * (p.v - a.v) - ev * (p.u - a.u)) / side - slack; };
            if (!clipPart(part, distance(from), distance(to) - distance(from))) return false;
            // A sheet that stands upright has two sides, which do not bound it along itself.
            const auto before = [&](PlanePoint p) { return (eu * (p.u - a.u) + ev * (p.v - a.v)) / side - slack; };
            if (ring.size() == 2 && !clipPart(part, before(from), before(to) - before(from))) return false;
        }
        return true;
    }

    [[nodiscard]] static bool isThin(const Ring& ring) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
            const double eu = b.u - a.u, ev = b.v - a.v, side = std::hypot(eu, ev);
            double farthest = 0;
            for (const PlanePoint p : ring) farthest = std::max(farthest, (eu * (p.v - a.v) - ev * (p.u - a.u)) / side);
            if (!(farthest > 2 * kAroundThin)) return true;
        }
        return false;
    }

    // By the number of borders to the left.
    [[nodiscard]] bool isCovered(PlanePoint p) {
        bool isInside = false;
        index_->visitNear({leftmost_, p.v}, p, seen_, [&](std::uint32_t item) {
            const PlanePoint a = borders_[2 * item], b = borders_[2 * item + 1];
            if ((a.v > p.v) != (b.v > p.v) && a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u) < p.u) isInside = !isInside;
            return true;
        });
        return isInside;
    }

    std::vector<std::pair<PlanePoint, PlanePoint>> rings_;
    std::vector<PlanePoint> borders_;  // two each
    double leftmost_ = 0;
    std::optional<PlaneIndex> index_;
    PlaneIndex::Seen seen_;
};

}  // namespace

std::vector<std::uint8_t> labelsInView(const volume::SemanticVolume& volume, const SectionDrawing& drawing,
                                       std::span<const std::uint8_t> isDrawn, const ViewOptions& view, double depth,
                                       const DrawingTables& tables) {
    const volume::Grid& grid = volume.grid;
    const Vec3d up = grid.axes()[2];
    const bool isPlan = std::abs(dot(drawing.plane.normal, up)) > 1 - 1e-12;
    if (!isPlan || view.everyEdge) return {};
    const bool looksUp = (dot(drawing.plane.normal, up) > 0) == view.looksAtCut;
    const double cut = dot(drawing.plane.point - grid.origin(), up);
    const PlanHulls& plans = tables.plans();
    const Vec3d toDrawing = grid.origin() - drawing.axes.origin;
    const PlanePoint shift{dot(toDrawing, drawing.axes.u), dot(toDrawing, drawing.axes.v)};
    const auto leastDepth = [&](std::uint32_t l) {
        return looksUp ? plans.labels[l].low - cut : cut - plans.labels[l].high;
    };
    const auto deepest = [&](std::uint32_t l) {
        return looksUp ? plans.labels[l].high - cut : cut - plans.labels[l].low;
    };
    std::vector<std::uint32_t> far;
    std::vector<std::uint8_t> isNeeded(plans.labels.size(), 0);
    for (std::uint32_t l = 0; l < isNeeded.size(); ++l) {
        if (plans.labels[l].firstRun == plans.labels[l].endRun || deepest(l) < -kApart) continue;
        isNeeded[l] = 1;
        far.push_back(l);
    }
    for (double layer = depth > 0 ? depth : kNearLayer;; layer *= 2) {
        std::erase_if(far, [&](std::uint32_t l) { return isNeeded[l] == 0 || leastDepth(l) <= layer + kApart; });
        std::vector<std::uint8_t> isNear = isNeeded;
        for (const std::uint32_t l : far) isNear[l] = 0;
        const auto near = static_cast<std::size_t>(std::count(isNear.begin(), isNear.end(), 1));
        // The faces cost more than they spare.
        if (2 * far.size() <= near || far.empty()) return isNeeded;
        const ViewShapes shapes = projectMeshes(volume, drawing.plane, drawing.axes, isDrawn, view, tables, isNear);
        CoveredPlan covered(drawing, shapes.faces, layer, tables.facts());
        bool isUseful = layer == kNearLayer;
        for (const std::uint32_t l : far)
            if (covered.contains(plans.of(l), shift)) {
                isNeeded[l] = 0;
                isUseful = true;
            }
        if (depth > 0 || !isUseful) return isNeeded;
    }
}

}  // namespace svt::drawing

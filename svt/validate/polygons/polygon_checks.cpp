#include <svt/validate/polygons/polygon_checks.hpp>

#include <svt/plane/box_tree.hpp>
#include <svt/plane/edges.hpp>
#include <svt/validate/exact/snapper.hpp>
#include <svt/validate/polygons/groups.hpp>
#include <svt/validate/polygons/plane_fit.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace svt::validate {
namespace {

// Steps of the lattice within which a point lies on a line: the largest error of rounding to the lattice.
constexpr double kNoise = 2;

struct Ring {
    std::vector<std::uint32_t> ids;                            // of the snapped points
    std::vector<std::uint32_t> flat;                           // in Polygon::points
    std::vector<plane::Point> at;                              // projected
    std::map<std::size_t, std::vector<std::uint32_t>> splits;  // edge -> ids of points of other rings that lie on it
    [[nodiscard]] std::size_t size() const { return ids.size(); }
    [[nodiscard]] std::size_t after(std::size_t i) const { return i + 1 == ids.size() ? 0 : i + 1; }
};

enum class Where { Outside, On, Inside };

// The position of a point relative to a ring that does not cross itself.
Where locate(const Ring& ring, plane::Point p) {
    bool isInside = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const plane::Point a = ring.at[i], b = ring.at[ring.after(i)];
        if (liesOn(p, a, b)) return Where::On;
        if ((a.v > p.v) != (b.v > p.v) && (turn(a, b, p) > 0) == (b.v > a.v)) isInside = !isInside;
    }
    return isInside ? Where::Inside : Where::Outside;
}

// Distance of p from the line through a and b, in steps.
double distanceFromLine(plane::Point a, plane::Point b, plane::Point p) {
    const double u = static_cast<double>(b.u - a.u), v = static_cast<double>(b.v - a.v);
    const double pu = static_cast<double>(p.u - a.u), pv = static_cast<double>(p.v - a.v);
    const double l = std::sqrt(u * u + v * v);
    return l > 0 ? std::abs(u * pv - v * pu) / l : std::sqrt(pu * pu + pv * pv);
}

double distanceFromSegment(plane::Point a, plane::Point b, plane::Point p) {
    const double u = static_cast<double>(b.u - a.u), v = static_cast<double>(b.v - a.v);
    const double pu = static_cast<double>(p.u - a.u), pv = static_cast<double>(p.v - a.v);
    const double square = u * u + v * v;
    const double at = square > 0 ? std::clamp((pu * u + pv * v) / square, 0.0, 1.0) : 0;
    return std::sqrt((pu - at * u) * (pu - at * u) + (pv - at * v) * (pv - at * v));
}

class PolygonChecker {
public:
    PolygonChecker(const model::Polygon& polygon, const Lattice& lattice, const PolygonTolerances& tolerances)
        : polygon_(polygon), lattice_(lattice), tolerances_(tolerances), snapper_(tolerances.snap / lattice.unit()) {}

    CheckedPolygon run() {
        readRings();
        if (checkPoints() && checkFlatness()) {
            project();
            if (checkSimple() && checkDirections() && checkRingPairs() && checkNesting() && checkConnected()) {
                cutIntoTriangles();
                checkNormals();
            }
        }
        if (!result_.defects.empty()) result_.triangles.clear();
        return std::move(result_);
    }

private:
    struct Edge {
        std::size_t ring, index;
        plane::Point a, b;
        plane::Box box;
    };

    Defect& report(Code code, Vec3d at, std::string message) {
        Defect& defect = result_.defects.emplace_back();
        defect.code = code;
        defect.at = at;
        defect.message = std::move(message);
        return defect;
    }
    [[nodiscard]] Vec3d world(const Ring& ring, std::size_t i) const { return polygon_.points[ring.flat[i]]; }
    [[nodiscard]] std::array<Vec3d, 2> markOf(const Ring& ring, std::size_t i) const {
        return {world(ring, i), world(ring, ring.after(i))};
    }
    [[nodiscard]] std::string nameOf(std::size_t ring) const {
        return ring == 0 ? "the exterior ring" : fmt::format("interior ring {}", ring);
    }
    void markRing(Defect& defect, const Ring& ring) const {
        for (std::size_t i = 0; i < ring.size(); ++i) defect.marks.push_back(markOf(ring, i));
    }

    void readRings() {
        std::uint32_t begin = 0;
        for (const std::uint32_t end : polygon_.ringEnds) {
            Ring ring;
            for (std::uint32_t i = begin; i < end; ++i) {
                ring.ids.push_back(snapper_.add(lattice_.toLattice(polygon_.points[i])));
                ring.flat.push_back(i);
                if (ring.ids.back() == firstAt_.size()) firstAt_.push_back(i);
            }
            // A last point that differs from the first one only by rounding just closes the ring.
            while (ring.size() > 3 && ring.ids.back() == ring.ids.front()) {
                ring.ids.pop_back();
                ring.flat.pop_back();
            }
            rings_.push_back(std::move(ring));
            begin = end;
        }
    }

    bool checkPoints() {
        if (rings_.empty()) {
            report(Code::TooFewPoints, {}, "a polygon without a ring");
            return false;
        }
        for (std::size_t r = 0; r < rings_.size(); ++r) {
            const Ring& ring = rings_[r];
            const std::set<std::uint32_t> distinct(ring.ids.begin(), ring.ids.end());
            if (distinct.size() < 3) {
                report(Code::TooFewPoints, ring.size() == 0 ? Vec3d{} : world(ring, 0),
                       fmt::format("{} has {} distinct points, fewer than three", nameOf(r), distinct.size()));
                return false;
            }
            for (std::size_t i = 0; i < ring.size(); ++i) {
                if (ring.ids[i] != ring.ids[ring.after(i)]) continue;
                report(Code::RepeatedPoint, world(ring, i),
                       fmt::format("{} has the same point twice in a row", nameOf(r)));
                return false;
            }
        }
        return true;
    }

    bool checkFlatness() {
        std::vector<Vec3d> points;
        for (const Ring& ring : rings_)
            for (const std::uint32_t id : ring.ids) points.push_back(Lattice::local(snapper_.points()[id]));
        fit_ = fitPlane(points);
        const Vec3d at = world(rings_[0], 0);
        if (fit_.width < kNoise) {
            markRing(report(Code::ZeroArea, at, "the exterior ring is collapsed to a line"), rings_[0]);
            return false;
        }
        const double away = fit_.thickness * lattice_.unit();
        if (points.size() == 3 || away <= tolerances_.planarity) return true;
        const Vec3d farthest = lattice_.toWorld(points[fit_.farthest]);
        Defect& defect =
            report(Code::NonPlanar, farthest,
                   fmt::format("a point lies {:.4f} m from the plane of its polygon, over the {} m allowed", away,
                               tolerances_.planarity));
        defect.value = away;
        defect.marks.push_back(
            {farthest, lattice_.toWorld(points[fit_.farthest] -
                                        fit_.normal * dot(points[fit_.farthest] - fit_.center, fit_.normal))});
        return false;
    }

    void project() {
        const Vec3d size{std::abs(fit_.normal.x), std::abs(fit_.normal.y), std::abs(fit_.normal.z)};
        const int axis = size.z >= size.x && size.z >= size.y ? 2 : size.y >= size.x ? 1 : 0;
        for (Ring& ring : rings_)
            for (const std::uint32_t id : ring.ids) ring.at.push_back(dropped(snapper_.points()[id], axis));
        for (std::size_t r = 0; r < rings_.size(); ++r)
            for (std::size_t i = 0; i < rings_[r].size(); ++i) {
                const plane::Point a = rings_[r].at[i], b = rings_[r].at[rings_[r].after(i)];
                edges_.push_back({r, i, a, b, plane::boxOf(a, b)});
            }
        std::stable_sort(edges_.begin(), edges_.end(),
                         [](const Edge& a, const Edge& b) { return a.box.low.u < b.box.low.u; });
    }

    // Most polygons are simple. Polygons with many edges are tested for this first, because long edges side by side
    // have common ranges.
    [[nodiscard]] bool isSimple() {
        constexpr std::size_t kFew = 64;
        if (isSimple_ || edges_.size() < kFew) return isSimple_;
        std::vector<std::pair<plane::Point, plane::Point>> edges;
        edges.reserve(edges_.size());
        for (const Edge& edge : edges_) edges.emplace_back(edge.a, edge.b);
        return isSimple_ = !plane::meetBeyondEnds(edges);
    }

    // Calls visit(edge, edge, meeting) for all edges that have a point in common, except if the polygon is simple.
    // Stops when a call returns false.
    template <class Visit>
    bool forEachMeeting(const Visit& visit) {
        if (isSimple()) return true;
        for (std::size_t i = 0; i < edges_.size(); ++i)
            for (std::size_t j = i + 1; j < edges_.size() && edges_[j].box.low.u <= edges_[i].box.high.u; ++j) {
                if (!edges_[j].box.overlaps(edges_[i].box)) continue;
                const Meeting meeting = meet(edges_[i].a, edges_[i].b, edges_[j].a, edges_[j].b);
                if (meeting != Meeting::None && !visit(edges_[i], edges_[j], meeting)) return false;
            }
        return true;
    }

    bool checkSimple() {
        return forEachMeeting([&](const Edge& e, const Edge& f, Meeting meeting) {
            if (e.ring != f.ring) return true;
            const Ring& ring = rings_[e.ring];
            const bool isBefore = ring.after(e.index) == f.index, isAfter = ring.after(f.index) == e.index;
            if ((isBefore || isAfter) && ring.size() > 2 && !isFoldedBack(isBefore ? e : f, isBefore ? f : e))
                return true;
            const std::size_t at = touchPoint(ring, e, f, meeting);
            Defect& defect =
                report(Code::SelfTouchingRing, at == ring.size() ? crossing(ring, e, f) : world(ring, at),
                       fmt::format("{} {} itself", nameOf(e.ring), meeting == Meeting::Cross ? "crosses" : "touches"));
            defect.marks = {markOf(ring, e.index), markOf(ring, f.index)};
            return false;
        });
    }

    // For neighbouring edges: `next` begins at the end of `edge`.
    static bool isFoldedBack(const Edge& edge, const Edge& next) {
        if (turn(edge.a, edge.b, next.b) != 0) return false;
        const Vec3d one{static_cast<double>(edge.b.u - edge.a.u), static_cast<double>(edge.b.v - edge.a.v), 0};
        const Vec3d two{static_cast<double>(next.b.u - next.a.u), static_cast<double>(next.b.v - next.a.v), 0};
        return dot(one, two) < 0;
    }

    // The corner at which two edges touch; size() where they cross.
    static std::size_t touchPoint(const Ring& ring, const Edge& e, const Edge& f, Meeting meeting) {
        if (meeting == Meeting::Cross) return ring.size();
        if (liesOn(e.a, f.a, f.b)) return e.index;
        if (liesOn(e.b, f.a, f.b)) return ring.after(e.index);
        return liesOn(f.a, e.a, e.b) ? f.index : ring.after(f.index);
    }

    [[nodiscard]] Vec3d crossing(const Ring& ring, const Edge& e, const Edge& f) const {
        const double a = distanceFromLine(f.a, f.b, e.a), b = distanceFromLine(f.a, f.b, e.b);
        const std::array<Vec3d, 2> mark = markOf(ring, e.index);
        return mark[0] + (mark[1] - mark[0]) * (a / (a + b));
    }

    // The exterior one way, holes the other; the polygon as a whole may turn either way as seen.
    bool checkDirections() {
        for (const Ring& ring : rings_) {
            std::size_t low = 0;
            for (std::size_t i = 1; i < ring.size(); ++i)
                if (ring.at[i] < ring.at[low]) low = i;
            turns_.push_back(
                turn(ring.at[(low + ring.size() - 1) % ring.size()], ring.at[low], ring.at[ring.after(low)]));
        }
        for (std::size_t r = 1; r < rings_.size(); ++r) {
            if (turns_[r] != turns_[0]) continue;
            markRing(report(Code::InnerRingTurnsAlike, world(rings_[r], 0),
                            nameOf(r) + " turns the same way as the exterior ring"),
                     rings_[r]);
            return false;
        }
        return true;
    }

    bool checkRingPairs() {
        if (const auto alike = findSameRings()) {
            markRing(report(Code::DuplicateRing, world(rings_[alike->second], 0),
                            fmt::format("{} and {} are the same", nameOf(alike->first), nameOf(alike->second))),
                     rings_[alike->second]);
            return false;
        }
        if (rings_.size() == 1) return true;
        return forEachMeeting([&](const Edge& e, const Edge& f, Meeting meeting) {
            if (e.ring == f.ring) return true;
            if (!isCrossing(e, f, meeting) && !overlapAlongLine(e, f)) {
                noteTouches(e, f);
                noteTouches(f, e);
                return true;
            }
            Defect& defect = report(Code::RingsIntersect, world(rings_[e.ring], e.index),
                                    fmt::format("{} and {} cross or share a line", nameOf(std::min(e.ring, f.ring)),
                                                nameOf(std::max(e.ring, f.ring))));
            if (meeting == Meeting::Cross) defect.at = crossing(rings_[e.ring], e, f);
            defect.marks = {markOf(rings_[e.ring], e.index), markOf(rings_[f.ring], f.index)};
            return false;
        });
    }

    // The first two rings, if any, that have the same corners.
    [[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> findSameRings() const {
        if (rings_.size() < 2) return {};
        std::optional<std::pair<std::size_t, std::size_t>> first;
        std::map<std::vector<std::uint32_t>, std::size_t> seen;
        for (std::size_t r = 0; r < rings_.size(); ++r) {
            std::vector<std::uint32_t> corners = rings_[r].ids;
            std::sort(corners.begin(), corners.end());
            const auto [same, isNew] = seen.try_emplace(std::move(corners), r);
            if (isNew) continue;
            const std::pair found{same->second, r};
            if (!first || found < *first) first = found;
        }
        return first;
    }

    // An end that lies beyond the other edge only by rounding touches the edge.
    static bool isCrossing(const Edge& e, const Edge& f, Meeting meeting) {
        if (meeting != Meeting::Cross) return false;
        const double least = std::min({distanceFromLine(f.a, f.b, e.a), distanceFromLine(f.a, f.b, e.b),
                                       distanceFromLine(e.a, e.b, f.a), distanceFromLine(e.a, e.b, f.b)});
        return least > kNoise;
    }

    static bool overlapAlongLine(const Edge& e, const Edge& f) {
        if (turn(e.a, e.b, f.a) != 0 || turn(e.a, e.b, f.b) != 0) return false;
        const bool alongU = std::abs(e.a.u - e.b.u) >= std::abs(e.a.v - e.b.v);
        const auto value = [&](plane::Point p) { return alongU ? p.u : p.v; };
        return std::max(std::min(value(e.a), value(e.b)), std::min(value(f.a), value(f.b))) <
               std::min(std::max(value(e.a), value(e.b)), std::max(value(f.a), value(f.b)));
    }

    // Ends of e on f: where two rings touch.
    void noteTouches(const Edge& e, const Edge& f) {
        const Ring& ring = rings_[e.ring];
        for (const std::size_t corner : {e.index, ring.after(e.index)}) {
            const plane::Point p = ring.at[corner];
            if (!liesOn(p, f.a, f.b) && distanceFromSegment(f.a, f.b, p) > kNoise) continue;
            touches_.insert({e.ring, ring.ids[corner]});
            touches_.insert({f.ring, ring.ids[corner]});
            if (p != f.a && p != f.b) {
                std::vector<std::uint32_t>& split = rings_[f.ring].splits[f.index];
                if (std::find(split.begin(), split.end(), ring.ids[corner]) == split.end())
                    split.push_back(ring.ids[corner]);
            }
        }
    }

    // The position of `ring` relative to `other`, which it does not cross.
    [[nodiscard]] Where locateRing(const Ring& ring, const Ring& other) const {
        for (const plane::Point p : ring.at)
            if (const Where where = locate(other, p); where != Where::On) return where;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const plane::Point a = ring.at[i], b = ring.at[ring.after(i)];
            const plane::Point middle{a.u + (b.u - a.u) / 2, a.v + (b.v - a.v) / 2};
            if (const Where where = locate(other, middle); where != Where::On) return where;
        }
        return Where::On;
    }

    bool checkNesting() {
        for (std::size_t r = 1; r < rings_.size(); ++r) {
            if (locateRing(rings_[r], rings_[0]) != Where::Outside) continue;
            markRing(
                report(Code::InnerRingOutside, world(rings_[r], 0), nameOf(r) + " lies outside of the exterior ring"),
                rings_[r]);
            return false;
        }
        const auto nested = findNestedRings();
        if (!nested) return true;
        markRing(report(Code::InnerRingsNested, world(rings_[nested->first], 0),
                        fmt::format("{} lies within {}", nameOf(nested->first), nameOf(nested->second))),
                 rings_[nested->first]);
        return false;
    }

    // The first interior ring, if any, that lies within another, and the first one around it. Rings are compared whose
    // boxes lie within each other.
    [[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> findNestedRings() const {
        std::vector<Box3d> boxes(rings_.size());
        for (std::size_t r = 1; r < rings_.size(); ++r)
            for (const plane::Point p : rings_[r].at) boxes[r].add(Vec3d{double(p.u), double(p.v), 0});
        const plane::BoxTree tree(boxes);
        for (std::size_t inner = 1; inner < boxes.size(); ++inner)
            for (const std::uint32_t outer : tree.findAll(boxes[inner]))
                if (outer != inner && boxes[outer].contains(boxes[inner].min) &&
                    boxes[outer].contains(boxes[inner].max) &&
                    locateRing(rings_[inner], rings_[outer]) == Where::Inside)
                    return std::pair{inner, std::size_t(outer)};
        return std::nullopt;
    }

    // Rings and the points where they touch, as a graph: a circle of them cuts the interior in two.
    bool checkConnected() {
        Groups groups(rings_.size() + snapper_.points().size());
        for (const auto& [ring, id] : touches_) {
            if (groups.leaderOf(ring) == groups.leaderOf(rings_.size() + id)) {
                markRing(report(Code::PolygonSplit, polygon_.points[firstAt_[id]],
                                "rings touch so that they cut the interior of the polygon in two"),
                         rings_[ring]);
                return false;
            }
            groups.join(ring, rings_.size() + id);
        }
        return true;
    }

    void cutIntoTriangles() {
        std::vector<Vec3d> points(polygon_.points.size());
        for (std::size_t i = 0; i < firstAt_.size(); ++i) points[firstAt_[i]] = Lattice::local(snapper_.points()[i]);
        std::vector<std::vector<plane::RingCorner>> rings;
        for (Ring& ring : rings_) {
            std::vector<plane::RingCorner> corners;
            for (std::size_t i = 0; i < ring.size(); ++i) {
                corners.push_back({ring.at[i], firstAt_[ring.ids[i]]});
                const auto split = ring.splits.find(i);
                if (split == ring.splits.end()) continue;
                const Vec3d from = points[firstAt_[ring.ids[i]]];
                std::sort(split->second.begin(), split->second.end(), [&](std::uint32_t a, std::uint32_t b) {
                    return length(points[firstAt_[a]] - from) < length(points[firstAt_[b]] - from);
                });
                for (const std::uint32_t id : split->second) corners.push_back({flatOf(id), firstAt_[id]});
            }
            // Counter-clockwise outside, whichever way the polygon is seen; turned back below.
            if (turns_[0] < 0) std::reverse(corners.begin(), corners.end());
            rings.push_back(std::move(corners));
        }
        result_.triangles = plane::triangulateRings(rings, points);
        if (turns_[0] < 0)
            for (Corners& corners : result_.triangles) std::swap(corners[1], corners[2]);
        points_ = std::move(points);
    }

    [[nodiscard]] plane::Point flatOf(std::uint32_t id) const {
        for (const Ring& ring : rings_)
            for (std::size_t i = 0; i < ring.size(); ++i)
                if (ring.ids[i] == id) return ring.at[i];
        return {};
    }

    // Triangles thinner than the tolerance of points have no reliable normal.
    void checkNormals() {
        struct Facet {
            Vec3d normal;
            double area, height;
        };
        std::vector<Facet> facets;
        std::size_t largest = 0;
        for (const Corners& t : result_.triangles) {
            const Vec3d a = points_[t[0]], b = points_[t[1]], c = points_[t[2]];
            const Vec3d n = cross(b - a, c - a);
            const double longest = std::max({length(b - a), length(c - b), length(a - c)});
            facets.push_back({normalized(n), length(n), longest > 0 ? length(n) / longest : 0});
            if (facets.back().area > facets[largest].area) largest = facets.size() - 1;
        }
        double worst = 0;
        std::size_t worstAt = 0;
        for (std::size_t i = 0; i < facets.size(); ++i) {
            if (facets[i].height * lattice_.unit() < tolerances_.snap) continue;
            const double angle = std::atan2(length(cross(facets[i].normal, facets[largest].normal)),
                                            dot(facets[i].normal, facets[largest].normal)) *
                                 (180 / 3.14159265358979323846);
            if (angle > worst) {
                worst = angle;
                worstAt = i;
            }
        }
        if (worst <= tolerances_.normalsDegrees) return;
        const Corners& t = result_.triangles[worstAt];
        const auto at = [&](int i) { return polygon_.points[t[static_cast<std::size_t>(i)]]; };
        Defect& defect = report(Code::NormalsDeviate, (at(0) + at(1) + at(2)) / 3.0,
                                fmt::format("a part of the polygon is folded by {:.1f} degrees, over the {} allowed",
                                            worst, tolerances_.normalsDegrees));
        defect.value = worst;
        defect.marks = {{at(0), at(1)}, {at(1), at(2)}, {at(2), at(0)}};
    }

    const model::Polygon& polygon_;
    const Lattice& lattice_;
    const PolygonTolerances& tolerances_;
    Snapper snapper_;
    std::vector<std::uint32_t> firstAt_;  // snapped point -> the first of Polygon::points there
    std::vector<Ring> rings_;
    std::vector<Edge> edges_;                                  // by `low`
    bool isSimple_ = false;                                    // true: proven; false: not asked, or not so
    std::vector<int> turns_;                                   // of each ring, as projected
    std::set<std::pair<std::size_t, std::uint32_t>> touches_;  // ring, snapped point
    std::vector<Vec3d> points_;
    PlaneFit fit_;
    CheckedPolygon result_;
};

}  // namespace

CheckedPolygon checkPolygon(const model::Polygon& polygon, const Lattice& lattice,
                            const PolygonTolerances& tolerances) {
    return PolygonChecker(polygon, lattice, tolerances).run();
}

}  // namespace svt::validate

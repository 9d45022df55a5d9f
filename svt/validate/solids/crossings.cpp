#include <svt/validate/solids/crossings.hpp>

#include <algorithm>
#include <set>

namespace svt::validate {
namespace {

Vec3d unitNormal(const Triangle& t) noexcept {
    const Vec3d a = Lattice::local(t[0]);
    return normalized(cross(Lattice::local(t[1]) - a, Lattice::local(t[2]) - a));
}

// Two triangles with a common edge p q: they overlap if they lie in one plane, on one side of the edge.
bool foldOntoEachOther(const Point& p, const Point& q, const Point& a, const Point& b) noexcept {
    if (side(p, q, a, b) != 0) return false;
    const int axis = axisOf(p, q, a);
    if (axis < 0) return false;
    const plane::Point from = dropped(p, axis), to = dropped(q, axis);
    return turn(from, to, dropped(a, axis)) == turn(from, to, dropped(b, axis));
}

// The edge of `t` that faces its corner i.
std::array<Point, 2> edgeFacing(const Triangle& t, std::size_t i) noexcept { return {t[(i + 1) % 3], t[(i + 2) % 3]}; }

// An edge that two faces share holds what their triangles have in common. Needed where a ring of one face ends on the
// edge of another ring, so that its triangles are cut there and those beside are not.
bool liesOnSharedEdge(const Face& a, const Face& b, const Segment& common, const PointSet& points) {
    const auto edgesOf = [](const Face& face) {
        std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (const auto& ring : face.rings)
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const std::uint32_t p = ring[i], q = ring[i + 1 == ring.size() ? 0 : i + 1];
                edges.insert({std::min(p, q), std::max(p, q)});
            }
        return edges;
    };
    constexpr double kNear = 4;  // steps: the largest error of rounding at the common segment
    const auto ofB = edgesOf(b);
    for (const auto& [p, q] : edgesOf(a)) {
        if (ofB.count({p, q}) == 0) continue;
        const Vec3d from = points.units(p), along = normalized(points.units(q) - from);
        const double size = length(points.units(q) - from);
        const bool isOn = std::all_of(common.begin(), common.end(), [&](Vec3d end) {
            const Vec3d d = end - from;
            const double at = dot(d, along);
            return at >= -kNear && at <= size + kNear && length(d - along * at) <= kNear;
        });
        if (isOn) return true;
    }
    return false;
}

struct MeetingFaces {
    std::uint32_t a, b;  // faces
    std::uint32_t s, t;  // triangles
    friend auto operator<=>(const MeetingFaces&, const MeetingFaces&) = default;
};

}  // namespace

bool triangleMeets(const Triangle& a, const Triangle& b) noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
        if (meet(a[i], a[(i + 1) % 3], b) != Meeting::None) return true;
        if (meet(b[i], b[(i + 1) % 3], a) != Meeting::None) return true;
    }
    return false;
}

bool triangleCrosses(const Triangle& a, const Triangle& b, double depth) noexcept {
    const auto leadsThrough = [depth](const Triangle& one, const Triangle& other) {
        const Vec3d normal = unitNormal(other), at = Lattice::local(other[0]);
        for (std::size_t i = 0; i < 3; ++i) {
            const Point p = one[i], q = one[(i + 1) % 3];
            if (std::abs(dot(Lattice::local(p) - at, normal)) <= depth) continue;
            if (std::abs(dot(Lattice::local(q) - at, normal)) <= depth) continue;
            if (meet(p, q, other) == Meeting::Cross) return true;
        }
        return false;
    };
    return leadsThrough(a, b) || leadsThrough(b, a);
}

bool meetBeyondCorners(const Corners& a, const Corners& b, const PointSet& points) {
    std::size_t sharedOfA[3], sharedOfB[3], count = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (a[i] == b[j] && count < 3) {
                sharedOfA[count] = i;
                sharedOfB[count++] = j;
            }
    const Triangle s = points.corners(a), t = points.corners(b);
    if (axisOf(s[0], s[1], s[2]) < 0 || axisOf(t[0], t[1], t[2]) < 0) return false;
    if (count == 0) return triangleMeets(s, t);
    if (count == 1) {
        const std::array<Point, 2> ofS = edgeFacing(s, sharedOfA[0]), ofT = edgeFacing(t, sharedOfB[0]);
        return meet(ofS[0], ofS[1], t) != Meeting::None || meet(ofT[0], ofT[1], s) != Meeting::None;
    }
    if (count == 2) {
        const std::size_t restOfA = 3 - sharedOfA[0] - sharedOfA[1], restOfB = 3 - sharedOfB[0] - sharedOfB[1];
        return foldOntoEachOther(s[sharedOfA[0]], s[sharedOfA[1]], s[restOfA], t[restOfB]);
    }
    return true;
}

std::optional<Segment> cutByPlane(const Triangle& a, const Triangle& b, double noise, bool& isCoplanar) {
    const Vec3d normal = unitNormal(a), at = Lattice::local(a[0]);
    double away[3];
    Vec3d corner[3];
    for (std::size_t i = 0; i < 3; ++i) {
        corner[i] = Lattice::local(b[i]);
        away[i] = dot(corner[i] - at, normal);
        if (std::abs(away[i]) <= noise) away[i] = 0;
    }
    isCoplanar = away[0] == 0 && away[1] == 0 && away[2] == 0;
    if (isCoplanar) return std::nullopt;
    std::vector<Vec3d> ends;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if (away[i] == 0) ends.push_back(corner[i]);
        if (away[i] * away[j] < 0)
            ends.push_back(corner[i] + (corner[j] - corner[i]) * (away[i] / (away[i] - away[j])));
    }
    if (ends.size() < 2) return std::nullopt;
    return Segment{ends[0], ends[1]};
}

std::optional<Segment> clippedTo(const Triangle& t, const Segment& s, double noise) {
    const Vec3d normal = unitNormal(t);
    double from = 0, to = 1;
    const Vec3d along = s[1] - s[0];
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d a = Lattice::local(t[i]), b = Lattice::local(t[(i + 1) % 3]);
        const Vec3d inwards = normalized(cross(normal, b - a));
        const double at0 = dot(s[0] - a, inwards) + noise, slope = dot(along, inwards);
        if (slope == 0) {
            if (at0 < 0) return std::nullopt;
        } else if (slope > 0) {
            from = std::max(from, -at0 / slope);
        } else {
            to = std::min(to, -at0 / slope);
        }
    }
    if (from > to) return std::nullopt;
    return Segment{s[0] + along * from, s[0] + along * to};
}

std::vector<Box3d> boxesOf(std::span<const Corners> triangles, const PointSet& points) {
    std::vector<Box3d> boxes(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (const std::uint32_t corner : triangles[t]) boxes[t].add(points.units(corner));
    return boxes;
}

void checkIntersections(const Shell& shell, const PointSet& points, std::vector<Defect>& defects) {
    plane::BoxTree tree = treeOf(boxesOf(shell.triangles, points));
    std::vector<plane::SpaceTriangle> triangles;
    triangles.reserve(shell.triangles.size());
    for (const Corners& t : shell.triangles)
        triangles.push_back({points.units(t[0]), points.units(t[1]), points.units(t[2])});
    tree.addSlabs(triangles);
    std::vector<MeetingFaces> found;
    for (std::uint32_t t = 0; t < shell.triangles.size() && found.size() < kLargestDefectCount; ++t)
        tree.forEachBeside(tree.boxes()[t], triangles[t], [&](std::uint32_t s) {
            if (s >= t || shell.faceOf[s] == shell.faceOf[t]) return;
            if (!meetBeyondCorners(shell.triangles[s], shell.triangles[t], points)) return;
            const Triangle a = points.corners(shell.triangles[s]), b = points.corners(shell.triangles[t]);
            const Face &one = shell.faces[shell.faceOf[s]], &other = shell.faces[shell.faceOf[t]];
            bool isCoplanar = false;
            std::optional<Segment> common = cutByPlane(a, b, 0, isCoplanar);
            if (common) common = clippedTo(a, *common, 1);
            if (common && liesOnSharedEdge(one, other, *common, points)) return;
            found.push_back(
                {std::min(shell.faceOf[s], shell.faceOf[t]), std::max(shell.faceOf[s], shell.faceOf[t]), s, t});
        });
    // One defect for each pair of faces.
    std::sort(found.begin(), found.end());
    for (std::size_t i = 0; i < found.size() && defects.size() < kLargestDefectCount; ++i) {
        if (i > 0 && found[i].a == found[i - 1].a && found[i].b == found[i - 1].b) continue;
        const Triangle a = points.corners(shell.triangles[found[i].s]), b = points.corners(shell.triangles[found[i].t]);
        bool isCoplanar = false;
        std::optional<Segment> common = cutByPlane(a, b, 0, isCoplanar);
        if (common) common = clippedTo(a, *common, 1);
        Defect defect;
        defect.code = Code::ShellSelfIntersects;
        defect.polygon = shell.faces[found[i].b].polygon;
        defect.message = "two faces of the shell intersect";
        const Vec3d center = (Lattice::local(b[0]) + Lattice::local(b[1]) + Lattice::local(b[2])) / 3.0;
        defect.at = points.lattice->toWorld(common ? ((*common)[0] + (*common)[1]) * 0.5 : center);
        if (common)
            defect.marks.push_back({points.lattice->toWorld((*common)[0]), points.lattice->toWorld((*common)[1])});
        for (std::size_t k = 0; k < 3; ++k)
            defect.marks.push_back({points.lattice->toWorld(b[k]), points.lattice->toWorld(b[(k + 1) % 3])});
        defects.push_back(std::move(defect));
    }
}

}  // namespace svt::validate

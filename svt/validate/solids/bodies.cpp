#include <svt/validate/solids/bodies.hpp>

#include <algorithm>

namespace svt::validate {
namespace {

constexpr std::size_t kMaxPieces = 4096;  // of one triangle; further lines are left out
constexpr double kParallel = 0.999;       // cosine of 2.6 degrees

Vec3d normalOf(const Triangle& t) noexcept {
    const Vec3d a = Lattice::local(t[0]);
    return cross(Lattice::local(t[1]) - a, Lattice::local(t[2]) - a);
}

Point rounded(Vec3d p) noexcept { return {std::llround(p.x), std::llround(p.y), std::llround(p.z)}; }

// The side of the line a b on which the point p lies, after p is moved by an infinitely small distance along u and by
// an infinitely smaller distance along v. This is simulation of simplicity (Edelsbrunner and Muecke 1990). Never 0 for
// a line of two points.
int turnMoved(plane::Point a, plane::Point b, plane::Point p) noexcept {
    if (const int exact = turn(a, b, p); exact != 0) return exact;
    if (a.v != b.v) return a.v > b.v ? 1 : -1;
    return b.u > a.u ? 1 : b.u < a.u ? -1 : 0;
}

// The point of a triangle nearest to p (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
Vec3d nearestOf(Vec3d a, Vec3d b, Vec3d c, Vec3d p) noexcept {
    const Vec3d ab = b - a, ac = c - a, ap = p - a;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return a;
    const Vec3d bp = p - b;
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    const Vec3d cp = p - c;
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double sum = va + vb + vc;
    return sum > 0 ? a + ab * (vb / sum) + ac * (vc / sum) : a;
}

void finish(Piece& piece, Vec3d normal) {
    Vec3d sum{};
    for (const Vec3d& corner : piece.corners) sum = sum + corner;
    const Vec3d middle = sum / static_cast<double>(piece.corners.size());
    // The centre of area: of a convex piece it lies well inside.
    Vec3d weighted{};
    piece.area = 0;
    for (std::size_t i = 0; i < piece.corners.size(); ++i) {
        const Vec3d &a = piece.corners[i], &b = piece.corners[(i + 1) % piece.corners.size()];
        const double area = 0.5 * dot(cross(a - middle, b - middle), normal);
        piece.area += area;
        weighted = weighted + (a + b + middle) * (area / 3);
    }
    piece.center = piece.area > 0 ? weighted / piece.area : middle;
}

// Halves of a piece along the segment, or nothing where it does not lead through it.
bool halve(const Piece& piece, const Segment& segment, Vec3d normal, double least, Piece& left, Piece& right) {
    const Vec3d along = segment[1] - segment[0];
    const double size = length(along);
    if (size <= least) return false;
    const Vec3d direction = along / size, across = cross(normal, direction);
    double from = 0, to = size, low = 0, high = 0;
    const std::size_t count = piece.corners.size();
    std::vector<double> away(count);
    for (std::size_t i = 0; i < count; ++i) {
        away[i] = dot(piece.corners[i] - segment[0], across);
        low = std::min(low, away[i]);
        high = std::max(high, away[i]);
    }
    if (low > -least || high < least) return false;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3d a = piece.corners[i], edge = piece.corners[(i + 1) % count] - a;
        const Vec3d inwards = cross(normal, edge);
        const double at0 = dot(segment[0] - a, inwards), slope = dot(direction, inwards);
        if (slope == 0 ? at0 < 0 : false) return false;
        if (slope > 0) from = std::max(from, -at0 / slope);
        if (slope < 0) to = std::min(to, -at0 / slope);
    }
    if (to - from <= least) return false;
    left.corners.clear();
    right.corners.clear();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t j = (i + 1) % count;
        if (away[i] >= 0) left.corners.push_back(piece.corners[i]);
        if (away[i] <= 0) right.corners.push_back(piece.corners[i]);
        if (away[i] * away[j] < 0) {
            const Vec3d cut =
                piece.corners[i] + (piece.corners[j] - piece.corners[i]) * (away[i] / (away[i] - away[j]));
            left.corners.push_back(cut);
            right.corners.push_back(cut);
        }
    }
    return left.corners.size() > 2 && right.corners.size() > 2;
}

}  // namespace

Body::Body(std::vector<Corners> triangles, PointSet points)
    : triangles_(std::move(triangles)), points_(points), tree_(treeOf(boxesOf(triangles_, points_))) {}

bool Body::encloses(Vec3d p) const {
    const Point at = rounded(p);
    const plane::Point flat = dropped(at, 2);
    bool isInside = false;
    Box3d ray{Lattice::local(at), Lattice::local(at)};
    ray.max.z = kInfinity;
    tree_.forEach(ray, [&](std::uint32_t t) {
        const Triangle corners = triangle(t);
        const plane::Point a = dropped(corners[0], 2), b = dropped(corners[1], 2), c = dropped(corners[2], 2);
        const int ab = turnMoved(a, b, flat), bc = turnMoved(b, c, flat), ca = turnMoved(c, a, flat);
        if (ab == 0 || ab != bc || bc != ca) return;
        if (side(corners[0], corners[1], corners[2], at) == -ab) isInside = !isInside;
    });
    return isInside;
}

std::optional<Body::Nearest> Body::near(Vec3d p, double reach, Vec3d normal) const {
    const Vec3d at = Lattice::local(rounded(p));
    std::optional<Nearest> best;
    double bestParallel = -1;
    tree_.forEach(plane::grown({at, at}, std::ceil(reach) + 1), [&](std::uint32_t t) {
        const Triangle corners = triangle(t);
        const Vec3d a = Lattice::local(corners[0]), b = Lattice::local(corners[1]), c = Lattice::local(corners[2]);
        const double distance = length(nearestOf(a, b, c, p) - p);
        if (distance > reach) return;
        const Vec3d own = normalized(normalOf(corners));
        const double parallel = std::abs(dot(own, normal));
        if (!best) best = Nearest{distance, own};
        best->distance = std::min(best->distance, distance);
        if (parallel > bestParallel) {
            bestParallel = parallel;
            best->normal = own;
        }
    });
    return best;
}

std::vector<Piece> cutTriangle(const Triangle& triangle, const std::vector<Segment>& segments, double least) {
    const Vec3d normal = normalized(normalOf(triangle));
    std::vector<Piece> pieces(1);
    for (const Point& corner : triangle) pieces[0].corners.push_back(Lattice::local(corner));
    Piece left, right;
    for (const Segment& segment : segments) {
        const std::size_t count = pieces.size();
        for (std::size_t i = 0; i < count && pieces.size() < kMaxPieces; ++i) {
            if (!halve(pieces[i], segment, normal, least, left, right)) continue;
            pieces[i] = left;
            pieces.push_back(right);
        }
    }
    for (Piece& piece : pieces) finish(piece, normal);
    return pieces;
}

std::vector<Segment> linesOn(const Triangle& triangle, const Body& body, double noise) {
    std::vector<Segment> lines;
    Box3d box;
    for (const Point& corner : triangle) box.add(Lattice::local(corner));
    body.tree().forEach(plane::grown(box, std::ceil(noise) + 1), [&](std::uint32_t t) {
        const Triangle other = body.triangle(t);
        bool isCoplanar = false;
        if (const auto line = cutByPlane(triangle, other, noise, isCoplanar)) {
            if (const auto part = clippedTo(triangle, *line, noise)) lines.push_back(*part);
        } else if (isCoplanar) {
            for (std::size_t i = 0; i < 3; ++i)
                if (const auto part = clippedTo(
                        triangle, Segment{Lattice::local(other[i]), Lattice::local(other[(i + 1) % 3])}, noise))
                    lines.push_back(*part);
        }
    });
    return lines;
}

Share shareOf(const Body& body, const Body& other, double noise) {
    Share share;
    const double least = std::max(noise, 4.0);
    for (std::uint32_t t = 0; t < body.triangles().size(); ++t) {
        const Triangle triangle = body.triangle(t);
        const Vec3d normal = normalized(normalOf(triangle));
        if (dot(normal, normal) == 0) continue;
        for (const Piece& piece : cutTriangle(triangle, linesOn(triangle, other, noise), least)) {
            if (piece.area <= 0) continue;
            const auto near = other.near(piece.center, noise, normal);
            if (near) {
                const double cosine = dot(near->normal, normal);
                if (std::abs(cosine) < kParallel) continue;
                (cosine > 0 ? share.alike : share.opposite) += piece.area;
                share.onAt = piece.center;
            } else if (other.encloses(piece.center)) {
                share.inside += piece.area;
                const auto surface = other.near(piece.center, 10 * noise, normal);
                const double depth = surface ? surface->distance : 10 * noise;
                if (depth > share.depth) {
                    share.depth = depth;
                    share.insideAt = piece.center;
                }
            } else {
                share.outside += piece.area;
                share.outsideAt = piece.center;
            }
        }
    }
    return share;
}

bool Relation::areSame() const noexcept {
    return first.inside == 0 && first.outside == 0 && second.inside == 0 && second.outside == 0 &&
           first.opposite == 0 && second.opposite == 0 && first.alike > 0 && second.alike > 0;
}

Relation relate(const Body& first, const Body& second, double noise) {
    Relation relation;
    for (std::uint32_t t = 0; t < first.triangles().size() && !relation.crossing; ++t) {
        const Triangle a = first.triangle(t);
        second.tree().forEach(plane::grown(first.tree().boxes()[t], std::ceil(noise)), [&](std::uint32_t u) {
            const Triangle b = second.triangle(u);
            relation.haveContact = relation.haveContact || triangleMeets(a, b);
            if (!relation.crossing && triangleCrosses(a, b, noise)) {
                bool isCoplanar = false;
                std::optional<Segment> common = cutByPlane(a, b, 0, isCoplanar);
                if (common) common = clippedTo(a, *common, 1);
                relation.crossing = common ? ((*common)[0] + (*common)[1]) * 0.5 : Lattice::local(a[0]);
            }
        });
    }
    relation.first = shareOf(first, second, noise);
    relation.second = shareOf(second, first, noise);
    return relation;
}

}  // namespace svt::validate

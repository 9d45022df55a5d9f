#include <svt/voxelize/surfaces/lid_field.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace svt::voxelize {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// Product of complex numbers, each of argument in (-pi, pi], that keeps count of full turns. Cheaper than the sum of
// the arguments: one arc tangent in all.
class TurnCounter {
public:
    void multiply(double real, double imaginary) noexcept {
        const double x = real_ * real - imaginary_ * imaginary;
        const double y = real_ * imaginary + imaginary_ * real;
        if (imaginary_ >= 0 && imaginary >= 0) {
            if (y < 0) ++turns_;
        } else if (imaginary_ < 0 && imaginary < 0 && y >= 0) {
            --turns_;
        }
        const double size = std::abs(x) + std::abs(y);
        if (!(size > 0)) return;  // the point is on the rim
        real_ = x / size;
        imaginary_ = y / size;
    }
    // Sum of the arguments over 2 pi.
    [[nodiscard]] double turns() const noexcept {
        return turns_ + std::atan2(imaginary_ + 0.0, real_) / kTurn;  // + 0.0: no negative zero
    }

private:
    double real_ = 1, imaginary_ = 0;
    int turns_ = 0;
};

struct Ray {
    Vec3d to;
    double length;
    Ray(Vec3d point, Vec3d from) noexcept : to(point - from), length(svt::length(to)) {}
};

// Half the solid angle of a triangle is the argument of (real, imaginary) (Van Oosterom & Strackee 1983).
struct HalfAngle {
    double real, imaginary;
    HalfAngle(const Ray& a, const Ray& b, const Ray& c) noexcept
        : real(a.length * b.length * c.length + dot(a.to, b.to) * c.length + dot(b.to, c.to) * a.length +
               dot(c.to, a.to) * b.length),
          imaginary(dot(a.to, cross(b.to, c.to))) {}
};

double squaredDistance(Vec3d a, Vec3d b) noexcept {
    // From the origin to the segment from a to b.
    const Vec3d ab = b - a;
    const double squared = dot(ab, ab);
    const double t = squared > 0 ? std::clamp(-dot(a, ab) / squared, 0.0, 1.0) : 0.0;
    const Vec3d nearest = a + ab * t;
    return dot(nearest, nearest);
}

// Adds gradient and hessian of 4 pi c of the edge from a to b.
void addEdge(const Ray& a, const Ray& b, Jet& jet) noexcept {
    const double product = a.length * b.length, cosine = dot(a.to, b.to);
    const double weight = product * (product + cosine);
    if (!(weight > 0)) return;
    const Vec3d normal = cross(a.to, b.to);
    const double inverse = 1 / weight, field = (a.length + b.length) * inverse;
    const double ratio = 2 * product + cosine, inverseProduct = 1 / product;
    const double inverseA = b.length * inverseProduct, inverseB = a.length * inverseProduct;
    // The derivative of `field`, which depends on p through the lengths and the cosine.
    const Vec3d slope = (a.to * (inverseA - field * (ratio * b.length * inverseA + product)) +
                         b.to * (inverseB - field * (ratio * a.length * inverseB + product))) *
                        -inverse;
    jet.gradient = jet.gradient + normal * field;
    // The antisymmetric part cancels around a loop.
    jet.diagonal = jet.diagonal + scaled(normal, slope);
    jet.mixed = jet.mixed + Vec3d{normal.y * slope.z + normal.z * slope.y, normal.x * slope.z + normal.z * slope.x,
                                  normal.x * slope.y + normal.y * slope.x} *
                                0.5;
}

// Whether the path from a over b to c bends at b.
bool isCorner(Vec3d a, Vec3d b, Vec3d c) noexcept {
    const Vec3d ab = b - a, bc = c - b;
    return !(length(cross(ab, bc)) <= 1e-9 * length(ab) * length(bc) && dot(ab, bc) > 0);
}

// The points of a ring at which it bends; one at least.
std::vector<std::uint32_t> cornersOf(std::span<const std::uint32_t> ring, const std::vector<Vec3d>& vertices) {
    std::vector<std::uint32_t> corners;
    for (std::size_t n = 0; n < ring.size(); ++n)
        if (isCorner(vertices[ring[n > 0 ? n - 1 : ring.size() - 1]], vertices[ring[n]],
                     vertices[ring[n + 1 < ring.size() ? n + 1 : 0]]))
            corners.push_back(ring[n]);
    if (corners.empty()) corners.push_back(ring[0]);
    return corners;
}

}  // namespace

LidSide::LidSide(const QuantaPoint& a, const QuantaPoint& b, const QuantaPoint& c, std::int32_t depth) noexcept
    : corners{a, b, c} {
    const auto along = [&](const QuantaPoint& to, std::size_t axis) { return std::int64_t(to[axis]) - a[axis]; };
    const std::int64_t area = along(b, 0) * along(c, 1) - along(b, 1) * along(c, 0);
    isVertical = area == 0;
    looksUp = area > 0;
    normalX = double(along(b, 1)) * double(along(c, 2)) - double(along(b, 2)) * double(along(c, 1));
    normalY = double(along(b, 2)) * double(along(c, 0)) - double(along(b, 0)) * double(along(c, 2));
    if (!isVertical) height = HeightPlane(triangleHeight(a, b, c, kScanAxes[2]), depth);
}

bool LidSide::isBehind(Vec3i sample) const noexcept {
    if (!isVertical) return (sample.z >= height.sampleAbove(sample.x, sample.y)) != looksUp;
    // The longest of its edges in plan; a sample exactly on it counts as east of it, as for EdgeWalk.
    std::int64_t dx = 0, dy = 0, longest = -1;
    const QuantaPoint* from = &corners[0];
    for (std::size_t e = 0; e < 3; ++e) {
        const QuantaPoint &p = corners[e], &q = corners[e == 2 ? 0 : e + 1];
        const std::int64_t x = std::int64_t(q[0]) - p[0], y = std::int64_t(q[1]) - p[1];
        if (std::abs(x) + std::abs(y) <= longest) continue;
        longest = std::abs(x) + std::abs(y);
        dx = x;
        dy = y;
        from = &p;
    }
    const std::int64_t px = std::int64_t(sample.x) * kQuanta + 1 - (*from)[0];
    const std::int64_t py = std::int64_t(sample.y) * kQuanta + 1 - (*from)[1];
    std::int64_t left = dx * py - dy * px;  // > 0: left of the edge
    if (left == 0) left = -dy;
    const double facing = normalX * double(-dy) + normalY * double(dx);  // > 0: the triangle faces left
    return (left > 0) != (facing > 0);
}

LidField::LidField(const CoveredShell& shell, const IndexMesh& lattice, const volume::Grid& grid, Vec3d localOrigin)
    : origin_(grid.worldFromIndex({0, 0, 0}) - localOrigin),
      steps_{grid.worldFromIndexDirection({1, 0, 0}), grid.worldFromIndexDirection({0, 1, 0}),
             grid.worldFromIndexDirection({0, 0, 1})} {
    for (const RimLoop& loop : shell.loops) addLoop(shell, loop, lattice, grid.dimension().z);
}

void LidField::addLoop(const CoveredShell& shell, const RimLoop& loop, const IndexMesh& lattice, std::int32_t depth) {
    const auto& vertices = shell.mesh.vertices;
    const auto snapped = [&](std::uint32_t vertex) {
        const QuantaPoint& q = lattice.points[vertex];
        return localFromIndex({q[0] / double(kQuanta), q[1] / double(kQuanta), q[2] / double(kQuanta)});
    };
    auto ring = shell.ringOf(loop);
    std::vector<std::uint32_t> turned(ring.begin(), ring.end());
    if (loop.hasOwnApex) {
        // Begin at a corner, so that no straight stretch goes around the end of the list.
        const std::vector<std::uint32_t> corners = cornersOf(ring, vertices);
        std::rotate(turned.begin(), std::ranges::find(turned, corners[0]), turned.end());
    }
    ring = turned;
    const std::size_t count = ring.size(), end = loop.hasOwnApex ? count : count - 1;
    const auto first = static_cast<std::uint32_t>(pieces_.size());
    for (std::size_t n = loop.hasOwnApex ? 0 : 1; n < end;) {
        LidPiece piece;
        piece.apex = vertices[loop.apex];
        piece.from = vertices[ring[n]];
        piece.firstSide = static_cast<std::uint32_t>(sides_.size());
        do {
            const std::uint32_t from = ring[n], to = ring[(n + 1) % count];
            sides_.emplace_back(lattice.points[loop.apex], lattice.points[from], lattice.points[to], depth);
            const std::uint32_t corners[] = {loop.apex, from, to};
            for (std::size_t c = 0; c < 3; ++c) sides_.back().local[c] = snapped(corners[c]);
            ++n;
        } while (loop.hasOwnApex && n < end &&
                 !isCorner(vertices[ring[n - 1]], vertices[ring[n]], vertices[ring[(n + 1) % count]]));
        piece.sideEnd = static_cast<std::uint32_t>(sides_.size());
        piece.to = vertices[ring[n % count]];
        piece.area = length(cross(piece.from - piece.apex, piece.to - piece.apex)) / 2;
        piece.length = length(piece.from - piece.apex) + length(piece.to - piece.from) + length(piece.apex - piece.to);
        for (const Vec3d& corner : {piece.apex, piece.from, piece.to}) piece.bounds.add(corner);
        piece.previous = static_cast<std::uint32_t>(pieces_.size()) - 1;
        piece.next = static_cast<std::uint32_t>(pieces_.size()) + 1;
        pieces_.push_back(piece);
    }
    const auto last = static_cast<std::uint32_t>(pieces_.size() - 1);
    pieces_[first].previous = loop.hasOwnApex && last != first ? last : LidPiece::kNone;
    pieces_[last].next = loop.hasOwnApex && last != first ? first : LidPiece::kNone;
}

double LidField::winding(std::span<const std::uint32_t> set, Vec3d p) const noexcept {
    // On the border of a piece its angle is undefined, though that of all pieces is smooth where they meet: step aside.
    constexpr double kAtBorder = 1e-9, kAside = 1e-6;
    for (int aside = 0;; ++aside) {
        TurnCounter product;
        bool isAtBorder = false;
        const Vec3d at = p + (steps_[0] + steps_[1] * 0.7 + steps_[2] * 0.4) * (kAside * aside);
        for (const std::uint32_t number : set) {
            const LidPiece& piece = pieces_[number];
            const Ray apex(piece.apex, at), from(piece.from, at), to(piece.to, at);
            const HalfAngle angle(apex, from, to);
            isAtBorder = isAtBorder || std::abs(angle.real) + std::abs(angle.imaginary) <=
                                           kAtBorder * apex.length * from.length * to.length;
            product.multiply(angle.real, angle.imaginary);
        }
        if (!isAtBorder || aside == 3) return product.turns();
    }
}

namespace {

// The part of a triangle of a lid on the lattice, in full turns; its side is decided as in the sweep.
double turnsOnLattice(const LidSide& side, Vec3i sample, Vec3d p) noexcept {
    constexpr double kFlat =
        1e-4;  // of the product of the lengths: so close to the triangle that its side is uncertain
    const Ray apex(side.local[0], p), from(side.local[1], p), to(side.local[2], p);
    HalfAngle angle(apex, from, to);
    if (angle.real < 0 && std::abs(angle.imaginary) < kFlat * apex.length * from.length * to.length)
        angle.imaginary = std::copysign(angle.imaginary, side.isBehind(sample) ? 1.0 : -1.0);
    return std::atan2(angle.imaginary, angle.real) / kTurn;
}

}  // namespace

double LidField::windingNear(std::span<const std::uint32_t> set, Vec3i sample) const noexcept {
    const Vec3d p = localOfSample(sample);
    double onLattice = 0;
    for (const std::uint32_t number : set) {
        const LidPiece& piece = pieces_[number];
        for (std::uint32_t n = piece.firstSide; n < piece.sideEnd; ++n)
            onLattice += turnsOnLattice(sides_[n], sample, p);
    }
    // Snapped pieces and pieces differ by strips along their border, thinner than 1/256 voxel.
    const double exact = winding(set, p);
    return exact + std::nearbyint(onLattice - exact);
}

double LidField::latticeDifference(std::uint32_t number, Vec3i sample) const noexcept {
    constexpr double kUnclear = 1e-7;  // of the product of the lengths: rounding may decide the side of the piece
    const Vec3d p = localOfSample(sample);
    const LidPiece& piece = pieces_[number];
    const Ray apex(piece.apex, p), from(piece.from, p), to(piece.to, p);
    const HalfAngle angle(apex, from, to);
    if (angle.real <= 0 && std::abs(angle.imaginary) <= kUnclear * apex.length * from.length * to.length)
        return std::numeric_limits<double>::quiet_NaN();
    double difference = -std::atan2(angle.imaginary, angle.real) / kTurn;
    for (std::uint32_t n = piece.firstSide; n < piece.sideEnd; ++n) difference += turnsOnLattice(sides_[n], sample, p);
    return difference;
}

// Calls `body(from, to)` for the edges of the border of a set of pieces, until it returns false. An edge that two
// neighbouring pieces of the set share is left out.
template <class Body>
void LidField::forEachEdge(std::span<const std::uint32_t> set, Body&& body) const {
    for (std::size_t n = 0; n < set.size(); ++n) {
        const LidPiece& piece = pieces_[set[n]];
        // At the ends of the list of a ring its first and its last piece may be neighbours.
        const bool hasPrevious =
            piece.previous < set[n]
                ? n > 0 && set[n - 1] == piece.previous
                : piece.previous != LidPiece::kNone && std::binary_search(set.begin(), set.end(), piece.previous);
        const bool hasNext = piece.next > set[n] ? n + 1 < set.size() && set[n + 1] == piece.next
                                                 : std::binary_search(set.begin(), set.end(), piece.next);
        if (!body(piece.from, piece.to)) return;
        if (!hasPrevious && !body(piece.apex, piece.from)) return;
        if (!hasNext && !body(piece.to, piece.apex)) return;
    }
}

double LidField::jetError(std::span<const std::uint32_t> set, Vec3d p, double radius) const noexcept {
    double byLength = 0, byArea = 0;
    // The third derivatives of an edge's part are at most 6 times the integral of 1 / r^4 along it.
    forEachEdge(set, [&](Vec3d from, Vec3d to) {
        const double distance = std::sqrt(squaredDistance(from - p, to - p)) - radius;
        const double inverse = distance > 0 ? 1 / distance : kInfinity;
        byLength += inverse * inverse * inverse * std::min(length(to - from) * inverse, std::numbers::pi / 2);
        return distance > 0;
    });
    // Those of a triangle's part are at most 24 times the integral of 1 / r^5 over it.
    for (const std::uint32_t number : set) {
        const LidPiece& piece = pieces_[number];
        const Vec3d outside{std::max({piece.bounds.min.x - p.x, p.x - piece.bounds.max.x, 0.0}),
                            std::max({piece.bounds.min.y - p.y, p.y - piece.bounds.max.y, 0.0}),
                            std::max({piece.bounds.min.z - p.z, p.z - piece.bounds.max.z, 0.0})};
        const double away = length(outside) - radius;
        byArea += away > 0 ? 4 * piece.area / (away * away * away * away * away) : kInfinity;
        if (byArea >= byLength) break;
    }
    return std::min(byLength, byArea) * radius * radius * radius / (2 * kTurn);
}

Jet LidField::jet(std::span<const std::uint32_t> set, Vec3d p, double radius, double limit) const noexcept {
    Jet jet;
    jet.error = jetError(set, p, radius);
    if (!(jet.error <= limit)) return jet;
    forEachEdge(set, [&](Vec3d from, Vec3d to) {
        addEdge(Ray(from, p), Ray(to, p), jet);
        return true;
    });
    constexpr double kScale = 1 / (2 * kTurn);
    jet.gradient = jet.gradient * kScale;
    jet.diagonal = jet.diagonal * kScale;
    jet.mixed = jet.mixed * kScale;
    jet.value = winding(set, p);
    return jet;
}

}  // namespace svt::voxelize

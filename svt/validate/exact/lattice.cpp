#include <svt/validate/exact/lattice.hpp>

namespace svt::validate {
namespace {

using plane::Wide;

constexpr double kReach = 1099511627776.0;  // 2^40: products of three differences then fit 128 bits
// Rounding error of the determinants below, relative to the sum of their terms' magnitudes: at most 8 roundings.
constexpr double kRounding = 8 * 1.2e-16;

int signOf(Wide value) noexcept { return value > 0 ? 1 : value < 0 ? -1 : 0; }

Wide product(std::int64_t a, std::int64_t b) noexcept { return static_cast<Wide>(a) * b; }

bool isSame(int a, int b, int c) noexcept { return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0); }

}  // namespace

Lattice::Lattice(const Box3d& bounds) noexcept {
    if (bounds.isEmpty()) return;
    const Vec3d center = bounds.center();
    origin_ = {std::floor(center.x), std::floor(center.y), std::floor(center.z)};
    const Vec3d half = bounds.size() * 0.5;
    const double reach = std::max({half.x, half.y, half.z}) + 2;
    while (reach / unit_ > kReach) unit_ *= 2;
}

Point Lattice::toLattice(Vec3d world) const noexcept {
    const Vec3d at = (world - origin_) / unit_;
    return {std::llround(at.x), std::llround(at.y), std::llround(at.z)};
}

int side(const Point& a, const Point& b, const Point& c, const Point& d) noexcept {
    const Point p{b.x - a.x, b.y - a.y, b.z - a.z}, q{c.x - a.x, c.y - a.y, c.z - a.z},
        r{d.x - a.x, d.y - a.y, d.z - a.z};
    const Vec3d pd = Lattice::local(p), qd = Lattice::local(q), rd = Lattice::local(r);
    const double yz = pd.y * qd.z, zy = pd.z * qd.y, zx = pd.z * qd.x, xz = pd.x * qd.z, xy = pd.x * qd.y,
                 yx = pd.y * qd.x;
    const double volume = (yz - zy) * rd.x + (zx - xz) * rd.y + (xy - yx) * rd.z;
    const double error =
        kRounding * ((std::abs(yz) + std::abs(zy)) * std::abs(rd.x) + (std::abs(zx) + std::abs(xz)) * std::abs(rd.y) +
                     (std::abs(xy) + std::abs(yx)) * std::abs(rd.z));
    if (volume > error) return 1;
    if (volume < -error) return -1;
    return signOf((product(p.y, q.z) - product(p.z, q.y)) * r.x + (product(p.z, q.x) - product(p.x, q.z)) * r.y +
                  (product(p.x, q.y) - product(p.y, q.x)) * r.z);
}

int axisOf(const Point& a, const Point& b, const Point& c) noexcept {
    const Vec3d n = cross(Lattice::local(b) - Lattice::local(a), Lattice::local(c) - Lattice::local(a));
    // The largest component first; it fails only for slivers, which the exact test finds.
    int order[3] = {0, 1, 2};
    const double size[3] = {std::abs(n.x), std::abs(n.y), std::abs(n.z)};
    if (size[order[1]] > size[order[0]]) std::swap(order[0], order[1]);
    if (size[order[2]] > size[order[0]]) std::swap(order[0], order[2]);
    for (const int axis : order)
        if (turn(dropped(a, axis), dropped(b, axis), dropped(c, axis)) != 0) return axis;
    return -1;
}

Meeting meet(const Point& p, const Point& q, const std::array<Point, 3>& t) noexcept {
    const int ofP = side(t[0], t[1], t[2], p), ofQ = side(t[0], t[1], t[2], q);
    if (ofP * ofQ > 0) return Meeting::None;
    if (ofP * ofQ < 0) {
        const int a = side(p, q, t[0], t[1]), b = side(p, q, t[1], t[2]), c = side(p, q, t[2], t[0]);
        if (!isSame(a, b, c)) return Meeting::None;
        return a != 0 && b != 0 && c != 0 ? Meeting::Cross : Meeting::Touch;
    }
    const int axis = axisOf(t[0], t[1], t[2]);
    if (axis < 0) return Meeting::None;
    const std::array<plane::Point, 3> flat{dropped(t[0], axis), dropped(t[1], axis), dropped(t[2], axis)};
    const plane::Point a = dropped(p, axis), b = dropped(q, axis);
    if (ofP == 0 && holds(flat, a)) return Meeting::Touch;
    if (ofQ == 0 && holds(flat, b)) return Meeting::Touch;
    if (ofP != 0 || ofQ != 0) return Meeting::None;
    for (std::size_t i = 0; i < 3; ++i)
        if (meet(a, b, flat[i], flat[(i + 1) % 3]) != Meeting::None) return Meeting::Touch;
    return Meeting::None;
}

}  // namespace svt::validate

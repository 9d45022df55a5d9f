#include <svt/validate/exact/snapper.hpp>

namespace svt::validate {

std::uint32_t Snapper::add(const Point& point) {
    // A cell is twice as wide as the tolerance: no more than two of them along each axis.
    const auto cellAt = [&](std::int64_t by) {
        const auto divided = [&](std::int64_t at) { return (at - (at < 0 ? cell_ - 1 : 0)) / cell_; };
        return plane::Cell{divided(point.x + by), divided(point.y + by), divided(point.z + by)};
    };
    return welder_.add(point, cellAt(0), cellAt(-reach_), cellAt(reach_), [&](std::uint32_t i) {
        const double apart = length(Lattice::local(points()[i]) - Lattice::local(point));
        return apart < tolerance_ || apart == 0;
    });
}

}  // namespace svt::validate

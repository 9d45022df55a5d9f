#include <svt/validate/exact/snapper.hpp>

namespace svt::validate {
namespace {

constexpr std::uint32_t kNoPoint = 0xFFFFFFFFu;

std::int64_t floorDivided(std::int64_t a, std::int64_t b) noexcept {
    const std::int64_t quotient = a / b;
    return quotient * b > a ? quotient - 1 : quotient;
}

}  // namespace

std::size_t Snapper::CellHash::operator()(const Point& p) const noexcept {
    std::uint64_t hash = 0x9E3779B97F4A7C15u;
    for (const std::int64_t value : {p.x, p.y, p.z}) {
        hash ^= static_cast<std::uint64_t>(value);
        hash *= 0xBF58476D1CE4E5B9u;
        hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
}

std::uint32_t Snapper::add(const Point& point) {
    const auto cellOf = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        return Point{floorDivided(x, cell_), floorDivided(y, cell_), floorDivided(z, cell_)};
    };
    // A cell is twice as wide as the tolerance: no more than two of them along each axis.
    const Point low = cellOf(point.x - reach_, point.y - reach_, point.z - reach_);
    const Point high = cellOf(point.x + reach_, point.y + reach_, point.z + reach_);
    std::uint32_t best = kNoPoint;
    for (std::int64_t z = low.z; z <= high.z; ++z)
        for (std::int64_t y = low.y; y <= high.y; ++y)
            for (std::int64_t x = low.x; x <= high.x; ++x) {
                const auto found = at_.find(Point{x, y, z});
                for (std::uint32_t i = found == at_.end() ? kNoPoint : found->second; i != kNoPoint; i = next_[i]) {
                    const double apart = length(Lattice::local(points_[i]) - Lattice::local(point));
                    if ((apart < tolerance_ || apart == 0) && i < best) best = i;
                }
            }
    if (best != kNoPoint) return best;
    const auto index = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
    const auto [cell, isNew] = at_.try_emplace(cellOf(point.x, point.y, point.z), index);
    next_.push_back(isNew ? kNoPoint : cell->second);
    cell->second = index;
    return index;
}

}  // namespace svt::validate

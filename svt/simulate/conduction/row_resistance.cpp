#include <svt/simulate/conduction/row_resistance.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace svt::simulate {
namespace {

constexpr double kStillAir = 0.025;             // W/(m K)
constexpr double kMostOfAir = 0.18;             // m2 K/W: ISO 6946, over 25 mm
constexpr double kSliver = 1e-3;                // voxels: shorter parts that do not conduct are rounding
constexpr double kNear = 0.05, kInside = 1e-9;  // voxels
constexpr double kFarthestEnd = 1.5;            // voxels

}  // namespace

std::size_t RowResistance::partAt(double place) const noexcept {
    const auto after = std::upper_bound(parts_.begin(), parts_.end(), place,
                                        [](double p, const RowPart& part) { return p < part.from; });
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - parts_.begin() - 1, 0));
}

double RowResistance::endOfPart(std::size_t n) const noexcept {
    return n + 1 < parts_.size() ? parts_[n + 1].from : std::numeric_limits<double>::infinity();
}

std::optional<double> RowResistance::nodeOf(std::int32_t voxel, volume::Scalar scalar, bool isThin) const {
    const double centre = voxel + 0.5;
    const std::size_t own = partAt(centre);
    if (isSolid(own)) return centre;
    if (own > 0 && isSolid(own - 1) && centre - parts_[own].from < kNear) return parts_[own].from - kInside;
    if (own + 1 < parts_.size() && isSolid(own + 1) && parts_[own + 1].from - centre < kNear)
        return parts_[own + 1].from + kInside;
    return isThin ? thinNodeOf(centre, scalar) : std::nullopt;
}

std::optional<double> RowResistance::thinNodeOf(double centre, volume::Scalar scalar) const {
    std::optional<double> best;
    double bestDistance = 1;
    bool isBestOwn = false;
    for (std::size_t n = partAt(centre - 1); n < parts_.size() && parts_[n].from < centre + 1; ++n) {
        if (!isSolid(n)) continue;
        const double middle = (std::max(parts_[n].from, centre - 1) + std::min(endOfPart(n), centre + 1)) / 2;
        const bool isOwn = parts_[n].scalar == scalar;
        if (isBestOwn && !isOwn) continue;
        if (std::abs(middle - centre) >= bestDistance && isBestOwn == isOwn) continue;
        best = middle;
        bestDistance = std::abs(middle - centre);
        isBestOwn = isOwn;
    }
    return best;
}

std::optional<double> RowResistance::between(double from, double to) const {
    double sum = 0;
    for (std::size_t n = partAt(from); n < parts_.size() && parts_[n].from < to; ++n) {
        const double voxels = std::min(to, endOfPart(n)) - std::max(from, parts_[n].from);
        const double metres = voxels * spacing_, key = keys_[parts_[n].scalar];
        if (!(voxels > 0)) continue;
        if (key > 0)
            sum += metres / key;
        else if (key == kAirKey)
            sum += voxels > kSliver ? std::min(metres / kStillAir, kMostOfAir) : 0;
        else if (voxels > kSliver)
            return std::nullopt;
    }
    return sum;
}

std::optional<SolidEnd> RowResistance::endOf(double node, bool isUpwards) const {
    const auto goesOn = [&](std::size_t part) {
        return isSolid(part) || endOfPart(part) - parts_[part].from < kSliver;
    };
    std::size_t n = partAt(node);
    if (isUpwards) {
        do ++n;
        while (n < parts_.size() && goesOn(n));
        if (n == parts_.size()) return std::nullopt;
    } else {
        while (n > 0 && goesOn(n - 1)) --n;
        if (n == 0) return std::nullopt;
    }
    const RowPart& part = parts_[n];
    if (std::abs(part.from - node) > kFarthestEnd) return std::nullopt;
    return SolidEnd{part.from, double{part.slope}, isUpwards ? double{part.upwards} : -double{part.upwards},
                    part.hasFace};
}

}  // namespace svt::simulate

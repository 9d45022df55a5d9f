#include <svt/writers/marks/blocked_places.hpp>

#include <algorithm>
#include <cmath>

namespace svt::writers {
namespace {

// The whole squares that a rectangle of a size contains at least, wherever it stands.
std::int64_t leastSquares(double size) noexcept {
    constexpr double kRoundedSize = 1e-6, kMostSize = 1e4;  // millimetres
    return static_cast<std::int64_t>(std::floor(std::min(size, kMostSize) - kRoundedSize)) - 1;
}

}  // namespace

BlockedPlaces::BlockedPlaces(const FreeSpace& space, const MarkBox& reach, std::pair<double, double> size,
                             bool withLines)
    : columns_(leastSquares(size.first)), rows_(leastSquares(size.second)) {
    constexpr double kMostArea = 1.6e7;  // mm2: ten times A0
    const double area = (reach.high.u - reach.low.u) * (reach.high.v - reach.low.v);
    const bool isEmpty = !(reach.low.u <= reach.high.u && reach.low.v <= reach.high.v);
    if (columns_ < 1 || rows_ < 1 || isEmpty || !(area <= kMostArea)) return;
    marks_ = space.marksIn(reach, withLines);
    widen(columns_);
    heighten(rows_);
}

// Marks each square that has a marked one among the `columns` squares from it to the right.
void BlockedPlaces::widen(std::int64_t columns) {
    const std::size_t words = marks_.words;
    for (std::int64_t done = 1; done < columns;) {
        const std::int64_t step = std::min(done, columns - done);
        const auto whole = static_cast<std::size_t>(step >> 6);
        const auto bits = static_cast<unsigned>(step & 63);
        for (std::size_t first = 0; first < marks_.rows.size(); first += words)
            // From the left, so that words to the right are those before the step.
            for (std::size_t w = 0; w + whole < words; ++w) {
                std::uint64_t moved = marks_.rows[first + w + whole] >> bits;
                if (bits > 0 && w + whole + 1 < words) moved |= marks_.rows[first + w + whole + 1] << (64 - bits);
                marks_.rows[first + w] |= moved;
            }
        done += step;
    }
}

// The same with the `rows` squares from it upwards.
void BlockedPlaces::heighten(std::int64_t rows) {
    for (std::int64_t done = 1; done < rows;) {
        const std::int64_t step = std::min(done, rows - done);
        const std::size_t away = static_cast<std::size_t>(step) * marks_.words;
        for (std::size_t w = 0; w + away < marks_.rows.size(); ++w) marks_.rows[w] |= marks_.rows[w + away];
        done += step;
    }
}

bool BlockedPlaces::isBlocked(const MarkBox& box) const noexcept {
    if (marks_.rows.empty()) return false;
    const auto u = static_cast<double>(marks_.left), v = static_cast<double>(marks_.low);
    const double left = std::ceil(box.low.u) - u, low = std::ceil(box.low.v) - v,
                 right = std::floor(box.high.u) - u - static_cast<double>(columns_),
                 high = std::floor(box.high.v) - v - static_cast<double>(rows_);
    const std::size_t rows = marks_.rows.size() / marks_.words;
    const double width = static_cast<double>(marks_.words * 64), height = static_cast<double>(rows);
    if (!(left >= 0 && low >= 0 && right >= left && high >= low && right < width && high < height)) return false;
    const auto u0 = static_cast<std::int64_t>(left), v0 = static_cast<std::int64_t>(low),
               u1 = static_cast<std::int64_t>(right), v1 = static_cast<std::int64_t>(high);
    // The second column and row cover the squares that this place has beyond the least number.
    return isMarked(u0, v0) || isMarked(u1, v1) || isMarked(u0, v1) || isMarked(u1, v0);
}

}  // namespace svt::writers

#include <svt/drawing/beyond/plane_index.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace svt::drawing {

PlaneIndex::PlaneIndex(std::span<const PlanePoint> corners, std::span<const std::uint32_t> firstCorner, double reach)
    : reach_(reach), items_(firstCorner.empty() ? 0 : firstCorner.size() - 1) {
    if (items_ == 0) return;
    constexpr double kFar = std::numeric_limits<double>::infinity();
    PlanePoint high{-kFar, -kFar};
    low_ = {kFar, kFar};
    for (const PlanePoint p : corners) {
        low_ = {std::min(low_.u, p.u), std::min(low_.v, p.v)};
        high = {std::max(high.u, p.u), std::max(high.v, p.v)};
    }
    low_ = {low_.u - 2 * reach, low_.v - 2 * reach};
    const double width = high.u - low_.u + 2 * reach, height = high.v - low_.v + 2 * reach;
    // About as many cells as items, but no more than 1024 on a side.
    cell_ = std::max({std::sqrt(width * height / static_cast<double>(items_)), width / 1024, height / 1024, reach});
    columns_ = static_cast<std::int32_t>(width / cell_) + 1;
    rows_ = static_cast<std::int32_t>(height / cell_) + 1;
    cellStart_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    const auto forCells = [&](const auto& body) {
        for (std::uint32_t item = 0; item < items_; ++item) {
            const auto own = corners.subspan(firstCorner[item], firstCorner[item + 1] - firstCorner[item]);
            const Rows rows = rowsOf(own);
            for (std::int32_t row = rows.first; row <= rows.last; ++row) {
                const Rows columns = columnsOf(own, row);
                for (std::int32_t column = columns.first; column <= columns.last; ++column)
                    body(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                             static_cast<std::size_t>(column),
                         item);
            }
        }
    };
    forCells([&](std::size_t cell, std::uint32_t) { ++cellStart_[cell + 1]; });
    for (std::size_t cell = 1; cell < cellStart_.size(); ++cell) cellStart_[cell] += cellStart_[cell - 1];
    cellItems_.resize(cellStart_.back());
    std::vector<std::uint32_t> next(cellStart_.begin(), cellStart_.end() - 1);
    forCells([&](std::size_t cell, std::uint32_t item) { cellItems_[next[cell]++] = item; });
}

PlaneIndex::Rows PlaneIndex::rowsOf(std::span<const PlanePoint> corners) const noexcept {
    double low = corners.front().v, high = low;
    for (const PlanePoint p : corners) {
        low = std::min(low, p.v);
        high = std::max(high, p.v);
    }
    const double first = std::floor((low - reach_ - low_.v) / cell_),
                 last = std::floor((high + reach_ - low_.v) / cell_);
    if (last < 0 || first >= rows_) return {};
    return {static_cast<std::int32_t>(std::max(first, 0.0)), static_cast<std::int32_t>(std::min(last, rows_ - 1.0))};
}

PlaneIndex::Rows PlaneIndex::columnsOf(std::span<const PlanePoint> corners, std::int32_t row) const noexcept {
    const double bottom = low_.v + row * cell_ - reach_, top = low_.v + (row + 1) * cell_ + reach_;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t n = 0; n < corners.size(); ++n) {
        PlanePoint a = corners[n], b = corners[(n + 1) % corners.size()];
        if (a.v > b.v) std::swap(a, b);
        if (b.v < bottom || a.v > top) continue;
        const auto at = [&](double v) { return a.u + (b.u - a.u) * ((v - a.v) / (b.v - a.v)); };
        const double from = a.v < bottom ? at(bottom) : a.u, to = b.v > top ? at(top) : b.u;
        low = std::min({low, from, to});
        high = std::max({high, from, to});
    }
    if (!(low <= high)) return {};
    const double first = std::floor((low - reach_ - low_.u) / cell_),
                 last = std::floor((high + reach_ - low_.u) / cell_);
    if (last < 0 || first >= columns_) return {};
    return {static_cast<std::int32_t>(std::max(first, 0.0)), static_cast<std::int32_t>(std::min(last, columns_ - 1.0))};
}

}  // namespace svt::drawing

#include <svt/analyze/outside_faces.hpp>

#include <svt/analyze/contacts/air_pieces.hpp>

#include <algorithm>
#include <array>

namespace svt::analyze {
namespace {

using volume::kNoLabel;
using volume::Run;

// Calls visit(a, b, size) for each part of two columns in which both have one scalar.
template <class Visit>
void visitPairs(std::span<const Run> a, std::span<const Run> b, const Visit& visit) {
    std::uint32_t from = 0;
    for (auto x = a.begin(), y = b.begin(); x != a.end() && y != b.end();) {
        const std::uint32_t to = std::min(x->end, y->end);
        visit(x->scalar, y->scalar, to - from);
        from = to;
        if (x->end == to) ++x;
        if (y->end == to) ++y;
    }
}

class SideCounter {
public:
    SideCounter(const volume::ColumnVolume& columns, const volume::Grid& grid,
                std::span<const std::uint32_t> groupOfScalar, std::size_t groups)
        : columns_(columns),
          groupOf_(groupOfScalar),
          // Across x and y.
          face_{grid.spacing().y * grid.spacing().z, grid.spacing().x * grid.spacing().z},
          areas_(groups) {}

    std::vector<SideArea> count() {
        const Vec3i n = columns_.dimension();
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) {
                if (i + 1 < n.x) countWhole(columns_.column(i, j), columns_.column(i + 1, j), face_[0]);
                if (j + 1 < n.y) countWhole(columns_.column(i, j), columns_.column(i, j + 1), face_[1]);
                for (const std::int32_t end : {0, n.x - 1})
                    if (i == end) countBorder(columns_.column(i, j), face_[0]);
                for (const std::int32_t end : {0, n.y - 1})
                    if (j == end) countBorder(columns_.column(i, j), face_[1]);
            }
        Pieces pieces = sweepAir(columns_, groupOf_, [](std::int32_t, std::int32_t, const AirRun&) {});
        // A second sweep, since only the first one shows which air is outside.
        (void)sweepAir(columns_, groupOf_, [&](std::int32_t i, std::int32_t j, const AirRun& run) {
            if (pieces.rootOf(run.piece) != kOutside) return;
            if (i > 0) countOutside(columns_.column(i - 1, j), run, face_[0]);
            if (i + 1 < n.x) countOutside(columns_.column(i + 1, j), run, face_[0]);
            if (j > 0) countOutside(columns_.column(i, j - 1), run, face_[1]);
            if (j + 1 < n.y) countOutside(columns_.column(i, j + 1), run, face_[1]);
        });
        return std::move(areas_);
    }

private:
    void countWhole(std::span<const Run> a, std::span<const Run> b, double face) {
        visitPairs(a, b, [&](volume::Scalar x, volume::Scalar y, std::uint32_t size) {
            const std::uint32_t left = groupOf_[x], right = groupOf_[y];
            if (left == right) return;
            if (left != kNoLabel) areas_[left].whole += face * size;
            if (right != kNoLabel) areas_[right].whole += face * size;
        });
    }
    // The outermost columns have the space beyond the grid beside them.
    void countBorder(std::span<const Run> column, double face) {
        std::uint32_t begin = 0;
        for (const Run& run : column) {
            if (const std::uint32_t group = groupOf_[run.scalar]; group != kNoLabel) {
                areas_[group].whole += face * (run.end - begin);
                areas_[group].outside += face * (run.end - begin);
            }
            begin = run.end;
        }
    }
    void countOutside(std::span<const Run> column, const AirRun& air, double face) {
        auto run = std::upper_bound(column.begin(), column.end(), air.begin,
                                    [](std::uint32_t k, const Run& candidate) { return k < candidate.end; });
        for (std::uint32_t from = air.begin; run != column.end() && from < air.end; ++run) {
            const std::uint32_t to = std::min(run->end, air.end);
            if (const std::uint32_t group = groupOf_[run->scalar]; group != kNoLabel)
                areas_[group].outside += face * (to - from);
            from = to;
        }
    }

    const volume::ColumnVolume& columns_;
    std::span<const std::uint32_t> groupOf_;
    std::array<double, 2> face_;
    std::vector<SideArea> areas_;
};

}  // namespace

std::vector<SideArea> findSideAreas(const volume::ColumnVolume& columns, const volume::Grid& grid,
                                    std::span<const std::uint32_t> groupOfScalar, std::size_t groups) {
    return SideCounter(columns, grid, groupOfScalar, groups).count();
}

OutsideAir::OutsideAir(const volume::ColumnVolume& columns, std::span<const std::uint32_t> labelOfScalar)
    : dimension_(columns.dimension()), first_(std::size_t(dimension_.x) * std::size_t(dimension_.y) + 1, 0) {
    Pieces pieces = sweepAir(columns, labelOfScalar, [](std::int32_t, std::int32_t, const AirRun&) {});
    // A second sweep, since only the first one shows which air is outside. It visits the columns in order.
    (void)sweepAir(columns, labelOfScalar, [&](std::int32_t i, std::int32_t j, const AirRun& run) {
        if (pieces.rootOf(run.piece) != kOutside) return;
        ++first_[std::size_t(i) + std::size_t(dimension_.x) * std::size_t(j) + 1];
        intervals_.push_back({run.begin, run.end});
    });
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
}

bool OutsideAir::contains(std::int32_t i, std::int32_t j, std::int32_t k) const noexcept {
    if (i < 0 || j < 0 || k < 0 || i >= dimension_.x || j >= dimension_.y || k >= dimension_.z) return true;
    const std::size_t column = std::size_t(i) + std::size_t(dimension_.x) * std::size_t(j);
    const auto begin = intervals_.begin() + std::ptrdiff_t(first_[column]);
    const auto end = intervals_.begin() + std::ptrdiff_t(first_[column + 1]);
    const auto next = std::upper_bound(begin, end, std::uint32_t(k),
                                       [](std::uint32_t at, const Interval& one) { return at < one.end; });
    return next != end && next->begin <= std::uint32_t(k);
}

}  // namespace svt::analyze

#pragma once
/// \file
/// Connected pieces of background (voxels connected by faces), and the one that reaches the border of the grid.

#include <svt/volume/column_volume.hpp>
#include <svt/volume/label_table.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace svt::analyze {

inline constexpr std::uint32_t kOutside = 0;

/// Union-find; the smaller number becomes the root, so all that is joined with the outside is kOutside.
class Pieces {
public:
    [[nodiscard]] std::uint32_t rootOf(std::uint32_t piece) noexcept {
        while (parent_[piece] != piece) piece = parent_[piece] = parent_[parent_[piece]];
        return piece;
    }
    std::uint32_t add() {
        parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
        return parent_.back();
    }
    void join(std::uint32_t a, std::uint32_t b) noexcept {
        a = rootOf(a);
        b = rootOf(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    [[nodiscard]] std::size_t size() const noexcept { return parent_.size(); }

private:
    std::vector<std::uint32_t> parent_{kOutside};
};

/// A run of background.
struct AirRun {
    std::uint32_t begin = 0, end = 0, piece = 0;
};

/// The background of a row of columns.
struct AirRow {
    std::vector<AirRun> runs;
    std::vector<std::size_t> start;  // first run of each column, and the end
    [[nodiscard]] std::span<AirRun> column(std::size_t i) {
        return std::span(runs).subspan(start[i], start[i + 1] - start[i]);
    }
};

// Joins runs of adjacent columns that share a face; runs of `own` without a piece get that of a neighbour.
inline void joinWith(std::span<AirRun> own, std::span<const AirRun> neighbors, Pieces& pieces) {
    for (std::size_t a = 0, b = 0; a < own.size() && b < neighbors.size();) {
        if (own[a].begin < neighbors[b].end && neighbors[b].begin < own[a].end) {
            if (own[a].piece == volume::kNoLabel)
                own[a].piece = neighbors[b].piece;
            else
                pieces.join(own[a].piece, neighbors[b].piece);
        }
        if (own[a].end < neighbors[b].end)
            ++a;
        else
            ++b;
    }
}

/// Connected component labelling, row by row: calls visit(i, j, run) for each run of background, with a provisional
/// number of its piece. Two sweeps give the same numbers.
/// \param labelOf  by scalar; kNoLabel: background
template <class Visit>
Pieces sweepAir(const volume::ColumnVolume& columns, std::span<const std::uint32_t> labelOf, const Visit& visit) {
    const Vec3i n = columns.dimension();
    const auto top = static_cast<std::uint32_t>(n.z);
    Pieces pieces;
    AirRow row, below;
    for (std::int32_t j = 0; j < n.y; ++j) {
        std::swap(row, below);
        row.runs.clear();
        row.start.assign(1, 0);
        for (std::int32_t i = 0; i < n.x; ++i) {
            const auto first = static_cast<std::ptrdiff_t>(row.runs.size());
            std::uint32_t begin = 0;
            for (const volume::Run& run : columns.column(i, j)) {
                if (labelOf[run.scalar] == volume::kNoLabel) {
                    if (!row.runs.empty() && std::ssize(row.runs) > first && row.runs.back().end == begin)
                        row.runs.back().end = run.end;
                    else
                        row.runs.push_back({begin, run.end, volume::kNoLabel});
                }
                begin = run.end;
            }
            row.start.push_back(row.runs.size());
            const std::span<AirRun> own = row.column(std::size_t(i));
            if (i > 0) joinWith(own, row.column(std::size_t(i) - 1), pieces);
            if (j > 0) joinWith(own, below.column(std::size_t(i)), pieces);
            const bool isBorder = i == 0 || j == 0 || i == n.x - 1 || j == n.y - 1;
            for (AirRun& run : own) {
                const bool isOpen = isBorder || run.begin == 0 || run.end == top;
                if (run.piece == volume::kNoLabel)
                    run.piece = isOpen ? kOutside : pieces.add();
                else if (isOpen)
                    pieces.join(run.piece, kOutside);
                visit(i, j, run);
            }
        }
    }
    return pieces;
}

}  // namespace svt::analyze

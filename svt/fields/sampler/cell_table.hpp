#pragma once
/// \file
/// The nodes that each voxel of a cell reaches, for lattices with steps of more than one voxel.

#include <svt/fields/sampler/lattice_axes.hpp>
#include <svt/fields/sampler/medium_grid.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace svt::fields {

inline constexpr std::size_t kNoNode = std::numeric_limits<std::size_t>::max();
/// Cells around a cell that lead to its nearest node.
inline constexpr std::int32_t kReachCells = 2;

/// The nodes that a point may take its value from.
struct Reach {
    std::uint8_t corners = 0;         ///< of the cell: bit c is LatticeAxes::nodeOf(cell, c)
    std::size_t elsewhere = kNoNode;  ///< if no corner has a value: another node
    friend bool operator==(const Reach&, const Reach&) = default;
};

/// The parts of each cell: voxels of one medium that are joined by faces. Immutable; any thread may read it.
class CellTable {
public:
    CellTable() = default;
    /// \param hasValue  one entry per node: whether it has a value at any time
    /// Cost: O(cells + voxels of cells with several media). The result does not depend on the number of threads.
    CellTable(const LatticeAxes& axes, const MediumGrid& media, const std::vector<bool>& hasValue);

    /// \param voxel  in the box of the cell
    [[nodiscard]] Reach at(const LatticeAxes& axes, Vec3i cell, Vec3i voxel) const noexcept;

    [[nodiscard]] std::size_t sizeBytes() const noexcept;

private:
    friend class CellTableBuilder;
    static constexpr std::uint32_t kMissing = 0, kJoined = 1, kFirstRecord = 2;
    // A record: the number of parts; per part its corners and two words of the other node; bit planes of the part of each voxel.
    static constexpr std::size_t kPartWords = 3;

    std::vector<std::uint32_t> cells_;  // kMissing, kJoined, or kFirstRecord + the offset of a record in the layer
    std::vector<std::vector<std::uint32_t>> layers_;  // records of the cells of one k
};

}  // namespace svt::fields

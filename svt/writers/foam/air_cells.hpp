#pragma once
/// \file
/// The air of rooms as cells of a mesh: a cell per voxel, in one piece.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace svt::writers {

struct AirCells {
    static constexpr std::int32_t kNone = -1;

    Vec3i first{};                      ///< voxel of the volume at the lower corner of the box around the air
    Vec3i size{};                       ///< voxels of the box
    std::vector<std::int32_t> numbers;  ///< by voxel of the box, x fastest: the number of its cell, or kNone
    std::uint32_t count = 0;            ///< cells; they are numbered in the order of the voxels
    std::uint64_t leftOut = 0;          ///< voxels of pieces that do not touch the largest one

    [[nodiscard]] std::size_t indexOf(Vec3i voxel) const noexcept {
        const auto [x, y, z] = voxel;
        return static_cast<std::size_t>(x) +
               static_cast<std::size_t>(size.x) *
                   (static_cast<std::size_t>(y) + static_cast<std::size_t>(size.y) * static_cast<std::size_t>(z));
    }
    [[nodiscard]] Vec3i voxelAt(std::size_t index) const noexcept {
        const auto nx = static_cast<std::size_t>(size.x), ny = static_cast<std::size_t>(size.y);
        return {static_cast<std::int32_t>(index % nx), static_cast<std::int32_t>(index / nx % ny),
                static_cast<std::int32_t>(index / (nx * ny))};
    }
    /// The number of the cell at a voxel of the box or beside it.
    [[nodiscard]] std::int32_t at(Vec3i voxel) const noexcept {
        for (int axis = 0; axis < 3; ++axis)
            if (voxel[axis] < 0 || voxel[axis] >= size[axis]) return kNone;
        return numbers[indexOf(voxel)];
    }
};

/// Voxels of air count as connected where they have a face in common. Pieces that together have at most 1 % of the
/// cells of the largest piece are left out.
/// \param air      query for the rooms; a flat or storey stands for its rooms; empty: all
/// \param maxCells bound of the cells, and, times 8, of the voxels of their box
/// \return the cells; BadQuery; NothingSelected for no air; BadArgument for more cells than maxCells, and for several
///         large pieces, with the rooms of the largest ones
/// Cost: O(voxels of the box). Memory: 12 bytes for each.
[[nodiscard]] Result<AirCells> airCells(const volume::SemanticVolume& volume, const std::string& air,
                                        std::uint64_t maxCells);

}  // namespace svt::writers

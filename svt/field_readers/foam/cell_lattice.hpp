#pragma once
/// \file
/// The cells of an OpenFOAM mesh as nodes of a lattice.

#include <svt/core/result.hpp>
#include <svt/field_readers/common/placement.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace svt::field_readers {

struct CellLattice {
    NodePlaces places;                      ///< centres of cells along the axes of the mesh, metres
    std::vector<std::uint32_t> nodeOfCell;  ///< index of the node, x fastest
    std::optional<Frame> frame;             ///< by the note of `svt convert`; unset: the mesh states no place

    [[nodiscard]] std::size_t nodes() const noexcept { return places[0].size() * places[1].size() * places[2].size(); }
};

/// Reads `constant/polyMesh` of a case. All faces must lie across an axis, so that cells are boxes, as those of `svt
/// convert` and of blockMesh. Their centres are the nodes, so cells of several sizes have a lattice with gaps.
/// \return the lattice; CannotOpen; BadField with the file, where a cell is not a box, or two cells have one place;
///         InputTooBig for files over maxBytes, and for over 16 nodes per cell
/// Cost: O(points + faces + cells log cells). Memory: 5 times that of the files.
[[nodiscard]] Result<CellLattice> readCellLattice(const std::filesystem::path& folder, std::uint64_t maxBytes);

}  // namespace svt::field_readers

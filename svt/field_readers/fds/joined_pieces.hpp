#pragma once
/// \file
/// The results of several meshes on one lattice.

#include <svt/field_readers/common/placement.hpp>
#include <svt/field_readers/fds/frame_file.hpp>
#include <svt/field_readers/fds/smv_file.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace svt::field_readers {

/// The results of one quantity in one mesh.
struct Piece {
    const SmvFile* file = nullptr;
    const SmvMesh* mesh = nullptr;
    FrameFile list;
    NodePlaces places;  ///< of the values that count: nodes, or centres of cells without the ghost cells
    Vec3i skipped{};    ///< values before them, along each axis
};

/// Places of all pieces, and the index there of each value of a piece.
struct Joined {
    NodePlaces places;
    std::vector<std::array<std::size_t, 3>> first;  ///< by piece: its first value; the next values follow one by one

    [[nodiscard]] Vec3i size() const noexcept {
        return {static_cast<std::int32_t>(places[0].size()), static_cast<std::int32_t>(places[1].size()),
                static_cast<std::int32_t>(places[2].size())};
    }
};

/// The common lattice of pieces that agree. Within the extent of a piece, the places of the lattice are those of the piece.
/// Along an axis, the pieces leave no space out. All have the same times. The lattice has at most four times their values.
/// \return the lattice, or nothing where they do not agree
[[nodiscard]] std::optional<Joined> joinPieces(std::span<const Piece> pieces);

/// Whether two lists of times agree as far as both reach.
[[nodiscard]] bool hasSameTimes(std::span<const double> a, std::span<const double> b) noexcept;

}  // namespace svt::field_readers

#pragma once
/// \file
/// Lattices of files in the index space of a volume.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/field_readers/common/reading.hpp>
#include <svt/fields/field.hpp>
#include <svt/volume/grid.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::field_readers {

/// The frame of a file: world = origin + axes * local.
struct Frame {
    Vec3d origin{};                                                             ///< world space, metres
    std::array<Vec3d, 3> axes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};  ///< unit vectors
};

/// The frame in a text that `svt convert` writes into a case: "Metres from (x, y, z) along (a, b, c) and (d, e, f)". The
/// first axis points along x of the case, the second along y.
[[nodiscard]] std::optional<Frame> frameOfComment(std::string_view text);

/// Places of nodes along the axes of a file, strictly ascending, metres.
using NodePlaces = std::array<std::vector<double>, 3>;

/// A lattice, and where the nodes of the file are in it.
struct PlacedLattice {
    fields::Lattice lattice;
    std::array<int, 3> fileAxis{0, 1, 2};                 ///< of the file, by axis of the volume
    std::array<bool, 3> isReversed{false, false, false};  ///< by axis of the volume

    [[nodiscard]] bool isSame() const noexcept {
        return fileAxis == std::array{0, 1, 2} && isReversed == std::array{false, false, false};
    }
};

/// \return the lattice, or BadArgument where the axes of the file are not parallel to those of the grid, with the angle
[[nodiscard]] Result<PlacedLattice> placeLattice(const NodePlaces& places, const Frame& frame,
                                                 const volume::Grid& grid);

/// Reorders the values of a scalar field from the order of the file to that of the lattice. Cost: O(values).
void reorder(const PlacedLattice& placed, const Vec3i& fileSize, std::vector<float>& values);

/// The box of the lattice's nodes in index space.
[[nodiscard]] Box3d boxOf(const fields::Lattice& lattice) noexcept;
/// The box of all voxels in index space.
[[nodiscard]] Box3d boxOf(const volume::Grid& grid) noexcept;
/// The world box around a box of index space.
[[nodiscard]] Box3d worldBox(const Box3d& index, const volume::Grid& grid) noexcept;
/// "(0, 0, 0) to (1, 2, 3)", with millimetres.
[[nodiscard]] std::string boxText(const Box3d& box);

/// FieldOutside with both boxes.
/// \param field   in index space
/// \param remedy  for the message
[[nodiscard]] Error outsideError(std::string_view name, const Box3d& field, const Reading& reading,
                                 std::string_view remedy = "give the place of its origin with --at X,Y,Z");

}  // namespace svt::field_readers

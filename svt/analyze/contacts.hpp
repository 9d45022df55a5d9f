#pragma once
/// \file
/// Contacts between labels and their areas: the neighbours of each label, and its surface area.
///
/// The faces between voxels overestimate the area of an oblique surface by up to a factor of sqrt(3). But their counts
/// across x, y and z are the surface's projections along these axes. So area is measured in cells of 8 x 8 x 8 voxels.
/// It is the length of the vector of the three counts (times the area of a face). This is exact for a plane through the
/// whole cell. Where axis-aligned faces meet each other, as on a box, or meet an oblique one, areas are summed:
///
///     a slope: sqrt(4^2 + 9^2)   --+              an edge: 4 + 9    --------+
///                                  +--+                                     |
///                                     +--+                                  |
///                                        +--                                +
///
/// The two cases are distinguished by the steps: on a digital plane, one side of each step is a single voxel; on an
/// edge it is not. Error of the area, measured on solids of known area (contacts_test.cpp), with edges and radii in
/// voxels:
///
///     | boxes along the grid                            | 0 %; -1.5 % where edges lie one voxel from two cell sides
///     | planes of any slope, discs                      | -1.5 to +4 %, on average +1 %
///     | boxes rotated about z   edges of 20, 30, 50     | -11, -5, -3 % to +1 %
///     | boxes rotated freely    edges of 20, 30, 50     | -14, -8, -5 % at most
///     | spheres                 radius 10, 15, 20, 30   | -4.5, -2.5, -1, +-0.5 % at most
///
/// Area is lost at oblique edges, up to two voxels along each; a single voxel counts 3.5 of its 6 faces.

#include <svt/volume/column_volume.hpp>
#include <svt/volume/grid.hpp>
#include <svt/volume/label_table.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace svt::analyze {

/// The contact of two labels, or of a label and background.
struct Contact {
    std::uint32_t a = 0;                   ///< label
    std::uint32_t b = volume::kNoLabel;    ///< label > a, or kNoLabel: background, including space beyond the grid
    double area = 0;                       ///< m2
    std::array<std::uint64_t, 3> faces{};  ///< faces between their voxels across x, y, z
    friend bool operator==(const Contact&, const Contact&) = default;
};

/// All pairs of labels with voxels that share a face, ordered by (a, b). Scalars of one label are one body. The sum
/// over a label's contacts is its surface area.
/// \param threads  0: all cores; the result does not depend on it
/// Cost: O(runs of the distinct 9 x 9 footprints of columns in each tile). Memory: about twice the result.
[[nodiscard]] std::vector<Contact> findContacts(const volume::ColumnVolume& columns, const volume::Grid& grid,
                                                const volume::LabelTable& labels, int threads = 0);

/// A neighbour of a label, and the area of their contact.
struct Neighbor {
    std::uint32_t label = volume::kNoLabel;  ///< kNoLabel: background
    double area = 0;                         ///< m2
    friend bool operator==(const Neighbor&, const Neighbor&) = default;
};

/// The neighbours of `label`, largest area first; those of equal area by label. Cost: O(contacts).
[[nodiscard]] std::vector<Neighbor> findNeighbors(std::uint32_t label, const std::vector<Contact>& contacts);

/// Indices of the contacts of one label in `contacts`, ascending. Cost: O(contacts).
[[nodiscard]] std::vector<std::size_t> contactsWith(std::uint32_t label, const std::vector<Contact>& contacts);

}  // namespace svt::analyze

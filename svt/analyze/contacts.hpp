#pragma once
/// \file
/// Where labels touch, and with how much area: who is a neighbour of whom, and the surface of each label.
///
/// The faces between voxels overstate a slanted surface, by up to a factor of sqrt(3). But their counts across x, y and
/// z are the surface's projections along these axes. So it is measured cell by cell, in cells of 8 x 8 x 8 voxels: the
/// area is the length of the vector of the three counts (times the area of a face), which is exact for a plane that
/// goes through the cell. Where flat faces meet as those of a box do, or a flat one meets a slanted one, they are
/// summed:
///
///     a slope: sqrt(4^2 + 9^2)   --+              an edge: 4 + 9    --------+
///                                  +--+                                     |
///                                     +--+                                  |
///                                        +--                                +
///
/// A digital plane has corners with one arm of a single voxel, an edge has not. How far the area may be off, found on
/// solids of known area (contacts_test.cpp) of edges and radii in voxels:
///
///     boxes along the grid                              0 %; -1.5 % where edges lie one voxel from two cell sides
///     planes of any slope, discs                        -1.5 to +4 %, on average +1 %
///     boxes turned about z      edges of 20, 30, 50     -11, -5, -3 % to +1 %
///     boxes turned any way      edges of 20, 30, 50     -14, -8, -5 % at the most
///     spheres                   radius 10, 15, 20, 30   -4.5, -2.5, -1, +-0.5 % at the most
///
/// What is lost is lost at slanted edges, up to two voxels along each; a speck of one voxel counts 3.5 of its 6 faces.

#include <svt/volume/column_volume.hpp>
#include <svt/volume/grid.hpp>
#include <svt/volume/label_table.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace svt::analyze {

/// Two labels side by side, or one beside background.
struct Contact {
    std::uint32_t a = 0;                   ///< label
    std::uint32_t b = volume::kNoLabel;    ///< label > a, or kNoLabel: background, what is beyond the grid included
    double area = 0;                       ///< m2
    std::array<std::uint64_t, 3> faces{};  ///< faces between their voxels across x, y, z
    friend bool operator==(const Contact&, const Contact&) = default;
};

/// All pairs of labels with voxels side by side (sharing a face), ordered by (a, b). Scalars of one label are one body.
/// The sum over a label's contacts is its surface.
/// \param threads  0: all cores; the result does not depend on it
/// Cost: O(runs of the distinct 9 x 9 footprints of columns in each tile). Memory: about twice the result.
[[nodiscard]] std::vector<Contact> contactsOf(const volume::ColumnVolume& columns, const volume::Grid& grid,
                                              const volume::LabelTable& labels, int threads = 0);

/// Who touches a label, and with how much area.
struct Neighbor {
    std::uint32_t label = volume::kNoLabel;  ///< kNoLabel: background
    double area = 0;                         ///< m2
    friend bool operator==(const Neighbor&, const Neighbor&) = default;
};

/// The neighbours of `label`, the largest area first; those of equal areas by label. Cost: O(contacts).
[[nodiscard]] std::vector<Neighbor> neighborsOf(std::uint32_t label, const std::vector<Contact>& contacts);

/// The contacts of one label among those of all, by index, ascending. Cost: O(contacts).
[[nodiscard]] std::vector<std::size_t> contactsWith(std::uint32_t label, const std::vector<Contact>& contacts);

}  // namespace svt::analyze

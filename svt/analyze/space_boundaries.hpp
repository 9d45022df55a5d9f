#pragma once
/// \file
/// The layers between two spaces, or a space and the outside, with their thickness: the input of energy and acoustic
/// models (in IFC: space boundaries of the second level).
///
/// Lines of samples are followed along x, y and z. Where one leaves a space and enters another, the labels between are
/// a path:
///
///     kitchen | plaster 0.015 | brick 0.24 | plaster 0.02 | outside        along x, 4.32 m2
///
/// An element along the grid's axes has its true thickness and area. A slanted one, with the normal n, is crossed along
/// more than one axis, with the area A |n_i| and the thickness t / |n_i| along axis i. So the conductances A n_i^2 / t
/// of its paths add up to its own, A / t.

#include <svt/volume/column_volume.hpp>
#include <svt/volume/grid.hpp>
#include <svt/volume/label_table.hpp>

#include <cstdint>
#include <vector>

namespace svt::analyze {

/// A label between two spaces.
struct BoundaryLayer {
    std::uint32_t label = 0;
    double thickness = 0;  ///< along the axis, metres, mean over the area
    friend bool operator==(const BoundaryLayer&, const BoundaryLayer&) = default;
};

/// All lines along one axis that lead from `a` to `b` through the same labels.
struct SpaceBoundary {
    std::uint32_t a = 0;                 ///< label of a space
    std::uint32_t b = volume::kNoLabel;  ///< label > a, or kNoLabel: outside
    int axis = 0;                        ///< of the grid: 0 x, 1 y, 2 z
    std::vector<BoundaryLayer> layers;   ///< from a to b; empty: they touch
    double area = 0;                     ///< across the axis, m2
    friend bool operator==(const SpaceBoundary&, const SpaceBoundary&) = default;
};

/// The space of each label. Spaces filled with air (model::isSpace) belong to themselves. Objects in a room, such as
/// furniture, and the sheets that bound it belong to the room. kNoLabel: a component, also a surface that stands for
/// the material behind it (volume::Filling::Body), and its doors and windows.
[[nodiscard]] std::vector<std::uint32_t> spacesOfLabels(const volume::LabelTable& labels);

/// Background counts as outside, also where it is enclosed. Paths from a space back into itself, and between outside
/// and outside, are left out.
/// \return ordered by (a, b, axis, layers' labels)
/// Cost: O(columns + area of surfaces in voxels). Memory: the result, and a plane of samples.
[[nodiscard]] std::vector<SpaceBoundary> findSpaceBoundaries(const volume::ColumnVolume& columns,
                                                             const volume::Grid& grid,
                                                             const volume::LabelTable& labels);

}  // namespace svt::analyze

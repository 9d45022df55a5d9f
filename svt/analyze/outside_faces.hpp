#pragma once
/// \file
/// The sides of components, and the part of them that outside air touches: the hull of a building.

#include <svt/volume/column_volume.hpp>
#include <svt/volume/grid.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::analyze {

/// Faces between voxels across x and y, m2.
struct SideArea {
    double whole = 0;    ///< towards other groups and background
    double outside = 0;  ///< of it: towards outside air
    friend bool operator==(const SideArea&, const SideArea&) = default;
};

/// The sides of each group of scalars. Outside air is background that is connected to the border of the grid (voxels
/// connected by faces), and the space beyond the grid. Rooms are groups, so the air in them is not outside air.
/// \param groupOfScalar  the group of each scalar; volume::kNoLabel: background
/// \param groups         number of groups
/// Faces overestimate the area of an oblique side by up to a factor of sqrt(2), in both numbers alike.
/// Cost: O(runs of all columns). Memory: see findGaps().
[[nodiscard]] std::vector<SideArea> findSideAreas(const volume::ColumnVolume& columns, const volume::Grid& grid,
                                                  std::span<const std::uint32_t> groupOfScalar, std::size_t groups);

/// The samples of outside air: background that is connected to the border of the grid (voxels connected by faces), and
/// the space beyond the grid.
class OutsideAir {
public:
    /// \param labelOfScalar  see volume::LabelTable::labelOfScalar()
    /// Cost: O(runs of all columns), and two words for each run of outside air.
    OutsideAir(const volume::ColumnVolume& columns, std::span<const std::uint32_t> labelOfScalar);

    /// Cost: O(log runs).
    [[nodiscard]] bool contains(std::int32_t i, std::int32_t j, std::int32_t k) const noexcept;

private:
    struct Interval {
        std::uint32_t begin = 0, end = 0;
    };
    Vec3i dimension_;
    std::vector<std::size_t> first_;  // of column (i, j): intervals_[first_[i + nx * j]] .. [+ 1]
    std::vector<Interval> intervals_;
};

}  // namespace svt::analyze

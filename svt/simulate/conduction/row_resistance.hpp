#pragma once
/// \file
/// Resistances along a row of voxels: between the nodes of two cells, and from a node to the air.

#include <svt/simulate/conduction/row_rays.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::simulate {

/// Keys of scalars that do not conduct; others have their conductivity, W/(m K).
inline constexpr double kAirKey = -1, kOtherKey = -2;

/// The end of solids along a row.
struct SolidEnd {
    double at = 0;  ///< voxels, as RowPart::from
    double slope = 1;
    double upwards = 0;  ///< of the normal out of the solid: the part along z
    bool hasFace = false;
};

/// A row with the conductivities of its parts. All must outlive it.
class RowResistance {
public:
    /// \param keys     by scalar
    /// \param spacing  metres along the row
    RowResistance(std::span<const RowPart> parts, std::span<const double> keys, double spacing)
        : parts_(parts), keys_(keys), spacing_(spacing) {}

    /// Where a cell is on this row: the centre of its voxel if a solid is there, or the nearest place of a solid within a
    /// twentieth of a voxel. Thin parts get voxels whose centre their solid does not reach. Then it is the middle of the
    /// nearest part of a solid within a voxel, if there is one, first of the cell's own label.
    [[nodiscard]] std::optional<double> nodeOf(std::int32_t voxel, volume::Scalar scalar, bool isThin) const;
    /// m2 K/W between two places, from < to. Nothing if no heat passes. Air between solids has a resistance of at most
    /// 0.18 m2 K/W.
    [[nodiscard]] std::optional<double> between(double from, double to) const;
    /// Where the solids around `node` end, upwards or downwards; nothing if that is over 1.5 voxels away.
    [[nodiscard]] std::optional<SolidEnd> endOf(double node, bool isUpwards) const;

private:
    [[nodiscard]] bool isSolid(std::size_t n) const noexcept { return keys_[parts_[n].scalar] > 0; }
    [[nodiscard]] std::optional<double> thinNodeOf(double centre, volume::Scalar scalar) const;
    [[nodiscard]] std::size_t partAt(double place) const noexcept;
    [[nodiscard]] double endOfPart(std::size_t n) const noexcept;

    std::span<const RowPart> parts_;
    std::span<const double> keys_;
    double spacing_;
};

}  // namespace svt::simulate

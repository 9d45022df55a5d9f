#pragma once
/// \file
/// World-space directions of a volume's planes and voxel faces.

#include <svt/core/vec.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/grid.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::render {

/// Directions that the planes and voxel faces of a volume have in world space.
class DirectionTable {
public:
    struct Directions {
        Vec3d normal;  ///< world space, unit length
        Vec3d away;    ///< the same direction in index space, longest component 1
    };
    DirectionTable(const volume::BrickVolume& volume, const volume::Grid& grid);

    /// Of voxel faces across an axis, upwards.
    [[nodiscard]] const Directions& axis(int axis) const noexcept { return axes_[static_cast<std::size_t>(axis)]; }
    /// Of a plane of BrickVolume::oblique(), to its positive side.
    [[nodiscard]] const Directions& plane(std::uint32_t number) const noexcept { return planes_[number]; }
    [[nodiscard]] std::span<const Directions> planes() const noexcept { return planes_; }
    /// Of what has `index` as its normal in index space.
    [[nodiscard]] Directions directions(Vec3d index) const noexcept;
    /// Directions::away of a direction in world space.
    [[nodiscard]] Vec3d away(Vec3d normal) const noexcept;

private:
    const volume::Grid& grid_;
    std::array<Directions, 3> axes_;
    std::vector<Directions> planes_;
};

}  // namespace svt::render

#pragma once
/// \file
/// World-space normals of a volume's planes and voxel faces, precomputed.

#include <svt/core/vec.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/grid.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::render {

/// World-space normals of a volume's planes and voxel faces.
class DirectionTable {
public:
    struct Directions {
        Vec3d normal;        ///< world space, unit length
        Vec3d outwardIndex;  ///< the same direction in index space, scaled to a longest component of 1
    };
    DirectionTable(const volume::BrickVolume& volume, const volume::Grid& grid);

    /// Normal of voxel faces across an axis, in the axis's positive direction.
    [[nodiscard]] const Directions& axis(int axis) const noexcept { return axes_[static_cast<std::size_t>(axis)]; }
    /// Normal of a plane of BrickVolume::planes(), towards its positive side.
    [[nodiscard]] const Directions& plane(std::uint32_t number) const noexcept { return planes_[number]; }
    [[nodiscard]] std::span<const Directions> planes() const noexcept { return planes_; }
    /// Directions of a surface with the normal (covector) `index` in index space.
    [[nodiscard]] Directions directions(Vec3d index) const noexcept;
    /// Directions::outwardIndex for a normal in world space.
    [[nodiscard]] Vec3d outwardIndex(Vec3d normal) const noexcept;

private:
    const volume::Grid& grid_;
    std::array<Directions, 3> axes_;
    std::vector<Directions> planes_;
};

}  // namespace svt::render

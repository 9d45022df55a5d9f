#pragma once
/// \file
/// The sample positions of a volume.
///
///      by dimension                    by spacing               index space: sample (i, j, k) is at (i, j, k), the
///                                      x   x   x   x   x        centre of its voxel [i-1/2, i+1/2] x ...
///      x---x---x---x   dimension 4       +-----------+          x runs fastest, then y, then z:
///      |   envelope                    x | x   x   x | x        linear index = i + nx * (j + ny * k)
///      x---x---x---x                     +-----------+
///                                      x   x   x   x   x
///
/// A grid by dimension is the node grid of the paper (section 3.2), spacing[i] = envelope[i] / (dimension[i] - 1): the
/// first and last samples lie on the envelope. In a grid by spacing, they lie half a step outside of it. So faces at
/// whole steps lie between samples, both lower and upper faces. A model that is rotated by 90 or 180 degrees gets the
/// same labels.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <array>
#include <cstdint>

namespace svt::volume {

/// World space = origin + axes * (index * spacing). `axes` is a rotation: identity for a grid along the world axes, a
/// rotation about z for a building's own frame.
class Grid {
public:
    static constexpr std::int32_t kMaxDimension = 65535;

    /// A grid of `dimension` samples over `envelope` (world space, metres; local to `axes` where given).
    /// An axis without extent is widened to one thousandth of the largest extent, at least 1 mm.
    /// \return the grid, or BadDimension if a dimension is outside 2..65535 or the envelope is empty, or GridTooLarge
    ///         if there are more than 2^31 columns (nx * ny)
    [[nodiscard]] static Result<Grid> fromDimension(const Box3d& envelope, Vec3i dimension);

    /// A grid with `spacing` metres (> 0) between samples along each axis. The envelope is widened equally on both
    /// sides to a whole number of steps, and by half a step more. Errors as fromDimension.
    [[nodiscard]] static Result<Grid> fromSpacing(const Box3d& envelope, Vec3d spacing);

    /// From stored values, which are checked and not changed. Errors as fromDimension, and BadDimension if `spacing`,
    /// `origin` or `axes` are invalid.
    [[nodiscard]] static Result<Grid> fromParts(Vec3i dimension, Vec3d spacing, Vec3d origin,
                                                const std::array<Vec3d, 3>& axes);

    [[nodiscard]] Vec3i dimension() const noexcept { return dimension_; }
    [[nodiscard]] Vec3d spacing() const noexcept { return spacing_; }  ///< metres
    [[nodiscard]] Vec3d origin() const noexcept { return origin_; }    ///< sample (0, 0, 0), world space
    [[nodiscard]] const std::array<Vec3d, 3>& axes() const noexcept {
        return axes_;
    }  ///< unit vectors of i, j, k in world space
    [[nodiscard]] std::uint64_t sampleCount() const noexcept;
    [[nodiscard]] double voxelVolume() const noexcept { return spacing_.x * spacing_.y * spacing_.z; }  ///< m3
    [[nodiscard]] bool isAxisParallel() const noexcept;

    [[nodiscard]] Vec3d worldFromIndex(Vec3d index) const noexcept;
    [[nodiscard]] Vec3d indexFromWorld(Vec3d world) const noexcept;
    /// Transforms a direction (without the offset); the result is not normalized.
    [[nodiscard]] Vec3d worldFromIndexDirection(Vec3d index) const noexcept;
    [[nodiscard]] Vec3d indexFromWorldDirection(Vec3d world) const noexcept;

    /// This grid, rotated: `axes` replaces the identity. For an envelope that was measured along `axes`, relative to
    /// `pivot` (world space).
    [[nodiscard]] Grid turned(const std::array<Vec3d, 3>& axes, Vec3d pivot) const;

    friend bool operator==(const Grid&, const Grid&) = default;

private:
    Vec3i dimension_{2, 2, 2};
    Vec3d spacing_{1, 1, 1};
    Vec3d origin_{};
    std::array<Vec3d, 3> axes_{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
};

}  // namespace svt::volume

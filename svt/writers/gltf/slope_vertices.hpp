#pragma once
/// \file
/// Moves vertices of voxel surfaces back onto the oblique planes of the original geometry, so that slopes are smooth
/// instead of stairs.
///
///     stairs of voxels           vertices on the plane
///          +--+                        __/
///       +--+           ->           __/
///     --+                         _/

#include <svt/volume/brick_volume.hpp>

#include <cstdint>
#include <span>

namespace svt::writers {

/// Final positions of voxel corners. A position depends only on the volume and the corner, so closed surfaces stay
/// closed and touching labels stay in contact. Threads: reads only.
class SlopeVertices {
public:
    /// \param bricks         of the volume, with BrickFaces::Planes; must outlive this
    /// \param labelOfScalar  entry s owns scalar s, volume::kNoLabel for none; must outlive this
    SlopeVertices(const volume::BrickVolume& bricks, std::span<const std::uint32_t> labelOfScalar)
        : bricks_(bricks), labelOfScalar_(labelOfScalar) {}

    /// Position of the corner (i, j, k) of voxel (i, j, k), in voxels from the volume's lower corner. The voxels around
    /// the corner with different labels are examined in pairs. A plane of their brick or of an adjacent brick counts if
    /// it separates a pair and the brick's code classifies both voxels correctly. The corner moves to such a plane, or
    /// to the line where two of them meet. Any other separation fixes the corner along its axis. A corner that would
    /// move by more than a voxel, or that more than two planes separate, does not move.
    [[nodiscard]] Vec3d place(Vec3i corner) const;

private:
    [[nodiscard]] std::uint32_t separatingPlane(Vec3i a, Vec3i b) const;

    const volume::BrickVolume& bricks_;
    std::span<const std::uint32_t> labelOfScalar_;
};

}  // namespace svt::writers

#pragma once
/// \file
/// Corners of voxel surfaces put back onto the oblique planes that the voxels came from, so that slopes are slopes and
/// not stairs.
///
///     stairs of voxels           corners on the plane
///          +--+                        __/
///       +--+           ->           __/
///     --+                         _/

#include <svt/volume/brick_volume.hpp>

#include <cstdint>
#include <span>

namespace svt::writers {

/// Where the corners of a volume's voxels belong. A place depends on the volume and the corner alone, so surfaces that
/// are closed stay closed, and labels that touch still do. Threads: reads only.
class SlopeVertices {
public:
    /// \param bricks         of the volume, with BrickFaces::Planes; must outlive this
    /// \param labelOfScalar  entry s owns scalar s, volume::kNoLabel for none; must outlive this
    SlopeVertices(const volume::BrickVolume& bricks, std::span<const std::uint32_t> labelOfScalar)
        : bricks_(bricks), labelOfScalar_(labelOfScalar) {}

    /// The place of the corner (i, j, k) of voxel (i, j, k), in voxels from the volume's lower corner. Of the voxels
    /// around it, those with different labels are looked at two by two: where a plane parts them, of their brick or of
    /// one beside it, if that has a code which says of both what they are, the corner goes to that plane, or to the
    /// edge of two; what else parts them keeps it at its place along that axis. A corner that would move by more than a
    /// voxel, or that more planes part, stays.
    [[nodiscard]] Vec3d place(Vec3i corner) const;

private:
    [[nodiscard]] std::uint32_t separatingPlane(Vec3i a, Vec3i b) const;

    const volume::BrickVolume& bricks_;
    std::span<const std::uint32_t> labelOfScalar_;
};

}  // namespace svt::writers

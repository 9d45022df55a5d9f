#pragma once
/// \file
/// The planes that the faces of a model lie on, kept beside the voxels that were made of them. Bricks try them before
/// they fit planes to voxels: a face keeps the plane that it has in the model, one along its whole length.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

/// The points p of voxel space (index space + 1/2) with dot(normal, p) + offset = 0; positive is one side, the rest is
/// the other. `normal` has length 1, in voxels.
struct BrickPlane {
    Vec3d normal{};
    double offset = 0;
    friend bool operator==(const BrickPlane&, const BrickPlane&) = default;
};

/// A plane with faces of the model on it, all of which are within voxels [min, max).
struct FacePlane {
    BrickPlane plane;
    std::array<std::uint16_t, 3> min{}, max{};
    friend bool operator==(const FacePlane&, const FacePlane&) = default;
};

/// \return BadVolume that says which plane has no normal of length 1 (to 1e-9), no finite offset, or a box that is
///         empty or reaches out of the volume
[[nodiscard]] Result<void> checkFacePlanes(std::span<const FacePlane> planes, Vec3i dimension);

/// The planes as one zstd frame, see docs/formats/svt.md. Equal planes give equal bytes.
/// \return the frame, or BadArgument where there are more than 2^24, or they repeat more often than a reader accepts
[[nodiscard]] Result<std::vector<std::byte>> compressFacePlanes(std::span<const FacePlane> planes);

/// Any bytes are safe: everything is checked before it is used or allocated; memory is bounded by 8 MiB + 8192 times
/// the frame. \return the planes, or BadVolume
[[nodiscard]] Result<std::vector<FacePlane>> readFacePlanes(std::span<const std::byte> frame, Vec3i dimension);

}  // namespace svt::volume

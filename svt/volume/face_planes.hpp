#pragma once
/// \file
/// The planes of the faces of a model, stored with the voxels. Bricks try them before they fit planes to voxels, so
/// that a face keeps its plane from the model along its whole length.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::volume {

/// The points p of voxel space (index space + 1/2) with dot(normal, p) + offset = 0. The positive side has the points
/// with a positive value; the other side has all others. `normal` has length 1, in voxels.
struct BrickPlane {
    Vec3d normal{};
    double offset = 0;
    friend bool operator==(const BrickPlane&, const BrickPlane&) = default;
};

/// A plane, and the voxels [min, max) that bound the model's faces on it.
struct FacePlane {
    BrickPlane plane;
    std::array<std::uint16_t, 3> min{}, max{};
    friend bool operator==(const FacePlane&, const FacePlane&) = default;
};

/// Checks planes from an untrusted source.
/// \return success, or BadVolume that names a plane whose normal does not have length 1 (to 1e-9), whose offset is not
///         finite, or whose box is empty or exceeds the volume
[[nodiscard]] Result<void> checkFacePlanes(std::span<const FacePlane> planes, Vec3i dimension);

/// The planes as one zstd frame, see docs/formats/svt.md. Equal planes give equal bytes.
/// \return the frame, or BadArgument if there are more than 2^24 planes, or they compress better than a reader accepts
[[nodiscard]] Result<std::vector<std::byte>> compressFacePlanes(std::span<const FacePlane> planes);

/// Decompresses planes. Safe for any bytes: everything is checked before it is used or allocated. Memory is bounded by
/// 8 MiB + 8192 times the frame.
/// \return the planes, or BadVolume
[[nodiscard]] Result<std::vector<FacePlane>> readFacePlanes(std::span<const std::byte> frame, Vec3i dimension);

/// The planes across an axis near each border between voxels. Thread-safe to read.
class FaceBorders {
public:
    /// For the voxels [low, low + size). Faces that are not across an axis are left out.
    /// \param faces  must outlive this
    FaceBorders(Vec3i low, Vec3i size, std::span<const FacePlane> faces);

    [[nodiscard]] bool isEmpty() const noexcept { return count_ == 0; }

    /// Finds the plane of a face across `axis` in or next to the voxels [brick, brick + 8), between the samples on both
    /// sides of `border` (voxels from the corner of the volume). If there are several, the plane whose faces cover most
    /// of the brick's side wins. Its normal points up the axis. A plane exactly across the axis has exactly this axis
    /// as its normal.
    [[nodiscard]] std::optional<BrickPlane> find(int axis, std::int32_t border, Vec3i brick) const;

private:
    struct Candidate {
        BrickPlane plane;
        const FacePlane* face = nullptr;
    };
    void add(const FacePlane& face, int axis);

    Vec3i low_, size_;
    std::array<std::vector<std::vector<Candidate>>, 3> byBorder_;
    std::size_t count_ = 0;
};

}  // namespace svt::volume

#pragma once
/// \file
/// Faces of the model that are parallel to an axis, by the border between voxels that stands for them: bricks and
/// drawings put such borders onto the planes of the faces.

#include <svt/core/vec.hpp>
#include <svt/volume/face_planes.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::volume {

/// The planes across an axis near each border between voxels. Thread-safe to read.
class FaceBorders {
public:
    /// For the voxels [low, low + size). Faces across no axis are left out.
    /// \param faces  must outlive this
    FaceBorders(Vec3i low, Vec3i size, std::span<const FacePlane> faces);

    [[nodiscard]] bool isEmpty() const noexcept { return count_ == 0; }

    /// The plane of a face across `axis` in or beside the voxels [brick, brick + 8), between the samples on both sides of
    /// `border` (voxels from the corner of the volume); of several the one whose faces cover most of the brick's side.
    /// Its normal points up the axis. A plane across the axis itself has exactly that axis as normal.
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

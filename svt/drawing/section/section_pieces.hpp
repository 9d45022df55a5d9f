#pragma once
/// \file
/// Cuts the bricks of a volume with a plane, brick by brick, into convex pieces.

#include <svt/drawing/section_drawing.hpp>
#include <svt/plane/point.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::drawing {

/// A directed edge of a piece; coordinates in drawing units, at most 2^29 from 0. `label` is on its left.
struct PieceEdge {
    plane::Point from, to;
    std::uint32_t label = 0;
};

/// The plane in voxel space, and the transform from voxel space to the drawing.
///
/// Voxel space is index space + 1/2: voxel (i, j, k) is [i, i + 1] x [j, j + 1] x [k, k + 1].
class CutPlane {
public:
    CutPlane(const SectionPlane& plane, const PlaneAxes& axes, const volume::Grid& grid);

    /// Whether a corner of voxels is above the plane, on the side to which the axes' normal points. Corners on the
    /// plane count as on the side that is cut away.
    [[nodiscard]] bool isAbove(double i, double j, double k) const noexcept {
        return gradient_.x * i + gradient_.y * j + gradient_.z * k + offset_ > 0;
    }
    /// Intersection of the plane with the line along `axis` through a corner; the same for all pieces that share the
    /// line.
    [[nodiscard]] Vec3d crossing(int axis, Vec3d corner) const noexcept;
    /// Gradient of the height above the plane: metres per voxel along each axis.
    [[nodiscard]] Vec3d gradient() const noexcept { return gradient_; }
    [[nodiscard]] double heightOf(Vec3d voxel) const noexcept { return dot(gradient_, voxel) + offset_; }
    [[nodiscard]] plane::Point quantized(Vec3d voxel) const noexcept;
    [[nodiscard]] double drawingUnit() const noexcept { return drawingUnit_; }

private:
    Vec3d gradient_;
    double offset_ = 0;          // moved by a millionth of a voxel towards the kept side
    Vec3d uOfVoxel_, vOfVoxel_;  // affine: u = dot(uOfVoxel_, voxel) + uOffset_
    double uOffset_ = 0, vOffset_ = 0;
    double drawingUnit_ = 1;
};

/// Edges of all pieces that have a label. Edges of adjacent pieces have the same end points: each edge between two
/// labels appears once in each direction. Voxel borders that represent faces of the model perpendicular to an axis lie
/// on these faces.
/// \param faces          the planes of the model's faces
/// \param labelOfScalar  entry per scalar: the label, or kNoLabel if it is not drawn
[[nodiscard]] std::vector<PieceEdge> cutPieces(const volume::BrickVolume& bricks,
                                               std::span<const volume::FacePlane> faces, const CutPlane& plane,
                                               std::span<const std::uint32_t> labelOfScalar);

}  // namespace svt::drawing

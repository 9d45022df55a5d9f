#pragma once
/// \file
/// Normal and lighting of the surfaces that rays meet.

#include <svt/render/light/sample.hpp>
#include <svt/render/light/surface_normal.hpp>
#include <svt/render/prepare/prepared_frame.hpp>

namespace svt::render {

/// Where a ray enters a label.
struct SurfaceHit {
    double from;              ///< t of the ray
    Vec3d origin, direction;  ///< of the ray, voxel space
    Vec3d view;               ///< world space, unit length, towards the viewer
    Vec3i voxel;              ///< voxel that the ray enters
    int axis;                 ///< axis of the voxel face that it crosses there, or -1
    std::uint32_t plane;      ///< oblique plane that it crosses there, or BrickVolume::kNoPlane
    bool isVoxel;             ///< the brick is one of voxels only
    CapFace cap;              ///< the clip face that it lies on, or none
    /// Normal of the face of the model that it lies on, world space, unit length, of either sign; null: none.
    const Vec3d* faceNormal = nullptr;
};

/// The surface at the start of a run, and its lighting.
struct Surface {
    Vec3d normal{};        ///< world space, unit length
    Vec3d outwardIndex{};  ///< the same direction in index space, scaled to a longest component of 1
    double cavity = 0;     ///< how deep in a concave corner of voxels, 0..1
    double light = 1;      ///< factor of the color
    bool isCap = false;
    bool isAroundEye = false;  ///< the eye is inside the label; there is no surface
};

/// Lights the surfaces of one pass.
class SurfaceLight {
public:
    SurfaceLight(const PreparedFrame& frame, std::size_t pass, NormalCache& cache)
        : frame_(frame), pass_(frame.passes[pass]), passNumber_(pass), volume_(frame.volumeOf(pass)), cache_(cache) {}

    /// The surface has the normal of the plane or voxel face that the ray crosses. For a body in a brick of voxels
    /// only, the normal is fitted to the voxels around, from which the cavity factor comes as well.
    [[nodiscard]] Surface at(const LinearStyle& style, const SurfaceHit& hit) const;
    /// The same without lighting.
    [[nodiscard]] Surface findNormal(const LinearStyle& style, const SurfaceHit& hit) const;
    /// Light on a surface that is not of voxels.
    /// \param normal  world space, unit length, towards the viewer
    /// \param view    direction to the viewer, world space, unit length
    /// \param point   voxel space
    [[nodiscard]] double lightSurface(const LinearStyle& style, Vec3d normal, Vec3d view, Vec3d point) const noexcept;

    /// Share of the key light that reaches a surface; 1 without shadows.
    /// \param point   voxel space
    /// \param normal  world space, unit length
    [[nodiscard]] double unshaded(Vec3d point, Vec3d normal) const noexcept;

private:
    [[nodiscard]] const SurfaceNormal& normalAt(Vec3i voxel, int axis, int sign) const;
    [[nodiscard]] double lightOn(Vec3d normal, Vec3d view, double open, Vec3d point) const noexcept;
    [[nodiscard]] double openness(Vec3d point, Vec3d outwardIndex, double cavity) const noexcept;

    const PreparedFrame& frame_;
    const PreparedPass& pass_;
    std::size_t passNumber_;
    const PreparedVolume& volume_;
    NormalCache& cache_;
};

}  // namespace svt::render

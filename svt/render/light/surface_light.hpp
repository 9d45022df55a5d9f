#pragma once
/// \file
/// Normal and light where a ray meets a surface. Internal to render.

#include <svt/render/light/sample.hpp>
#include <svt/render/light/surface_normal.hpp>
#include <svt/render/prepare/prepared_frame.hpp>

namespace svt::render {

/// Where a ray meets a label, and how.
struct SurfaceHit {
    double from;              ///< the ray's parameter there
    Vec3d origin, direction;  ///< of the ray, voxel space
    Vec3d view;               ///< world space, unit length, towards the viewer
    Vec3i cell;               ///< voxel that the ray enters
    int axis;                 ///< whose voxel face it crosses there, or -1
    std::uint32_t plane;      ///< oblique plane that it crosses there, or BrickVolume::kNoPlane
    bool isVoxel;             ///< the label is told by voxels alone
    CapFace cap;              ///< the clip on which it lies, or none
};

/// Where a run begins, and how it is lit there.
struct Surface {
    Vec3d normal{};     ///< world space, unit length
    Vec3d away{};       ///< the same direction in index space, longest component 1
    double crease = 0;  ///< how deep in a corner of voxels, 0..1
    double light = 1;
    bool isCap = false;
    bool isAroundEye = false;  ///< the eye is inside; there is no surface
};

/// Lights the surfaces of one pass.
class SurfaceLight {
public:
    SurfaceLight(const PreparedFrame& frame, std::size_t pass, NormalCache& cache)
        : frame_(frame), pass_(frame.passes[pass]), passNumber_(pass), volume_(frame.volumeOf(pass)), cache_(cache) {}

    /// A surface has the normal of the plane or voxel face that the ray crosses. Where voxels alone tell the label, a
    /// body's is fitted to those around, which also say how deep in a corner it lies.
    [[nodiscard]] Surface at(const LinearStyle& style, const SurfaceHit& hit) const;
    /// The same without light.
    [[nodiscard]] Surface facing(const LinearStyle& style, const SurfaceHit& hit) const;
    /// Light on a surface that is no voxel's. \param normal  world space, unit length, towards the viewer
    /// \param view  the same, to the viewer \param point  voxel space
    [[nodiscard]] double on(const LinearStyle& style, Vec3d normal, Vec3d view, Vec3d point) const noexcept;

private:
    [[nodiscard]] const SurfaceNormal& normalAt(Vec3i cell, int axis, int sign) const;
    [[nodiscard]] double lightOn(Vec3d normal, Vec3d view, double open) const noexcept;
    [[nodiscard]] double openness(Vec3d point, Vec3d away, double crease) const noexcept;

    const PreparedFrame& frame_;
    const PreparedPass& pass_;
    std::size_t passNumber_;
    const PreparedVolume& volume_;
    NormalCache& cache_;
};

}  // namespace svt::render

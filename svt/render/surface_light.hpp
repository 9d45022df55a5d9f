#pragma once
/// \file
/// Normal and light where a ray meets a surface. Internal to render.

#include <svt/render/sample_caster.hpp>

namespace svt::render {

/// Where a ray meets a label, and how.
struct SurfaceHit {
    double from;                  ///< the ray's parameter there
    Vec3d origin, direction;      ///< of the ray, voxel space
    Vec3d view;                   ///< world space, unit length, towards the viewer
    Vec3i cell;                   ///< voxel that the ray enters
    int axis;                     ///< whose voxel face it crosses there, or -1
    std::uint32_t plane;          ///< oblique plane that it crosses there, or BrickVolume::kNoPlane
    const HalfSpace* capPlane;    ///< clip plane on which it lies, or null
};

/// Where a run begins, and how it is lit there.
struct Surface {
    Vec3d normal{};  ///< world space, unit length
    double light = 1;
    bool isCap = false;
};

/// Lights the surfaces of one pass.
class SurfaceLight {
public:
    SurfaceLight(const Scene& scene, std::size_t pass, NormalCache& cache)
        : scene_(scene), pass_(scene.passes[pass]), passNumber_(pass), cache_(cache) {}

    /// Glass has the normal of the plane or voxel face that it begins with. For a body, the voxels around tell how deep
    /// in a corner it lies, and, where there is no plane, its slope.
    [[nodiscard]] Surface at(const LinearStyle& style, const SurfaceHit& hit) const;

private:
    [[nodiscard]] Surface bodyAt(const SurfaceHit& hit) const;
    [[nodiscard]] const SurfaceNormal& normalAt(Vec3i cell, int axis, int sign) const;
    [[nodiscard]] bool isFlatAround(Vec3i cell, int axis, int sign) const;
    [[nodiscard]] bool isOpenBefore(Vec3i cell, std::uint32_t plane, bool isPositive) const;
    [[nodiscard]] bool isBorderFar(Vec3i brick) const noexcept;
    template <class IsFine>
    [[nodiscard]] bool checkAround(Vec3i brick, const IsFine& isFine) const;
    [[nodiscard]] double lightOn(Vec3d normal, Vec3d view, double open) const noexcept;
    /// 1 in the open, less in corners. `away`: from the surface, index space, longest component 1.
    [[nodiscard]] double openness(const SurfaceHit& hit, Vec3d away, float coverage) const noexcept;

    const Scene& scene_;
    const PreparedPass& pass_;
    std::size_t passNumber_;
    NormalCache& cache_;
};

}  // namespace svt::render

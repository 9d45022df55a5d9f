#pragma once
/// \file
/// Casts single rays: walks the runs, lights them and blends them. Internal to render.

#include <svt/render/camera_rays.hpp>
#include <svt/render/clip_intervals.hpp>
#include <svt/render/occlusion.hpp>
#include <svt/render/pass_shapes.hpp>
#include <svt/render/pass_table.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/render/surface_normal.hpp>
#include <svt/render/visible_hull.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <vector>

namespace svt::render {

/// What one ray has seen.
struct Sample {
    Vec3f color{};  ///< linear light, premultiplied
    float alpha = 0;
    volume::Scalar label = 0;
    std::uint32_t object = 0;
    float depth = std::numeric_limits<float>::infinity();  ///< infinity: nothing met
    Vec3f normal{};                                        ///< world space, unit length, where the label begins
    bool isCap = false;                                    ///< the label begins on a clip plane
    bool hasLine = false;                                  ///< a line is part of the color
    std::uint8_t volume = 0;                               ///< where the label was met, see Scene::volumes
    std::uint8_t lens = 0;                                 ///< number of the pass that replaced all before it; 0: none

    [[nodiscard]] bool hasHit() const noexcept { return depth < std::numeric_limits<float>::infinity(); }
};

[[nodiscard]] inline Vec3f toFloat(Vec3d v) noexcept {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Color and opacity of a ray at its end. What is left behind a ray that ended early is not seen.
inline void finishSample(Vec3d color, double transmittance, const CastOptions& options, Sample& sample) noexcept {
    const double alpha = 1 - transmittance;
    const bool isOpaque = alpha >= double(options.opaqueAt) && alpha < 1;
    sample.color = toFloat(isOpaque ? color * (1 / alpha) : color);
    sample.alpha = isOpaque ? 1 : static_cast<float>(alpha);
}

/// Joins what pass `number` has seen to what the passes before it have.
void joinPass(Pass::Join join, std::size_t number, const Sample& pass, Sample& joined) noexcept;

/// Whether nothing of the passes before is left in joinPass().
[[nodiscard]] inline bool hidesAllBefore(Pass::Join join, const Sample& pass) noexcept {
    return (join == Pass::Join::Replace && pass.alpha > 0) ||
           (join == Pass::Join::Over && pass.alpha >= 1 && pass.hasHit());
}

/// A pass as all rays share it.
struct PreparedPass {
    PassTable table;
    Clipper clipper;
    OcclusionField occlusion;
    Pass::Join join;
    std::uint8_t volume;  ///< see Scene::volumes
    PassShapes shapes{};
    VisibleHull hull{};  ///< not of the reference, which walks all of its rays
};

/// Part of the picture, pixels.
struct PixelRect {
    double left = 0, top = 0, right = 0, bottom = 0;
    void widen(double by) noexcept { *this = {left - by, top - by, right + by, bottom + by}; }
    void include(const PixelRect& other) noexcept {
        *this = {std::min(left, other.left), std::min(top, other.top), std::max(right, other.right),
                 std::max(bottom, other.bottom)};
    }
    [[nodiscard]] bool overlaps(std::int32_t x, std::int32_t y, std::int32_t width,
                                std::int32_t height) const noexcept {
        return x <= right && x + width >= left && y <= bottom && y + height >= top;
    }
};

/// Directions that the planes and voxel faces of a volume have in world space.
class DirectionTable {
public:
    struct Directions {
        Vec3d normal;  ///< world space, unit length
        Vec3d away;    ///< the same direction in index space, longest component 1
    };
    DirectionTable(const volume::BrickVolume& volume, const volume::Grid& grid);

    /// Of voxel faces across an axis, upwards.
    [[nodiscard]] const Directions& axis(int axis) const noexcept { return axes_[static_cast<std::size_t>(axis)]; }
    /// Of a plane of BrickVolume::oblique(), to its positive side.
    [[nodiscard]] const Directions& plane(std::uint32_t number) const noexcept { return planes_[number]; }
    [[nodiscard]] std::span<const Directions> planes() const noexcept { return planes_; }
    /// Of what has `index` as its normal in index space.
    [[nodiscard]] Directions directions(Vec3d index) const noexcept;
    /// Directions::away of a direction in world space.
    [[nodiscard]] Vec3d away(Vec3d normal) const noexcept;

private:
    const volume::Grid& grid_;
    std::array<Directions, 3> axes_;
    std::vector<Directions> planes_;
};

/// A volume as all rays share it.
struct PreparedVolume {
    const volume::BrickVolume& bricks;
    const volume::Grid& grid;
    CameraRays rays;
    DirectionTable directions;
    double voxelSize;  ///< metres, the largest spacing

    PreparedVolume(const DrawnVolume& drawn, const FrameSpec& spec)
        : bricks(drawn.bricks()),
          grid(drawn.grid()),
          rays(spec, grid),
          directions(bricks, grid),
          voxelSize(std::max({grid.spacing().x, grid.spacing().y, grid.spacing().z})) {}
};

/// The picture as all rays share it.
struct Scene {
    const FrameSpec& spec;
    const CastOptions& options;
    std::vector<PreparedVolume> volumes{};  ///< at least one
    std::vector<PreparedPass> passes{};
    Vec3d towardsLight{};  ///< world space, unit length
    Vec3f hatchColor{};    ///< linear light
    bool isReference = false;
    bool isAdaptive = false;  ///< more samples only where pixels differ
    PixelRect drawn{};        ///< outside of it no ray meets the volume or a line
    bool hasShapes = false;   ///< any pass has
    /// Samples along a pixel's side, over which lines fade out. Adaptive pictures have one in most pixels.
    double lineSamples = 1;

    /// What rays have in common whatever volume they cross: all but CameraRay::index.
    [[nodiscard]] const CameraRays& rays() const noexcept { return volumes.front().rays; }
    [[nodiscard]] const PreparedVolume& volumeOf(std::size_t pass) const noexcept {
        return volumes[passes[pass].volume];
    }
};

/// Normals of hit voxels, kept per tile: neighbouring rays often hit the same voxel.
class NormalCache {
public:
    struct Slot {
        std::uint64_t key = ~std::uint64_t{0};
        SurfaceNormal normal;
    };
    [[nodiscard]] Slot& slot(std::uint64_t key) noexcept { return slots_[place(key)]; }

private:
    static constexpr int kBits = 10;
    [[nodiscard]] static std::size_t place(std::uint64_t key) noexcept {
        return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ull) >> (64 - kBits));
    }
    std::array<Slot, std::size_t{1} << kBits> slots_{};
};

class FragmentFinder;
struct Fragments;

/// Casts rays one by one: the plain way, which packets are held against. Belongs to one thread.
class SampleCaster {
public:
    explicit SampleCaster(const Scene& scene);
    ~SampleCaster();

    /// \param withColor  false: label and depth alone
    [[nodiscard]] Sample cast(double u, double v, bool withColor);

private:
    const Scene& scene_;
    NormalCache cache_;
    std::unique_ptr<FragmentFinder> finder_;
    std::unique_ptr<Fragments> fragments_;  // of the ray
};

}  // namespace svt::render

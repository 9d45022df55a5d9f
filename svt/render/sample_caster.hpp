#pragma once
/// \file
/// Casts single rays: walks the runs, lights them and blends them. Internal to render.

#include <svt/render/camera_rays.hpp>
#include <svt/render/clip_intervals.hpp>
#include <svt/render/occlusion.hpp>
#include <svt/render/pass_table.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/render/surface_normal.hpp>

#include <array>
#include <limits>
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

    [[nodiscard]] bool hasHit() const noexcept { return depth < std::numeric_limits<float>::infinity(); }
};

/// A pass as all rays share it.
struct PreparedPass {
    PassTable table;
    Clipper clipper;
    OcclusionField occlusion;
    Pass::Join join;
};

/// Part of the picture, pixels.
struct PixelRect {
    double left = 0, top = 0, right = 0, bottom = 0;
    [[nodiscard]] bool overlaps(std::int32_t x, std::int32_t y, std::int32_t width,
                                std::int32_t height) const noexcept {
        return x <= right && x + width >= left && y <= bottom && y + height >= top;
    }
};

/// The picture as all rays share it.
struct Scene {
    const volume::BrickVolume& volume;
    const volume::Grid& grid;
    const FrameSpec& spec;
    const CastOptions& options;
    CameraRays rays;
    std::vector<PreparedPass> passes;
    Vec3f towardsLight{};  ///< world space, unit length
    bool isReference = false;
    PixelRect drawn;  ///< outside of it no ray meets the volume
};

/// Normals of hit voxels, kept per tile: neighbouring rays often hit the same voxel.
class NormalCache {
public:
    struct Slot {
        std::uint64_t key = ~std::uint64_t{0};
        SurfaceNormal normal;
    };
    [[nodiscard]] Slot& slot(std::uint64_t key) noexcept {
        return slots_[static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ull) >> (64 - kBits))];
    }

private:
    static constexpr int kBits = 10;
    std::array<Slot, std::size_t{1} << kBits> slots_{};
};

/// Casts rays of one tile; belongs to one thread.
class SampleCaster {
public:
    explicit SampleCaster(const Scene& scene) : scene_(scene) {}

    /// \param withColor  false: label and depth alone
    [[nodiscard]] Sample cast(double u, double v, bool withColor);

private:
    const Scene& scene_;
    NormalCache cache_;
};

}  // namespace svt::render

#pragma once
/// \file
/// The share of the key light that reaches a point. Several directions represent the disc of the light. For each
/// direction, a picture of the model as seen from the light stores how deep the light reaches (shadow maps: Williams
/// 1978). The mean over the directions is the soft shadow of a disc, without noise.

#include <svt/render/frame_spec.hpp>
#include <svt/render/ray_caster.hpp>

#include <array>
#include <span>
#include <vector>

namespace svt::render {

class ShadowMaps {
public:
    ShadowMaps() = default;
    /// \param towardsLight  world space, unit length
    /// \return the maps, or Cancelled
    /// Cost: that of 5, 9 or 16 frames of opaque parts without corners and lines, in orthographic projection, of up to
    /// 2048 x 2048 pixels.
    [[nodiscard]] static Result<ShadowMaps> make(std::span<const DrawnVolume> volumes, const FrameSpec& spec,
                                                 Vec3d towardsLight, const CastOptions& options);

    [[nodiscard]] bool isEmpty() const noexcept { return maps_.empty(); }
    /// Share of the light that reaches a surface, 0..1; between pixels of the maps by linear interpolation.
    /// \param point   world space
    /// \param normal  world space, unit length, towards the visible side
    [[nodiscard]] double lightAt(Vec3d point, Vec3d normal) const noexcept;

private:
    struct Map {
        Vec3d eye, forward, right, up;
        image::Image<float> depth;  // metres from the eye plane; infinity: nothing
    };
    std::vector<Map> maps_;
    double pixel_ = 1;  // metres
    double lift_ = 0;   // metres by which a point is taken off its surface, so that it does not shade itself
};

}  // namespace svt::render

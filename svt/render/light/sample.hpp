#pragma once
/// \file
/// The result of a ray, and how results of passes are composited.

#include <svt/core/vec.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/render/ray_caster.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace svt::render {

/// The result of one ray.
struct Sample {
    Vec3f color{};  ///< linear light, premultiplied
    float alpha = 0;
    volume::Scalar label = 0;
    std::uint32_t object = 0;
    float depth = std::numeric_limits<float>::infinity();  ///< infinity: nothing met
    Vec3f normal{};                                        ///< world space, unit length, where the label begins
    bool isCap = false;                                    ///< the label begins on a clip face
    bool hasLine = false;                                  ///< a line contributes to the color
    std::uint8_t volume = 0;                               ///< of the label: index into PreparedFrame::volumes
    std::uint8_t lens = 0;                                 ///< number of the pass that replaced all before it; 0: none

    [[nodiscard]] bool hasHit() const noexcept { return depth < std::numeric_limits<float>::infinity(); }
};

[[nodiscard]] inline Vec3f toFloat(Vec3d v) noexcept {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Sets color and opacity of a ray that has ended. A ray terminated early counts as opaque.
inline void finishSample(Vec3d color, double transmittance, const CastOptions& options, Sample& sample) noexcept {
    const double alpha = 1 - transmittance;
    const bool isOpaque = alpha >= double(options.opaqueAt) && alpha < 1;
    sample.color = toFloat(isOpaque ? color * (1 / alpha) : color);
    sample.alpha = isOpaque ? 1 : static_cast<float>(alpha);
}

/// Composites the sample of pass `number` with that of the passes before it, `joined`.
void joinPass(Pass::Join join, std::size_t number, const Sample& pass, Sample& joined) noexcept;

/// Composites the samples of a pass and of its parts (Pass::Join::Part), which it sorts by depth.
[[nodiscard]] Sample joinParts(std::span<const Sample*> parts) noexcept;

/// Whether joinPass() keeps nothing of the passes before.
[[nodiscard]] inline bool hidesAllBefore(Pass::Join join, const Sample& pass) noexcept {
    return (join == Pass::Join::Replace && pass.alpha > 0) ||
           (join == Pass::Join::Over && pass.alpha >= 1 && pass.hasHit());
}

}  // namespace svt::render

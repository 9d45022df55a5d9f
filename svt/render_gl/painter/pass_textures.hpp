#pragma once
/// \file
/// Styles, clips and occlusion of a pass as textures.

#include <svt/render/clip_intervals.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/render/occlusion.hpp>
#include <svt/render_gl/painter/gl_objects.hpp>
#include <svt/render_gl/painter/shape_textures.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/grid.hpp>

#include <cstdint>
#include <vector>

namespace svt::render_gl {

/// Textures of one pass. Only what has changed since the last frame is uploaded again.
class PassTextures {
public:
    /// Updates the textures to `pass`.
    /// \return nothing, or errors as VolumeTextures::make() and ShapeTextures::update()
    [[nodiscard]] Result<void> update(const render::Pass& pass, const render::FrameSpec& spec,
                                      const volume::BrickVolume& volume, const volume::Grid& grid, Vec3i middle,
                                      const GlLimits& limits, int threads);
    void setUniforms(Program& program) const;

    [[nodiscard]] bool hasClips() const noexcept { return clipRegions_ > 0; }
    [[nodiscard]] bool hasOpaque() const noexcept { return hasOpaque_; }
    [[nodiscard]] bool hasTranslucent() const noexcept { return hasTranslucent_; }
    [[nodiscard]] bool hasShapes() const noexcept { return !shapes_.isEmpty(); }
    [[nodiscard]] bool hasTriangles() const noexcept { return shapes_.hasTriangles(); }
    [[nodiscard]] bool hasHatches() const noexcept { return hasHatches_ && hasClips(); }

private:
    [[nodiscard]] Result<void> updateStyles(const render::Pass& pass, const render::FrameSpec& spec,
                                            std::uint64_t scalarCount, const GlLimits& limits);
    [[nodiscard]] Result<void> updateClips(const render::Pass& pass, const volume::Grid& grid, Vec3i middle,
                                           const GlLimits& limits);
    [[nodiscard]] Result<void> updateOcclusion(const volume::BrickVolume& volume, const volume::Grid& grid,
                                               const GlLimits& limits, int threads);

    Texture styleTexture_, clipTexture_, occlusionTexture_;
    ShapeTextures shapes_;
    std::uint32_t styleCount_ = 0, clipRegions_ = 0;
    bool hasOpaque_ = false, hasTranslucent_ = false, hasHatches_ = false;
    std::vector<Vec3i> occlusionCounts_;
    std::vector<GLuint> occlusionFirsts_;
    std::vector<float> occlusionGains_;
    float occlusionCell_ = 8;  // voxels along a block of the finest level
    // Inputs of the current textures, to find changes.
    std::vector<render::Style> styles_;
    std::vector<std::uint32_t> objects_;
    std::vector<render::ClipRegion> clips_;
    std::vector<std::uint8_t> bodies_;           // by scalar
    std::vector<std::uint8_t> occludingBodies_;  // by scalar, when the occlusion was made
    std::vector<render::ClipRegion> occludingClips_;
};

}  // namespace svt::render_gl

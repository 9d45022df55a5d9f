#pragma once
/// \file
/// The bricks of a volume as textures, as they are. Internal to render_gl.

#include <svt/render_gl/painter/gl_objects.hpp>
#include <svt/volume/brick_volume.hpp>

namespace svt::render_gl {

/// Never changes once it is made: styles, clips and cameras leave it alone.
struct VolumeTextures {
    Texture index, boxes, codes, bricks, palettes, words, planes;
    Texture patterns;  ///< palette brick by brick, where normals are fitted to voxels
    std::uint32_t uniformBoxes = 0, boxCount = 0;
    Vec3i dimension{}, brickCount{};
    Vec3i middle{};          ///< places in shaders are counted from this voxel, so that they are small
    bool hasVoxels = false;  ///< any brick is a matter of voxels
    std::size_t sizeBytes = 0;

    /// \return the textures; GridTooLarge where one does not hold its array, NoGraphics where memory ends
    [[nodiscard]] static Result<VolumeTextures> make(const volume::BrickVolume& volume, const GlLimits& limits);
    void setUniforms(Program& program) const;
};

}  // namespace svt::render_gl

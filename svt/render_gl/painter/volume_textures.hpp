#pragma once
/// \file
/// The bricks of a volume as textures, in the layout of BrickVolume::Arrays.

#include <svt/render_gl/painter/gl_objects.hpp>
#include <svt/volume/brick_volume.hpp>

namespace svt::render_gl {

/// Immutable: styles, clips and cameras do not change it.
struct VolumeTextures {
    Texture index, boxes, codes, bricks, palettes, words, planes;
    Texture patterns;  ///< number of the palette brick by brick, for fitted normals
    std::uint32_t uniformBoxes = 0, boxCount = 0;
    Vec3i dimension{}, brickCount{};
    Vec3i middle{};          ///< origin of positions in shaders, so that they are small and floats precise
    bool hasVoxels = false;  ///< whether any brick is one of voxels only
    std::size_t sizeBytes = 0;

    /// \return the textures; GridTooLarge if an array does not fit a texture, NoGraphics if memory runs out
    [[nodiscard]] static Result<VolumeTextures> make(const volume::BrickVolume& volume, const GlLimits& limits);
    void setUniforms(Program& program) const;
};

}  // namespace svt::render_gl

#pragma once
/// \file
/// Lines and triangles of a pass as textures, binned into squares of the picture.

#include <svt/render/frame_spec.hpp>
#include <svt/render_gl/painter/gl_objects.hpp>
#include <svt/volume/grid.hpp>

#include <cstdint>

namespace svt::render_gl {

/// The bins depend on the camera, so they are uploaded with each frame.
class ShapeTextures {
public:
    /// \param middle  see VolumeTextures::middle
    /// \return nothing, or errors as VolumeTextures::make(), and BadFrame if they cover the picture too often
    [[nodiscard]] Result<void> update(const render::Pass& pass, const render::FrameSpec& spec, const volume::Grid& grid,
                                      Vec3i middle, const GlLimits& limits, int threads);
    void setUniforms(Program& program) const;
    [[nodiscard]] bool isEmpty() const noexcept { return isEmpty_; }
    [[nodiscard]] bool hasTriangles() const noexcept { return !isEmpty_ && hasTriangles_; }

private:
    Texture squares_, list_, table_;
    bool isEmpty_ = true, hasTriangles_ = false, isPerspective_ = true;
    std::uint32_t squaresX_ = 0, squaresY_ = 0, lineStylesFirst_ = 0, trianglesFirst_ = 0;
    double lineSamples_ = 1, pixelSize_ = 1, voxelSize_ = 1;
};

}  // namespace svt::render_gl

#pragma once
/// \file
/// Trial runs of `svt doctor`: the sample house as a coarse volume, and a small picture of it.

#include <svt/illustrate/scene_painter.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>

namespace svt::cli {

struct TestVolume {
    volume::SemanticVolume volume;
    double seconds = 0;  ///< reading and building
};

/// Reads the house from memory and builds it at 0.2 m. No file is touched.
/// \return the volume, or an error of the readers or of buildVolume()
[[nodiscard]] Result<TestVolume> buildTestVolume();

struct TestPicture {
    render::Frame frame;
    double firstSeconds = 0;  ///< of the first picture, with one-time setup: bricks, shader programs
    double seconds = 0;       ///< of a second picture
};

/// Draws the house twice, 320 x 180 pixels of one ray.
/// \param draw  on the CPU (castByCpu()) or by OpenGL
[[nodiscard]] Result<TestPicture> drawTestPicture(illustrate::ScenePainter& painter,
                                                  const illustrate::ScenePainter::Draw& draw);

/// Draws on the CPU, each pixel with all its rays, as OpenGL does.
[[nodiscard]] Result<render::Frame> castByCpu(std::span<const render::DrawnVolume> volumes,
                                              const render::FrameSpec& spec);

/// The number of pixels that differ between two frames of equal size: another label, or a colour that differs by more
/// than 3 of 255. render_gl::GlRenderer stays within this bound, except for a few pixels at edges.
[[nodiscard]] std::size_t differingPixels(const render::Frame& a, const render::Frame& b);

}  // namespace svt::cli

#pragma once
/// \file
/// Hatches on cut faces. Internal to render.

#include <svt/render/light/sample.hpp>
#include <svt/render/light/surface_normal.hpp>
#include <svt/render/prepare/prepared_frame.hpp>

namespace svt::render {

/// Draws the hatch of its label on a sample of `pass` that lies on a cut face.
/// \param u, v  where in the picture, see CameraRays::at()
void hatchCap(const PreparedFrame& frame, std::size_t pass, double u, double v, Sample& sample) noexcept;

}  // namespace svt::render

#pragma once
/// \file
/// Hatches on caps (cut faces).

#include <svt/render/light/sample.hpp>
#include <svt/render/light/surface_normal.hpp>
#include <svt/render/prepare/prepared_frame.hpp>

namespace svt::render {

/// Draws the hatch of the sample's label over a sample of `pass` that lies on a cap.
/// \param u, v  place in the picture, see CameraRays::at()
void hatchCap(const PreparedFrame& frame, std::size_t pass, double u, double v, Sample& sample) noexcept;

}  // namespace svt::render

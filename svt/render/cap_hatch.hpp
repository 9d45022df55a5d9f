#pragma once
/// \file
/// Hatches on cut faces. Internal to render.

#include <svt/render/sample_caster.hpp>

namespace svt::render {

/// Draws the hatch of its label on a sample of `pass` that lies on a cut face.
/// \param u, v  where in the picture, see CameraRays::at()
void hatchCap(const Scene& scene, std::size_t pass, double u, double v, Sample& sample) noexcept;

}  // namespace svt::render

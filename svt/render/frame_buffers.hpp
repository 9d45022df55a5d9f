#pragma once
/// \file
/// The label and depth buffers of a frame as gray pictures of 16 bits, for image::writePng().

#include <svt/core/result.hpp>
#include <svt/image/image.hpp>
#include <svt/volume/column_volume.hpp>

#include <cstdint>

namespace svt::render {

/// The label buffer: each pixel is the scalar itself.
/// \return the picture, or BadImage if a scalar is over 65535
[[nodiscard]] Result<image::Image<std::uint16_t>> grayFromLabels(const image::Image<volume::Scalar>& labels);
/// The depth buffer: 0 for background, else 1 + depth / metresPerStep, rounded, at most 65535.
/// \param metresPerStep  > 0; with 0.001 the range is 65 m
[[nodiscard]] image::Image<std::uint16_t> grayFromDepth(const image::Image<float>& depth, double metresPerStep);

}  // namespace svt::render

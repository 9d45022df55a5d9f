#pragma once
/// \file
/// The label and depth buffers of a frame as gray pictures of 16 bits, for image::writePng().

#include <svt/core/result.hpp>
#include <svt/image/image.hpp>
#include <svt/volume/column_volume.hpp>

#include <cstdint>

namespace svt::render {

/// The scalars themselves.
/// \return the picture, or BadImage where a scalar is over 65535
[[nodiscard]] Result<image::Image<std::uint16_t>> grayFromLabels(const image::Image<volume::Scalar>& labels);
/// 0 for nothing, else 1 + depth / metresPerStep, rounded, at most 65535.
/// \param metresPerStep  > 0; 0.001 reaches to 65 m
[[nodiscard]] image::Image<std::uint16_t> grayFromDepth(const image::Image<float>& depth, double metresPerStep);

}  // namespace svt::render

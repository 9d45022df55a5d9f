#include <svt/render/frame_buffers.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::render {

Result<image::Image<std::uint16_t>> grayFromLabels(const image::Image<volume::Scalar>& labels) {
    image::Image<std::uint16_t> gray(labels.width(), labels.height());
    for (std::size_t n = 0; n < labels.pixels().size(); ++n) {
        if (labels.pixels()[n] > 0xFFFF)
            return Error(Code::BadImage,
                         fmt::format("scalar {} does not fit into the 16 bits of a gray PNG", labels.pixels()[n]));
        gray.pixels()[n] = static_cast<std::uint16_t>(labels.pixels()[n]);
    }
    return gray;
}

image::Image<std::uint16_t> grayFromDepth(const image::Image<float>& depth, double metresPerStep) {
    image::Image<std::uint16_t> gray(depth.width(), depth.height());
    for (std::size_t n = 0; n < depth.pixels().size(); ++n) {
        const auto metres = static_cast<double>(depth.pixels()[n]);
        if (std::isfinite(metres))
            gray.pixels()[n] =
                static_cast<std::uint16_t>(std::clamp(std::round(1 + metres / metresPerStep), 1.0, 65535.0));
    }
    return gray;
}

}  // namespace svt::render

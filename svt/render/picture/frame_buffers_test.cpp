#include <svt/render/frame_buffers.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace svt::render {
namespace {

TEST(FrameBuffers, LabelsAndDepthsBecomeGray) {
    image::Image<volume::Scalar> labels(2, 1);
    labels.pixels() = {7, 65535};
    EXPECT_EQ(grayFromLabels(labels)->pixels(), (std::vector<std::uint16_t>{7, 65535}));
    labels.at(0, 0) = 65536;
    EXPECT_EQ(grayFromLabels(labels).error().code(), Code::BadImage);
    image::Image<float> depth(4, 1);
    depth.pixels() = {0, 1.5f, 1e9f, std::numeric_limits<float>::infinity()};
    EXPECT_EQ(grayFromDepth(depth, 0.001).pixels(), (std::vector<std::uint16_t>{1, 1501, 65535, 0}));
}

}  // namespace
}  // namespace svt::render

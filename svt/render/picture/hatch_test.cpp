#include <svt/render/hatch.hpp>

#include <svt/render/camera_presets.hpp>
#include <svt/render/test_volume_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace svt::render {
namespace {

using test::cast;
using test::makeVolume;
using test::stylesOf;
using test::TestVolume;

// Mean ink over a field of 4 x 4 m.
double meanInk(Hatch hatch, const HatchPen& pen) {
    double sum = 0;
    constexpr int kSteps = 800;
    for (int y = 0; y < kSteps; ++y)
        for (int x = 0; x < kSteps; ++x)
            sum += hatchCoverage(hatch, (x + 0.5) * 4 / kSteps, (y + 0.5) * 4 / kSteps, pen);
    return sum / (kSteps * kSteps);
}

TEST(Hatch, LinesCoverTheirShare) {
    const HatchPen pen{0.25, 0.05, 0.005};
    EXPECT_NEAR(meanInk(Hatch::Masonry, pen), 0.2, 0.01);
    EXPECT_NEAR(meanInk(Hatch::General, pen), 0.1, 0.01);
    EXPECT_NEAR(meanInk(Hatch::Steel, pen), 0.2, 0.01);
    // Every second line has gaps of 0.35 of its length.
    EXPECT_NEAR(meanInk(Hatch::ReinforcedConcrete, pen), 0.2 * (1 - 0.35 / 2), 0.01);
    EXPECT_EQ(meanInk(Hatch::None, pen), 0);
    // A softer edge moves ink, and keeps its sum.
    EXPECT_NEAR(meanInk(Hatch::Masonry, {0.25, 0.05, 0.04}), 0.2, 0.01);
}

TEST(Hatch, EachIsSeenAndLeavesPaper) {
    for (const auto& [hatch, name] : kNames<Hatch>) {
        if (hatch == Hatch::None) continue;
        const double ink = meanInk(hatch, {0.2, 0.01, 0.005});
        EXPECT_GT(ink, 0.005) << name;
        EXPECT_LT(ink, 0.3) << name;
    }
}

TEST(Hatch, LinesRiseToTheRight) {
    const HatchPen pen{1, 0.1, 0.01};
    for (double s = 0; s < 3; s += 0.1) EXPECT_EQ(hatchCoverage(Hatch::Masonry, s, s, pen), 1) << s;
    EXPECT_EQ(hatchCoverage(Hatch::Masonry, 0.7, 0, pen), 0);
}

TEST(Hatch, TooDenseIsGray) {
    const HatchPen pen{0.01, 0.004, 0.1};
    const double first = hatchCoverage(Hatch::Masonry, 0, 0, pen);
    EXPECT_GT(first, 0.1);
    EXPECT_LE(first, 0.5);
    for (double u = 0; u < 1; u += 0.03) EXPECT_EQ(hatchCoverage(Hatch::Masonry, u, 0, pen), first);
}

// A cube of one label, seen from above.
class HatchedCube : public ::testing::Test {
protected:
    HatchedCube() {
        spec_.width = spec_.height = 100;
        spec_.camera = *cameraPreset("top", volume_.grid, {1, 0, Camera::Projection::Orthographic, 30});
        auto styles = stylesOf({{{0.8f, 0.8f, 0.8f}, 1}});
        styles[1].hatch = Hatch::Masonry;
        spec_.light.ambientOcclusion = 0;
        spec_.passes.push_back({std::move(styles), {}, Pass::Join::Over});
        spec_.hatches = {0.4, 4, 1, {1, 0, 0}};
    }
    std::size_t redPixels() {
        const Frame frame = cast(volume_, spec_);
        return static_cast<std::size_t>(std::ranges::count_if(
            frame.color.pixels(), [](const image::Rgba8& pixel) { return pixel.r > 150 && pixel.g < 100; }));
    }
    const TestVolume volume_ = makeVolume({32, 32, 32}, {0.1, 0.1, 0.1}, [](auto, auto, auto) { return 1u; });
    FrameSpec spec_;
};

TEST_F(HatchedCube, OnlyCutFacesAreHatched) {
    EXPECT_EQ(redPixels(), 0u);
    spec_.passes[0].clips = {ClipRegion::plane({0, 0, 1}, {0, 0, 1.55})};
    // Lines of 4 pixels, 12.5 pixels apart.
    EXPECT_NEAR(static_cast<double>(redPixels()) / 1e4, 4 / 12.5, 0.06);
    spec_.hatches.strength = 0;
    EXPECT_EQ(redPixels(), 0u);
}

TEST_F(HatchedCube, CutFacesHaveLinesOfTheirOwnWidth) {
    const auto darkPixels = [&] {
        const Frame frame = cast(volume_, spec_);
        return std::ranges::count_if(frame.color.pixels(),
                                     [](const image::Rgba8& pixel) { return pixel.b > 200 && pixel.r < 40; });
    };
    spec_.passes[0].styles[1].hatch = Hatch::None;
    spec_.camera.orthographicHeight *= 2;  // the cube is 50 pixels wide
    spec_.borders = {1, 1, 6, {0, 0, 1}};
    EXPECT_NEAR(static_cast<double>(darkPixels()), 4 * 50, 12);
    spec_.passes[0].clips = {ClipRegion::plane({0, 0, 1}, {0, 0, 1.55})};
    EXPECT_NEAR(static_cast<double>(darkPixels()), 4 * 6 * 50 - 4 * 36, 60);
}

}  // namespace
}  // namespace svt::render

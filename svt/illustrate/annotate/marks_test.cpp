#include <svt/illustrate/annotate/marks.hpp>

#include <svt/illustrate/annotate/name_tags.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace svt::illustrate {
namespace {

constexpr Vec3f kBlack{0, 0, 0}, kWhite{1, 1, 1};
constexpr Vec3d kNorth{0, 1, 0};

image::Image<image::Rgba8> paper(std::int32_t width, std::int32_t height) {
    image::Image<image::Rgba8> image(width, height);
    for (std::int32_t y = 0; y < height; ++y)
        for (std::int32_t x = 0; x < width; ++x) image.at(x, y) = {255, 255, 255, 255};
    return image;
}

bool isDark(const image::Image<image::Rgba8>& image, std::int32_t x, std::int32_t y) { return image.at(x, y).r < 100; }

// Camera from above, north up unless turned.
render::Camera plan(Vec3d up) {
    render::Camera camera;
    camera.projection = render::Camera::Projection::Orthographic;
    camera.eye = {0, 0, 10};
    camera.target = {0, 0, 0};
    camera.up = up;
    camera.orthographicHeight = 12;
    return camera;
}

TEST(Marks, AScaleBarIsAsLongAsItSays) {
    auto image = paper(600, 400);
    drawScaleBar(plan({0, 1, 0}), kBlack, kWhite, image);
    // 12 m in 400 pixels: a quarter of the width has 4.5 m, so the bar has 2 m, 66.7 pixels.
    const auto y = static_cast<std::int32_t>(400 - 2.6 * nameHeight(400));
    std::int32_t first = 600, last = 0;
    for (std::int32_t x = 0; x < 600; ++x)
        if (isDark(image, x, y)) {
            first = std::min(first, x);
            last = std::max(last, x);
        }
    EXPECT_NEAR(last - first, 2 * 400 / 12.0, 2.5);
}

// Middle of what is dark, from the middle of the arrow, which is its line's.
Vec3d darkMiddle(const image::Image<image::Rgba8>& image) {
    Vec3d sum{0, 0, 0};
    double count = 0;
    for (std::int32_t y = 0; y < image.height(); ++y)
        for (std::int32_t x = 0; x < image.width(); ++x)
            if (isDark(image, x, y)) {
                sum = sum + Vec3d{x + 0.5, y + 0.5, 0};
                count += 1;
            }
    const double height = nameHeight(image.height());
    return sum * (1 / count) - Vec3d{image.width() - 4 * height, image.height() - 4 * height, 0};
}

TEST(Marks, TheArrowPointsNorth) {
    // Head and letter lie to where the arrow points.
    auto up = paper(600, 400), left = up, down = up;
    drawNorthArrow(plan({0, 1, 0}), kNorth, kBlack, kWhite, up);
    EXPECT_LT(darkMiddle(up).y, -3);
    EXPECT_NEAR(darkMiddle(up).x, 0, 1.5);
    drawNorthArrow(plan({1, 0, 0}), kNorth, kBlack, kWhite, left);
    EXPECT_LT(darkMiddle(left).x, -3);
    drawNorthArrow(plan({0, -1, 0}), kNorth, kBlack, kWhite, down);
    EXPECT_GT(darkMiddle(down).y, 3);
}

TEST(Marks, AlongTheViewTheArrowIsARing) {
    render::Camera south = plan({0, 0, 1});
    south.eye = {0, -10, 0};
    render::Camera north = south;
    north.eye = {0, 10, 0};
    auto away = paper(600, 400), nearer = away;
    drawNorthArrow(south, kNorth, kBlack, kWhite, away);
    drawNorthArrow(north, kNorth, kBlack, kWhite, nearer);
    EXPECT_NE(away, nearer) << "a cross away from the viewer, a dot towards";
    const double height = nameHeight(400);
    const auto x = static_cast<std::int32_t>(600 - 4 * height), y = static_cast<std::int32_t>(400 - 4 * height);
    EXPECT_TRUE(isDark(nearer, x, y));
}

TEST(Marks, PicturesOfAnySizeAreDrawnOn) {
    for (const std::int32_t size : {1, 7, 40}) {
        auto image = paper(size, size);
        drawTitle("A title that is much too long for this picture", kBlack, kWhite, image);
        drawScaleBar(plan({0, 1, 0}), kBlack, kWhite, image);
        drawNorthArrow(plan({0, 1, 0}), kNorth, kBlack, kWhite, image);
    }
}

TEST(Marks, ATitleStandsAtTheUpperLeft) {
    auto image = paper(600, 400);
    drawTitle("A house", kBlack, kWhite, image);
    const double height = 1.6 * nameHeight(400);
    std::size_t dark = 0;
    for (std::int32_t y = 0; y < 400; ++y)
        for (std::int32_t x = 0; x < 600; ++x) {
            if (!isDark(image, x, y)) continue;
            ++dark;
            EXPECT_GT(x, height / 2);
            EXPECT_LT(x, 300);
            EXPECT_LT(y, 2.5 * height);
        }
    EXPECT_GT(dark, 50u);
    auto nothing = paper(600, 400);
    drawTitle("", kBlack, kWhite, nothing);
    EXPECT_EQ(nothing, paper(600, 400));
}

}  // namespace
}  // namespace svt::illustrate

#include <svt/image/text.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace svt::image {
namespace {

struct Inked {
    std::int32_t left = 1000, right = -1, top = 1000, bottom = -1;
    std::size_t count = 0;
};

Inked inkOf(const Image<Rgba8>& image) {
    Inked inked;
    for (std::int32_t y = 0; y < image.height(); ++y)
        for (std::int32_t x = 0; x < image.width(); ++x) {
            if (image.at(x, y).r > 128) continue;
            inked.left = std::min(inked.left, x);
            inked.right = std::max(inked.right, x);
            inked.top = std::min(inked.top, y);
            inked.bottom = std::max(inked.bottom, y);
            ++inked.count;
        }
    return inked;
}

Image<Rgba8> paper() { return {200, 60, Rgba8{255, 255, 255, 255}}; }

TEST(Text, StandsWhereItIsAskedFor) {
    auto image = paper();
    drawText(image, 20, 30, "HEH", {24, {0, 0, 0}, {1, 1, 1}, 0});
    const Inked inked = inkOf(image);
    EXPECT_NEAR(inked.left, 22, 2);
    EXPECT_NEAR(inked.right, 20 + textWidth("HEH", 24), 4);
    // Capitals around the middle line.
    EXPECT_NEAR((inked.top + inked.bottom) / 2.0, 30, 1.5);
    EXPECT_NEAR(inked.bottom - inked.top, 0.73 * 0.78 * 24, 2);
}

TEST(Text, HasWidthByItsLetters) {
    EXPECT_EQ(textWidth("", 20), 0);
    EXPECT_GT(textWidth("WW", 20), textWidth("ii", 20));
    EXPECT_NEAR(textWidth("Wand-Ext", 40), 2 * textWidth("Wand-Ext", 20), 8);
    EXPECT_GT(textWidth("Küche", 20), textWidth("Kche", 20));
    // No UTF-8: each byte is a sign of its own, and nothing breaks.
    EXPECT_GT(textWidth("\xff\xc3", 20), 0);
}

TEST(Text, MayReachOverThePicture) {
    auto image = paper();
    drawText(image, -30, 0, "Wohnen und Essen und noch mehr, als Platz hat", {200, {0, 0, 0}, {1, 1, 1}, 3});
    drawLine(image, -1e6, -1e6, 1e6, 1e6, {3, {0, 0, 0}});
    EXPECT_GT(inkOf(image).count, 100u);
}

TEST(Text, AHaloIsAroundTheLetters) {
    Image<Rgba8> image(200, 60, Rgba8{0, 0, 0, 255});
    drawText(image, 20, 30, "I", {30, {0, 0, 0}, {1, 1, 1}, 3});
    const auto bright = std::ranges::count_if(image.pixels(), [](const Rgba8& p) { return p.r > 150; });
    EXPECT_GT(bright, 60);
}

TEST(Line, IsAsWideAsAskedFor) {
    auto image = paper();
    drawLine(image, 50, 10, 50, 50, {4, {0, 0, 0}});
    const Inked inked = inkOf(image);
    EXPECT_EQ(inked.left, 48);
    EXPECT_EQ(inked.right, 51);
    EXPECT_NEAR(static_cast<double>(inked.count), 4 * 42, 8);
}

TEST(ImageText, NamesTheCharactersThatTheFontDoesNotHave) {
    EXPECT_EQ(missingLetters("Level \u00B10.00, \u25BD, \u0416, line\nbreak"), "");
    EXPECT_EQ(missingLetters("\u6807\u9AD8 1, \u6807\u9AD8 2"), "\u6807\u9AD8");
    EXPECT_EQ(missingLetters("\xFF"), "") << "not UTF-8";
}

}  // namespace
}  // namespace svt::image

#include <svt/image/linear_image.hpp>

#include <svt/image/color.hpp>
#include <svt/image/png.hpp>
#include <svt/image/tiny_jpeg_test.hpp>

#include <gtest/gtest.h>

namespace svt::image {
namespace {

double linearShare(int byte) { return 65535 * static_cast<double>(linearFromSrgb(static_cast<float>(byte) / 255)); }

TEST(LinearImage, BlocksAreMeansInLinearLight) {
    Image<Rgba8> stripes(2048, 2);
    for (std::int32_t y = 0; y < 2; ++y)
        for (std::int32_t x = 0; x < 2048; ++x)
            stripes.at(x, y) = x % 2 == 0 ? Rgba8{0, 0, 0, 255} : Rgba8{255, 100, 0, 255};
    const auto image = decodeLinear(*encodePng(stripes));
    ASSERT_TRUE(image.hasValue());
    EXPECT_EQ(image->width, 2048);
    ASSERT_EQ(image->pixels.width(), 1024);
    ASSERT_EQ(image->pixels.height(), 1);
    EXPECT_EQ(image->pixels.at(7, 0).r, 32768);  // the mean of bytes would be 128, in linear light 14000
    EXPECT_NEAR(image->pixels.at(1023, 0).g, linearShare(100) / 2, 1);
    EXPECT_EQ(image->pixels.at(0, 0).a, 65535);
}

TEST(LinearImage, InvisiblePixelsHaveNoColor) {
    Image<Rgba8> pixels(2, 1);
    pixels.pixels() = {{255, 255, 255, 0}, {255, 0, 0, 128}};
    const auto image = decodeLinear(*encodePng(pixels));
    ASSERT_TRUE(image.hasValue());
    EXPECT_EQ(image->pixels.at(0, 0), LinearPixel{});
    EXPECT_EQ(image->pixels.at(1, 0), (LinearPixel{32896, 0, 0, 32896}));
}

TEST(LinearImage, ReadsAJpeg) {
    const auto image = decodeLinear(test::tinyJpeg());
    ASSERT_TRUE(image.hasValue()) << image.error().message();
    ASSERT_EQ(image->pixels.width(), 16);
    ASSERT_EQ(image->pixels.height(), 16);
    for (const LinearPixel& pixel : image->pixels.pixels()) {
        EXPECT_NEAR(pixel.r, linearShare(200), 1200);
        EXPECT_NEAR(pixel.g, linearShare(40), 400);
        EXPECT_NEAR(pixel.b, linearShare(30), 400);
    }
}

TEST(LinearImage, DamagedJpegsAreBadImages) {
    const std::vector<std::byte> bytes = test::tinyJpeg();
    for (std::size_t size = 0; size + 2 < bytes.size(); ++size)
        EXPECT_EQ(decodeLinear(std::span(bytes).first(size)).error().code(), Code::BadImage) << size;
}

// Width and height are at the bytes 16 and 20 of a PNG, and follow the marker FF C0 in a JPEG.
TEST(LinearImage, LargeImagesAreRefusedBeforeTheyAreDecoded) {
    std::vector<std::byte> png = *encodePng(Image<Rgba8>(2, 2));
    EXPECT_EQ(pngPixels(png), 4U);
    png[17] = png[21] = std::byte{1};
    EXPECT_EQ(pngPixels(png), std::uint64_t{65538} * 65538);
    const auto large = decodeLinear(png);
    ASSERT_FALSE(large.hasValue());
    EXPECT_NE(large.error().message().find("more than 67108864"), std::string::npos) << large.error().message();

    std::vector<std::byte> jpeg = test::tinyJpeg();
    for (std::size_t i = 0; i + 8 < jpeg.size(); ++i)
        if (jpeg[i] == std::byte{0xFF} && jpeg[i + 1] == std::byte{0xC0}) jpeg[i + 5] = jpeg[i + 7] = std::byte{0xF0};
    const auto wide = decodeLinear(jpeg);
    ASSERT_FALSE(wide.hasValue());
    EXPECT_NE(wide.error().message().find("61456 x 61456 pixels"), std::string::npos) << wide.error().message();
}

TEST(LinearImage, OtherImagesAreNamed) {
    const auto messageOf = [](std::string_view text) {
        return decodeLinear(std::as_bytes(std::span(text.data(), text.size()))).error().message();
    };
    EXPECT_EQ(messageOf(""), "this is empty; save it as a PNG or JPEG");
    EXPECT_EQ(messageOf(std::string_view("II*\0abcd", 8)), "this is a TIFF; save it as a PNG or JPEG");
    EXPECT_EQ(messageOf("RIFF1234WEBPVP8 "), "this is a WebP; save it as a PNG or JPEG");
    EXPECT_EQ(messageOf("<html>"), "this is not an image that is known; save it as a PNG or JPEG");
}

}  // namespace
}  // namespace svt::image

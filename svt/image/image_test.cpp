#include <svt/core/temporary_folder_test.hpp>
#include <svt/image/image.hpp>
#include <svt/image/png.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace svt::image {
namespace {

Image<Rgba8> noise(std::int32_t width, std::int32_t height, unsigned seed) {
    std::mt19937 random(seed);
    Image<Rgba8> image(width, height);
    const auto byte = [&] { return static_cast<std::uint8_t>(random() % 256); };
    for (Rgba8& pixel : image.pixels()) pixel = {byte(), byte(), byte(), byte()};
    return image;
}

TEST(Png, WhatIsWrittenIsReadBack) {
    const test::TemporaryFolder folder;
    for (const auto& [width, height] : {std::pair{1, 1}, std::pair{17, 5}, std::pair{640, 3}}) {
        const Image<Rgba8> image = noise(width, height, 1);
        ASSERT_TRUE(writePng(folder / "a.png", image).hasValue());
        const auto read = readPng(folder / "a.png");
        ASSERT_TRUE(read.hasValue());
        EXPECT_EQ(*read, image);
    }
    Image<std::uint16_t> gray(3, 2);
    gray.pixels() = {0, 1, 255, 256, 40000, 65535};
    ASSERT_TRUE(writePng(folder / "g.png", gray).hasValue());
    const auto read = readGrayPng(folder / "g.png");
    ASSERT_TRUE(read.hasValue());
    EXPECT_EQ(*read, gray);
    EXPECT_EQ(readPng(folder / "g.png")->at(1, 1), (Rgba8{156, 156, 156, 255}));  // 40000 / 256
    EXPECT_EQ(readGrayPng(folder / "a.png").error().code(), Code::BadImage);
}

TEST(Png, TheSamePictureGivesTheSameBytes) {
    EXPECT_EQ(*encodePng(noise(50, 40, 2)), *encodePng(noise(50, 40, 2)));
    EXPECT_NE(*encodePng(noise(50, 40, 2)), *encodePng(noise(50, 40, 3)));
}

TEST(Png, DamagedBytesAreBadImages) {
    const auto bytes = *encodePng(noise(20, 20, 4));
    EXPECT_EQ(decodePng({}).error().code(), Code::BadImage);
    for (std::size_t size = 0; size < bytes.size(); size += 97)
        EXPECT_EQ(decodePng(std::span(bytes).first(size)).error().code(), Code::BadImage) << size;
    auto damaged = bytes;
    damaged[bytes.size() / 2] ^= std::byte{0x40};
    EXPECT_EQ(decodePng(damaged).error().code(), Code::BadImage);
    auto tooWide = bytes;
    tooWide[18] = std::byte{0xFF};  // width, big endian from byte 16
    EXPECT_EQ(decodePng(tooWide).error().code(), Code::BadImage);
}

TEST(Png, PicturesOverTheLimitAreRefused) {
    const auto wide = *encodePng(noise(50, 3, 5));
    EXPECT_TRUE(decodePng(wide, 50).hasValue());
    EXPECT_NE(decodePng(wide, 49).error().message().find("50 x 3 pixels are over the limit of 49 x 49"),
              std::string::npos);
    EXPECT_EQ(encodePng(Image<Rgba8>()).error().code(), Code::BadImage);
    EXPECT_TRUE(encodePng(Image<std::uint16_t>(kMaxPngSize, 1)).hasValue());
    EXPECT_EQ(encodePng(Image<std::uint16_t>(kMaxPngSize + 1, 1)).error().code(), Code::BadImage);
}

TEST(Png, AFileThatCannotBeWrittenOrReadIsAnError) {
    const test::TemporaryFolder folder;
    EXPECT_EQ(writePng(folder / "no" / "a.png", noise(2, 2, 5)).error().code(), Code::CannotWrite);
    EXPECT_EQ(readPng(folder / "a.png").error().code(), Code::CannotOpen);
    test::writeText(folder / "text.png", "no picture");
    const auto text = readPng(folder / "text.png");
    EXPECT_EQ(text.error().code(), Code::BadImage);
    EXPECT_EQ(text.error().where().file, (folder / "text.png").string());
}

TEST(CompareImages, EqualPicturesHaveNoError) {
    const ImageDifference same = compareImages(noise(33, 21, 6), noise(33, 21, 6));
    EXPECT_EQ(same.error, 0);
    EXPECT_EQ(same.differing, 0u);
}

TEST(CompareImages, TheScaleIsAsDocumented) {
    const Image<Rgba8> white(64, 64, {255, 255, 255, 255}), black(64, 64, {0, 0, 0, 255});
    EXPECT_EQ(compareImages(white, black).error, 1);
    EXPECT_EQ(compareImages(white, Image<Rgba8>(64, 63)).error, 1);
    const Image<Rgba8> gray(64, 64, {128, 128, 128, 255}), grayer(64, 64, {129, 129, 128, 255});
    const ImageDifference rounding = compareImages(gray, grayer);
    EXPECT_LT(rounding.error, 0.005);
    EXPECT_EQ(rounding.largest, 1);
    EXPECT_EQ(rounding.differing, 64u * 64u);
    // A small thing that is gone is not lost in a large picture.
    Image<Rgba8> dot = white;
    for (std::int32_t y = 8; y < 16; ++y)
        for (std::int32_t x = 8; x < 16; ++x) dot.at(x, y) = {0, 0, 0, 255};
    EXPECT_EQ(compareImages(white, dot).error, 1);
    EXPECT_NEAR(compareImages(white, dot).mean, 1.0 / 64, 1e-12);
}

TEST(CompareImages, TheColorOfWhatIsTransparentDoesNotCount) {
    const Image<Rgba8> a(4, 4, {10, 20, 30, 0}), b(4, 4, {200, 100, 50, 0});
    EXPECT_EQ(compareImages(a, b).error, 0);
    EXPECT_EQ(compareImages(a, b).differing, 16u);
}

}  // namespace
}  // namespace svt::image

#include <svt/illustrate/annotate/name_tags.hpp>

#include <svt/illustrate/scene.hpp>
#include <svt/image/text.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace svt::illustrate {
namespace {

// A big block and a small one on its east side, and one inside of the big.
volume::SemanticVolume blocks() {
    volume::SemanticVolume volume = volume::test::emptyVolume({40, 20, 20}, {0.5, 0.5, 0.5}, {10, 20, 30});
    for (const char* id : {"big", "small", "inner"}) volume::test::addObject(volume, id, "BuildingConstructiveElement");
    volume::test::addGroup(volume, "none", "BuildingConstructiveElement");
    volume.labels.labels[1].name = "Kleiner Block";
    volume::test::paintBoxes(
        volume, {{1, {0, 0, 0}, {20, 20, 20}}, {2, {30, 5, 5}, {40, 15, 15}}, {3, {5, 5, 5}, {10, 10, 10}}});
    return volume;
}

class NameTagsTest : public ::testing::Test {
protected:
    NameTagsTest() {
        Scene scene;
        scene.width = 400;
        scene.height = 300;
        scene.camera.preset = "front";
        scene.camera.isParallel = true;
        spec_ = *makeFrameSpec(scene, volume_);
        frame_ = *render::castRays(*volume::BrickVolume::fromColumns(volume_.columns), volume_.grid, spec_);
    }
    const volume::SemanticVolume volume_ = blocks();
    render::FrameSpec spec_;
    render::Frame frame_;
};

TEST_F(NameTagsTest, StandInWhatTheyName) {
    const auto found = findNameTags({"all"}, volume_, volume_.labels, frame_);
    ASSERT_TRUE(found);
    ASSERT_EQ(found->tags.size(), 2u);
    EXPECT_EQ(found->hiddenCount, 1u) << "the inner block is not seen, the last has no voxels";
    EXPECT_EQ(found->tags[0].text, "big");
    EXPECT_EQ(found->tags[1].text, "Kleiner Block");
    for (std::uint32_t n = 0; n < 2; ++n) {
        const NameTag& tag = found->tags[n];
        EXPECT_TRUE(tag.isInside);
        // All that the text covers.
        const auto half = static_cast<std::int32_t>(image::textWidth(tag.text, found->textHeight) / 2);
        for (const std::int32_t dx : {-half, 0, half})
            for (const std::int32_t dy : {-5, 5})
                EXPECT_EQ(frame_.label.at(static_cast<std::int32_t>(tag.x) + dx, static_cast<std::int32_t>(tag.y) + dy),
                          n + 1);
    }
}

TEST_F(NameTagsTest, ALeaderEndsAtTheInnermostPixel) {
    volume::SemanticVolume named = volume_;
    // A little wider than the block, for which there is room in the picture, but not in the block.
    const auto seen = findNameTags({"id=small"}, volume_, volume_.labels, frame_);
    ASSERT_TRUE(seen);
    std::string& name = named.labels.labels[1].name = "";
    while (image::textWidth(name, seen->textHeight) < (seen->right - seen->left) / 4 - 3) name += 'i';
    const auto found = findNameTags({"id=small"}, named, named.labels, frame_);
    ASSERT_TRUE(found);
    const NameTag& tag = found->tags.at(0);
    EXPECT_FALSE(tag.isInside);
    // The middle of the small block's face.
    const double metre = (found->right - found->left) / 20;
    EXPECT_NEAR(tag.x, found->left + 17.5 * metre, 2);
    EXPECT_NEAR(tag.clearance, 2.5 * metre, 2);
}

NameTags manyTags(std::size_t count) {
    NameTags tags;
    tags.left = 150;
    tags.right = 450;
    tags.textHeight = 11;
    std::uint32_t state = 7;
    const auto next = [&](double most) {
        state = state * 1664525U + 1013904223U;
        return static_cast<double>(state >> 8U) / (1 << 24) * most;
    };
    for (std::size_t n = 0; n < count; ++n) tags.tags.push_back({"name", 150 + next(300), next(400), false, next(20)});
    return tags;
}

// Whether two segments, as drawn by `leaders`, have a point in common inside both.
bool cross(const Leader& a, const Leader& b) {
    const auto side = [](const Leader& line, double x, double y) {
        return (line.x1 - line.x0) * (y - line.y0) - (line.y1 - line.y0) * (x - line.x0);
    };
    return side(a, b.x0, b.y0) * side(a, b.x1, b.y1) < 0 && side(b, a.x0, a.y0) * side(b, a.x1, a.y1) < 0;
}

TEST_F(NameTagsTest, LeadersDoNotCross) {
    for (const std::size_t count : {2u, 9u, 25u, 50u}) {
        const std::vector<Leader> leaders = layOutLeaders(manyTags(count), 600, 400);
        EXPECT_EQ(leaders.size(), std::min<std::size_t>(count, leaders.size()));
        EXPECT_GE(leaders.size(), std::min<std::size_t>(count, 9));
        for (std::size_t a = 0; a < leaders.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                EXPECT_FALSE(cross(leaders[a], leaders[b])) << count << " tags: " << a << " and " << b;
    }
}

TEST_F(NameTagsTest, WhatHasNoRoomIsLeftOutTheSmallestFirst) {
    const NameTags tags = manyTags(200);
    const std::vector<Leader> leaders = layOutLeaders(tags, 600, 400);
    ASSERT_LT(leaders.size(), 60u);
    ASSERT_GT(leaders.size(), 40u);
    double most = 0, least = 100;  // clearance of what is left out, and of what is drawn, on the left
    for (const NameTag& tag : tags.tags) {
        if (tag.x >= 300) continue;
        const bool isDrawn = std::any_of(leaders.begin(), leaders.end(), [&](const Leader& leader) {
            return leader.x1 == tag.x && leader.y1 == tag.y;
        });
        (isDrawn ? least : most) = isDrawn ? std::min(least, tag.clearance) : std::max(most, tag.clearance);
    }
    EXPECT_GE(least, most);
}

TEST_F(NameTagsTest, AreDrawn) {
    const auto found = findNameTags({"all"}, volume_, volume_.labels, frame_);
    ASSERT_TRUE(found);
    auto image = frame_.color;
    EXPECT_EQ(drawNameTags(*found, {0, 0, 0}, {1, 1, 1}, image), 2u);
    EXPECT_NE(image, frame_.color);
    image::Image<image::Rgba8> tiny(1, 1);
    drawNameTags(manyTags(100), {0, 0, 0}, {1, 1, 1}, tiny);
}

TEST_F(NameTagsTest, QueriesMustSelectSomething) {
    const auto found = findNameTags({"id=bgi"}, volume_, volume_.labels, frame_);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code(), Code::NothingSelected);
}

// Whether no character of UTF-8 is cut.
bool hasWholeCharacters(const std::string& text) {
    for (std::size_t n = 0; n < text.size();) {
        const auto lead = static_cast<unsigned char>(text[n]);
        const std::size_t length = lead < 0x80U ? 1 : lead < 0xC0U ? 0 : lead < 0xE0U ? 2 : lead < 0xF0U ? 3 : 4;
        if (length == 0 || n + length > text.size()) return false;
        for (std::size_t k = 1; k < length; ++k)
            if ((static_cast<unsigned char>(text[n + k]) & 0xC0U) != 0x80U) return false;
        n += length;
    }
    return true;
}

TEST(ShortenedNames, EndInAnEllipsisFitAndKeepWholeCharacters) {
    const std::string ellipsis = "\xE2\x80\xA6";
    // Characters of one to four bytes.
    const std::string name = "\xC3\xA4 very l\xC3\xB6ng \xE2\x82\xAC\xE2\x82\xAC n\xF0\x9F\x8F\xA0me";
    const double height = 12, all = image::textWidth(name, height);
    EXPECT_EQ(shortened(name, all, height), name);
    EXPECT_EQ(shortened("", 0, height), "");
    for (double width = image::textWidth(ellipsis, height); width < all - 1; width += 0.5) {
        const std::string text = shortened(name, width, height);
        EXPECT_LE(image::textWidth(text, height), width) << text;
        EXPECT_TRUE(hasWholeCharacters(text)) << text;
        ASSERT_TRUE(text.ends_with(ellipsis)) << text;
        EXPECT_TRUE(name.starts_with(text.substr(0, text.size() - ellipsis.size()))) << text;
    }
    EXPECT_EQ(shortened(name, 0, height), ellipsis);
}

}  // namespace
}  // namespace svt::illustrate

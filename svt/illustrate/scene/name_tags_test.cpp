#include <svt/illustrate/scene/name_tags.hpp>

#include <svt/illustrate/scene.hpp>
#include <svt/volume/brick_volume.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace svt::illustrate {
namespace {

// A big block and a small one on its east side, and one inside of the big.
volume::SemanticVolume blocks() {
    volume::SemanticVolume volume;
    volume.grid = *volume::Grid::fromParts({40, 20, 20}, {0.5, 0.5, 0.5}, {10, 20, 30},
                                           {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
    for (const char* id : {"big", "small", "inner", "none"}) {
        volume::Label label;
        label.id = id;
        label.className = "BuildingConstructiveElement";
        label.name = std::string(id) == "small" ? "Kleiner Block" : "";
        label.count = std::string(id) == "none" ? 0 : 1;
        label.first = label.count == 0 ? 0 : volume.labels.scalarCount();
        label.subtreeEnd = static_cast<std::uint32_t>(volume.labels.labels.size() + 1);
        volume.labels.labels.push_back(label);
    }
    std::vector<volume::Scalar> dense(40 * 20 * 20, 0);
    const auto fill = [&](Vec3i low, Vec3i high, volume::Scalar scalar) {
        for (int k = low.z; k < high.z; ++k)
            for (int j = low.y; j < high.y; ++j)
                for (int i = low.x; i < high.x; ++i) dense[static_cast<std::size_t>(i + 40 * (j + 20 * k))] = scalar;
    };
    fill({0, 0, 0}, {20, 20, 20}, 1);
    fill({30, 5, 5}, {40, 15, 15}, 2);
    fill({5, 5, 5}, {10, 10, 10}, 3);
    volume.columns = volume::ColumnVolume::fromDense({40, 20, 20}, dense);
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

TEST_F(NameTagsTest, PointIntoWhatTheyName) {
    const auto found = findNameTags({"all"}, volume_, volume_.labels, spec_, frame_);
    ASSERT_TRUE(found);
    ASSERT_EQ(found->tags.size(), 3u);
    for (std::size_t n = 0; n < 2; ++n) {
        const NameTag& tag = found->tags[n];
        EXPECT_FALSE(tag.isHidden);
        EXPECT_EQ(frame_.label.at(static_cast<std::int32_t>(tag.x), static_cast<std::int32_t>(tag.y)), n + 1);
    }
    EXPECT_EQ(found->tags[0].text, "big");
    EXPECT_EQ(found->tags[1].text, "Kleiner Block");
    // The middle of the small block's face.
    const double metre = (found->right - found->left) / 20;
    EXPECT_NEAR(found->tags[1].x, found->left + 17.5 * metre, 2);
    // What is not seen is pointed at where it is: the middle of samples 5 to 9.
    EXPECT_TRUE(found->tags[2].isHidden);
    EXPECT_NEAR(found->tags[2].x, found->left + 3.75 * metre, 2);
}

TEST_F(NameTagsTest, AreDrawnBesideThePicture) {
    const auto found = findNameTags({"all"}, volume_, volume_.labels, spec_, frame_);
    ASSERT_TRUE(found);
    auto image = frame_.color;
    EXPECT_EQ(drawNameTags(*found, 0, {0, 0, 0}, {1, 1, 1}, image), 3u);
    EXPECT_NE(image, frame_.color);
    // A hundred do not fit, and do no harm.
    NameTags many = *found;
    many.tags.assign(100, found->tags[0]);
    const std::size_t drawn = drawNameTags(many, 20, {0, 0, 0}, {1, 1, 1}, image);
    EXPECT_GT(drawn, 5u);
    EXPECT_LT(drawn, 20u);
    image::Image<image::Rgba8> tiny(1, 1);
    drawNameTags(many, 0, {0, 0, 0}, {1, 1, 1}, tiny);
}

TEST_F(NameTagsTest, QueriesMustSelectSomething) {
    const auto found = findNameTags({"id=bgi"}, volume_, volume_.labels, spec_, frame_);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code(), Code::NothingSelected);
}

}  // namespace
}  // namespace svt::illustrate

#include <svt/volume/dense.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/volume_readers/label_array.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace svt::volume_readers {
namespace {

using volume::Grid;
using volume::Scalar;

// 4 x 3 x 2 samples of a quarter of a metre, turned by 90 degrees about z.
Grid smallGrid() {
    return *Grid::fromParts({4, 3, 2}, {0.5, 0.25, 1}, {10, 20, 30}, {Vec3d{0, 1, 0}, Vec3d{-1, 0, 0}, Vec3d{0, 0, 1}});
}

template <class T>
LabelArray arrayOf(const std::vector<T>& samples) {
    LabelArray array;
    array.grid = smallGrid();
    array.samples = std::as_bytes(std::span(samples));
    array.bits = 8 * sizeof(T);
    return array;
}

std::vector<Scalar> scalarsOf(const volume::SemanticVolume& volume) { return *volume::toDense<Scalar>(volume.columns); }

TEST(LabelArray, EachValueIsALabelInOrder) {
    std::vector<std::uint16_t> samples(24, 0);
    samples[1] = 700;
    samples[5] = samples[23] = 30;
    const auto volume = volumeFromArray(arrayOf(samples));
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->grid, smallGrid());
    ASSERT_EQ(volume->labels.labels.size(), 2u);
    EXPECT_EQ(volume->labels.labels[0].id, "label-30");
    EXPECT_EQ(volume->labels.labels[0].voxels, 2u);
    EXPECT_DOUBLE_EQ(volume->labels.labels[0].volume, 2 * 0.125);
    std::vector<Scalar> expected(24, 0);
    expected[1] = 2;
    expected[5] = expected[23] = 1;
    EXPECT_EQ(scalarsOf(*volume), expected);
}

TEST(LabelArray, TableNamesTheValues) {
    std::vector<std::int32_t> samples(24, 0);
    samples[0] = 5;
    samples[2] = 6;
    samples[3] = 9;
    LabelArray array = arrayOf(samples);
    array.isSigned = true;
    const auto volume = volumeFromArray(array, R"({"labels": [
        {"value": 9, "id": "room", "class": "BuildingRoom", "parent": "house"},
        {"value": [5, 6], "id": "wall", "parent": "house", "attributes": {"u": 0.25}},
        {"id": "house", "class": "Building"}]})");
    ASSERT_TRUE(volume) << volume.error().toString();
    const auto& labels = volume->labels.labels;
    ASSERT_EQ(labels.size(), 3u);
    EXPECT_EQ(labels[0].id, "house");
    EXPECT_EQ(labels[1].id, "room");
    EXPECT_EQ(labels[2].count, 2u);
    EXPECT_EQ(labels[2].voxels, 2u);
    EXPECT_EQ(labels[2].attributes.at(0).name, "u");
}

TEST(LabelArray, TableOfAVolumeKeepsItsScalarsAndIsCountedAgain) {
    std::vector<std::uint8_t> samples(24, 2);
    auto volume =
        volumeFromArray(arrayOf(samples), R"({"labels": [{"value": [1, 2], "id": "a"}, {"value": 3, "id": "b"}]})");
    ASSERT_TRUE(volume);
    samples[4] = 0;
    const auto again = volumeFromArray(arrayOf(samples), volume::writeLabelsJson(volume->labels));
    // Of the values 1 to 3 only 2 occurs, which is scalar 1 of the volume.
    EXPECT_EQ(again.error().code(), Code::BadVolume);
    std::vector<std::uint8_t> ones(24, 1);
    ones[4] = 0;
    const auto part = volumeFromArray(arrayOf(ones), volume::writeLabelsJson(volume->labels));
    ASSERT_TRUE(part);
    EXPECT_EQ(part->labels.labels[0].voxels, 23u);
    EXPECT_DOUBLE_EQ(part->labels.labels[0].volume, 23 * 0.125);
    EXPECT_EQ(scalarsOf(*part)[4], 0u);
}

TEST(LabelArray, WhatIsNoLabelArrayIsRefused) {
    std::vector<std::int16_t> samples(24, -1);
    LabelArray array = arrayOf(samples);
    array.isSigned = true;
    EXPECT_EQ(volumeFromArray(array).error().code(), Code::BadArgument);
    array.isSigned = false;
    EXPECT_TRUE(volumeFromArray(array));  // 65535
    array.samples = array.samples.first(46);
    EXPECT_EQ(volumeFromArray(array).error().code(), Code::BadArgument);
    array = arrayOf(samples);
    array.bits = 64;
    EXPECT_EQ(volumeFromArray(array).error().code(), Code::BadArgument);
    EXPECT_EQ(volumeFromArray(arrayOf(samples), "{").error().code(), Code::BadJson);
    EXPECT_EQ(volumeFromArray(arrayOf(samples), "{}", 100).error().code(), Code::BadJson);
    EXPECT_EQ(volumeFromArray(arrayOf(samples), {}, 100).error().code(), Code::InputTooBig);
    Progress stopped;
    stopped.cancel = true;
    EXPECT_EQ(volumeFromArray(arrayOf(samples), {}, 0, &stopped).error().code(), Code::Cancelled);
}

}  // namespace
}  // namespace svt::volume_readers

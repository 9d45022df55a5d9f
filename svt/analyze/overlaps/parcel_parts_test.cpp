/// Parts of features in parcels against closed forms, without voxels and by voxels.

#include <svt/analyze/parcel_parts.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <string>

namespace svt::analyze {
namespace {

using volume::Filling;
using volume::kNoLabel;

std::uint32_t addParcelBox(volume::SemanticVolume& volume, const std::string& id, Vec3d low, Vec3d high) {
    volume::Label& label = volume::test::addObject(volume, id, "BuildingUnit");
    const Vec3d size = high - low;
    label.filling = Filling::Solid;
    label.volume = size.x * size.y * size.z;
    const std::uint32_t number = label.subtreeEnd - 1;
    volume::test::addBoxMesh(volume, number, low, high);
    return number;
}

TEST(ParcelParts, OfBoxesAreExactWithoutVoxels) {
    volume::SemanticVolume volume = volume::test::emptyVolume({16, 16, 8}, {0.5, 0.5, 0.5});
    const std::uint32_t flat = addParcelBox(volume, "flat", {0.3, 1, 0}, {4.8, 3, 2});
    // A cellar that lies in the flat for 1 m3 and reaches out of it: the smaller solid has this space.
    const std::uint32_t cellar = addParcelBox(volume, "cellar", {4.3, 1, 0}, {5.3, 2, 2});
    volume::SemanticVolume parcels = volume::test::emptyVolume({16, 16, 8}, {0.5, 0.5, 0.5});
    addParcelBox(parcels, "west", {-50, -50, -50}, {2.1, 50, 50});
    addParcelBox(parcels, "east", {2.1, -50, -50}, {4.6, 50, 50});
    const auto parts = partsInParcels(volume, std::vector<std::uint32_t>{flat, cellar}, parcels, 1);
    ASSERT_TRUE(parts) << parts.error().toString();
    ASSERT_EQ(parts->size(), 5u);
    const double flatVolume = 4.5 * 2 * 2 - 0.5 * 1 * 2;
    const double expected[] = {1.8 * 4, 2.5 * 4 - 0.3 * 2, 0.2 * 4 - 0.2 * 2, 0.3 * 2, 0.7 * 2};
    for (std::size_t n = 0; n < 5; ++n) {
        const ParcelPart& part = (*parts)[n];
        EXPECT_NEAR(part.volume, expected[n], 1e-5) << n;
        EXPECT_NEAR(part.part, expected[n] / (n < 3 ? flatVolume : 2.0), 1e-5) << n;
        EXPECT_EQ(part.source, VolumeSource::Meshes);
        ASSERT_TRUE(part.bound);
        EXPECT_LT(*part.bound, 1e-3);
        EXPECT_EQ(part.voxels, 0u);
    }
    EXPECT_EQ((*parts)[2].parcel, kNoLabel) << "east of both parcels";
}

TEST(ParcelParts, OfParcelsThatOverlapAreCounted) {
    volume::SemanticVolume volume = volume::test::emptyVolume({16, 4, 4}, {1, 1, 1});
    const std::uint32_t flat = addParcelBox(volume, "flat", {0, 0, 0}, {16, 4, 4});
    volume::test::paint(volume, [](int, int, int) { return 1; });
    volume::SemanticVolume parcels = volume::test::emptyVolume({16, 4, 4}, {1, 1, 1});
    addParcelBox(parcels, "west", {0, 0, 0}, {8.2, 4, 4});
    addParcelBox(parcels, "east", {8, 0, 0}, {16, 4, 4});
    volume::test::paint(parcels, [](int i, int, int) { return i < 8 ? 1 : 2; });
    const auto parts = partsInParcels(volume, std::vector<std::uint32_t>{flat}, parcels, 1);
    ASSERT_TRUE(parts);
    ASSERT_EQ(parts->size(), 2u);
    for (const ParcelPart& part : *parts) {
        EXPECT_EQ(part.source, VolumeSource::Voxels);
        EXPECT_EQ(part.bound, std::nullopt);
        EXPECT_DOUBLE_EQ(part.part, 0.5);
        EXPECT_EQ(part.voxels, 128u);
    }
}

// The solid of a flat lies in two smaller solids, so the flat has only the voxels of its balcony.
TEST(ParcelParts, OfAFlatWithoutSpaceOfItsSolidComeFromVoxels) {
    volume::SemanticVolume volume = volume::test::emptyVolume({16, 4, 4}, {1, 1, 1});
    const std::uint32_t flat = addParcelBox(volume, "flat", {0, 0, 0}, {8, 4, 4});
    volume::test::addObject(volume, "balcony", "BuildingRoom", flat);
    const std::uint32_t west = addParcelBox(volume, "west", {0, 0, 0}, {4, 4, 4});
    const std::uint32_t east = addParcelBox(volume, "east", {4, 0, 0}, {8, 4, 4});
    volume::test::paint(volume, [](int i, int, int) { return i < 4 ? 3 : i < 8 ? 4 : i < 10 ? 2 : 0; });
    volume::SemanticVolume parcels = volume::test::emptyVolume({16, 4, 4}, {1, 1, 1});
    addParcelBox(parcels, "plot", {-50, -50, -50}, {50, 50, 50});
    const auto parts = partsInParcels(volume, std::vector<std::uint32_t>{flat, west, east}, parcels, 1);
    ASSERT_TRUE(parts) << parts.error().toString();
    ASSERT_EQ(parts->size(), 3u);
    EXPECT_NEAR((*parts)[0].volume, 32, 1e-9);
    EXPECT_EQ((*parts)[0].source, VolumeSource::Voxels);
    EXPECT_EQ((*parts)[1].source, VolumeSource::Meshes);
}

TEST(ParcelParts, NeedOneGrid) {
    const volume::SemanticVolume volume = volume::test::emptyVolume({16, 4, 4}, {1, 1, 1});
    const volume::SemanticVolume other = volume::test::emptyVolume({16, 4, 4}, {0.5, 1, 1});
    EXPECT_EQ(partsInParcels(volume, {}, other).error().code(), Code::BadArgument);
}

}  // namespace
}  // namespace svt::analyze

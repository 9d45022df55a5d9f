#include <svt/analyze/selection.hpp>

#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

namespace svt::analyze {
namespace {

TEST(LabelRows, AreThoseOfTheTableAndMadeOnce) {
    const volume::SemanticVolume volume = volume::test::sampleVolume();
    const LabelRows rows(volume.labels);
    const auto first = rows.get();
    ASSERT_EQ(first.size(), 5u);
    EXPECT_EQ(first[1].id, "room-1");
    EXPECT_EQ(first[2].voxels, volume.labels.labels[2].voxels);
    EXPECT_EQ(rows.get().data(), first.data());
}

TEST(LabelRows, OfAnEmptyTableAreNone) {
    const volume::LabelTable none;
    EXPECT_TRUE(LabelRows(none).get().empty());
}

TEST(Selection, IsTheSameByTableAndByRows) {
    const volume::SemanticVolume volume = volume::test::sampleVolume();
    const LabelRows rows(volume.labels);
    for (const char* query : {"class=BuildingRoom", "under building", "storey=EG", "all"}) {
        const auto byTable = selectLabels(volume.labels, query), byRows = selectLabels(rows, query);
        ASSERT_TRUE(byTable && byRows) << query;
        EXPECT_EQ(*byTable, *byRows) << query;
    }
    EXPECT_EQ(*selectLabels(rows, "class=BuildingRoom"), (std::vector<std::uint32_t>{1, 3}));
}

TEST(Selection, OfNothingNamesTheNearestValue) {
    const volume::SemanticVolume volume = volume::test::sampleVolume();
    const auto nothing = selectLabels(volume.labels, "class=BuildingRom");
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().code(), Code::NothingSelected);
    EXPECT_NE(nothing.error().message().find("'BuildingRoom'"), std::string::npos) << nothing.error().message();
    EXPECT_EQ(selectLabels(volume.labels, "class=").error().code(), Code::BadQuery);
}

}  // namespace
}  // namespace svt::analyze

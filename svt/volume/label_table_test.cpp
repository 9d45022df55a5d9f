#include <svt/volume/label_table.hpp>

#include <gtest/gtest.h>

namespace svt::volume {
namespace {

LabelTable tableWith(std::vector<std::pair<Scalar, Scalar>> ranges) {
    LabelTable table;
    for (const auto& [first, count] : ranges) {
        Label label;
        label.first = first;
        label.count = count;
        table.labels.push_back(label);
    }
    return table;
}

TEST(LabelTable, EmptyTableHasBackgroundAlone) {
    const LabelTable table;
    EXPECT_EQ(table.scalarCount(), 1u);
    EXPECT_EQ(table.scalarBits(), 8);
    EXPECT_EQ(table.labelOfScalar(), std::vector<std::uint32_t>{kNoLabel});
}

TEST(LabelTable, SmallestTypeThatHoldsTheLargestScalar) {
    EXPECT_EQ(tableWith({{1, 255}}).scalarBits(), 8);     // scalars up to 255
    EXPECT_EQ(tableWith({{1, 256}}).scalarBits(), 16);    // up to 256
    EXPECT_EQ(tableWith({{1, 65535}}).scalarBits(), 16);  // up to 65535
    EXPECT_EQ(tableWith({{1, 65536}}).scalarBits(), 32);  // up to 65536
    EXPECT_EQ(tableWith({{65536, 1}}).scalarCount(), 65537u);
}

TEST(LabelTable, EveryScalarKnowsItsOwner) {
    // A group without voxels stands between two objects, one of them with three phases.
    const LabelTable table = tableWith({{1, 1}, {0, 0}, {2, 3}, {5, 1}});
    const std::vector<std::uint32_t> expected{kNoLabel, 0, 2, 2, 2, 3};
    EXPECT_EQ(table.labelOfScalar(), expected);
}

TEST(LabelTable, FillingNamesGoThereAndBack) {
    for (const Filling filling : {Filling::None, Filling::Solid, Filling::TJunctions, Filling::Complemented,
                                  Filling::Capped, Filling::Winding, Filling::Surface, Filling::Body}) {
        Filling back = filling == Filling::None ? Filling::Body : Filling::None;
        EXPECT_TRUE(fillingFromName(fillingName(filling), back));
        EXPECT_EQ(back, filling);
    }
    EXPECT_EQ(fillingName(Filling::TJunctions), "t-junctions");
    Filling untouched = Filling::Capped;
    EXPECT_FALSE(fillingFromName("Solid", untouched));
    EXPECT_FALSE(fillingFromName("", untouched));
    EXPECT_EQ(untouched, Filling::Capped);
}

}  // namespace
}  // namespace svt::volume

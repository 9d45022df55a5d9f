#include <svt/core/edit_distance.hpp>

#include <gtest/gtest.h>

namespace svt {
namespace {

TEST(EditDistance, CountsInsertedDroppedChangedAndSwappedLetters) {
    EXPECT_EQ(editDistance("room", "room", 5), 0u);
    EXPECT_EQ(editDistance("Room", "rOOM", 5), 0u);
    EXPECT_EQ(editDistance("rom", "room", 5), 1u);
    EXPECT_EQ(editDistance("roomy", "room", 5), 1u);
    EXPECT_EQ(editDistance("roam", "room", 5), 1u);
    EXPECT_EQ(editDistance("orom", "room", 5), 1u);
    EXPECT_EQ(editDistance("kitten", "sitting", 5), 3u);
    EXPECT_EQ(editDistance("", "room", 5), 4u);
}

TEST(EditDistance, StopsAtTheLimit) {
    EXPECT_EQ(editDistance("kitten", "sitting", 2), 3u);
    EXPECT_EQ(editDistance("a", "abcdefgh", 3), 4u);
}

TEST(EditDistance, TheNearestNameIsWithinHalfOfTheWord) {
    const std::string_view names[] = {"render", "section", "query"};
    EXPECT_EQ(nearestName("rendr", names), "render");
    EXPECT_EQ(nearestName("selection", names), "section");
    EXPECT_EQ(nearestName("x", names), "");
    EXPECT_EQ(nearestName("qerry", names), "query");
    EXPECT_EQ(nearestName("publish", names), "");
    EXPECT_EQ(nearestName("render", {}), "");
}

}  // namespace
}  // namespace svt

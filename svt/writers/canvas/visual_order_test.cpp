/// Arabic and Hebrew text as it is drawn.

#include <svt/writers/canvas/visual_order.hpp>

#include <gtest/gtest.h>

namespace svt::writers {
namespace {

TEST(VisualOrder, IsNeededForScriptsFromTheRight) {
    EXPECT_FALSE(hasRightToLeft("Plan EG, \u00B10.00 \u5BDD"));
    EXPECT_TRUE(hasRightToLeft("Plan \u05E9"));
    EXPECT_TRUE(hasRightToLeft("\u0633\u0644"));
    EXPECT_FALSE(hasRightToLeft("\xFF\u05E9")) << "invalid";
}

TEST(VisualOrder, TurnsLettersAndJoinsThem) {
    if (!visualOrder("a")) GTEST_SKIP() << "no FriBidi library";
    EXPECT_EQ(visualOrder("abc 12"), "abc 12");
    EXPECT_EQ(visualOrder("\u05E9\u05DC\u05D5\u05DD 12"), "12 \u05DD\u05D5\u05DC\u05E9") << "numbers keep their order";
    EXPECT_EQ(visualOrder("Plan \u05E9\u05DC, level +3"), "Plan \u05DC\u05E9, level +3");
    // Seen, lam with alef, meem: the initial form, the final ligature, the isolated form.
    EXPECT_EQ(visualOrder("\u0633\u0644\u0627\u0645"), "\uFEE1\uFEFC\uFEB3");
    EXPECT_EQ(visualOrder("\xFF\u05E9"), "\xFF\u05E9");
}

}  // namespace
}  // namespace svt::writers

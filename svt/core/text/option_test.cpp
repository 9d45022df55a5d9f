#include <svt/core/option.hpp>

#include <gtest/gtest.h>

namespace svt {
namespace {

TEST(Option, ChoicesAreSplit) {
    EXPECT_EQ(splitChoices("thin|conservative"), (std::vector<std::string_view>{"thin", "conservative"}));
    EXPECT_TRUE(splitChoices("").empty());
}

TEST(Option, LongNameIsTheOneAfterTheComma) {
    EXPECT_EQ(longName({.name = "-o,--output", .help = ""}), "--output");
    EXPECT_EQ(longName({.name = "input", .help = ""}), "input");
}

TEST(Option, ValuesAreHeldAgainstKindRangeAndChoices) {
    const Option zoom{.name = "--zoom", .kind = OptionKind::Number, .least = 0.01, .most = 100, .help = ""};
    EXPECT_EQ(faultOf(zoom, "0.01"), "");
    EXPECT_EQ(faultOf(zoom, "100"), "");
    EXPECT_EQ(faultOf(zoom, "0"), "0 is out of range; possible is 0.01 to 100");
    EXPECT_EQ(faultOf(zoom, "101"), "101 is out of range; possible is 0.01 to 100");
    for (const char* bad : {"", "x", "1x", "nan", "inf", " 1"}) EXPECT_NE(faultOf(zoom, bad), "") << bad;
    const Option level{.name = "--level", .kind = OptionKind::Whole, .least = 0, .help = ""};
    EXPECT_EQ(faultOf(level, "7"), "");
    EXPECT_EQ(faultOf(level, "1.5"), "'1.5' is not a whole number");
    EXPECT_EQ(faultOf(level, "-1"), "-1 is out of range; possible is at least 0");
    const Option seed{.name = "--seed", .kind = OptionKind::Whole, .least = 0, .help = ""};
    EXPECT_EQ(faultOf(seed, "9007199254740992"), "");
    for (const char* bad : {"18446744073709551615", "1e300", "-1"}) EXPECT_NE(faultOf(seed, bad), "") << bad;
    const Option sheets{.name = "--sheets", .choices = "thin|conservative", .help = ""};
    EXPECT_EQ(faultOf(sheets, "thin"), "");
    EXPECT_EQ(faultOf(sheets, "thick"), "'thick' is not possible; possible are thin, conservative");
}

}  // namespace
}  // namespace svt

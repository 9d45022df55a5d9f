#include <svt/core/option.hpp>
#include <svt/core/text.hpp>

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

TEST(Option, AnEmptyTextIsAFaultWithItsRemedy) {
    EXPECT_EQ(faultOf({.name = "--section", .value = "PLANE", .help = ""}, ""),
              "the value is empty; give PLANE, or leave the option out");
    EXPECT_EQ(faultOf({.name = "-o,--output", .value = "F.svt", .help = "", .isRequired = true}, ""),
              "the value is empty; give F.svt");
    EXPECT_EQ(faultOf({.name = "--title", .help = ""}, ""), "the value is empty; give a text, or leave the option out");
    EXPECT_EQ(faultOf({.name = "--fov", .kind = OptionKind::Number, .help = ""}, ""),
              "the value is empty; give a number, or leave the option out");
    EXPECT_EQ(faultOf({.name = "--sheets", .choices = "thin|conservative", .help = ""}, ""),
              "the value is empty; give one of thin, conservative, or leave the option out");
    EXPECT_EQ(faultOf({.name = "--wireframe", .value = "QUERY", .help = "", .leastCount = 0}, ""),
              "the value is empty; give QUERY, or leave the option out");
}

}  // namespace
}  // namespace svt

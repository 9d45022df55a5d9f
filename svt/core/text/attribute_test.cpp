#include <svt/core/attribute.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace svt {
namespace {

TEST(Attribute, TextOfValues) {
    EXPECT_EQ(toText(std::string("Küche")), "Küche");
    EXPECT_EQ(toText(std::int64_t{-5}), "-5");
    EXPECT_EQ(toText(9.5), "9.5");
    EXPECT_EQ(toText(0.1), "0.1");
    EXPECT_EQ(toText(true), "true");
    EXPECT_EQ(toText(false), "false");
}

std::string linesOf(const std::vector<Attribute>& attributes) {
    std::string lines;
    for (const AttributeList& list : attributeLists(attributes))
        lines += std::string(list.name) + "=" + toText(list) + "\n";
    return lines;
}

TEST(AttributeLists, HoldEqualNamesInOrder) {
    EXPECT_EQ(linesOf({{"year", std::int64_t{1985}},
                       {"usage", std::string("office")},
                       {"year", std::int64_t{2001}},
                       {"usage", std::string("a \"b\"\n")},
                       {"old", true}}),
              "year=[1985,2001]\nusage=[\"office\",\"a \\\"b\\\"\\u000a\"]\nold=true\n");
    EXPECT_TRUE(attributeLists({}).empty());
}

TEST(AttributeLists, KeepRecordsApart) {
    // Three floods: the second has no depth, the third two sources; the first alone has an author.
    EXPECT_EQ(linesOf({{"flood/depth", 0.5, "m", 0},
                       {"flood/rank", std::int64_t{1}, "", 0},
                       {"flood/by/name", std::string("x"), "", 0},
                       {"flood/rank", std::int64_t{3}, "", 1},
                       {"flood/depth", 2.0, "m", 2},
                       {"flood/source", std::string("a"), "", 2},
                       {"flood/source", std::string("b"), "", 2},
                       {"flooded", true}}),
              "flood/depth=[0.5,null,2]\nflood/rank=[1,3,null]\nflood/by/name=[\"x\",null,null]\n"
              "flood/source=[null,null,[\"a\",\"b\"]]\nflooded=true\n");
    // A record that is the only one, and a list beside it.
    EXPECT_EQ(
        linesOf(
            {{"owner/name", std::string("Eva")}, {"owner/phone", std::string("1")}, {"owner/phone", std::string("2")}}),
        "owner/name=Eva\nowner/phone=[\"1\",\"2\"]\n");
}

TEST(AttributeLists, OfHostileRecordsStaySmall) {
    const auto lists = attributeLists(std::vector<Attribute>{{"a/x", true, "", 4'000'000'000u}, {"a/y", true}});
    ASSERT_EQ(lists.size(), 2u);
    EXPECT_LE(lists[0].items.size() + lists[1].items.size(), kMostGaps + 2);
    EXPECT_EQ(linesOf({{"n", std::nan("")}, {"n", 1.0}, {"n", std::string("\xFF")}}), "n=[null,1,\"\xEF\xBF\xBD\"]\n");
}

}  // namespace
}  // namespace svt

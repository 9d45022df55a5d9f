#include <svt/core/error.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include <svt/core/test_data_test.hpp>

namespace svt {
namespace {

TEST(Error, TextIsCodeNamePlaceMessage) {
    const Error error(Code::BadXml, "no end tag", {"house.gml", 12, 5, "wall-3"});
    EXPECT_EQ(error.toString(), "E102 BadXml: house.gml:12:5 (id 'wall-3'): no end tag");
    EXPECT_EQ(Error(Code::Internal, "x").toString(), "E999 Internal: x");
}

TEST(Place, EmptyPartsAreLeftOut) {
    EXPECT_EQ((Place{"a.gml", 3, 4, "b"}).toString(), "a.gml:3:4 (id 'b')");
    EXPECT_EQ((Place{"a.gml", 3, 0, ""}).toString(), "a.gml:3");
    EXPECT_EQ((Place{"a.gml", 0, 0, ""}).toString(), "a.gml");
    EXPECT_EQ((Place{"a.gml", 0, 0, "b"}).toString(), "a.gml (id 'b')");
    EXPECT_EQ((Place{"", 3, 0, ""}).toString(), "line 3");
    EXPECT_EQ((Place{"", 0, 0, "b"}).toString(), "(id 'b')");
    EXPECT_EQ((Place{"", 0, 4, ""}).toString(), "");
    EXPECT_EQ(Place{}.toString(), "");
}

TEST(Error, TagHasThreeDigits) {
    EXPECT_EQ(codeTag(Code::CannotOpen), "E101");
    EXPECT_EQ(codeTag(Code::Internal), "E999");
    EXPECT_EQ(codeName(static_cast<Code>(7)), "Unknown");
}

TEST(Error, EveryCodeHasItsNameAndItsOwnNumber) {
    std::ifstream header(std::filesystem::path(test::kSourceRoot) / "svt/core/error.hpp");
    ASSERT_TRUE(header);
    std::stringstream text;
    text << header.rdbuf();
    const std::string all = text.str();
    const std::regex pattern(R"(\n    (\w+) = (\d{3}),)");
    std::map<int, std::string> names;
    for (std::sregex_iterator it(all.begin(), all.end(), pattern), end; it != end; ++it) {
        const int number = std::stoi((*it)[2]);
        EXPECT_TRUE(names.emplace(number, (*it)[1]).second) << number << " stands twice";
        EXPECT_EQ(codeName(static_cast<Code>(number)), (*it)[1].str());
    }
    EXPECT_GT(names.size(), 50u);
}

}  // namespace
}  // namespace svt

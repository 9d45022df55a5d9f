#include <svt/model/query/regex.hpp>

#include <gtest/gtest.h>

#include <random>
#include <regex>
#include <string>

namespace svt::model {
namespace {

bool isFound(std::string_view pattern, std::string_view text) {
    const auto regex = Regex::compile(pattern);
    EXPECT_TRUE(regex) << pattern << ": " << (regex ? "" : regex.error().toString());
    return regex && regex->isFoundIn(text);
}

std::size_t errorColumn(std::string_view pattern) {
    const auto regex = Regex::compile(pattern);
    EXPECT_FALSE(regex) << pattern;
    if (regex) return 0;
    EXPECT_EQ(regex.error().code(), Code::BadQuery);
    EXPECT_FALSE(regex.error().message().empty());
    return regex.error().where().column;
}

TEST(Regex, LiteralIsFoundAnywhere) {
    EXPECT_TRUE(isFound("Unterzug", "Der Unterzug-1"));
    EXPECT_FALSE(isFound("Unterzug", "Oberzug"));
    EXPECT_FALSE(isFound("unterzug", "Unterzug")) << "case counts";
    EXPECT_TRUE(isFound("", ""));
    EXPECT_TRUE(isFound("", "abc"));
}

TEST(Regex, QuantifiersCount) {
    EXPECT_TRUE(isFound("^ab*c$", "ac"));
    EXPECT_TRUE(isFound("^ab*c$", "abbbc"));
    EXPECT_FALSE(isFound("^ab+c$", "ac"));
    EXPECT_TRUE(isFound("^ab?c$", "abc"));
    EXPECT_FALSE(isFound("^ab?c$", "abbc"));
    EXPECT_FALSE(isFound("^a{2,3}$", "a"));
    EXPECT_TRUE(isFound("^a{2,3}$", "aa"));
    EXPECT_TRUE(isFound("^a{2,3}$", "aaa"));
    EXPECT_FALSE(isFound("^a{2,3}$", "aaaa"));
    EXPECT_TRUE(isFound("^(ab){2}$", "abab"));
    EXPECT_FALSE(isFound("^(ab){2}$", "ababab"));
    EXPECT_TRUE(isFound("^a{3,}$", "aaaaa"));
    EXPECT_FALSE(isFound("^a{3,}$", "aa"));
    EXPECT_TRUE(isFound("^a{0}b$", "b"));
    EXPECT_TRUE(isFound("^a+?b$", "aab")) << "lazy";
}

TEST(Regex, AlternativesAndGroupsNest) {
    EXPECT_TRUE(isFound("^(EG|OG|DG)$", "OG"));
    EXPECT_FALSE(isFound("^(EG|OG|DG)$", "UG"));
    EXPECT_TRUE(isFound("^(?:a(b|c)+|d)*$", "abcdacb"));
    EXPECT_FALSE(isFound("^(?:a(b|c)+|d)*$", "aad"));
    EXPECT_TRUE(isFound("^(|a)b$", "b"));
}

TEST(Regex, ClassesAndEscapesNameCharacters) {
    EXPECT_TRUE(isFound("^Dach-\\d+$", "Dach-12"));
    EXPECT_FALSE(isFound("^Dach-\\d+$", "Dach-x"));
    EXPECT_TRUE(isFound("^[A-Ca-c_]+$", "aBc_"));
    EXPECT_FALSE(isFound("^[A-Ca-c]+$", "abd"));
    EXPECT_TRUE(isFound("^[^0-9]+$", "abc"));
    EXPECT_FALSE(isFound("[^0-9]", "123"));
    EXPECT_TRUE(isFound("^[\\w.-]+$", "a_b-c.9"));
    EXPECT_TRUE(isFound("^\\S+\\s\\S+$", "two words"));
    EXPECT_TRUE(isFound("^\\W\\D$", "-x"));
    EXPECT_TRUE(isFound("a\\.b\\(c\\)", "a.b(c)"));
    EXPECT_FALSE(isFound("a\\.b", "axb"));
    EXPECT_TRUE(isFound("^[a-]$", "-"));
    EXPECT_TRUE(isFound("^[\\]]$", "]"));
    EXPECT_FALSE(isFound("^.$", "\n"));
}

TEST(Regex, DotIsOneCharacterOfUtf8) {
    EXPECT_TRUE(isFound("^Gescho.$", "Gescho\u00df"));
    EXPECT_TRUE(isFound("^[\u00e4-\u00fc]$", "\u00f6"));
    EXPECT_TRUE(isFound("^..$", "\xFF\xC3")) << "bytes that are no UTF-8 count one by one";
}

TEST(Regex, AnchorsHoldOnlyAtTheEnds) {
    EXPECT_FALSE(isFound("^b", "ab"));
    EXPECT_FALSE(isFound("a$", "ab"));
    EXPECT_TRUE(isFound("^$", ""));
    EXPECT_FALSE(isFound("a^b", "ab"));
    EXPECT_TRUE(isFound("(^a|b$)", "xb"));
}

TEST(Regex, ErrorsNameTheColumn) {
    EXPECT_EQ(errorColumn("*a"), 1u);
    EXPECT_EQ(errorColumn("a(b"), 4u);
    EXPECT_EQ(errorColumn("a)b"), 2u);
    EXPECT_EQ(errorColumn("ab[cd"), 3u);
    EXPECT_EQ(errorColumn("a\\"), 3u);
    EXPECT_EQ(errorColumn("\\b"), 2u);
    EXPECT_GT(errorColumn("a{"), 0u);
    EXPECT_GT(errorColumn("a{3,2}"), 0u);
    EXPECT_GT(errorColumn("a**"), 0u);
    EXPECT_GT(errorColumn("^*"), 0u);
    EXPECT_GT(errorColumn("[z-a]"), 0u);
    EXPECT_GT(errorColumn("(?=a)"), 0u);
    EXPECT_GT(errorColumn(std::string(40, '(') + std::string(40, ')')), 0u);
}

TEST(Regex, SizeIsLimited) {
    EXPECT_FALSE(Regex::compile(std::string(257, 'a')));
    EXPECT_TRUE(Regex::compile(std::string(256, 'a')));
    EXPECT_FALSE(Regex::compile("((a{100}){100}){100}"));
    EXPECT_FALSE(Regex::compile("a{1001}"));
    EXPECT_FALSE(Regex::compile("a{99999999999999999999}"));
}

TEST(Regex, NestedQuantifiersTakeLinearTime) {
    const std::string text = std::string(4000, 'a') + "!";
    EXPECT_FALSE(isFound("^(a+)+$", text));
    EXPECT_FALSE(isFound("^(a|aa)+$", text));
    EXPECT_FALSE(isFound("^(a*)*b", text));
    EXPECT_FALSE(isFound("(.*){10}x$", text));
    EXPECT_TRUE(isFound("^(a?){20}a{20}", text));
}

TEST(Regex, AgreesWithTheStandardLibraryOnRandomPatterns) {
    std::mt19937 random(7);
    const std::string_view pieces[] = {"a",  "b",       ".",  "[ab]",   "[^a]", "(a|b)", "(ab)", "a*",
                                       "b+", "(a|bc)*", "c?", "a{1,2}", "|",    "^",     "$",    "\\w"};
    int compared = 0;
    for (int round = 0; round < 2000; ++round) {
        std::string pattern, text;
        for (int k = 0; k < 4; ++k) pattern += pieces[random() % std::size(pieces)];
        for (int k = static_cast<int>(random() % 6); k > 0; --k) text += "abc"[random() % 3];
        const auto regex = Regex::compile(pattern);
        if (!regex) continue;
        ++compared;
        EXPECT_EQ(regex->isFoundIn(text), std::regex_search(text, std::regex(pattern))) << pattern << " in " << text;
    }
    EXPECT_GT(compared, 1500);
}

}  // namespace
}  // namespace svt::model

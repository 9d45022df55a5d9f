#include <svt/core/rounding.hpp>
#include <svt/core/text.hpp>

#include <gtest/gtest.h>

namespace svt {
namespace {

TEST(Utf8, CharactersComeBack) {
    for (const char32_t code : {U'a', U'\u007F', U'\u0080', U'\u07FF', U'\u0800', U'\uD7FF', U'\uE000', U'\uFFFF',
                                U'\U00010000', U'\U0010FFFF'}) {
        std::string text;
        appendUtf8(code, text);
        const Utf8Character read = firstCharacter(text + "x");
        EXPECT_EQ(read.code, code);
        EXPECT_EQ(read.size, text.size());
        EXPECT_EQ(findInvalidUtf8(text + "x"), std::string_view::npos);
        EXPECT_EQ(characterCount(text + "x"), 2u);
    }
}

TEST(Utf8, WrongBytesAreFound) {
    for (const char* bad : {"\x80", "\xC0\x80", "\xC1\xBF", "\xC3", "\xC3(", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xE2\x82",
                            "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF"}) {
        EXPECT_EQ(firstCharacter(bad).size, 0) << bad;
        EXPECT_EQ(findInvalidUtf8(std::string("a\xC3\xA4") + bad), 3u) << bad;
    }
}

TEST(PlainLength, EndsAtQuotesBackslashesAndOtherThanPrintableAscii) {
    EXPECT_EQ(plainLength("", '"'), 0u);
    EXPECT_EQ(plainLength("a 'b' ~", '"'), 7u);
    EXPECT_EQ(plainLength("a 'b'", '\''), 2u);
    for (const char* end : {"\"", "\\", "\n", "\x1F", "\x7F", "\xC3\xA4"})
        EXPECT_EQ(plainLength(std::string("ab") + end, '"'), 2u);
}

TEST(Ascii, DigitsAndBlanksAreThoseOfAsciiAlone) {
    for (int code = 0; code < 256; ++code) {
        const auto c = static_cast<char>(code);
        EXPECT_EQ(isDigit(c), std::string_view("0123456789").find(c) != std::string_view::npos) << code;
        EXPECT_EQ(isBlank(c), std::string_view(" \t\r\n").find(c) != std::string_view::npos) << code;
    }
}

TEST(LowerCase, CapitalsOfEuropeanAlphabetsHaveTheirSmallLetters) {
    EXPECT_EQ(lowerCase("Hauptstraße 12A ÄÖÜ ÉÇÑ Ÿ ẞ"), "hauptstraße 12a äöü éçñ ÿ ß");
    EXPECT_EQ(lowerCase("ŁÓDŹ ŽIŽKOV ŐRÜL ĐURO ȘTEFAN ĹĽŇ"), "łódź žižkov őrül đuro ștefan ĺľň");
    EXPECT_EQ(lowerCase("ΑΘΗΝΑ Άγιος ΈΏ"), "αθηνα άγιος έώ");
    EXPECT_EQ(lowerCase("МОСКВА ЁЖ Їжак Ґ"), "москва ёж їжак ґ");
}

TEST(LowerCase, OtherTextStaysAndInvalidBytesAreReplaced) {
    EXPECT_EQ(lowerCase("×÷ ﬁ 東京 ß ð"), "×÷ ﬁ 東京 ß ð");
    EXPECT_EQ(lowerCase(std::string("A\xFF"
                                    "B")),
              "a\xEF\xBF\xBD"
              "b");
    for (char32_t code = 0; code < 0x3000; ++code) EXPECT_EQ(lowerCase(lowerCase(code)), lowerCase(code)) << int(code);
}

TEST(Ascii, OnlyItsLettersChangeCase) {
    EXPECT_EQ(lowerAscii("EG Küche ÄÖ [@Z]"), "eg küche ÄÖ [@z]");
    EXPECT_TRUE(equalsIgnoringCase("EG", "eg"));
    EXPECT_FALSE(equalsIgnoringCase("EG", "eg "));
    static_assert(lowerAscii('Q') == 'q' && lowerAscii('[') == '[' && lowerAscii('@') == '@');
}

TEST(Numbers, AreReadWhole) {
    EXPECT_EQ(parseNumber("1.5"), 1.5);
    EXPECT_EQ(parseNumber("-1.5e2"), -150.0);
    EXPECT_EQ(parseNumber("+.5"), 0.5);
    EXPECT_EQ(parseNumber("5."), 5.0);
    EXPECT_EQ(parseNumber("-.25E-1"), -0.025);
    EXPECT_EQ(parseNumber("0.1"), 0.1) << "rounded correctly";
    for (const char* other :
         {"",   "+",   "-",    ".",   "+-1",  "-+1",      "++1",   " 1",     "1 ",     "1,5",   "0x10", "1e",
          "e1", "inf", "-inf", "nan", "+nan", "infinity", "1e999", "-1e999", "1e-400", "1.2.3", "one"})
        EXPECT_FALSE(parseNumber(other)) << other;
    EXPECT_FALSE(parseNumber(std::string_view("1\0", 2))) << "a zero byte is not the end";
}

TEST(Numbers, AreTakenFromTheBeginning) {
    std::string_view text = "-1.5e1.5x";
    EXPECT_EQ(takeNumber(text), -15.0);
    EXPECT_EQ(text, ".5x");
    EXPECT_EQ(takeNumber(text), 0.5);
    EXPECT_EQ(text, "x");
    EXPECT_FALSE(takeNumber(text));
    EXPECT_EQ(text, "x") << "stays";
}

TEST(Numbers, AreListedWithCommas) {
    using List = std::vector<double>;
    EXPECT_EQ(parseNumbers("1, -2.5 ,3", 3), (List{1, -2.5, 3}));
    EXPECT_FALSE(parseNumbers("1,2,3,4", 3));
    for (const char* other : {"", ",", "1,", ",1", "1,,2", "1 2", "1;2", "1,x"})
        EXPECT_FALSE(parseNumbers(other, 9)) << other;
}

TEST(Numbers, IntegersAreInRange) {
    EXPECT_EQ(parseInteger<int>("-12"), -12);
    EXPECT_EQ(parseInteger<std::uint8_t>("255"), 255);
    EXPECT_EQ(parseInteger<unsigned>("ff80", 16), 0xFF80u);
    EXPECT_FALSE(parseInteger<std::uint8_t>("256"));
    for (const char* other : {"", "-", "+1", " 1", "1 ", "1.0", "x"}) EXPECT_FALSE(parseInteger<int>(other)) << other;
    EXPECT_FALSE(parseInteger<unsigned>("-1"));
}

TEST(Rounding, NumbersBecomeOneTwoOrFive) {
    for (const double power : {0.001, 1.0, 100.0}) {
        EXPECT_DOUBLE_EQ(roundDownTo125(1.99 * power), 1 * power);
        EXPECT_DOUBLE_EQ(roundDownTo125(2.001 * power), 2 * power);
        EXPECT_DOUBLE_EQ(roundDownTo125(4.99 * power), 2 * power);
        EXPECT_DOUBLE_EQ(roundDownTo125(5.001 * power), 5 * power);
        EXPECT_DOUBLE_EQ(roundDownTo125(9.99 * power), 5 * power);
    }
}

TEST(XmlText, KeepsWhatXmlMayHold) {
    EXPECT_EQ(xmlContent("a<b>&\"c'\n\t\u00e4"), "a&lt;b&gt;&amp;\"c'\n\t\u00e4");
    EXPECT_EQ(xmlAttribute("a<b>&\"c'\n\t\u00e4"), "a&lt;b&gt;&amp;&quot;c&#39;&#10;&#9;\u00e4");
    EXPECT_EQ(xmlContent(std::string_view("\0\r\x7F", 3)), "   ");
    EXPECT_EQ(xmlContent("\xFFx\xEF\xBF\xBF"), "\xEF\xBF\xBDx\xEF\xBF\xBD") << "invalid, and U+FFFF";
}

}  // namespace
}  // namespace svt

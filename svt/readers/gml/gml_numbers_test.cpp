#include <svt/readers/gml/gml_crs.hpp>
#include <svt/readers/gml/gml_numbers.hpp>
#include <svt/readers/gml/missing_values.hpp>
#include <svt/readers/xml/xml_encoding.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>

namespace svt::readers::gml {
namespace {

TEST(GmlNumbers, EveryDoubleIsReadBack) {
    std::mt19937_64 random(7);  // NOLINT: the same numbers in every run
    std::string text;
    std::vector<double> expected;
    const auto add = [&](double value) {
        expected.push_back(value);
        text += fmt::format("{} ", value);
    };
    for (int i = 0; i < 20000; ++i) {
        const std::uint64_t bits = random();
        double any = 0;
        std::memcpy(&any, &bits, sizeof any);
        if (std::isfinite(any)) add(any);
        add(static_cast<double>(random() % 10'000'000'000) / 1000.0);
        add(-static_cast<double>(random() % 1'000'000'000'000'000'000) / 1e9);
    }
    std::vector<double> numbers;
    EXPECT_EQ(parseNumbers(text, numbers), "");
    EXPECT_EQ(numbers, expected);
}

TEST(GmlNumbers, LongDecimalsAreRoundedLikeStrtod) {
    for (const char* text :
         {"0.1", "9007199254740993", "9007199254740992.5", "123456789012345678", "1234567890123456789",
          "0.000000000000000001", "5819214.18602785", "390477.994899531", "64.2225904352854", "1.7976931348623157e308",
          "4.9e-324", "1e-400", "0.30000000000000004", "-0"}) {
        std::vector<double> numbers;
        EXPECT_EQ(parseNumbers(text, numbers), "");
        ASSERT_EQ(numbers.size(), 1u);
        EXPECT_EQ(numbers[0], std::strtod(text, nullptr)) << text;
    }
}

TEST(GmlNumbers, TheFirstTokenThatIsNoNumberIsNamed) {
    for (const char* bad : {"x", "1x", "--1", "+", "-", ".", "1,5", "1e", "0x10", "1.2.3", "+-1"}) {
        std::vector<double> numbers;
        EXPECT_EQ(parseNumbers(fmt::format("1 2 {} 3", bad), numbers), bad);
    }
    std::vector<double> numbers;
    EXPECT_EQ(parseNumbers("+1.5\t.5\n5. \r1E2", numbers), "");
    EXPECT_EQ(numbers, (std::vector<double>{1.5, 0.5, 5, 100}));
    numbers.clear();
    EXPECT_EQ(parseNumbers("NaN INF -INF 1e999", numbers), "");
    for (const double number : numbers) EXPECT_FALSE(std::isfinite(number));
}

TEST(GmlCrs, CodesAreFoundInEveryForm) {
    const std::pair<std::string_view, int> names[] = {
        {"EPSG:25832", 25832},
        {"epsg:25832", 25832},
        {"urn:ogc:def:crs:EPSG::28992", 28992},
        {"urn:ogc:def:crs:EPSG:6.9:31467", 31467},
        {"urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783", 25832},
        {"urn:ogc:def:crs,crs:EPSG:6.12:3068,crs:EPSG:6.12:5783", 3068},
        {"http://www.opengis.net/def/crs/EPSG/0/25832", 25832},
        {"https://www.opengis.net/def/crs/EPSG/0/6697", 6697},
        {"http://www.opengis.net/gml/srs/epsg.xml#4326", 4326},
        {"EPSG:28992+5109", 28992},
        {"http://www.opengis.net/def/crs-compound?1=http://www.opengis.net/def/crs/EPSG/0/25833&2=http://"
         "www.opengis.net/def/crs/EPSG/0/5783",
         25833},
        {"urn:adv:crs:ETRS89_UTM32*DE_DHHN92_NH", 25832},
        {"urn:adv:crs:DE_DHDN_3GK3*DE_DHHN92_NH", 31467},
        {"25833", 25833},
        {"EPSG:7415", 7415},
        {"http://www.opengis.net/def/crs/EPSG/0/7415", 7415},
        {"", 0},
        {"local", 0},
        {"EPSG:99999999999999", 0},
        {"EPSG:", 0}};
    for (const auto& [name, code] : names) EXPECT_EQ(epsgCode(name), code) << name;
    EXPECT_TRUE(isSameCrs("EPSG:25832", "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783"));
    EXPECT_FALSE(isSameCrs("EPSG:25832", "EPSG:25833"));
    EXPECT_FALSE(isSameCrs("local a", "local b"));
}

TEST(GmlCrs, TheVerticalPartIsTheSecondCode) {
    EXPECT_EQ(verticalCode("urn:ogc:def:crs,crs:EPSG::2263,crs:EPSG::6360"), 6360);
    EXPECT_EQ(verticalCode("EPSG:28992+5109"), 5109);
    EXPECT_EQ(verticalCode("http://www.opengis.net/def/crs-compound?1=http://www.opengis.net/def/crs/EPSG/0/25833&2="
                           "http://www.opengis.net/def/crs/EPSG/0/5783"),
              5783);
    EXPECT_EQ(verticalCode("urn:ogc:def:crs:EPSG::25832"), 0);
    EXPECT_EQ(verticalCode(""), 0);
}

TEST(MissingValues, AreNumbersOfNinesOfHeightsAndYears) {
    for (const double value : {-9999.0, 9999.0, -999999.0, 99999.0}) {
        EXPECT_TRUE(isMissingValue("measuredHeight", value)) << value;
        EXPECT_TRUE(isMissingValue("height/value", value));
        EXPECT_TRUE(isMissingValue("yearOfConstruction", value));
        EXPECT_FALSE(isMissingValue("price", value));
        EXPECT_FALSE(isMissingValue("", value));
    }
    EXPECT_FALSE(isMissingValue("measuredHeight", 9998));
    EXPECT_FALSE(isMissingValue("measuredHeight", 12.5));
}

TEST(XmlEncoding, DeclaredEncodingsBecomeUtf8) {
    const auto convert = [](std::string_view encoding, std::string_view bytes) {
        const std::string text = fmt::format("<?xml version=\"1.0\" encoding=\"{}\"?><a>{}</a>", encoding, bytes);
        const auto utf8 = xml::toUtf8({reinterpret_cast<const std::byte*>(text.data()), text.size()}, "a.xml");
        if (!utf8) return std::string(codeName(utf8.error().code()));
        const std::string_view view = utf8->view();
        return std::string(view.substr(view.find("<a>") + 3, view.rfind("</a>") - view.find("<a>") - 3));
    };
    EXPECT_EQ(convert("ISO-8859-1", "\xE4\xA4"), "\xC3\xA4\xC2\xA4");
    EXPECT_EQ(convert("ISO-8859-15", "\xE4\xA4"), "\xC3\xA4\xE2\x82\xAC") << "the euro sign";
    EXPECT_EQ(convert("windows-1252", "\xE4\x80"), "\xC3\xA4\xE2\x82\xAC");
    EXPECT_EQ(convert("EBCDIC-US", "x"), "BadEncoding");
    EXPECT_EQ(convert("UTF-7//TRANSLIT", "x"), "BadEncoding");
#ifndef __EMSCRIPTEN__
    EXPECT_EQ(convert("Shift_JIS", "\x93\x8C\x8B\x9E"), "\xE6\x9D\xB1\xE4\xBA\xAC") << "Tokyo";
    EXPECT_EQ(convert("ISO-8859-2",
                      "\xB3\xF3"
                      "d\xBC"),
              "\xC5\x82\xC3\xB3"
              "d\xC5\xBA");
    EXPECT_EQ(convert("EUC-JP", "\xFF\xFF"), "BadEncoding");
    std::string many;
    for (int i = 0; i < 100000; ++i) many += "\x93\x8C";
    EXPECT_EQ(convert("Shift_JIS", many).size(), 300000u) << "more than one block";
#endif
}

TEST(XmlEncoding, BadBytesAreFoundWhereTheyAre) {
    EXPECT_EQ(xml::firstBadUtf8("plain \xC3\xA4 \xE2\x82\xAC \xF0\x9F\x8F\xA0"), std::string_view::npos);
    EXPECT_EQ(xml::firstBadUtf8(""), std::string_view::npos);
    EXPECT_EQ(xml::firstBadUtf8("ab\xFF"), 2u);
    EXPECT_EQ(xml::firstBadUtf8("ab\xC3"), 2u);
    EXPECT_EQ(xml::firstBadUtf8("\xC3\xA4\xC0\x80"), 2u) << "overlong";
    EXPECT_EQ(xml::firstBadUtf8("a\xED\xA0\x80"), 1u) << "surrogate";
    EXPECT_EQ(xml::firstBadUtf8(std::string_view("a\0b", 3)), 1u);
}

}  // namespace
}  // namespace svt::readers::gml

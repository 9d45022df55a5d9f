#include <svt/illustrate/color_by.hpp>

#include <svt/illustrate/annotate/legend.hpp>
#include <svt/illustrate/scene_painter.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

namespace svt::illustrate {
namespace {

using model::kNoRow;
using model::QueryRow;

// A building (0) with two storeys (1, 2), and rooms below them; the last room is on no storey.
class ColorByTest : public ::testing::Test {
protected:
    ColorByTest() {
        building_ = {{"year", std::int64_t{1985}, ""}, {"function", std::string("1000"), ""}};
        heightA_ = {{"height", 2.5, "m"}};
        heightB_ = {{"height", 3.5, "m"}, {"year", std::int64_t{1990}, ""}};
        rows_ = {{"b", "Building", "", kNoRow, building_, {}, 0, 0},
                 {"eg", "Storey", "EG", 0, {}, {}, 0, 0},
                 {"og", "Storey", "", 0, {}, {}, 0, 0},
                 {"r1", "Room", "Kitchen", 1, heightA_, {}, 10, 100},
                 {"r2", "Room", "Bath", 2, heightB_, {}, 30, 300},
                 {"r3", "Room", "", kNoRow, {}, {}, 20, 200}};
        isShown_ = {0, 0, 0, 1, 1, 1};
    }
    [[nodiscard]] Coloring by(std::string_view key) const {
        auto coloring = colorBy(key, rows_, isShown_);
        EXPECT_TRUE(coloring) << key << ": " << (coloring ? "" : coloring.error().toString());
        return coloring ? *coloring : Coloring{std::vector<Vec3f>(rows_.size()), {}};
    }
    std::vector<Attribute> building_, heightA_, heightB_;
    std::vector<QueryRow> rows_;
    std::vector<std::uint8_t> isShown_;
};

TEST_F(ColorByTest, NumbersGetARamp) {
    const Coloring coloring = by("volume");
    EXPECT_TRUE(coloring.scale.isRamp);
    EXPECT_EQ(coloring.scale.title, "volume (m3)");
    EXPECT_EQ(coloring.scale.low, 10);
    EXPECT_EQ(coloring.scale.high, 30);
    EXPECT_EQ(coloring.colors[3], rampColor(coloring.scale, 10));
    EXPECT_EQ(coloring.colors[5], rampColor(coloring.scale, 20));
    // From dark to light, as viridis does.
    const auto sum = [](Vec3f c) { return c.x + c.y + c.z; };
    EXPECT_LT(sum(coloring.colors[3]), sum(coloring.colors[5]));
    EXPECT_LT(sum(coloring.colors[5]), sum(coloring.colors[4]));
}

TEST_F(ColorByTest, AttributesComeFromTheNearestAbove) {
    const Coloring year = by("YEAR");
    EXPECT_EQ(year.scale.low, 1985) << "of the building";
    EXPECT_EQ(year.scale.high, 1990) << "the room's own";
    EXPECT_EQ(year.scale.missing, 1u);
    EXPECT_EQ(year.colors[5], missingColor());
    EXPECT_EQ(by("height").scale.title, "height (m)");
}

TEST_F(ColorByTest, WordsGetAPalette) {
    const Coloring storey = by("storey");
    EXPECT_FALSE(storey.scale.isRamp);
    ASSERT_EQ(storey.scale.entries.size(), 2u);
    EXPECT_EQ(storey.scale.entries[0].text, "EG");
    EXPECT_EQ(storey.scale.entries[1].text, "og") << "by its id where it has no name";
    EXPECT_EQ(storey.colors[3], storey.scale.entries[0].color);
    EXPECT_EQ(storey.colors[4], storey.scale.entries[1].color);
    EXPECT_NE(storey.colors[3], storey.colors[4]);
    EXPECT_EQ(by("class").scale.entries.at(0).text, "BuildingRoom");
    EXPECT_FALSE(by("function").scale.isRamp) << "a code is no measure";
}

TEST_F(ColorByTest, HidingComponentsKeepsTheColoursOfOthers) {
    const std::vector<std::uint8_t> isHidden{0, 0, 0, 1, 0, 0};
    for (const char* key : {"volume", "storey", "name", "class"}) {
        const Coloring before = by(key);
        isShown_[3] = 0;
        const auto after = colorBy(key, rows_, isShown_, {}, isHidden);
        isShown_[3] = 1;
        ASSERT_TRUE(after) << key;
        EXPECT_EQ(after->colors[4], before.colors[4]) << key;
        EXPECT_EQ(after->colors[5], before.colors[5]) << key;
        EXPECT_EQ(after->colors[3], missingColor()) << key;
        EXPECT_EQ(after->scale.low, before.scale.low) << key;
    }
    isShown_[3] = 0;
    const auto storey = colorBy("storey", rows_, isShown_, {}, isHidden);
    ASSERT_TRUE(storey);
    ASSERT_EQ(storey->scale.entries.size(), 1u) << "the legend lists visible components";
    EXPECT_EQ(storey->scale.entries[0].text, "og");
    EXPECT_EQ(storey->scale.entries[0].count, 1u);
    isShown_ = {0, 0, 0, 0, 0, 1};
    EXPECT_FALSE(colorBy("storey", rows_, isShown_, {}, isHidden)) << "no visible component has a storey";
}

TEST_F(ColorByTest, ManyWordsLeaveSomeGray) {
    std::vector<std::string> names;
    for (int n = 0; n < 30; ++n) names.push_back("name " + std::to_string(n));
    rows_.clear();
    for (const std::string& name : names) rows_.push_back({name, "Room", name, kNoRow, {}, {}, 1, 1});
    rows_.push_back({"again", "Room", "name 29", kNoRow, {}, {}, 1, 1});
    isShown_.assign(rows_.size(), 1);
    const Coloring coloring = by("name");
    ASSERT_EQ(coloring.scale.entries.size(), 19u);
    EXPECT_EQ(coloring.scale.entries[0].text, "name 29") << "the most frequent";
    EXPECT_EQ(coloring.scale.entries[18].text, "12 others");
    EXPECT_EQ(coloring.scale.entries[18].count, 12u);
    std::set<std::tuple<float, float, float>> colors;
    for (const Vec3f c : coloring.colors) colors.insert({c.x, c.y, c.z});
    EXPECT_EQ(colors.size(), 19u);
}

TEST_F(ColorByTest, UnknownKeysNameTheKnown) {
    const auto coloring = colorBy("colour", rows_, isShown_);
    ASSERT_FALSE(coloring);
    EXPECT_EQ(coloring.error().code(), Code::BadArgument);
    EXPECT_NE(coloring.error().message().find("height"), std::string::npos);
}

TEST_F(ColorByTest, HostileTreesEnd) {
    rows_[0].parent = 2;  // a circle
    EXPECT_EQ(by("height").scale.missing, 1u);
}

TEST_F(ColorByTest, LegendsOfAnySizeStayInThePicture) {
    Coloring coloring = by("volume");
    for (const int size : {1, 20, 300}) {
        image::Image<image::Rgba8> image(size, size);
        drawLegend(coloring.scale, {0, 0, 0}, {1, 1, 1}, image);
        ColorScale words = by("name").scale;
        for (int n = 0; n < 100; ++n) words.entries.push_back({"a rather long name of a room", {1, 0, 0}, 1});
        drawLegend(words, {0, 0, 0}, {1, 1, 1}, image);
    }
}

// Two rooms of Anna and Bert with a wall between them, one of Anna's alone, and what touches nobody.
TEST(OwnerAttributes, FollowTheTableAndContacts) {
    volume::SemanticVolume volume = volume::test::emptyVolume({9, 4, 4}, {0.5, 0.5, 0.5});
    for (const char* id : {"outer", "a", "between", "b", "far"})
        volume::test::addObject(volume, id, id[1] == '\0' ? "BuildingRoom" : "WallSurface");
    volume::test::paint(volume, [](int i, int, int) { return std::array{1, 2, 2, 3, 4, 4, 0, 0, 5}[std::size_t(i)]; });
    Diagnostics unknown;
    ASSERT_TRUE(addOwnerAttributes(volume, "feature,owner\na,Anna\nnobody,Carl\nb,Bert\n", "t.csv", unknown));
    ASSERT_EQ(unknown.items().size(), 1u);
    EXPECT_EQ(unknown.items()[0].where.line, 3u);
    EXPECT_NE(unknown.items()[0].message.find("'nobody'"), std::string::npos);
    const auto ownerOf = [&](std::size_t l) {
        const auto& attributes = volume.labels.labels[l].attributes;
        return attributes.empty() ? std::string("-") : toText(attributes.back().value);
    };
    EXPECT_EQ(ownerOf(0), "Anna");
    EXPECT_EQ(ownerOf(1), "Anna");
    EXPECT_EQ(ownerOf(2), "shared");
    EXPECT_EQ(ownerOf(3), "Bert");
    EXPECT_EQ(ownerOf(4), "-");
    EXPECT_EQ(addOwnerAttributes(volume, "feature,owner\nnobody,Anna\n", "t.csv", unknown).error().code(),
              Code::NothingSelected)
        << "no row has an effect";
}

TEST_F(ColorByTest, AreasAreGivenOrAttributes) {
    const std::vector<double> areas{0, 0, 0, 12.5, 20, 0};
    const auto coloring = colorBy("area", rows_, isShown_, areas);
    ASSERT_TRUE(coloring);
    EXPECT_EQ(coloring->scale.title, "area (m2)");
    EXPECT_EQ(coloring->scale.low, 12.5);
    EXPECT_EQ(coloring->scale.high, 20);
    EXPECT_EQ(coloring->scale.missing, 1u);
}

TEST_F(ColorByTest, ALegendShowsTheColoursOfItsEntries) {
    const auto byte = [](float c) { return static_cast<std::uint8_t>(std::lround(c * 255)); };
    const ColorScale words = by("storey").scale, ramp = by("volume").scale;
    ASSERT_FALSE(words.entries.empty());
    const Vec3f first = words.entries[0].color;
    const image::Rgba8 expected{byte(first.x), byte(first.y), byte(first.z), 255};
    for (const std::int32_t size : {100, 300}) {
        const image::Image<image::Rgba8> empty(size, size);
        auto ofWords = empty, ofRamp = empty;
        drawLegend(words, {0, 0, 0}, {1, 1, 1}, ofWords);
        drawLegend(ramp, {0, 0, 0}, {1, 1, 1}, ofRamp);
        EXPECT_NE(ofWords, empty) << size;
        EXPECT_NE(ofRamp, empty) << size;
        EXPECT_NE(ofWords, ofRamp) << size;
        const auto found = std::count(ofWords.pixels().begin(), ofWords.pixels().end(), expected);
        EXPECT_GT(found, 50) << size << ": a field of 1.2 by 0.84 heights of a text of 11 pixels";
    }
}

using Rows3 = std::array<Vec3d, 3>;

Vec3d times(const Rows3& rows, Vec3d v) { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }

// CIE Lab (D65) of an sRGB colour as it is seen by an eye, a matrix on linear RGB.
Vec3d labSeenBy(const Rows3& eye, Vec3f color) {
    const auto linear = [](float c) {
        const auto v = static_cast<double>(c);
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    const Vec3d seen = times(eye, {linear(color.x), linear(color.y), linear(color.z)});
    constexpr Rows3 kXyz{Vec3d{0.4124564, 0.3575761, 0.1804375}, Vec3d{0.2126729, 0.7151522, 0.0721750},
                         Vec3d{0.0193339, 0.1191920, 0.9503041}};
    const Vec3d xyz =
        times(kXyz, {std::clamp(seen.x, 0.0, 1.0), std::clamp(seen.y, 0.0, 1.0), std::clamp(seen.z, 0.0, 1.0)});
    const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
    const double fx = f(xyz.x / 0.95047), fy = f(xyz.y), fz = f(xyz.z / 1.08883);
    return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

TEST_F(ColorByTest, NineWordsAreToldApartByAllEyes) {
    std::vector<std::string> names;
    for (int n = 0; n < 9; ++n) names.push_back("name " + std::to_string(n));
    rows_.clear();
    for (const std::string& name : names) rows_.push_back({name, "Room", name, kNoRow, {}, {}, 1, 1});
    isShown_.assign(rows_.size(), 1);
    const auto entries = by("name").scale.entries;
    ASSERT_EQ(entries.size(), 9u);
    // Without green, red, blue cones: Machado, Oliveira and Fernandes 2009, severity 1.
    const std::pair<const char*, Rows3> eyes[] = {
        {"deutan",
         {Vec3d{0.367322, 0.860646, -0.227968}, Vec3d{0.280085, 0.672501, 0.047413},
          Vec3d{-0.011820, 0.042940, 0.968881}}},
        {"protan",
         {Vec3d{0.152286, 1.052583, -0.204868}, Vec3d{0.114503, 0.786281, 0.099216},
          Vec3d{-0.003882, -0.048116, 1.051998}}},
        {"tritan",
         {Vec3d{1.255528, -0.076749, -0.178779}, Vec3d{-0.078411, 0.930809, 0.147602},
          Vec3d{0.004733, 0.691367, 0.303900}}}};
    for (const auto& [name, eye] : eyes)
        for (std::size_t a = 0; a < entries.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                EXPECT_GT(length(labSeenBy(eye, entries[a].color) - labSeenBy(eye, entries[b].color)), 15)
                    << name << ' ' << a << ' ' << b;
}

}  // namespace
}  // namespace svt::illustrate

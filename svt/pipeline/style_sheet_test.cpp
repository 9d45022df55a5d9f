#include <svt/core/temporary_folder_test.hpp>
#include <svt/image/color_text.hpp>
#include <svt/pipeline/default_style.hpp>
#include <svt/pipeline/style_sheet.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace svt::pipeline {
namespace {

using voxelize::PatternKind;

// A sheet with one rule for `all` with the given members.
std::string ruleWith(const std::string& members) { return R"({"rules": [{"select": "all")" + members + "}]}"; }

void expectBad(const std::string& json, Code code, const std::vector<std::string>& words) {
    const auto sheet = parseStyleSheet(json, {});
    ASSERT_FALSE(sheet) << json;
    EXPECT_EQ(sheet.error().code(), code) << sheet.error().toString();
    for (const std::string& word : words)
        EXPECT_NE(sheet.error().message().find(word), std::string::npos) << word << " in: " << sheet.error().message();
}

TEST(DefaultStyle, BuiltInSheetsParse) {
    const auto plain = parseStyleSheet(kDefaultStyleJson, {}), patterns = parseStyleSheet(kDefaultPatternsJson, {});
    ASSERT_TRUE(plain) << plain.error().toString();
    ASSERT_TRUE(patterns) << patterns.error().toString();
    EXPECT_GT(plain->rules.size(), 20u);
    EXPECT_GT(patterns->rules.size(), 3u);
    EXPECT_EQ(defaultStyle(false).rules.size(), plain->rules.size());
    EXPECT_EQ(defaultStyle(true).rules.size(), plain->rules.size() + patterns->rules.size());
    for (const StyleRule& rule : patterns->rules) EXPECT_EQ(rule.patternColors.size(), rule.pattern->phaseCount());
}

TEST(DefaultStyle, EveryClassHasAColourAndRoomsAreThin) {
    const std::vector<Attribute> none;
    std::vector<model::QueryRow> rows;
    for (const char* className : {"Building", "BuildingRoom", "WallSurface", "SomethingNew"})
        rows.push_back({className, className, "", model::kNoRow, none, {}, 1, 1});
    const StyleSheet* sheets[] = {&defaultStyle(false)};
    const auto styles = resolveStyles(rows, sheets, {});
    EXPECT_EQ(styles[0].opacity, 1);
    EXPECT_LT(styles[1].opacity, 0.2f);
    EXPECT_EQ(styles[2].color, *image::parseColor("#d9c7a8"));
    EXPECT_EQ(styles[3].color, *image::parseColor("#c9c4ba"));
    EXPECT_EQ(styles[2].pattern.kind, PatternKind::None);
    const StyleSheet* patterned[] = {&defaultStyle(true)};
    const auto withPatterns = resolveStyles(rows, patterned, {});
    EXPECT_EQ(withPatterns[2].pattern.kind, PatternKind::Brick);
    EXPECT_EQ(withPatterns[2].phaseColors.size(), 2u);
    EXPECT_EQ(withPatterns[1].pattern.kind, PatternKind::None);
}

TEST(DefaultStyle, ClassesComeBeforeNames) {
    const std::vector<Attribute> none;
    std::vector<model::QueryRow> rows;
    for (const char* className : {"BuildingRoom", "BuildingConstructiveElement", "Door"})
        rows.push_back({className, className, "Roof terrace", model::kNoRow, none, {}, 1, 1});
    rows.push_back({"unnamed", "BuildingRoom", "", model::kNoRow, none, {}, 1, 1});
    const StyleSheet* sheets[] = {&defaultStyle(false)};
    const auto styles = resolveStyles(rows, sheets, {});
    EXPECT_EQ(styles[0].color, styles[3].color) << "a room is a room, whatever its name is";
    EXPECT_EQ(styles[1].color, *image::parseColor("#a8483a"));
    EXPECT_EQ(styles[2].color, *image::parseColor("#8a5a33"));
}

TEST(DefaultStyle, ElementsOfIfcAreToldApartByWhatTheyAre) {
    struct Element {
        const char *type, *predefined, *name, *color;
        PatternKind pattern;
    };
    const Element elements[] = {
        {"IfcWallStandardCase", "", "", "#dcc9a6", PatternKind::Brick},
        {"IfcSlab", "FLOOR", "", "#a9a59c", PatternKind::Concrete},
        {"IfcSlab", "BASESLAB", "", "#8d8a83", PatternKind::Concrete},
        {"IfcSlab", "ROOF", "", "#a8483a", PatternKind::Stripes},
        {"IfcSlab", "", "Dach-2", "#a8483a", PatternKind::Stripes},
        {"IfcRoof", "", "", "#a8483a", PatternKind::Stripes},
        {"IfcCovering", "CEILING", "", "#ece8df", PatternKind::None},
        {"IfcCovering", "FLOORING", "Roof terrace", "#b58d61", PatternKind::None},
        {"IfcColumn", "COLUMN", "", "#9c9184", PatternKind::None},
    };
    std::vector<std::vector<Attribute>> attributes;
    for (const Element& element : elements) {
        attributes.push_back({{"ifcType", std::string(element.type)}});
        if (*element.predefined != 0) attributes.back().push_back({"predefinedType", std::string(element.predefined)});
    }
    std::vector<model::QueryRow> rows;
    for (std::size_t n = 0; n < attributes.size(); ++n)
        rows.push_back({elements[n].type,
                        "BuildingConstructiveElement",
                        elements[n].name,
                        model::kNoRow,
                        attributes[n],
                        {},
                        1,
                        1});
    const StyleSheet* sheets[] = {&defaultStyle(true)};
    const auto styles = resolveStyles(rows, sheets, {});
    for (std::size_t n = 0; n < rows.size(); ++n) {
        EXPECT_EQ(styles[n].color, *image::parseColor(elements[n].color)) << n;
        EXPECT_EQ(styles[n].pattern.kind, elements[n].pattern) << n;
    }
}

TEST(DefaultStyle, FunctionsComeBeforeNames) {
    const std::vector<Attribute> none, wall{{"function", std::string("load-bearing wall")}};
    const std::vector<model::QueryRow> rows{
        {"a", "BuildingConstructiveElement", "Roof edge", model::kNoRow, none, {}, 1, 1},
        {"b", "BuildingConstructiveElement", "Roof edge", model::kNoRow, wall, {}, 1, 1}};
    const StyleSheet* sheets[] = {&defaultStyle(false)};
    const auto styles = resolveStyles(rows, sheets, {});
    EXPECT_EQ(styles[0].color, *image::parseColor("#a8483a"));
    EXPECT_EQ(styles[1].color, *image::parseColor("#dcc9a6"));
}

TEST(ParseColor, HexShortHexAndNames) {
    EXPECT_EQ(*image::parseColor("#ff8000"), (Vec3f{1, 128 / 255.0f, 0}));
    EXPECT_EQ(*image::parseColor("#FF8000"), (Vec3f{1, 128 / 255.0f, 0}));
    EXPECT_EQ(*image::parseColor("#f80"), (Vec3f{1, 136 / 255.0f, 0}));
    EXPECT_EQ(*image::parseColor("tomato"), (Vec3f{1, 99 / 255.0f, 71 / 255.0f}));
    EXPECT_EQ(*image::parseColor("white"), (Vec3f{1, 1, 1}));
    for (const char* bad :
         {"", "#", "#12", "#12345", "#1234567", "#12345g", "Tomato ", "rgb(1,2,3)", "#-12345", "0xffffff"}) {
        const auto color = image::parseColor(bad);
        ASSERT_FALSE(color) << bad;
        EXPECT_EQ(color.error().code(), Code::BadStyle);
        EXPECT_NE(color.error().message().find("steelblue"), std::string::npos);
    }
}

TEST(ParseStyleSheet, RuleWithAllMembers) {
    const auto sheet = parseStyleSheet(R"({"$schema": "x", "comment": "c", "rules": [
        {"select": "class=WallSurface", "color": "#102030", "opacity": 0.25, "comment": "wall",
         "pattern": {"type": "hatch", "size": [0.1, 0.2, 0.3], "line": 0.04, "angle": -30, "seed": 9, "colors": ["red", "#fff"]}}]})",
                                       {});
    ASSERT_TRUE(sheet) << sheet.error().toString();
    ASSERT_EQ(sheet->rules.size(), 1u);
    const StyleRule& rule = sheet->rules[0];
    EXPECT_EQ(*rule.color, *image::parseColor("#102030"));
    EXPECT_EQ(*rule.opacity, 0.25f);
    EXPECT_EQ(rule.pattern->kind, PatternKind::Hatch);
    EXPECT_EQ(rule.pattern->size, (Vec3d{0.1, 0.2, 0.3}));
    EXPECT_EQ(rule.pattern->line, 0.04);
    EXPECT_EQ(rule.pattern->angleDegrees, -30);
    EXPECT_EQ(rule.pattern->seed, 9u);
    EXPECT_EQ(rule.patternColors, (std::vector<Vec3f>{{1, 0, 0}, {1, 1, 1}}));
}

TEST(ParseStyleSheet, EmptySheetIsAllowed) {
    const auto sheet = parseStyleSheet(R"({"rules": []})", {});
    ASSERT_TRUE(sheet);
    EXPECT_TRUE(sheet->rules.empty());
}

TEST(ParseStyleSheet, PatternsOfAllKindsParse) {
    for (const auto& [kind, name] : kNames<PatternKind>) {
        if (kind == PatternKind::Image || kind == PatternKind::Raw) continue;
        const auto sheet =
            parseStyleSheet(ruleWith(R"(, "pattern": {"type": ")" + std::string(name) + R"(", "size": 0.2})"), {});
        ASSERT_TRUE(sheet) << name << ": " << sheet.error().toString();
        EXPECT_EQ(sheet->rules[0].pattern->kind, kind);
        EXPECT_EQ(sheet->rules[0].pattern->size, (Vec3d{0.2, 0.2, 0.2}));
    }
}

TEST(ParseStyleSheet, FilesAreFoundBesideTheSheet) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "grain.raw", std::string("\x01\x02\x03\x04\x05\x01\x01\x01", 8));
    test::writeText(folder / "style.json",
                    ruleWith(R"(, "pattern": {"type": "raw", "file": "grain.raw", "dimension": [2, 2, 2]})"));
    const auto sheet = readStyleSheet(folder / "style.json");
    ASSERT_TRUE(sheet) << sheet.error().toString();
    EXPECT_EQ(sheet->rules[0].pattern->phaseCount(), 5u);
    const auto cube = parseStyleSheet(ruleWith(R"(, "pattern": {"type": "raw", "file": "grain.raw", "dimension": 2})"),
                                      folder.path());
    ASSERT_TRUE(cube) << cube.error().toString();
    EXPECT_EQ(cube->rules[0].pattern->phaseCount(), 5u);
    const auto missing = readStyleSheet(folder / "other.json");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code(), Code::CannotOpen);
}

TEST(ParseStyleSheet, ErrorsOfASheetFileNameTheFile) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "style.json", R"({"rules": [{}]})");
    const auto sheet = readStyleSheet(folder / "style.json");
    ASSERT_FALSE(sheet);
    EXPECT_EQ(sheet.error().where().file, (folder / "style.json").string());
    EXPECT_NE(sheet.error().message().find("rules[0]"), std::string::npos);
}

TEST(ParseStyleSheet, StructureErrorsNameThePlace) {
    expectBad("", Code::BadStyle, {"file", "JSON"});
    expectBad("{", Code::BadStyle, {"file", "JSON"});
    expectBad("[]", Code::BadStyle, {"file", "object", "array"});
    expectBad("{}", Code::BadStyle, {"file", "rules"});
    expectBad(R"({"rules": {}})", Code::BadStyle, {"rules", "array"});
    expectBad(R"({"rules": [], "rule": 1})", Code::BadStyle, {"file", "'rule'", "rules"});
    expectBad(R"({"rules": [7]})", Code::BadStyle, {"rules[0]", "object", "number"});
    expectBad(R"({"rules": [{"select": "all"}, {"color": "red"}]})", Code::BadStyle, {"rules[1]", "select"});
    expectBad(R"({"rules": [{"select": 5}]})", Code::BadStyle, {"rules[0]", "select"});
    expectBad(R"({"rules": [{"select": "class="}]})", Code::BadStyle, {"rules[0].select"});
    expectBad(std::string(100, '[') + std::string(100, ']'), Code::BadStyle, {"100"});
    expectBad(std::string(1000000, '['), Code::BadStyle, {"64"});
}

TEST(ParseStyleSheet, ValueErrorsNameThePath) {
    expectBad(ruleWith(R"(, "colour": "red")"), Code::BadStyle, {"rules[0]", "'colour'", "color"});
    expectBad(ruleWith(R"(, "color": 5)"), Code::BadStyle, {"rules[0].color"});
    expectBad(ruleWith(R"(, "color": "reddish")"), Code::BadStyle, {"rules[0].color", "'reddish'"});
    expectBad(ruleWith(R"(, "opacity": "1")"), Code::BadStyle, {"rules[0].opacity", "number"});
    expectBad(ruleWith(R"(, "opacity": 1.5)"), Code::BadStyle, {"rules[0].opacity", "1.5", "0 to 1"});
    expectBad(ruleWith(R"(, "opacity": -0.1)"), Code::BadStyle, {"rules[0].opacity", "-0.1"});
}

TEST(ParseStyleSheet, PatternErrorsNameThePath) {
    const auto bad = [](const std::string& pattern, Code code, std::vector<std::string> words) {
        expectBad(ruleWith(R"(, "pattern": )" + pattern), code, words);
    };
    bad("5", Code::BadStyle, {"rules[0].pattern", "object"});
    bad("{}", Code::BadStyle, {"rules[0].pattern.type", "wood-grain"});
    bad(R"({"type": "bricks"})", Code::BadStyle, {"rules[0].pattern.type", "brick, block"});
    bad(R"({"type": "brick", "width": 1})", Code::BadStyle, {"rules[0].pattern", "'width'", "size"});
    bad(R"({"type": "brick", "size": [1, 2]})", Code::BadStyle, {"rules[0].pattern.size"});
    bad(R"({"type": "brick", "size": ["1", 2, 3]})", Code::BadStyle, {"rules[0].pattern.size"});
    bad(R"({"type": "brick", "size": "big"})", Code::BadStyle, {"rules[0].pattern.size"});
    bad(R"({"type": "brick", "size": 5000})", Code::BadPattern, {"rules[0].pattern", "5000", "along u"});
    bad(R"({"type": "brick", "line": "thin"})", Code::BadStyle, {"rules[0].pattern.line"});
    bad(R"({"type": "brick", "line": -1})", Code::BadPattern, {"rules[0].pattern", "line"});
    bad(R"({"type": "hatch", "angle": 1000})", Code::BadPattern, {"rules[0].pattern", "angle"});
    bad(R"({"type": "concrete", "seed": -1})", Code::BadStyle, {"rules[0].pattern.seed"});
    bad(R"({"type": "concrete", "seed": 4294967296})", Code::BadStyle, {"rules[0].pattern.seed"});
    bad(R"({"type": "brick", "colors": "red"})", Code::BadStyle, {"rules[0].pattern.colors"});
    bad(R"({"type": "brick", "colors": ["red", 5]})", Code::BadStyle, {"rules[0].pattern.colors"});
    bad(R"({"type": "brick", "colors": ["red", "rosso"]})", Code::BadStyle, {"rules[0].pattern.colors", "'rosso'"});
    bad(R"({"type": "brick", "file": "a.png"})", Code::BadStyle, {"rules[0].pattern.file"});
    bad(R"({"type": "image", "file": 5})", Code::BadStyle, {"rules[0].pattern.file"});
    bad(R"({"type": "image"})", Code::BadPattern, {"rules[0].pattern", "needs a file"});
    bad(R"({"type": "image", "file": "missing.png"})", Code::CannotOpen, {"rules[0].pattern.file"});
    bad(R"({"type": "raw", "file": "missing.raw"})", Code::BadStyle, {"rules[0].pattern", "dimension"});
    bad(R"({"type": "raw", "file": "missing.raw", "dimension": [2, 2.5, 2]})", Code::BadStyle,
        {"rules[0].pattern.dimension"});
    bad(R"({"type": "raw", "file": "missing.raw", "dimension": [2, 2, 2000]})", Code::BadStyle,
        {"rules[0].pattern.dimension"});
}

TEST(ParseStyleSheet, BracketsInTextDoNotNest) {
    std::string json = R"({"rules": [)";
    for (int r = 0; r < 100; ++r) json += std::string(r == 0 ? "" : ",") + R"({"select": "name=\"a[{\""})";
    const auto sheet = parseStyleSheet(json + "]}", {});
    ASSERT_TRUE(sheet) << sheet.error().toString();
    EXPECT_EQ(sheet->rules.size(), 100u);
}

class Resolving : public ::testing::Test {
protected:
    Resolving() {
        for (const char* id : {"a", "b", "c"}) rows_.push_back({id, "WallSurface", "", model::kNoRow, none_, {}, 1, 1});
    }
    [[nodiscard]] static StyleSheet sheet(const std::string& rules) {
        auto result = parseStyleSheet(R"({"rules": [)" + rules + "]}", {});
        EXPECT_TRUE(result) << result.error().toString();
        return *result;
    }
    std::vector<Attribute> none_;
    std::vector<model::QueryRow> rows_;
};

TEST_F(Resolving, LaterRulesWinMemberByMember) {
    const StyleSheet first =
        sheet(R"({"select": "all", "color": "red", "opacity": 0.5}, {"select": "id=b", "color": "lime"})");
    const StyleSheet* sheets[] = {&first};
    const auto styles = resolveStyles(rows_, sheets, {});
    EXPECT_EQ(styles[0].color, (Vec3f{1, 0, 0}));
    EXPECT_EQ(styles[1].color, (Vec3f{0, 1, 0}));
    EXPECT_EQ(styles[1].opacity, 0.5f);
}

TEST_F(Resolving, MaterialColoursStandBetweenTheBuiltInSheetAndTheOthers) {
    const StyleSheet first = sheet(R"({"select": "all", "color": "red"})"),
                     second = sheet(R"({"select": "id=c", "color": "lime"})");
    const StyleSheet* sheets[] = {&first, &second};
    const Vec3f blue{0, 0, 1};
    const std::vector<std::optional<Vec3f>> materials{std::nullopt, blue, blue};
    const auto styles = resolveStyles(rows_, sheets, materials);
    EXPECT_EQ(styles[0].color, (Vec3f{1, 0, 0}));
    EXPECT_EQ(styles[1].color, blue);
    EXPECT_EQ(styles[2].color, (Vec3f{0, 1, 0}));
}

TEST_F(Resolving, MissingPhaseColoursAreShadesOfTheColour) {
    const StyleSheet only = sheet(R"({"select": "id=a", "color": "white", "pattern": {"type": "concrete"}},
                                     {"select": "id=b", "color": "white", "pattern": {"type": "concrete", "colors": ["red"]}},
                                     {"select": "id=c", "pattern": {"type": "brick", "colors": ["red", "lime"]}},
                                     {"select": "id=c", "pattern": {"type": "none"}})");
    const StyleSheet* sheets[] = {&only};
    const auto styles = resolveStyles(rows_, sheets, {});
    ASSERT_EQ(styles[0].phaseColors.size(), 3u);
    EXPECT_EQ(styles[0].phaseColors[0], (Vec3f{1, 1, 1}));
    EXPECT_LT(styles[0].phaseColors[1].x, 1);
    EXPECT_LT(styles[0].phaseColors[2].x, styles[0].phaseColors[1].x);
    ASSERT_EQ(styles[1].phaseColors.size(), 3u);
    EXPECT_EQ(styles[1].phaseColors[0], (Vec3f{1, 0, 0}));
    EXPECT_TRUE(styles[2].phaseColors.empty());
    EXPECT_EQ(styles[2].pattern.phaseCount(), 1u);
}

TEST_F(Resolving, NoSheetsGiveGray) {
    const auto styles = resolveStyles(rows_, {}, {});
    ASSERT_EQ(styles.size(), 3u);
    EXPECT_EQ(styles[0].color, (Vec3f{0.8f, 0.8f, 0.8f}));
    EXPECT_EQ(styles[0].opacity, 1);
}

}  // namespace
}  // namespace svt::pipeline

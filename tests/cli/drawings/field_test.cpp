// `svt section --field` and `svt render --field`: bands, lines and legends of a field, and clear errors.
#include <tests/cli/run_command.hpp>

#include <svt/fields/svt_fields.hpp>
#include <svt/image/png.hpp>
#include <svt/volume/svt_file.hpp>

#include <cmath>
#include <regex>
#include <set>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

// Writes house.svt with fields "temperature" (air: 15 + x / 2 + y / 4, metres from the grid's corner) and "heat" (solid), and
// the whole house.gml.
void prepareFields(const fs::path& folder) {
    prepareHouse(folder, "0.1");
    const auto volume = volume::readSvt(folder / "house.svt");
    ASSERT_TRUE(volume) << volume.error().toString();
    fields::Field field;
    field.head.name = "temperature";
    field.head.unit = "Cel";
    field.head.medium = "air";
    field.head.lattice.size = volume->grid.dimension();
    const Vec3i n = field.head.lattice.size;
    for (int k = 0; k < n.z; ++k)
        for (int j = 0; j < n.y; ++j)
            for (int i = 0; i < n.x; ++i) field.values.push_back(static_cast<float>(15 + 0.05 * i + 0.025 * j));
    fields::Field solid = field;
    solid.head.name = "heat";
    solid.head.medium = "solid";
    const fields::Field both[] = {field, solid};
    const auto written = fields::writeFields(folder / "house.svt", folder / "house.svt", both);
    ASSERT_TRUE(written) << written.error().toString();
}

TEST(FieldDrawings, SectionsShowBandsLinesAndALegend) {
    const TemporaryFolder folder;
    prepareFields(folder.path());
    runSvtWell(folder.path(), {"section", "house.svt", "--plane", "z=1.6", "--field", "temperature", "--isolines",
                               "0.5", "-o", "plan.svg", "-o", "plan.geojson", "-o", "plan.dxf"});
    const std::string svg = readText(folder.path() / "plan.svg");
    for (const char* part : {"class=\"field\" ", "data-field=\"temperature\"", "class=\"band\"", "class=\"isoline\"",
                             "data-value=\"17.5\"", "temperature (\u00B0C), lines every 0.5 \u00B0C", "no value"})
        EXPECT_NE(svg.find(part), std::string::npos) << part;
    const auto drawn = nlohmann::json::parse(readText(folder.path() / "plan.geojson"));
    std::set<double> values;
    std::size_t bands = 0;
    for (const auto& feature : drawn["features"]) {
        const auto& properties = feature["properties"];
        if (!properties.contains("field")) continue;
        if (properties.contains("value")) values.insert(properties["value"].get<double>());
        if (properties.contains("low")) {
            ++bands;
            EXPECT_TRUE(std::regex_match(properties["fill"].get<std::string>(), std::regex("#[0-9a-f]{6}")));
        }
    }
    EXPECT_GT(values.size(), 8u);
    EXPECT_TRUE(values.contains(17.5));
    EXPECT_GT(bands, 8u);
    const std::string dxf = readText(folder.path() / "plan.dxf");
    for (const char* layer : {"FIELD_LINES", "FIELD_TEXT", "FIELD_17_5_18", "FIELD_NO_VALUE"})
        EXPECT_NE(dxf.find(layer), std::string::npos) << layer;
}

TEST(FieldDrawings, DxfAndGeojsonAreReadByGdal) {
    const TemporaryFolder folder;
    if (!hasProgram("ogrinfo --version")) GTEST_SKIP() << "GDAL is not installed";
    prepareFields(folder.path());
    runSvtWell(folder.path(), {"section", "house.svt", "--plane", "z=1.6", "--field", "temperature", "--isolines",
                               "0.5", "-o", "plan.geojson", "-o", "plan.dxf"});
    EXPECT_NE(runShellWell(folder.path(), "ogrinfo -ro -al plan.geojson").find("value (Real)"), std::string::npos);
    EXPECT_NE(runShellWell(folder.path(), "ogrinfo -ro -al plan.dxf").find("FIELD_LINES"), std::string::npos);
}

TEST(FieldDrawings, PicturesShowTheField) {
    const TemporaryFolder folder;
    prepareFields(folder.path());
    const std::vector<std::string> usual{"render",  "house.svt", "--size", "320x200",   "--camera", "top",
                                         "--ortho", "--section", "z=1.6",  "--samples", "1"};
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> all = usual;
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    runSvtWell(folder.path(), with({"-o", "plain.png"}));
    runSvtWell(folder.path(), with({"-o", "air.png", "--field", "temperature", "--write-scene", "air.scene.json"}));
    runSvtWell(folder.path(), with({"-o", "solid.png", "--field", "heat", "--map", "inferno", "--isolines", "1"}));
    std::set<std::string> pictures;
    for (const char* name : {"plain.png", "air.png", "solid.png"}) pictures.insert(readText(folder.path() / name));
    EXPECT_EQ(pictures.size(), 3u);
    const auto scene = nlohmann::json::parse(readText(folder.path() / "air.scene.json"));
    EXPECT_EQ(scene["field"]["name"], "temperature");
    runSvtWell(folder.path(), {"render", "house.svt", "--scene", "air.scene.json", "-o", "again.png"});
    EXPECT_EQ(readText(folder.path() / "again.png"), readText(folder.path() / "air.png"));
}

TEST(FieldDrawings, WhatCannotBeShownIsRefused) {
    const TemporaryFolder folder;
    prepareFields(folder.path());
    const auto expectRefused = [&](const std::vector<std::string>& arguments, const std::string& words) {
        const CommandResult result = runSvt(folder.path(), arguments);
        EXPECT_NE(result.exitCode, 0) << result.toString();
        EXPECT_NE(result.err.find(words), std::string::npos) << result.toString();
        for (const auto& entry : fs::directory_iterator(folder.path()))
            EXPECT_NE(entry.path().stem(), "none") << result.toString();
    };
    expectRefused({"render", "house.svt", "-o", "none.png", "--field", "temperature", "--gl"}, "--gl");
    expectRefused({"render", "house.svt", "-o", "none.svg", "--field", "temperature"}, "svt section");
    expectRefused({"render", "house.svt", "-o", "none.png", "--field", "temperature", "--explode", "2"}, "--explode");
    expectRefused({"render", "house.svt", "-o", "none.png", "--field", "temperature", "--color-by", "class"},
                  "--color-by");
    expectRefused({"render", "house.svt", "-o", "none.png", "--field", "smoke"}, "temperature");
    expectRefused({"render", "house.svt", "-o", "none.png", "--isolines", "1"}, "--field");
    expectRefused({"render", "house.svt", "-o", "none.png", "--field", "temperature", "--time", "5"}, "only at 0 s");
    expectRefused({"render", "house.svt", "-o", "none.png", "--field", "temperature", "--range", "3,3"}, "--range");
    expectRefused({"render", "house.gml", "-o", "none.png", "--field", "temperature"}, "(.svt)");
    expectRefused({"section", "house.gml", "-o", "none.svg", "--field", "temperature"}, "(.svt)");
    expectRefused({"section", "house.svt", "-o", "none.svg", "--bands", "1"}, "--field");
    expectRefused({"section", "house.svt", "-o", "none.svg", "--field", "temperature", "--isolines", "1e-6"},
                  "or more");
}

}  // namespace
}  // namespace svt::test

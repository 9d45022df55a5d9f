/// Tests of the writers of section drawings, with names that need escaping.

#include <svt/volume/sample_volume_test.hpp>
#include <svt/writers/drawing/drawing_files_test.hpp>
#include <svt/writers/drawing/drawing_style.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/dxf_drawing.hpp>
#include <svt/writers/geojson_drawing.hpp>
#include <svt/writers/section_table.hpp>
#include <svt/writers/svg_drawing.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace svt::writers {
namespace {

/// A room of 3 x 2 m in walls of 0.5 m, 4 x 3 x 2 m in all, at a large easting.
volume::SemanticVolume roomInWalls() {
    volume::SemanticVolume volume = volume::test::emptyVolume({40, 30, 20}, {0.1, 0.1, 0.1}, {500000, 5400000, 100});
    volume.crsName = "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783";
    volume.modelName = "Haus <1> & \"Söhne\"";
    volume::test::addObject(volume, "wall,1", "Wall Surface").name =
        "Au\xC3\x9F"
        "enwand \"Nord\"\xFF";
    volume::test::addObject(volume, "room&1", "BuildingRoom").name = "Küche <1> Ł";
    volume::test::paint(volume, [](int i, int j, int) { return i < 5 || i >= 35 || j < 5 || j >= 25 ? 1 : 2; });
    return volume;
}

drawing::SectionDrawing planOf(const volume::SemanticVolume& volume) {
    return *drawing::drawSection(volume, {{0, 0, 1}, volume.grid.origin() + Vec3d{0, 0, 1.03}});
}

TEST(DrawingText, EpsgCodesAreFoundInTheUsualNames) {
    EXPECT_EQ(epsgCodeOf("urn:ogc:def:crs:EPSG::25832"), 25832u);
    EXPECT_EQ(epsgCodeOf("urn:ogc:def:crs:EPSG:6.12:3068"), 3068u);
    EXPECT_EQ(epsgCodeOf("urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783"), 25832u);
    EXPECT_EQ(epsgCodeOf("EPSG:31467"), 31467u);
    EXPECT_EQ(epsgCodeOf("epsg:4979"), 4979u);
    EXPECT_EQ(epsgCodeOf("https://www.opengis.net/def/crs/EPSG/0/7415"), 28992u)
        << "the horizontal part of the compound";
    EXPECT_EQ(epsgCodeOf("http://www.opengis.net/gml/srs/epsg.xml#28992"), 28992u);
    EXPECT_EQ(epsgCodeOf("urn:adv:crs:ETRS89_UTM32*DE_DHHN92_NH"), 25832u);
    EXPECT_EQ(epsgCodeOf("EPSG"), 0u);
    EXPECT_EQ(epsgCodeOf("EPSG:"), 0u);
    EXPECT_EQ(epsgCodeOf(""), 0u);
}

TEST(DrawingText, NumbersAreShort) {
    EXPECT_EQ(shortNumber(1.5, 3), "1.5");
    EXPECT_EQ(shortNumber(-0.0001, 3), "0");
    EXPECT_EQ(shortNumber(100, 3), "100");
    EXPECT_EQ(shortNumber(100, 0), "100");
    EXPECT_EQ(shortNumber(5438353.70000049, 6), "5438353.7");
}

TEST(DrawingText, PlanesAreNamed) {
    const auto volume = roomInWalls();
    const auto textOf = [&](Vec3d normal, Vec3d point) {
        return planeText(*drawing::drawSection(volume, {normal, volume.grid.origin() + point}), volume);
    };
    EXPECT_EQ(textOf({0, 0, 1}, {0, 0, 1.2}), "Plan at z = 1.2 m");
    EXPECT_EQ(textOf({0, 0, -1}, {0, 0, 1.2}), "Plan at z = 1.2 m");
    EXPECT_EQ(textOf({0, -1, 0}, {0, 1.25, 0}), "Section at y = 1.25 m");
    EXPECT_EQ(textOf({0.6, 0.8, 0}, {1, 1, 0}), "Section 0.6, 0.8, 0, -1.4 m");
}

// A sheet takes the line of the part behind it towards a room, and has a thin line towards everything else.
TEST(DrawingStyle, SheetsAreBoldOnlyTowardsRooms) {
    auto volume = roomInWalls();
    const auto drawing = planOf(volume);
    const auto isBold = [&](std::uint32_t left, std::uint32_t right) {
        return DrawingStyle(drawing, volume, 20).isBoldBetween(left, right);
    };
    EXPECT_TRUE(isBold(0, 1));
    EXPECT_TRUE(isBold(0, volume::kNoLabel));
    volume.labels.labels[0].filling = volume::Filling::Surface;
    const bool isBoldToRoom = isBold(0, 1);
    EXPECT_EQ(isBold(1, 0), isBoldToRoom);
    volume::test::addObject(volume, "slab", "BuildingConstructiveElement");
    volume::test::addObject(volume, "chair", "BuildingFurniture");
    const auto other = *drawing::drawSection(volume, drawing.plane);
    const DrawingStyle style(other, volume, 20);
    for (const std::uint32_t part : {2u, 3u}) {
        EXPECT_FALSE(style.isBoldBetween(0, part));
        EXPECT_FALSE(style.isBoldBetween(part, 0));
    }
    EXPECT_TRUE(style.isBoldBetween(2, 3));
}

// Before, a wall had a thin outline where it touched the ground, and a bold one elsewhere.
TEST(DrawingStyle, WallsAreBoldAgainstTheGround) {
    auto volume = roomInWalls();
    for (const auto& [id, className] : {std::pair("ground", "TINRelief"), std::pair("wall", "WallSurface"),
                                        std::pair("slab", "BuildingConstructiveElement")})
        volume::test::addObject(volume, id, className).filling = volume::Filling::Solid;
    const auto drawing = planOf(volume);
    const DrawingStyle style(drawing, volume, 20);
    EXPECT_TRUE(style.isBoldBetween(2, 3));
    EXPECT_TRUE(style.isBoldBetween(4, 2));
    EXPECT_FALSE(style.isBoldBetween(3, 4));
    EXPECT_TRUE(style.isBoldBetween(2, volume::kNoLabel));
}

TEST(SvgDrawing, IsToScaleInMillimetres) {
    const auto volume = roomInWalls();
    const auto drawing = planOf(volume);
    SvgOptions options;
    options.scale = 20;  // 4 x 3 m are 200 x 150 mm
    const auto svg = makeSvg(drawing, volume, options);
    ASSERT_TRUE(svg);
    const SvgFile read(*svg);
    EXPECT_EQ(read.text("/svg/@width"), "220mm");
    EXPECT_EQ(read.text("/svg/@height"), "194mm");
    EXPECT_EQ(read.text("/svg/@viewBox"), "0 0 220 194");
    // The wall from corner to corner, with the room as a hole.
    EXPECT_EQ(read.text("//path[@data-id='wall,1']/@d"), "M10 160L210 160 210 10 10 10ZM35 135L35 35 185 35 185 135Z");
    EXPECT_EQ(read.count("//text[.='6.00 m\u00B2']"), 1u);
    EXPECT_EQ(*makeSvg(drawing, volume, options), *svg);
}

TEST(SvgDrawing, NamesAreEscapedAndClassesPlain) {
    const auto volume = roomInWalls();
    const std::string text = *makeSvg(planOf(volume), volume);
    const SvgFile svg(text);
    EXPECT_EQ(svg.text("//path[@data-id='wall,1']/@class"), "Wall_Surface");
    EXPECT_EQ(svg.text("//path[@data-id='wall,1']/@data-area"), "6");
    EXPECT_EQ(svg.text("//path[@data-id='wall,1']/title"), "wall,1: Außenwand \"Nord\"\xEF\xBF\xBD");
    EXPECT_EQ(svg.text("//path[@data-id='room&1']/title"), "room&1: Küche <1> Ł");
    EXPECT_EQ(svg.text("/svg/title"), "Haus <1> & \"Söhne\", Plan at z = 1.03 m");
    EXPECT_EQ(text.find('\xFF'), std::string::npos);
    EXPECT_EQ(svg.count("//pattern"), 1u);  // only hatches in use
}

TEST(SvgDrawing, RefusesScalesAndDrawsNothingAsNothing) {
    const auto volume = roomInWalls();
    for (const double scale : {0.0, -50.0, 1e9, double(NAN)}) {
        SvgOptions options;
        options.scale = scale;
        EXPECT_EQ(makeSvg(planOf(volume), volume, options).error().code(), Code::BadArgument);
    }
    const auto empty = *drawing::drawSection(volume, {{0, 0, 1}, volume.grid.origin() + Vec3d{0, 0, 50}});
    const auto svg = makeSvg(empty, volume);
    ASSERT_TRUE(svg);
    const SvgFile read(*svg);
    EXPECT_EQ(read.count("//path[@data-id]"), 0u);
    EXPECT_EQ(svg->find("nan"), std::string::npos);
    EXPECT_EQ(svg->find("inf"), std::string::npos);
    EXPECT_TRUE(read.text("/svg/@viewBox").starts_with("0 0 ")) << *svg;
}

TEST(DxfDrawing, IsPairsOfCodesAndValuesWithHandlesUsedOnce) {
    const auto volume = roomInWalls();
    const std::string text = makeDxf(planOf(volume), volume);
    for (const unsigned char c : text) ASSERT_TRUE(c == '\n' || (c >= 0x20 && c < 0x7F) || c >= 0xA0) << int(c);
    const DxfFile dxf(text);
    std::set<std::string> handles;
    for (const DxfPart& part : dxf.parts)
        for (const auto& [code, value] : part.pairs)
            if (code == 5 || code == 105) {
                EXPECT_TRUE(handles.insert(value).second) << value;
            }
    EXPECT_EQ(dxf.of("LWPOLYLINE").size(), 3u);  // the wall, its hole, the room
    EXPECT_EQ(dxf.of("TEXT").size(), 2u);        // name and area
}

TEST(DxfDrawing, HatchesWhatIsCutAndFollowsTheRings) {
    const auto volume = roomInWalls();
    const DxfFile dxf(makeDxf(planOf(volume), volume));
    const auto hatches = dxf.of("HATCH");
    ASSERT_EQ(hatches.size(), 1u);  // the wall with its hole, not the room
    EXPECT_EQ(hatches[0].value(2), "SVT_GENERAL");
    // Elevation, four corners of the wall, four of the hole.
    EXPECT_EQ(dxf.points("HATCH").size(), 9u);
    EXPECT_EQ(hatches[0].value(8), "Wall_Surface_HATCH");
}

// Two walls of one material have no border between them: their outlines are open there. Before, both had a line.
TEST(DxfDrawing, JointsOfWallsAreNoLines) {
    const auto volume = roomInWalls();
    auto drawing = planOf(volume);
    drawing.components.clear();
    drawing.borders.clear();
    const auto addWall = [&](std::uint32_t label, double left, double right) {
        drawing::SectionPolygon polygon{{{left, 0}, {right, 0}, {right, 1}, {left, 1}}, {}, right - left};
        drawing.components.push_back({label, {polygon}, right - left});
    };
    addWall(0, 0, 2);
    addWall(1, 2, 5);
    drawing.borders.push_back({{{2, 0}, {5, 0}, {5, 1}, {2, 1}}, 1, volume::kNoLabel});
    drawing.borders.push_back({{{2, 1}, {0, 1}, {0, 0}, {2, 0}}, 0, volume::kNoLabel});
    const auto outlines = DxfFile(makeDxf(drawing, volume)).of("LWPOLYLINE");
    ASSERT_EQ(outlines.size(), 2u);
    for (const DxfPart& outline : outlines) {
        EXPECT_EQ(outline.value(70), "0") << "open";
        EXPECT_EQ(outline.value(90), "4");
    }
    drawing.borders.push_back({{{2, 0}, {2, 1}}, 0, 1});
    for (const DxfPart& outline : DxfFile(makeDxf(drawing, volume)).of("LWPOLYLINE"))
        EXPECT_EQ(outline.value(70), "1") << "closed, with a border between them";
}

TEST(DxfDrawing, NamesLayersAfterIso13567WhereAsked) {
    auto volume = roomInWalls();
    const DxfFile iso(makeDxf(planOf(volume), volume, {.isoLayers = true, .world = false}));
    for (const char* const layer : {"A-22----E-", "A-22----H-", "A-90SPACE-", "A-------T-"})
        EXPECT_TRUE(iso.values(8).contains(layer)) << layer;
    volume.labels.labels[0].attributes.push_back({"ifcType", std::string("IfcWall"), ""});
    EXPECT_TRUE(DxfFile(makeDxf(planOf(volume), volume)).values(8).contains("IfcWall"));
}

// The air outside touches the wall around the room.
TEST(DxfDrawing, IsoLayersOfExternalWallsFollowTheFileOrTheHull) {
    auto volume = roomInWalls();
    std::vector<Attribute>& attributes = volume.labels.labels[0].attributes;
    attributes.push_back({"ifcType", std::string("IfcWall"), ""});
    const DxfOptions options{.isoLayers = true, .world = false};
    const std::string found = makeDxf(planOf(volume), volume, options);
    EXPECT_TRUE(DxfFile(found).values(8).contains("A-21----E-"));
    EXPECT_NE(found.find("1 of 1 (stated in the file: 0; found by the outside air"), std::string::npos);
    attributes.push_back({"Pset_WallCommon.IsExternal", false, ""});
    EXPECT_TRUE(DxfFile(makeDxf(planOf(volume), volume, options)).values(8).contains("A-22----E-"));
}

TEST(DxfDrawing, StandsInTheWorldWhereAsked) {
    const auto volume = roomInWalls();
    const DxfOptions world{.isoLayers = false, .world = true};
    for (const auto& p : DxfFile(makeDxf(planOf(volume), volume, world)).points("LWPOLYLINE")) {
        EXPECT_TRUE(p[0] >= 499999.9 && p[0] <= 500004) << p[0];
        EXPECT_TRUE(p[1] >= 5399999.9 && p[1] <= 5400003) << p[1];
    }
    // Upright: seen from the south, x is east, y is up; the plane lies 1.5 m from the corner.
    const auto section = *drawing::drawSection(volume, {{0, -1, 0}, volume.grid.origin() + Vec3d{0, 1.5, 0}});
    const DxfFile dxf(makeDxf(section, volume, world));
    for (const auto& p : dxf.points("LWPOLYLINE")) {
        EXPECT_TRUE(p[0] >= 499999.9 && p[0] <= 500004) << p[0];
        EXPECT_TRUE(p[1] >= 99.9 && p[1] <= 102) << p[1];
    }
    ASSERT_FALSE(dxf.of("LWPOLYLINE").empty());
    for (const DxfPart& line : dxf.of("LWPOLYLINE")) {
        EXPECT_EQ(line.value(220), "-1");
        EXPECT_EQ(line.value(38), "-5400001.5");
    }
}

TEST(DxfDrawing, HasABlockForEachDoor) {
    auto volume = roomInWalls();
    auto drawing = planOf(volume);
    drawing.doors.push_back({0, {{{1, 0}, {1, 0.8}}}, {{{1, 0}, {1.8, 0}, {1, 0.8}}}});
    const DxfFile dxf(makeDxf(drawing, volume));
    ASSERT_EQ(dxf.of("INSERT").size(), 1u);
    EXPECT_EQ(dxf.of("INSERT")[0].value(2), "DOOR_1");
    EXPECT_EQ(dxf.points("INSERT"), (std::vector<std::array<double, 2>>{{1, 0}}));
    ASSERT_EQ(dxf.of("ARC").size(), 1u);
    const DxfPart arc = dxf.of("ARC")[0];
    EXPECT_EQ(arc.section, "BLOCKS");
    for (const auto& [code, value] : {std::pair(10, "0"), {20, "0"}, {30, "0"}, {40, "0.8"}, {50, "0"}, {51, "90"}})
        EXPECT_EQ(arc.value(code), value) << code;
    const SvgFile svg(*makeSvg(drawing, volume));
    EXPECT_EQ(svg.count("//path[@class='swing' and @data-id='wall,1']"), 1u);
    EXPECT_EQ(svg.count("//path[@data-id='wall,1' and contains(@d, 'A8 8 0 0 0 ')]"), 1u);
}

TEST(SvgDrawing, SaysWhereItLiesAndHasLayers) {
    const auto volume = roomInWalls();
    const SvgFile svg(*makeSvg(planOf(volume), volume));
    EXPECT_EQ(svg.text("//svt:drawing/@crs"), "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783");
    EXPECT_EQ(svg.text("//svt:drawing/@height"), "101.03");
    EXPECT_EQ(svg.count("//g[@inkscape:groupmode='layer' and @inkscape:label='Wall Surface']"), 1u);
}

TEST(DxfDrawing, SaysUnitsAndWritesNamesInItsCodePage) {
    const auto volume = roomInWalls();
    const DxfFile dxf(makeDxf(planOf(volume), volume));
    EXPECT_EQ(dxf.variables.at("$INSUNITS"), "6");
    std::set<std::string> texts;
    for (const DxfPart& text : dxf.of("TEXT")) texts.insert(text.value(1));
    EXPECT_EQ(texts, (std::set<std::string>{"K\xFC"
                                            "che <1> \\U+0141",
                                            "6.00 m\xB2"}));
    EXPECT_TRUE(dxf.values(8).contains("Wall_Surface"));
    EXPECT_EQ(std::count(dxf.comments.begin(), dxf.comments.end(), "origin 500000 5400000 101.03"), 1);
}

TEST(GeojsonDrawing, IsInTheCoordinatesOfTheModel) {
    const auto volume = roomInWalls();
    using nlohmann::json;
    const json drawn = json::parse(makeGeojson(planOf(volume), volume));
    EXPECT_EQ(drawn.at("crs").at("properties").at("name"), "urn:ogc:def:crs:EPSG::25832");
    ASSERT_EQ(drawn.at("features").size(), 2u);
    const json &wall = drawn["features"][0], &room = drawn["features"][1];
    EXPECT_EQ(wall.at("geometry").at("coordinates")[0][0][0], json({499999.95, 5399999.95, 101.03}));
    EXPECT_EQ(wall.at("geometry").at("coordinates")[0][0][1], json({500003.95, 5399999.95, 101.03}));
    EXPECT_EQ(room.at("properties").at("class"), "BuildingRoom");
    EXPECT_EQ(room.at("properties").at("name"), "Küche <1> Ł");
    EXPECT_EQ(room.at("properties").at("area"), 6);
    auto unknown = volume;
    unknown.crsName = "local";
    EXPECT_FALSE(json::parse(makeGeojson(planOf(unknown), unknown)).contains("crs"));
}

TEST(SectionTable, CsvQuotesAndSumsUp) {
    const auto volume = roomInWalls();
    const std::string csv = makeSectionCsv(planOf(volume), volume);
    std::istringstream in(csv);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    ASSERT_EQ(lines.size(), 6u);
    EXPECT_EQ(lines[0], "kind,id,class,name,polygons,area_m2,area_bound_m2,exact,line_length_m\r");
    EXPECT_EQ(lines[1].rfind("component,\"wall,1\",Wall Surface,\"Außenwand \"\"Nord\"\"", 0), 0u) << lines[1];
    EXPECT_EQ(lines[3], "class,,BuildingRoom,,,6,,,\r");
    EXPECT_EQ(lines[4], "class,,Wall Surface,,,6,,,\r");
    EXPECT_EQ(lines[5], "total,,,,2,12,,,\r");
}

}  // namespace
}  // namespace svt::writers

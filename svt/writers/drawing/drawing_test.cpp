/// Tests of the writers of section drawings, with names that need escaping.

#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/dxf_drawing.hpp>
#include <svt/writers/geojson_drawing.hpp>
#include <svt/writers/section_table.hpp>
#include <svt/writers/svg_drawing.hpp>

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace svt::writers {
namespace {

/// A room of 3 x 2 m in walls of 0.5 m, 4 x 3 x 2 m in all, at a large easting.
volume::SemanticVolume roomInWalls() {
    volume::SemanticVolume volume;
    const Vec3i dimension{40, 30, 20};
    volume.grid = *volume::Grid::fromParts(dimension, {0.1, 0.1, 0.1}, {500000, 5400000, 100},
                                           {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
    volume.crsName = "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783";
    volume.modelName = "Haus <1> & \"Söhne\"";
    for (const auto& [id, className, name] : {std::tuple("wall,1", "Wall Surface",
                                                         "Au\xC3\x9F"
                                                         "enwand \"Nord\"\xFF"),
                                              std::tuple("room&1", "BuildingRoom", "Küche <1> Ł")}) {
        volume::Label label;
        label.id = id;
        label.className = className;
        label.name = name;
        label.first = volume.labels.scalarCount();
        label.count = 1;
        volume.labels.labels.push_back(label);
        volume.labels.labels.back().subtreeEnd = static_cast<std::uint32_t>(volume.labels.labels.size());
    }
    std::vector<volume::Scalar> dense;
    for (int k = 0; k < 20; ++k)
        for (int j = 0; j < 30; ++j)
            for (int i = 0; i < 40; ++i) dense.push_back(i < 5 || i >= 35 || j < 5 || j >= 25 ? 1 : 2);
    volume.columns = volume::ColumnVolume::fromDense(dimension, dense);
    return volume;
}

illustrate::SectionDrawing planOf(const volume::SemanticVolume& volume) {
    return *illustrate::drawSection(volume, {{0, 0, 1}, volume.grid.origin() + Vec3d{0, 0, 1.03}});
}

std::size_t countOf(std::string_view text, std::string_view part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(DrawingText, EpsgCodesAreFoundInTheUsualNames) {
    EXPECT_EQ(epsgCodeOf("urn:ogc:def:crs:EPSG::25832"), 25832u);
    EXPECT_EQ(epsgCodeOf("urn:ogc:def:crs:EPSG:6.12:3068"), 3068u);
    EXPECT_EQ(epsgCodeOf("urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783"), 25832u);
    EXPECT_EQ(epsgCodeOf("EPSG:31467"), 31467u);
    EXPECT_EQ(epsgCodeOf("epsg:4979"), 4979u);
    EXPECT_EQ(epsgCodeOf("https://www.opengis.net/def/crs/EPSG/0/7415"), 7415u);
    EXPECT_EQ(epsgCodeOf("http://www.opengis.net/gml/srs/epsg.xml#28992"), 0u);
    EXPECT_EQ(epsgCodeOf("urn:adv:crs:ETRS89_UTM32*DE_DHHN92_NH"), 0u);
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
        return planeText(*illustrate::drawSection(volume, {normal, volume.grid.origin() + point}), volume.grid);
    };
    EXPECT_EQ(textOf({0, 0, 1}, {0, 0, 1.2}), "Plan at z = 1.2 m");
    EXPECT_EQ(textOf({0, 0, -1}, {0, 0, 1.2}), "Plan at z = 1.2 m");
    EXPECT_EQ(textOf({0, -1, 0}, {0, 1.25, 0}), "Section at y = 1.25 m");
    EXPECT_EQ(textOf({0.6, 0.8, 0}, {1, 1, 0}), "Section 0.6, 0.8, 0, -1.4 m");
}

TEST(SvgDrawing, IsToScaleInMillimetres) {
    const auto volume = roomInWalls();
    const auto drawing = planOf(volume);
    SvgOptions options;
    options.scale = 20;  // 4 x 3 m are 200 x 150 mm
    const auto svg = makeSvg(drawing, volume, options);
    ASSERT_TRUE(svg);
    EXPECT_NE(svg->find("width=\"220mm\" height=\"194mm\" viewBox=\"0 0 220 194\""), std::string::npos);
    // The wall from corner to corner, with the room as a hole.
    EXPECT_NE(svg->find("d=\"M10 160L210 160 210 10 10 10ZM35 135L35 35 185 35 185 135Z\""), std::string::npos) << *svg;
    EXPECT_NE(svg->find(">6.00 m\u00B2</text>"), std::string::npos);
    EXPECT_EQ(*makeSvg(drawing, volume, options), *svg);
}

TEST(SvgDrawing, NamesAreEscapedAndClassesPlain) {
    const auto volume = roomInWalls();
    const std::string svg = *makeSvg(planOf(volume), volume);
    EXPECT_NE(svg.find("<path class=\"Wall_Surface\" data-id=\"wall,1\" data-area=\"6\""), std::string::npos);
    EXPECT_NE(svg.find("<title>room&amp;1: Küche &lt;1&gt; Ł</title>"), std::string::npos);
    EXPECT_NE(svg.find("Haus &lt;1&gt; &amp; &quot;Söhne&quot;"), std::string::npos);
    EXPECT_NE(svg.find("Außenwand &quot;Nord&quot;\xEF\xBF\xBD"), std::string::npos);
    EXPECT_EQ(svg.find('\xFF'), std::string::npos);
    EXPECT_EQ(countOf(svg, "<pattern "), 1u);  // only hatches in use
}

TEST(SvgDrawing, RefusesScalesAndDrawsNothingAsNothing) {
    const auto volume = roomInWalls();
    for (const double scale : {0.0, -50.0, 1e9, double(NAN)}) {
        SvgOptions options;
        options.scale = scale;
        EXPECT_EQ(makeSvg(planOf(volume), volume, options).error().code(), Code::BadArgument);
    }
    const auto empty = *illustrate::drawSection(volume, {{0, 0, 1}, volume.grid.origin() + Vec3d{0, 0, 50}});
    const auto svg = makeSvg(empty, volume);
    ASSERT_TRUE(svg);
    EXPECT_EQ(countOf(*svg, "<path data-"), 0u);
    EXPECT_EQ(svg->find("nan"), std::string::npos);
    EXPECT_EQ(svg->find("inf"), std::string::npos);
    EXPECT_NE(svg->find("viewBox=\"0 0 "), std::string::npos);
}

TEST(DxfDrawing, IsPairsOfCodesAndValuesWithHandlesUsedOnce) {
    const auto volume = roomInWalls();
    std::istringstream in(makeDxf(planOf(volume), volume));
    std::set<std::string> handles;
    std::map<std::string, int> entities;
    std::string code, value, section;
    bool isOpen = false;
    while (std::getline(in, code)) {
        ASSERT_TRUE(std::getline(in, value));
        const int number = std::stoi(code);
        for (const unsigned char c : value) ASSERT_TRUE((c >= 0x20 && c < 0x7F) || c >= 0xA0) << value;
        if (number == 0 && value == "SECTION") isOpen = true;
        if (number == 0 && value == "ENDSEC") isOpen = false;
        if (number == 2 && isOpen && (value == "ENTITIES" || value == "TABLES" || value == "HEADER")) section = value;
        if ((number == 5 && section != "HEADER") || number == 105) {
            EXPECT_TRUE(handles.insert(value).second) << value;
        }
        if (number == 0 && section == "ENTITIES") ++entities[value];
    }
    EXPECT_EQ(value, "EOF");
    EXPECT_EQ(entities["LWPOLYLINE"], 3);  // the wall, its hole, the room
    EXPECT_EQ(entities["TEXT"], 2);        // name and area
}

// Positions of all points of a kind of entity.
std::vector<std::array<double, 2>> pointsIn(const std::string& dxf, const std::string& kind) {
    std::istringstream in(dxf);
    std::vector<std::array<double, 2>> points;
    std::string code, value, current;
    double x = 0;
    while (std::getline(in, code) && std::getline(in, value)) {
        if (std::stoi(code) == 0) current = value;
        if (current != kind) continue;
        if (std::stoi(code) == 10) x = std::stod(value);
        if (std::stoi(code) == 20) points.push_back({x, std::stod(value)});
    }
    return points;
}

TEST(DxfDrawing, HatchesWhatIsCutAndFollowsTheRings) {
    const auto volume = roomInWalls();
    const std::string dxf = makeDxf(planOf(volume), volume);
    EXPECT_EQ(countOf(dxf, "\nHATCH\n"), 1u);  // the wall with its hole, not the room
    EXPECT_NE(dxf.find("SVT_GENERAL"), std::string::npos);
    // Elevation, four corners of the wall, four of the hole.
    EXPECT_EQ(pointsIn(dxf, "HATCH").size(), 9u);
    EXPECT_NE(dxf.find("\nWall_Surface_HATCH\n"), std::string::npos);
}

TEST(DxfDrawing, NamesLayersAfterIso13567WhereAsked) {
    auto volume = roomInWalls();
    const std::string iso = makeDxf(planOf(volume), volume, {.isoLayers = true, .world = false});
    for (const char* const layer : {"A-22----E-", "A-22----H-", "A-90SPACE-", "A-------T-"})
        EXPECT_NE(iso.find(std::string("\n  8\n") + layer + "\n"), std::string::npos) << layer;
    volume.labels.labels[0].attributes.push_back({"ifcType", std::string("IfcWall"), ""});
    EXPECT_NE(makeDxf(planOf(volume), volume).find("\n  8\nIfcWall\n"), std::string::npos);
}

TEST(DxfDrawing, StandsInTheWorldWhereAsked) {
    const auto volume = roomInWalls();
    const DxfOptions world{.isoLayers = false, .world = true};
    for (const auto& p : pointsIn(makeDxf(planOf(volume), volume, world), "LWPOLYLINE")) {
        EXPECT_TRUE(p[0] >= 499999.9 && p[0] <= 500004) << p[0];
        EXPECT_TRUE(p[1] >= 5399999.9 && p[1] <= 5400003) << p[1];
    }
    // Upright: seen from the south, x is east, y is up; the plane lies 1.5 m from the corner.
    const auto section = *illustrate::drawSection(volume, {{0, -1, 0}, volume.grid.origin() + Vec3d{0, 1.5, 0}});
    const std::string dxf = makeDxf(section, volume, world);
    for (const auto& p : pointsIn(dxf, "LWPOLYLINE")) {
        EXPECT_TRUE(p[0] >= 499999.9 && p[0] <= 500004) << p[0];
        EXPECT_TRUE(p[1] >= 99.9 && p[1] <= 102) << p[1];
    }
    EXPECT_NE(dxf.find("\n220\n-1\n"), std::string::npos);
    EXPECT_NE(dxf.find("\n 38\n-5400001.5\n"), std::string::npos);
}

TEST(DxfDrawing, HasABlockForEachDoor) {
    auto volume = roomInWalls();
    auto drawing = planOf(volume);
    drawing.doors.push_back({0, {{{1, 0}, {1, 0.8}}}, {{{1, 0}, {1.8, 0}, {1, 0.8}}}});
    const std::string dxf = makeDxf(drawing, volume);
    EXPECT_EQ(countOf(dxf, "\nINSERT\n"), 1u);
    EXPECT_NE(dxf.find("\nDOOR_1\n"), std::string::npos);
    EXPECT_NE(dxf.find("\nAcDbCircle\n 10\n0\n 20\n0\n 30\n0\n 40\n0.8\n100\nAcDbArc\n 50\n0\n 51\n90\n"),
              std::string::npos);
    EXPECT_EQ(pointsIn(dxf, "INSERT").front(), (std::array<double, 2>{1, 0}));
    const std::string svg = *makeSvg(drawing, volume);
    EXPECT_NE(svg.find("<path class=\"swing\" data-id=\"wall,1\""), std::string::npos);
    EXPECT_NE(svg.find("A8 8 0 0 0 "), std::string::npos);
}

TEST(SvgDrawing, SaysWhereItLiesAndHasLayers) {
    const auto volume = roomInWalls();
    const std::string svg = *makeSvg(planOf(volume), volume);
    EXPECT_NE(svg.find("crs=\"urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783\""), std::string::npos);
    EXPECT_NE(svg.find("height=\"101.03\""), std::string::npos);
    EXPECT_NE(svg.find("inkscape:groupmode=\"layer\" inkscape:label=\"Wall Surface\""), std::string::npos);
}

TEST(DxfDrawing, SaysUnitsAndWritesNamesInItsCodePage) {
    const auto volume = roomInWalls();
    const std::string dxf = makeDxf(planOf(volume), volume);
    EXPECT_NE(dxf.find("$INSUNITS\n 70\n6\n"), std::string::npos);
    EXPECT_NE(dxf.find("\n  1\nK\xFC"
                       "che <1> \\U+0141\n"),
              std::string::npos);
    EXPECT_NE(dxf.find("\n  1\n6.00 m\xB2\n"), std::string::npos);
    EXPECT_NE(dxf.find("\n  8\nWall_Surface\n"), std::string::npos);
    EXPECT_NE(dxf.find("999\norigin 500000 5400000 101.03\n"), std::string::npos);
}

TEST(GeojsonDrawing, IsInTheCoordinatesOfTheModel) {
    const auto volume = roomInWalls();
    const std::string json = makeGeojson(planOf(volume), volume);
    EXPECT_NE(json.find("urn:ogc:def:crs:EPSG::25832"), std::string::npos);
    EXPECT_NE(json.find("[[[[499999.95,5399999.95,101.03],[500003.95,5399999.95,101.03],"), std::string::npos) << json;
    EXPECT_NE(json.find("\"class\":\"BuildingRoom\",\"name\":\"Küche <1> Ł\",\"area\":6,"), std::string::npos);
    auto unknown = volume;
    unknown.crsName = "local";
    EXPECT_EQ(makeGeojson(planOf(unknown), unknown).find("\"crs\""), std::string::npos);
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

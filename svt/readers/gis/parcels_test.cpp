#include <svt/core/bytes.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/readers/gis/gis_features.hpp>
#include <svt/readers/owner_table.hpp>
#include <svt/readers/parcels.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace svt::readers::gis {
namespace {

constexpr const char* kTwoParcels = R"({"type":"FeatureCollection",
  "crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}},"features":[
  {"type":"Feature","properties":{"label":"12/3","area":96.5,"use":"garden"},"geometry":{"type":"Polygon","coordinates":
    [[[500000,5400000],[500010,5400000],[500010,5400010],[500000,5400010],[500000,5400000]],
     [[500004,5400004],[500006,5400004],[500006,5400006],[500004,5400006],[500004,5400004]]]}},
  {"type":"Feature","id":"east","properties":null,"geometry":{"type":"MultiPolygon","coordinates":
    [[[[500010,5400000],[500010,5400010],[500020,5400010],[500020,5400000],[500010,5400000]]],
     [[[500030,5400000],[500040,5400000],[500040,5400010],[500030,5400000]]]]}},
  {"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[1,2]}}]})";

struct Read {
    Result<model::BuildingModel> model;
    Diagnostics findings;
};

Read read(const std::string& text, const std::string& name = "p.geojson", ParcelOptions options = {}) {
    const svt::test::TemporaryFolder folder;
    svt::test::writeText(folder / name, text);
    if (options.high == 0) options.high = 10;
    if (options.crsName.empty()) options.crsName = "EPSG:25832";
    Diagnostics findings;
    auto model = readParcels(folder / name, options, &findings);
    return {std::move(model), std::move(findings)};
}

// The volume of a solid: the sum of cones over its polygons.
double volumeOf(const model::BuildingModel& model, const model::Solid& solid) {
    const Vec3d far{500000, 5400000, 0};
    double sum = 0;
    for (const model::SurfaceUse& use : solid.exterior) {
        const model::Polygon& polygon = model.polygons[use.polygon];
        std::size_t begin = 0;
        for (const std::uint32_t end : polygon.ringEnds) {
            for (std::size_t n = begin + 1; n + 1 < end; ++n)
                sum += dot(polygon.points[begin] - far, cross(polygon.points[n] - far, polygon.points[n + 1] - far));
            begin = end;
        }
    }
    return sum / 6;
}

TEST(Parcels, AreSolidsOfTheirPolygonsWithHoles) {
    const Read found = read(kTwoParcels);
    ASSERT_TRUE(found.model) << found.model.error().toString();
    const model::BuildingModel& model = *found.model;
    ASSERT_EQ(model.features.size(), 2u);
    EXPECT_EQ(model.features[0].className, "Parcel");
    EXPECT_EQ(model.features[0].id, "parcel-1");
    EXPECT_EQ(model.features[0].name, "12/3");
    EXPECT_EQ(model.features[1].id, "east");
    ASSERT_EQ(model.features[1].geometries[0].solids.size(), 2u);
    EXPECT_NEAR(volumeOf(model, model.features[0].geometries[0].solids[0]), 960, 1e-3);
    EXPECT_NEAR(volumeOf(model, model.features[1].geometries[0].solids[0]), 1000, 1e-3) << "a clockwise ring";
    EXPECT_EQ(found.findings.count(Code::NoGeometry), 1u) << "the point is left out";
    EXPECT_EQ(model.features[0].attributes.size(), 3u);
}

TEST(Parcels, InDegreesAreConvertedToTheProjectionOfTheModel) {
    const Read found = read(R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":
        {"type":"Polygon","coordinates":[[[9,48.75],[9.0001,48.75],[9.0001,48.7501],[9,48.75]]]}}]})");
    ASSERT_TRUE(found.model) << found.model.error().toString();
    const Vec3d corner = found.model->polygons[0].points[0];
    EXPECT_NEAR(corner.x, 500000, 1) << "the central meridian of UTM zone 32";
    EXPECT_NEAR(corner.y, 5399000, 2000);
    ParcelOptions unknown;
    unknown.crsName = "local";
    const Read refused = read(R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":
        {"type":"Polygon","coordinates":[[[9,48.75],[9.0001,48.75],[9.0001,48.7501],[9,48.75]]]}}]})",
                              "p.geojson", unknown);
    ASSERT_FALSE(refused.model);
    EXPECT_EQ(refused.model.error().code(), Code::CannotProject);
}

TEST(Parcels, OfUnknownSystemsAreUsedUnchangedWithAWarning) {
    std::string text = kTwoParcels;
    text.replace(text.find("urn:ogc:def:crs:EPSG::25832"), 27, "local survey");
    const Read found = read(text);
    ASSERT_TRUE(found.model);
    EXPECT_EQ(found.findings.count(Code::MixedCrs), 1u);
}

// A shapefile of polygons: records of one part or more.
std::string shapefile(const std::vector<std::vector<GisRing>>& shapes, std::int32_t type = 5) {
    const auto big = [](std::string& to, std::uint32_t value) {
        for (int shift = 24; shift >= 0; shift -= 8) to += static_cast<char>(value >> shift & 255);
    };
    std::string records;
    for (std::size_t n = 0; n < shapes.size(); ++n) {
        std::string record, points;
        appendBytes(record, type);
        for (int box = 0; box < 4; ++box) appendBytes(record, 0.0);
        std::uint32_t count = 0;
        std::string parts;
        for (const GisRing& ring : shapes[n]) {
            appendBytes(parts, count);
            count += static_cast<std::uint32_t>(ring.size());
            for (const Vec3d& p : ring) appendBytes(points, p.x, p.y);
        }
        appendBytes(record, static_cast<std::uint32_t>(shapes[n].size()), count);
        record += parts + points;
        big(records, static_cast<std::uint32_t>(n + 1));
        big(records, static_cast<std::uint32_t>(record.size() / 2));
        records += record;
    }
    std::string file;
    big(file, 9994);
    file.resize(24);
    big(file, static_cast<std::uint32_t>((100 + records.size()) / 2));
    appendBytes(file, std::int32_t{1000}, type);
    file.resize(100);
    return file + records;
}

const GisRing kOuter{{0, 0, 0}, {0, 10, 0}, {10, 10, 0}, {10, 0, 0}, {0, 0, 0}};
const GisRing kHole{{4, 4, 0}, {6, 4, 0}, {6, 6, 0}, {4, 6, 0}, {4, 4, 0}};

// dBASE: one field NAME of 10 characters.
std::string dbf(const std::vector<std::string>& names) {
    std::string table(32, '\0');
    table[0] = 3;
    table[4] = static_cast<char>(names.size());
    table[8] = 32 + 32 + 1;
    table[10] = 11;
    table += std::string("NAME") + std::string(7, '\0') + "C" + std::string(4, '\0') + "\x0a";
    table.resize(64);
    table += '\r';
    for (const std::string& name : names) {
        std::string field = name;
        field.resize(10, ' ');
        table += " " + field;
    }
    return table;
}

TEST(Shapefiles, HaveHolesAndAttributes) {
    const std::string shp = shapefile({{kOuter, kHole}, {kOuter}}), table = dbf({"A\xF6", "B"});
    const auto file = readShapefile(
        std::as_bytes(std::span(shp)), std::as_bytes(std::span(table)),
        "PROJCS[\"x\",GEOGCS[\"y\",AUTHORITY[\"EPSG\",\"4258\"]],AUTHORITY[\"EPSG\",\"25832\"]]", "p.shp");
    ASSERT_TRUE(file) << file.error().toString();
    EXPECT_EQ(file->epsg, 25832);
    ASSERT_EQ(file->features.size(), 2u);
    ASSERT_EQ(file->features[0].polygons.size(), 1u);
    EXPECT_EQ(file->features[0].polygons[0].rings.size(), 2u);
    EXPECT_EQ(toText(file->features[0].attributes.at(0).value), "A\u00F6") << "Latin-1";
    EXPECT_EQ(toText(file->features[1].attributes.at(0).value), "B");
}

TEST(Shapefiles, ThatAreCutOffOrOfAnotherKindAreErrors) {
    const std::string whole = shapefile({{kOuter, kHole}});
    for (std::size_t size = 0; size < whole.size(); ++size) {
        if (size == 100) continue;  // a header without records
        const std::string cut = whole.substr(0, size);
        const auto file = readShapefile(std::as_bytes(std::span(cut)), {}, {}, "p.shp");
        ASSERT_FALSE(file) << size;
        EXPECT_EQ(file.error().code(), Code::BadValue);
    }
    const std::string lines = shapefile({{kOuter}}, 3);
    EXPECT_FALSE(readShapefile(std::as_bytes(std::span(lines)), {}, {}, "p.shp"));
    // Any change of a byte gives a file or an error.
    for (std::size_t at = 0; at < whole.size(); ++at)
        for (const char value : {'\0', '\x7F', '\xFF'}) {
            std::string changed = whole;
            changed[at] = value;
            (void)readShapefile(std::as_bytes(std::span(changed)), {}, {}, "p.shp");
        }
}

TEST(Parcels, SayWhatIsWrong) {
    struct Case {
        std::string text;
        Code code;
    };
    const std::string empty = R"({"type":"FeatureCollection","features":[]})";
    for (const Case& wrong : {Case{empty, Code::EmptyModel}, Case{R"({"type":"FeatureCollection",)", Code::BadJson},
                              Case{"plain text", Code::UnknownFormat},
                              Case{std::string("SQLite format 3\0 and no more", 28), Code::BadValue}}) {
        const Read found = read(wrong.text);
        ASSERT_FALSE(found.model) << wrong.text;
        EXPECT_TRUE(found.model.error().code() == wrong.code || found.model.error().code() == Code::CannotOpen)
            << found.model.error().toString();
    }
    EXPECT_EQ(readParcels("/nowhere/p.geojson", {}).error().code(), Code::CannotOpen);
    EXPECT_FALSE(looksLikeParcels("/nowhere/p.geojson"));
}

TEST(OwnerTables, OfTextAreTheFileItself) {
    const svt::test::TemporaryFolder folder;
    svt::test::writeText(folder / "t.csv", "a,Ada\n");
    EXPECT_EQ(*readOwnerTable(folder / "t.csv"), "a,Ada\n");
    EXPECT_EQ(readOwnerTable(folder / "none.csv").error().code(), Code::CannotOpen);
}

TEST(Parcels, WhoseRingsCrossOrPartsOverlapAreLeftOut) {
    const auto withParcel = [](const std::string& coordinates) {
        std::string text = kTwoParcels;
        const std::string point = R"({"type":"Point","coordinates":[1,2]})";
        text.replace(text.find(point), point.size(), R"({"type":"MultiPolygon","coordinates":)" + coordinates + "}");
        return read(text);
    };
    const std::string square =
        "[[[500050,5400000],[500060,5400000],[500060,5400010],[500050,5400010],[500050,5400000]]]";
    const std::string beside =
        "[[[500060,5400000],[500070,5400000],[500070,5400010],[500060,5400010],[500060,5400000]]]";
    const std::string over = "[[[500055,5400000],[500065,5400000],[500065,5400010],[500055,5400010],[500055,5400000]]]";
    const std::string bow = "[[[500050,5400000],[500060,5400010],[500060,5400000],[500050,5400012],[500050,5400000]]]";
    for (const std::string& good : {"[" + square + "]", "[" + square + "," + beside + "]"}) {
        const Read whole = withParcel(good);
        ASSERT_TRUE(whole.model) << whole.model.error().toString();
        EXPECT_EQ(whole.model->features.size(), 3u) << good;
        EXPECT_EQ(whole.findings.count(Code::RingsIntersect), 0u);
    }
    for (const std::string& bad :
         {"[" + square + "," + over + "]", "[" + square + "," + square + "]", "[" + bow + "]"}) {
        const Read left = withParcel(bad);
        ASSERT_TRUE(left.model) << left.model.error().toString();
        EXPECT_EQ(left.model->features.size(), 2u) << bad;
        EXPECT_EQ(left.findings.count(Code::RingsIntersect), 1u);
    }
}

}  // namespace
}  // namespace svt::readers::gis

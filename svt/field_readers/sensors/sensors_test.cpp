#include <svt/field_readers/read_fields.hpp>

#include <svt/core/temporary_folder_test.hpp>
#include <svt/record/times.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace svt::field_readers {
namespace {

using record::isoText;
using record::parseIsoTime;

using svt::test::TemporaryFolder;
using svt::test::writeText;

// Two rooms of 1 m voxels, an L-shaped one and a box, and a wall.
volume::SemanticVolume rooms() {
    auto volume = volume::test::emptyVolume({12, 10, 4}, {1, 1, 1}, {0.5, 0.5, 0.5});
    volume::test::addObject(volume, "room-l", "BuildingRoom").name = "Corner";
    volume::test::addObject(volume, "room-b", "BuildingRoom").name = "Box";
    volume::test::addObject(volume, "wall", "Wall").name = "Wall";
    volume::test::addObject(volume, "twin-1", "BuildingRoom").name = "Twin";
    volume::test::addObject(volume, "twin-2", "BuildingRoom").name = "Twin";
    volume::test::paintBoxes(volume, {{1, {0, 0, 0}, {7, 1, 3}},
                                      {1, {0, 0, 0}, {1, 7, 3}},
                                      {2, {8, 1, 1}, {11, 4, 4}},
                                      {3, {7, 0, 0}, {8, 10, 4}},
                                      {4, {2, 8, 0}, {3, 9, 1}},
                                      {5, {4, 8, 0}, {5, 9, 1}}});
    return volume;
}

struct SensorRead {
    std::vector<fields::Field> fields;
    Diagnostics diagnostics;
    std::string error;

    [[nodiscard]] bool says(std::string_view text) const {
        for (const Diagnostic& item : diagnostics.items())
            if (item.message.find(text) != std::string::npos) return true;
        return false;
    }
};

class Sensors : public testing::Test {
protected:
    SensorRead read(std::string_view table, std::string_view places, std::string_view name = "co2.csv") {
        writeText(folder / name, table);
        if (!places.empty()) {
            writeText(folder / "places.csv", places);
            options.places = folder / "places.csv";
        }
        SensorRead result;
        const auto volume = rooms();
        auto fields = readFields(folder / name, volume, options, result.diagnostics);
        if (fields)
            result.fields = std::move(*fields);
        else
            result.error = fields.error().toString();
        return result;
    }

    TemporaryFolder folder;
    FieldReadOptions options;
};

TEST(IsoTime, ReadsDatesZonesAndFractions) {
    EXPECT_EQ(parseIsoTime("1970-01-01T00:00:00Z")->seconds, 0);
    EXPECT_EQ(parseIsoTime("2026-01-05T08:15:30Z")->seconds, 1767600930);
    EXPECT_EQ(parseIsoTime("2026-01-05T09:15:30+01:00")->seconds, 1767600930);
    EXPECT_EQ(parseIsoTime("2026-01-05 09:15:30+0100")->seconds, 1767600930);
    EXPECT_EQ(parseIsoTime("2026-01-05T03:15:30-05")->seconds, 1767600930);
    EXPECT_DOUBLE_EQ(parseIsoTime("2026-01-05T08:15:30.25Z")->seconds, 1767600930.25);
    EXPECT_EQ(parseIsoTime("2024-02-29")->seconds, 1709164800);
    EXPECT_FALSE(parseIsoTime("2024-02-29")->hasZone);
    EXPECT_EQ(parseIsoTime("1969-12-31T23:59Z")->seconds, -60);
    for (const char* wrong :
         {"", "2026", "2026-13-01", "2025-02-29", "2026-01-05T", "2026-01-05T25:00", "2026-01-05T08:15:30+",
          "2026-01-05T08:15:30 GMT", "05.01.2026", "2026-01-05T08:15:30+1:00"})
        EXPECT_FALSE(parseIsoTime(wrong)) << wrong;
}

TEST(IsoTime, WritesWhatItReads) {
    for (const char* text : {"1970-01-01T00:00:00Z", "2026-01-05T08:15:30Z", "2024-02-29T23:59:59Z",
                             "1969-12-31T23:59:00Z", "1600-03-01T12:00:00Z", "2026-01-05T08:15:30.250Z"})
        EXPECT_EQ(isoText(parseIsoTime(text)->seconds), text);
}

TEST_F(Sensors, ReadsLongTables) {
    const auto result = read(
        "time,sensor,co2 [ppm]\n2026-01-05T00:00:00Z,s1,400\n2026-01-05T00:15:00Z,s1,500\n"
        "2026-01-05T00:15:00Z,s2,600.5\n2026-01-05T00:30:00Z,s2,NaN\n",
        "name,x,y,z\ns1,1.5,0.5,1.5\ns2,9.5,2.5,2.5\n");
    ASSERT_EQ(result.error, "");
    ASSERT_EQ(result.fields.size(), 1u);
    const fields::FieldHead& head = result.fields[0].head;
    EXPECT_EQ(head.name, "co2");
    EXPECT_EQ(head.quantity, "co2");
    EXPECT_EQ(head.unit, "[ppm]");
    EXPECT_EQ(head.kind, fields::FieldKind::Points);
    EXPECT_EQ(head.epoch, "2026-01-05T00:00:00Z");
    EXPECT_EQ(head.times, (std::vector<double>{0, 900, 1800}));
    ASSERT_EQ(head.points.size(), 2u);
    EXPECT_EQ(head.points[1].at, (Vec3d{9.5, 2.5, 2.5}));
    const std::vector<float>& values = result.fields[0].values;
    ASSERT_EQ(values.size(), 6u);
    EXPECT_EQ(values[0], 400);
    EXPECT_TRUE(std::isnan(values[1]));
    EXPECT_EQ(values[2], 500);
    EXPECT_EQ(values[3], 600.5f);
    EXPECT_TRUE(std::isnan(values[4]) && std::isnan(values[5]));
    EXPECT_TRUE(result.says("3 of 6 values are missing"));
    EXPECT_EQ(head.precision, 0);
}

TEST_F(Sensors, ReadsWideTablesInAnyOrderOfTimes) {
    options.unit = "Cel";
    options.quantity = "Temperature";
    const auto result =
        read("\xEF\xBB\xBFtime;s2;s1\r\n10;21,5;-\r\n0;20;18\r\n5;;17\r\n", "sensor;room\ns1;room-b\ns2;Corner\n");
    ASSERT_EQ(result.error, "");
    const fields::Field& field = result.fields[0];
    EXPECT_EQ(field.head.name, "temperature");
    EXPECT_FALSE(field.head.epoch);
    EXPECT_EQ(field.head.times, (std::vector<double>{0, 5, 10}));
    ASSERT_EQ(field.head.points.size(), 2u);
    EXPECT_EQ(field.head.points[0].id, "s2");
    EXPECT_EQ(field.head.points[1].at, (Vec3d{9.5, 2.5, 2.5}));  // the middle of the box
    EXPECT_EQ(field.values[0], 20);
    EXPECT_EQ(field.values[1], 18);
    EXPECT_TRUE(std::isnan(field.values[2]));
    EXPECT_EQ(field.values[4], 21.5f);
    EXPECT_NE(field.head.parameters.find("given, Cel; the file states none"), std::string::npos)
        << field.head.parameters;
    EXPECT_NE(field.head.parameters.find("centroid of room 'Corner'"), std::string::npos);
}

TEST_F(Sensors, ThePlaceInARoomIsAVoxelOfTheRoom) {
    options.unit = "1";
    const auto result = read("time,s\n0,1\n", "name,room\ns,id=room-l\n");
    ASSERT_EQ(result.error, "");
    // The centroid of the L lies outside of the room.
    const auto volume = rooms();
    const Vec3d index = volume.grid.indexFromWorld(result.fields[0].head.points[0].at);
    EXPECT_EQ(volume.columns.scalarAt(int(index.x), int(index.y), int(index.z)), 1u);
}

TEST_F(Sensors, FaultsNameTheLine) {
    const std::string places = "name,x,y,z\ns1,1,1,1\n";
    options.unit = "Cel";
    EXPECT_NE(read("time,sensor,value\n0,s1,1\n0,s9,2\n", places).error.find("co2.csv:3: sensor 's9' has no place in"),
              std::string::npos);
    EXPECT_NE(read("time,sensor,value\n0,s1,warm\n", places).error.find("co2.csv:2: 'warm' is not a number"),
              std::string::npos);
    EXPECT_NE(read("time,sensor,value\nnoon,s1,1\n", places).error.find("'noon' is not a time"), std::string::npos);
    EXPECT_NE(
        read("time,sensor,value\n0,s1,1\n2026-01-05,s1,1\n", places).error.find("is a date, but the first time is not"),
        std::string::npos);
    EXPECT_NE(read("time,sensor,value\n2026-01-05T00:00Z,s1,1\n2026-01-05T00:00,s1,1\n", places)
                  .error.find("lacks a time zone"),
              std::string::npos);
    EXPECT_NE(read("time,sensor,value\n0,s1,1\n0,s1,2\n", places).error.find("co2.csv:3: sensor 's1' has two values"),
              std::string::npos);
    EXPECT_EQ(read("time,sensor,value\n0,s1,1\n0,s1,1\n", places).error, "");
    EXPECT_NE(read("time,sensor,value\n0,s1\n", places).error.find("2 cells of 3"), std::string::npos);
    EXPECT_NE(read("time,sensor,value\n", places).error.find("no row with values"), std::string::npos);
    EXPECT_NE(read("when,sensor,value\n0,s1,1\n", places).error.find("column 'time'"), std::string::npos);
    EXPECT_NE(read("time,s1\n0,\"1\n", places).error.find("quote"), std::string::npos);
}

TEST_F(Sensors, FaultsOfPlacesNameTheLine) {
    const std::string table = "time,sensor,value\n0,s1,1\n";
    options.unit = "Cel";
    EXPECT_NE(read(table, "a,b\n").error.find("places.csv:1: the first line must name the columns"), std::string::npos);
    EXPECT_NE(read(table, "name,x,y,z\ns1,1,2\n").error.find("places.csv:2: the place of 's1' is not three numbers"),
              std::string::npos);
    EXPECT_NE(read(table, "name,x,y,z\ns1,1,2,3\ns1,1,2,3\n").error.find("places.csv:3: 's1' has a place on line 2"),
              std::string::npos);
    EXPECT_NE(read(table, "name,room\ns1,Attic\n").error.find("no component has the id or the name 'Attic'"),
              std::string::npos);
    EXPECT_NE(read(table, "name,room\ns1,Twin\n").error.find("'Twin' names 2 components"), std::string::npos);
    EXPECT_NE(read(table, "name,x,y,z\ns1,100,200,3\n").error.find("E703"), std::string::npos);
    options.places.clear();
    EXPECT_NE(read(table, "").error.find("--places"), std::string::npos);
}

TEST_F(Sensors, AsksForAUnit) {
    EXPECT_NE(read("time,sensor,value\n0,s1,1\n", "name,x,y,z\ns1,1,1,1\n").error.find("--unit"), std::string::npos);
    options.unit = "deg C";
    EXPECT_NE(read("time,sensor,value\n0,s1,1\n", "name,x,y,z\ns1,1,1,1\n").error.find("'deg C' is not a unit"),
              std::string::npos);
}

TEST_F(Sensors, NotesUtcOutsideAndUnused) {
    options.unit = "Cel";
    const auto result = read("time,s1,s2\n2026-01-05 00:00,1,2\n", "name,x,y,z\ns1,1,1,1\ns2,50,1,1\nspare,1,1,1\n");
    ASSERT_EQ(result.error, "");
    EXPECT_TRUE(result.says("they count as UTC"));
    EXPECT_TRUE(result.says("1 of 2 points lie outside of the volume: 's2'"));
    EXPECT_TRUE(result.says("1 sensors with a place have no values: 'spare'"));
}

constexpr std::string_view kThings = R"({"value":[{"name":"kitchen",
 "Locations":[{"location":{"type":"Point","coordinates":[1.5,0.5,1.5]}}],
 "Datastreams":[{"name":"air","unitOfMeasurement":{"symbol":"degC"},"ObservedProperty":{"name":"Temperature"},
  "Observations@iot.nextLink":"https://example.org/next",
  "Observations":[{"phenomenonTime":"2026-01-05T00:00:00Z","result":20.5},
                  {"phenomenonTime":"2026-01-05T00:10:00Z/2026-01-05T00:20:00Z","result":"21.25"},
                  {"phenomenonTime":"2026-01-05T00:20:00Z","result":"off"},
                  {"phenomenonTime":"2026-01-05T00:30:00Z","result":null}]},
  {"name":"gas","unitOfMeasurement":{"symbol":"ppm"},"ObservedProperty":{"name":"CO2"},
  "Observations":[{"phenomenonTime":"2026-01-05T00:00:00Z","result":400}]}]}]})";

TEST_F(Sensors, ReadsSensorThings) {
    const auto result = read(kThings, "", "things.json");
    ASSERT_EQ(result.error, "");
    ASSERT_EQ(result.fields.size(), 2u);
    EXPECT_EQ(result.fields[0].head.name, "co2");
    EXPECT_EQ(result.fields[0].head.unit, "[ppm]");
    const fields::Field& field = result.fields[1];
    EXPECT_EQ(field.head.name, "temperature");
    EXPECT_EQ(field.head.unit, "Cel");
    EXPECT_EQ(field.head.times, (std::vector<double>{0, 600, 1200, 1800}));
    EXPECT_EQ(field.head.points[0].id, "kitchen");
    EXPECT_EQ(field.head.points[0].at, (Vec3d{1.5, 0.5, 1.5}));
    EXPECT_EQ(field.values[1], 21.25f);
    EXPECT_TRUE(std::isnan(field.values[2]) && std::isnan(field.values[3]));
    EXPECT_TRUE(result.says("https://example.org/next"));
    EXPECT_TRUE(result.says("1 results are not numbers"));
    EXPECT_TRUE(result.says("1 times are intervals"));
}

TEST_F(Sensors, SensorThingsTakePlacesOfTheTableAndRefuseOthers) {
    const auto placed = read(kThings, "name,room\nkitchen,Box\n", "things.json");
    ASSERT_EQ(placed.error, "");
    EXPECT_EQ(placed.fields[0].head.points[0].at, (Vec3d{9.5, 2.5, 2.5}));
    options.places.clear();
    EXPECT_NE(read("{}", "", "things.json").error.find("no Thing"), std::string::npos);
    EXPECT_NE(read("{", "", "things.json").error.find("not JSON"), std::string::npos);
    EXPECT_NE(
        read(
            R"({"value":[{"name":"a","Datastreams":[{"name":"t","unitOfMeasurement":{"symbol":"K"},"Observations":[]}]}]})",
            "", "things.json")
            .error.find("no Location with three coordinates"),
        std::string::npos);
}

}  // namespace
}  // namespace svt::field_readers

// `svt cadastre`: the land administration as GeoPackage, CityGML and report, relations of legal units, and parcels and
// owners from GIS files. GDAL, SQLite, xmllint and poppler read the output.
#include "../run_command.hpp"

#include <svt/core/test_data_test.hpp>

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace svt::test {
namespace {

using nlohmann::json;

constexpr const char* kShares =
    "feature,owner,share\ntower_S00_F1,Weber,1/3\ntower_S00_F1,Klein,2/3\ntower_S00_F2,Weber\n";

class Cadastre : public ::testing::Test {
protected:
    Cadastre() {
        prepare(folder.path(), {"sample", "tower", "-o", "tower.gml", "--storeys", "1"});
        prepare(folder.path(), {"build", "tower.gml", "-o", "tower.svt", "--spacing", "0.12"});
        writeText(folder / "shares.csv", kShares);
    }
    TemporaryFolder folder;
};

json relationOf(const json& report, const std::string& kind, const std::string& a, const std::string& b) {
    for (const json& relation : report["relations"])
        if (relation["kind"] == kind && relation["a"] == a && relation["b"] == b) return relation;
    return nullptr;
}

json unitOf(const json& report, const std::string& id) {
    for (const json& unit : report["units"])
        if (unit["id"] == id) return unit;
    return nullptr;
}

TEST_F(Cadastre, TheGeoPackageHasATablePerClassWithValidKeysAndGeometries) {
    runSvtWell(folder.path(), {"cadastre", "tower.svt", "-o", "units.gpkg", "--owners", "shares.csv"});
    std::string said;
    if (!isRun(folder.path(), pythonOf("read_ladm.py") + "units.gpkg", said)) GTEST_SKIP() << said;
    const json counts = json::parse(said);
    EXPECT_EQ(counts["la_party"], 2);
    EXPECT_EQ(counts["la_baunit"], 2);
    EXPECT_EQ(counts["la_right"], 3);
    EXPECT_EQ(counts["la_spatialunit"], 5) << "units without owners are registered, too";
    EXPECT_EQ(counts["la_source"], 2);
    EXPECT_EQ(counts["epsg"], 25832);
    EXPECT_EQ(counts["shares"]["tower_S00_F1 Weber"], "1/3");
    EXPECT_EQ(counts["shares"]["tower_S00_F1 Klein"], "2/3");
    EXPECT_EQ(counts["shares"]["tower_S00_F2 Weber"], "1/1");
    EXPECT_NEAR(counts["volumes"]["tower_S00_F1"].get<double>(), 197.266, 1e-3) << "the solid of the model";
    runSvtWell(folder.path(), {"cadastre", "tower.svt", "-o", "again.gpkg", "--owners", "shares.csv"});
    EXPECT_TRUE(readText(folder / "units.gpkg") == readText(folder / "again.gpkg"));
}

TEST_F(Cadastre, ABuildingThatIsAUnitHasItsBodyAndItsOwner) {
    writeText(folder / "all.csv", "feature,owner\ntower,Otto\ntower_S00_F1,Anna\n");
    runSvtWell(folder.path(), {"cadastre", "tower.svt", "--owners", "all.csv", "-o", "all.gml", "-o", "all.city.json",
                               "-o", "all.ifc"});
    const json objects = json::parse(readText(folder / "all.city.json"))["CityObjects"];
    EXPECT_FALSE(objects["tower"]["geometry"].empty());
    EXPECT_EQ(objects["tower"]["attributes"]["owner"], "Otto");
    EXPECT_EQ(objects["tower_S00_F1"]["attributes"]["owner"], "Anna") << "the owner of the model is replaced";
    EXPECT_FALSE(objects["tower_S00_F2"]["attributes"].contains("owner"));
    const std::string gml = readText(folder / "all.gml");
    const std::size_t building = gml.find("<bldg:Building "), unit = gml.find("<bldg:BuildingUnit ");
    EXPECT_LT(gml.find("<core:lod3Solid>"), unit) << "the solid of the building comes first";
    EXPECT_GT(gml.find("<core:lod3Solid>"), building);
    for (const char* file : {"all.gml", "all.city.json", "all.ifc"}) {
        runSvtWell(folder.path(), {"build", file, "-o", "again.svt", "--spacing", "0.5", "-q"});
        const json rows = runSvtForJson(folder.path(), {"query", "again.svt", "class=Building", "--json"});
        ASSERT_EQ(rows.size(), 1u) << file;
        EXPECT_GT(rows[0]["ownVoxels"].get<int>() + rows[0]["totalVoxels"].get<int>(), 0) << file;
    }
}

TEST_F(Cadastre, UnitsAndTheirRelationsAreThoseOfTheModel) {
    const json report = runSvtForJson(folder.path(), {"cadastre", "tower.svt", "--json"});
    EXPECT_EQ(report["parties"].size(), 5u) << "the attribute owner of four flats and the common area";
    ASSERT_EQ(report["units"].size(), 5u);
    const json flat = unitOf(report, "tower_S00_F1");
    EXPECT_EQ(flat["rights"][0]["party"], "F. Weber");
    EXPECT_EQ(flat["body"], "solid");
    EXPECT_EQ(unitOf(report, "tower_S00_common")["common"], true);
    // One volume in all commands: the best known one, with the balcony.
    for (const json& row : runSvtForJson(folder.path(), {"query", "tower.svt", "class=BuildingUnit", "--json"}))
        EXPECT_NEAR(unitOf(report, row["id"])["volume"].get<double>(), row["volume"].get<double>(), 1e-9) << row["id"];
    // The party wall of 0.24 m between flats 1 and 2: 7.00 x 2.84 m on each side.
    const json gap = relationOf(report, "gap", "tower_S00_F1", "tower_S00_F2");
    ASSERT_FALSE(gap.is_null()) << report["relations"];
    EXPECT_NEAR(gap["narrowest"].get<double>(), 0.24, 1e-3);
    EXPECT_NEAR(gap["area"].get<double>(), 7.00 * 2.84, 0.02);
    EXPECT_EQ(gap["between"], json::array({"tower_S00_wall_party_south_1"}));
    EXPECT_EQ(gap["open"], false);
    EXPECT_TRUE(gap["exact"]);
    for (const json& relation : report["relations"]) EXPECT_NE(relation["kind"], "overlap") << relation;
    // Without meshes, bodies are voxels, and nothing is called exact.
    runSvtWell(folder.path(), {"build", "tower.gml", "-o", "plain.svt", "--spacing", "0.24", "--vectors", "none"});
    const json voxels = runSvtForJson(folder.path(), {"cadastre", "plain.svt", "--json"});
    EXPECT_EQ(unitOf(voxels, "tower_S00_F1")["body"], "voxels");
    for (const json& relation : voxels["relations"]) EXPECT_FALSE(relation["exact"]) << relation;
}

// Boxes of CityJSON: id and x0, x1 in metres; 6 x 3 m in y and z.
std::string boxesModel(const std::vector<std::tuple<std::string, double, double>>& units) {
    std::string objects = R"("house":{"type":"Building","children":[)", vertices;
    for (std::size_t n = 0; n < units.size(); ++n)
        objects += fmt::format("{}\"{}\"", n ? "," : "", std::get<0>(units[n]));
    objects += "]}";
    int first = 0;
    for (const auto& [id, x0, x1] : units) {
        std::string faces;
        for (const auto& face :
             {std::array{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}})
            faces += fmt::format("{}[[{},{},{},{}]]", faces.empty() ? "" : ",", first + face[0], first + face[1],
                                 first + face[2], first + face[3]);
        objects += fmt::format(
            R"(,"{}":{{"type":"BuildingUnit","parents":["house"],"geometry":[{{"type":"Solid","lod":"3","boundaries":[[{}]]}}]}})",
            id, faces);
        for (const double z : {0.0, 3.0})
            for (const auto& [x, y] : {std::pair{x0, 0.0}, {x1, 0.0}, {x1, 6.0}, {x0, 6.0}})
                vertices +=
                    fmt::format("{}[{:.0f},{:.0f},{:.0f}]", vertices.empty() ? "" : ",", 1000 * x, 1000 * y, 1000 * z);
        first += 8;
    }
    return R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.001,0.001,0.001],"translate":[0,0,0]},"CityObjects":{)" +
           objects + "},\"vertices\":[" + vertices + "]}";
}

TEST(CadastreRelations, AreSharedFacesOverlapsAndGaps) {
    const TemporaryFolder folder;
    writeText(folder / "m.json", boxesModel({{"a", 0, 4}, {"b", 4, 8}, {"c", 7.99, 12}, {"d", 12.1, 16}}));
    const json report = runSvtForJson(folder.path(), {"cadastre", "m.json", "--json"});
    const json shared = relationOf(report, "shared face", "a", "b");
    ASSERT_FALSE(shared.is_null()) << report;
    EXPECT_NEAR(shared["area"].get<double>(), 18, 1e-4);
    ASSERT_EQ(shared["faces"].size(), 1u);
    EXPECT_EQ(shared["faces"][0]["minus"], "a");
    EXPECT_EQ(shared["faces"][0]["plus"], "b");
    EXPECT_FALSE(shared["faces"][0]["id"].get<std::string>().empty());
    EXPECT_EQ(shared["faces"][0]["rings"][0].size(), 4u);
    const json overlap = relationOf(report, "overlap", "b", "c");
    ASSERT_FALSE(overlap.is_null()) << report;
    EXPECT_NEAR(overlap["volume"].get<double>(), 0.01 * 18, 1e-4);
    const json gap = relationOf(report, "gap", "c", "d");
    ASSERT_FALSE(gap.is_null()) << report;
    EXPECT_NEAR(gap["narrowest"].get<double>(), 0.1, 1e-4);
    EXPECT_EQ(gap["open"], true) << "nothing is between them";
    EXPECT_EQ(report["relations"].size(), 3u);
    const json narrow = runSvtForJson(folder.path(), {"cadastre", "m.json", "--gap", "0.05", "--json"});
    EXPECT_TRUE(relationOf(narrow, "gap", "c", "d").is_null());
    const std::string csv = runSvtWell(folder.path(), {"cadastre", "m.json", "--csv"});
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4) << csv;
}

TEST_F(Cadastre, TheCityGmlIsValidAndComesBackWithTheSameUnits) {
    runSvtWell(folder.path(), {"cadastre", "tower.svt", "-o", "units.gml", "--owners", "shares.csv"});
    const json before = runSvtForJson(folder.path(), {"cadastre", "tower.svt", "--owners", "shares.csv", "--json"});
    const json after = runSvtForJson(folder.path(), {"cadastre", "units.gml", "--owners", "shares.csv", "--json"});
    ASSERT_EQ(after["units"].size(), before["units"].size());
    for (const json& unit : before["units"]) {
        const json again = unitOf(after, unit["id"]);
        ASSERT_FALSE(again.is_null()) << unit;
        EXPECT_EQ(again["name"], unit["name"]);
        EXPECT_EQ(again["class"], unit["class"]);
        EXPECT_EQ(again["rights"], unit["rights"]);
        EXPECT_NEAR(again["bodyVolume"].get<double>(), unit["bodyVolume"].get<double>(), 1e-3);
        EXPECT_NEAR(again["area"].get<double>(), unit["area"].get<double>(), 1e-3);
    }
    // The rights are attributes that a query finds.
    const json found = runSvtForJson(folder.path(), {"query", "units.gml", "\"LA_Right/party\"=Klein", "--json"});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0]["id"], "tower_S00_F1");
    if (const auto schemas = dataDir() / "schemas";
        std::filesystem::exists(schemas / "all_citygml.xsd") && hasProgram("xmllint --version")) {
        std::string all = readText(schemas / "all_citygml.xsd");
        const std::string from = "schemaLocation=\"";
        for (std::size_t at = 0; (at = all.find(from, at)) != std::string::npos;) {
            at += from.size();
            all.insert(at, schemas.string() + "/");
        }
        writeText(folder / "all.xsd", all);
        runShellWell(folder.path(), "xmllint --nonet --noout --schema all.xsd units.gml");
    }
}

constexpr const char* kRights =
    "feature,owner,share,right,source\ntower_S00_F1,Weber,1/3,ownership,deed 7\ntower_S00_F1,Klein,1/3,,deed 8\n"
    "tower_S00_F1,Müller,,lease,\ntower_S00_F1,Bank,,mortgage,deed 9\ntower_S00_F2,Bank,,mortgage,deed 9\n"
    "tower_S00_common,City,,maintenance\n";

TEST_F(Cadastre, RightsOfAllTypesAreInEveryOutput) {
    writeText(folder / "rights.csv", kRights);
    const CommandResult ran =
        runSvt(folder.path(), {"cadastre", "tower.svt", "--owners", "rights.csv", "--json", "-o", "units.gpkg", "-o",
                               "units.gml", "-o", "flat.pdf", "--pages-of", "id=tower_S00_F1"});
    ASSERT_EQ(ran.exitCode, 0) << ran.toString();
    EXPECT_NE(ran.err.find("'tower_S00_F1' add up to 0.666667"), std::string::npos) << ran.err;
    const json report = json::parse(ran.out);
    EXPECT_EQ(report["parties"], json::array({"Weber", "Klein", "Müller", "Bank", "City"}));
    EXPECT_EQ(report["sources"]["documents"], json::array({"deed 7", "deed 8", "deed 9"}));
    const json flat = unitOf(report, "tower_S00_F1");
    ASSERT_EQ(flat["rights"].size(), 4u);
    EXPECT_EQ(flat["rights"][0]["class"], "LA_Right");
    EXPECT_EQ(flat["rights"][0]["source"], "deed 7");
    EXPECT_EQ(flat["rights"][2]["type"], "lease");
    EXPECT_EQ(flat["rights"][2]["party"], "Müller");
    EXPECT_EQ(flat["rights"][2]["share"], nullptr) << "unknown";
    EXPECT_EQ(flat["rights"][3]["class"], "LA_Restriction");
    EXPECT_NEAR(flat["shares"]["ownership"].get<double>(), 2 / 3.0, 1e-12);
    EXPECT_EQ(flat["shares"]["mortgage"], nullptr);
    EXPECT_EQ(unitOf(report, "tower_S00_common")["rights"][0]["class"], "LA_Responsibility");
    // CityGML
    for (const char* query : {"\"LA_Restriction/party\"=Bank", "\"LA_Restriction/LA_AdministrativeSource\"=\"deed 9\""})
        EXPECT_EQ(runSvtForJson(folder.path(), {"query", "units.gml", query, "--json"}).size(), 2u) << query;
    EXPECT_EQ(
        runSvtForJson(folder.path(), {"query", "units.gml", "\"LA_Responsibility/type\"=maintenance", "--json"}).size(),
        1u);
    // Walls are divided between owners only.
    const json owners = runSvtForJson(folder.path(), {"query", "tower.svt", "all", "--owners", "rights.csv", "--json"});
    EXPECT_EQ(owners["owners"].size(), 2u) << owners["owners"];
    std::string said;
    if (isRun(folder.path(), "pdftotext -layout flat.pdf -", said)) {
        for (const char* text : {"Other rights", "Bank", "mortgage", "lease", "deed 7", "deed 9"})
            EXPECT_NE(said.find(text), std::string::npos) << text << "\n" << said;
    }
    if (!isRun(folder.path(), pythonOf("read_ladm.py") + "units.gpkg", said)) GTEST_SKIP() << said;
    const json counts = json::parse(said);
    EXPECT_EQ(counts["la_right"], 3);
    EXPECT_EQ(counts["la_restriction"], 2);
    EXPECT_EQ(counts["la_responsibility"], 1);
    EXPECT_EQ(counts["la_source"], 5);
    EXPECT_EQ(counts["restrictions"][0], json::array({"tower_S00_F1", "mortgage", "Bank", nullptr, "deed 9"}));
}

TEST_F(Cadastre, UnknownRightsAreAnErrorWithTheKnownOnes) {
    writeText(folder / "wrong.csv", "feature,owner,right\ntower_S00_F1,Weber,rent\n");
    const CommandResult wrong =
        runSvt(folder.path(), {"cadastre", "tower.svt", "--owners", "wrong.csv", "-o", "units.gpkg"});
    EXPECT_EQ(wrong.exitCode, kInput) << wrong.toString();
    EXPECT_NE(wrong.err.find("'rent' is not a known right; expected one of ownership, lease"), std::string::npos)
        << wrong.err;
    EXPECT_NE(wrong.err.find("wrong.csv:2"), std::string::npos) << wrong.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "units.gpkg"));
}

// The units of a model that `svt cadastre` wrote, by name: class and volume.
std::map<std::string, double> unitsOf(const std::filesystem::path& folder, const std::string& file) {
    std::map<std::string, double> units;
    const json report = runSvtForJson(folder, {"cadastre", file, "--json"});
    for (const json& unit : report["units"]) {
        EXPECT_EQ(unit["class"], "BuildingUnit");
        EXPECT_EQ(unit["body"], "solid");
        units[unit["name"]] = unit["bodyVolume"];
    }
    return units;
}

TEST_F(Cadastre, CityJsonAndIfcComeBackWithTheSameUnits) {
    writeText(folder / "rights.csv", kRights);
    runSvtWell(folder.path(),
               {"cadastre", "tower.svt", "--owners", "rights.csv", "-o", "units.city.json", "-o", "units.ifc"});
    const std::map<std::string, double> before = unitsOf(folder.path(), "tower.svt");
    for (const char* file : {"units.city.json", "units.ifc"}) {
        const std::map<std::string, double> after = unitsOf(folder.path(), file);
        ASSERT_EQ(after.size(), before.size()) << file;
        for (const auto& [name, volume] : before) EXPECT_NEAR(after.at(name), volume, 1e-3) << file << " " << name;
        const json info = runSvtForJson(folder.path(), {"info", file, "--json"});
        EXPECT_NE(info.dump().find("25832"), std::string::npos) << file;
    }
    const json found =
        runSvtForJson(folder.path(), {"query", "units.city.json", "\"+LA_Restriction/party\"=Bank", "--json"});
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0]["id"], "tower_S00_F1");
    EXPECT_EQ(runSvtForJson(folder.path(), {"query", "units.ifc", "\"LA_Restriction.party\"=Bank", "--json"}).size(),
              2u);
    EXPECT_EQ(runSvtForJson(folder.path(), {"query", "units.ifc", "\"LA_Right 3.party\"=Müller", "--json"}).size(), 1u);
    // The zone of a flat groups its rooms.
    const json rooms = runSvtForJson(folder.path(), {"query", "units.ifc", "class=BuildingRoom", "--json"});
    EXPECT_GT(rooms.size(), 10u);
    const json document = json::parse(readText(folder / "units.city.json"));
    EXPECT_EQ(document["version"], "2.0");
    EXPECT_TRUE(document["extensions"].contains("LADM"));
    EXPECT_EQ(document["+LADM"]["LA_Party"].size(), 5u);
    const json& flat = document["CityObjects"]["tower_S00_F1"];
    EXPECT_EQ(flat["type"], "BuildingUnit");
    EXPECT_EQ(flat["attributes"]["+LA_Right"][0]["share"], "1/3");
    EXPECT_EQ(flat["attributes"]["+LA_Right"][2]["share"], nullptr);
    const std::string ifc = readText(folder / "units.ifc");
    for (const char* text : {"FILE_SCHEMA(('IFC4'))", "=IFCSPATIALZONE(", "=IFCZONE(", "=IFCRELASSIGNSTOGROUP(",
                             "=IFCRELASSIGNSTOACTOR('", "=IFCACTOR(", "M\\X2\\00FC\\X0\\ller", ".OWNER."})
        EXPECT_NE(ifc.find(text), std::string::npos) << text;
    // The same bytes in a second run.
    runSvtWell(folder.path(), {"cadastre", "tower.svt", "--owners", "rights.csv", "-o", "b.city.json", "-o", "b.ifc"});
    EXPECT_TRUE(readText(folder / "b.ifc") == ifc);
    EXPECT_TRUE(readText(folder / "b.city.json") == readText(folder / "units.city.json"));
}

TEST_F(Cadastre, TheReportOfAUnitIsAPage) {
    runSvtWell(folder.path(),
               {"cadastre", "tower.svt", "-o", "flat.pdf", "--pages-of", "id=tower_S00_F1", "--owners", "shares.csv"});
    ASSERT_TRUE(readText(folder / "flat.pdf").starts_with("%PDF-"));
    std::string said;
    if (!isRun(folder.path(), "pdftotext -layout flat.pdf -", said)) GTEST_SKIP() << said;
    for (const char* text : {"S00 Flat 1", "tower_S00_F1", "Plan 1:", "Section 1:", "197.27", "Weber", "1/3", "2/3",
                             "S00 Flat 2", "0.24", "S00 Flat 1 living room", "tower.gml", "EPSG::25832"})
        EXPECT_NE(said.find(text), std::string::npos) << text << "\n" << said;
    EXPECT_EQ(said.find('\f'), said.rfind('\f')) << "one page";
    runSvtWell(folder.path(), {"cadastre", "tower.svt", "-o", "all.pdf"});
    ASSERT_TRUE(isRun(folder.path(), "pdfinfo all.pdf", said));
    EXPECT_NE(said.find("Pages:           5"), std::string::npos) << said;
    const CommandResult none =
        runSvt(folder.path(), {"cadastre", "tower.svt", "-o", "x.pdf", "--pages-of", "class=Window"});
    EXPECT_EQ(none.exitCode, kUsage) << none.toString();
    EXPECT_FALSE(std::filesystem::exists(folder / "x.pdf"));
}

TEST_F(Cadastre, ModelsWithoutUnitsSaySo) {
    writeText(folder / "m.json", boxesModel({}));
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    const CommandResult none = runSvt(folder.path(), {"cadastre", "house.gml", "--spacing", "0.5"});
    EXPECT_EQ(none.exitCode, kUsage) << none.toString();
    EXPECT_NE(none.err.find("no legal units"), std::string::npos) << none.err;
    writeText(folder / "rooms.csv", "name=Kitchen,Ada\n");
    const json rooms =
        runSvtForJson(folder.path(), {"cadastre", "house.gml", "--spacing", "0.5", "--owners", "rooms.csv", "--json"});
    ASSERT_EQ(rooms["units"].size(), 1u);
    EXPECT_EQ(rooms["units"][0]["class"], "BuildingRoom");
}

// Two parcels whose border is 8 m east of the tower's corner.
constexpr const char* kParcels = R"({"type":"FeatureCollection",
  "crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}},"features":[
  {"type":"Feature","properties":{"id":"west"},"geometry":{"type":"Polygon","coordinates":
    [[[499990,5399990],[500008,5399990],[500008,5400030],[499990,5400030],[499990,5399990]]]}},
  {"type":"Feature","properties":{"id":"east"},"geometry":{"type":"Polygon","coordinates":
    [[[500008,5399990],[500030,5399990],[500030,5400030],[500008,5400030],[500008,5399990]]]}}]})";

TEST_F(Cadastre, ParcelsMayBePolygonsOfGisFiles) {
    writeText(folder / "parcels.geojson", kParcels);
    const auto parts = [&](const std::string& file, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"query", "tower.svt", "id=tower_S00_F1", "--parcels", file, "--json"});
        std::map<std::string, double> found;
        for (const json& row : runSvtForJson(folder.path(), more))
            found[row["parcel"].is_null() ? "-" : row["parcel"].get<std::string>()] = row["part"];
        return found;
    };
    const auto whole = parts("parcels.geojson");
    ASSERT_EQ(whole.size(), 2u);
    EXPECT_NEAR(whole.at("west"), 0.79, 0.01);
    EXPECT_NEAR(whole.at("west") + whole.at("east"), 1, 1e-9) << "without limit in height";
    const auto low = parts("parcels.geojson", {"--parcel-heights", "90,101.42"});
    EXPECT_NEAR(low.at("-"), 0.5, 0.03) << "the upper half of the flat is in no parcel";
    EXPECT_NEAR(low.at("west") / low.at("east"), whole.at("west") / whole.at("east"), 0.2);
    if (hasProgram("ogr2ogr --version")) {
        runShellWell(folder.path(),
                     "ogr2ogr -f GPKG parcels.gpkg parcels.geojson && ogr2ogr parcels.shp parcels.geojson && "
                     "ogr2ogr -t_srs EPSG:4326 -lco RFC7946=YES degrees.geojson parcels.geojson");
        // A shapefile turns the rings, so sums round differently.
        for (const char* file : {"parcels.gpkg", "parcels.shp"})
            for (const auto& [parcel, part] : parts(file)) EXPECT_NEAR(part, whole.at(parcel), 1e-9) << file;
        EXPECT_NEAR(parts("degrees.geojson").at("west"), whole.at("west"), 0.02) << "degrees have seven decimals";
    }
    EXPECT_EQ(
        runSvt(folder.path(), {"query", "tower.svt", "all", "--parcels", "parcels.geojson", "--parcel-heights", "2,1"})
            .exitCode,
        kUsage);
    EXPECT_EQ(runSvt(folder.path(), {"query", "tower.svt", "all", "--parcel-heights", "1,2"}).exitCode, kUsage);
    EXPECT_EQ(runSvt(folder.path(), {"query", "tower.svt", "all", "--parcels", "tower.gml", "--parcel-heights", "1,2"})
                  .exitCode,
              kUsage);
}

// A parcel in the CRS of the model.
std::string parcel(const std::string& id, const std::string& points) {
    return fmt::format(
        R"({{"type":"Feature","properties":{{"id":"{}"}},"geometry":{{"type":"Polygon","coordinates":[[{}]]}}}})", id,
        points);
}
std::string parcelsOf(const std::string& features) {
    return R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}},"features":[)" +
           features + "]}";
}

TEST(CadastreParcels, CutClosedSolidsExactly) {
    const TemporaryFolder folder;
    writeText(folder / "m.json", boxesModel({{"a", 0, 4}, {"b", 4, 8}}));
    // The border runs from (1, 0) to (2, 6): 9 of 24 m2 of unit a are west of it. The grid has a spacing of 0.5 m.
    const std::string west = parcel("west", "[-9,-6],[0,-6],[3,12],[-9,12],[-9,-6]");
    const std::string east = parcel("east", "[0,-6],[7,-6],[7,12],[3,12],[0,-6]");
    writeText(folder / "p.geojson", parcelsOf(west + "," + east));
    const auto ask = [&](const std::string& model, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments{"query", model, "class=BuildingUnit", "--parcels", "p.geojson", "--json"};
        if (model == "m.json") arguments.insert(arguments.end(), {"--spacing", "0.5"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        std::map<std::string, json> rows;
        for (const json& row : runSvtForJson(folder.path(), arguments))
            rows[row["id"].get<std::string>() + " " +
                 (row["parcel"].is_null() ? "-" : row["parcel"].get<std::string>())] = row;
        return rows;
    };
    const auto expect = [](const json& row, double volume, double part) {
        EXPECT_NEAR(row["volume"].get<double>(), volume, 1e-4) << row;
        EXPECT_NEAR(row["part"].get<double>(), part, 1e-6) << row;
        EXPECT_EQ(row["volumeSource"], "meshes");
        EXPECT_LT(row["volumeBound"].get<double>(), 0.001);
    };
    auto rows = ask("m.json");
    ASSERT_EQ(rows.size(), 4u);
    expect(rows["a west"], 27, 9 / 24.0);
    expect(rows["a east"], 45, 15 / 24.0);
    expect(rows["b east"], 54, 0.75);
    expect(rows["b -"], 18, 0.25);
    auto low = ask("m.json", {"--parcel-heights", "-5,0.7"});
    expect(low["a west"], 9 * 0.7, 9 * 0.7 / 72);
    expect(low["a -"], 24 * 2.3, 2.3 / 3);
    // A volume without meshes is counted, with a bound that holds. So are parcels that overlap.
    runSvtWell(folder.path(), {"build", "m.json", "-o", "plain.svt", "--spacing", "0.3", "--vectors", "none"});
    auto counted = ask("plain.svt");
    EXPECT_EQ(counted["a west"]["volumeSource"], "voxels");
    EXPECT_LT(std::abs(counted["a west"]["volume"].get<double>() - 27), counted["a west"]["volumeBound"].get<double>());
    writeText(folder / "p.geojson", parcelsOf(west + "," + parcel("east", "[-1,-6],[7,-6],[7,12],[3,12],[-1,-6]")));
    auto overlapping = ask("m.json");
    EXPECT_EQ(overlapping["a east"]["volumeSource"], "voxels");
    EXPECT_EQ(overlapping["a east"]["volumeBound"], nullptr);
}

TEST_F(Cadastre, OwnersMayBeATableOfAGeoPackage) {
    runShellWell(folder.path(), pythonOf("make_owner_table.py") + "t.gpkg none.gpkg endless.gpkg");
    writeText(folder / "t.csv",
              "feature,owner,share,right,source\ntower_S00_F1,\"Weber, A.\",1/2,,deed 7\ntower_S00_F1,Klein,1/2\n"
              "tower_S00_F2,\"Weber, A.\"\ntower_S00_F1,Bank,,mortgage,deed 8\n");
    for (const char* command : {"query", "cadastre"}) {
        const auto ask = [&](const char* table) {
            std::vector<std::string> arguments{command, "tower.svt", "--owners", table, "--json"};
            if (std::string(command) == "query") arguments.insert(arguments.begin() + 2, "id=tower_S00_F1");
            return runSvtForJson(folder.path(), arguments);
        };
        json table = ask("t.gpkg"), text = ask("t.csv");
        table.erase("sources");
        text.erase("sources");
        EXPECT_EQ(table, text) << command;
    }
    const CommandResult none = runSvt(folder.path(), {"query", "tower.svt", "all", "--owners", "none.gpkg"});
    EXPECT_EQ(none.exitCode, kInput) << none.toString();
    EXPECT_NE(none.err.find("feature and owner"), std::string::npos) << none.err;
    const CommandResult endless = runSvt(folder.path(), {"query", "tower.svt", "all", "--owners", "endless.gpkg"});
    EXPECT_NE(endless.err.find("InputTooBig"), std::string::npos) << endless.toString();
}

}  // namespace
}  // namespace svt::test

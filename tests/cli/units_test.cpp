// Legal units in every command: a flat, a storey and a building are the union of their parts. The figures are compared
// with a dense array of the samples, and with the ids that the model's hierarchy and groups give.
#include "dense_volume.hpp"
#include "run_command.hpp"

#include <svt/core/test_data_test.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace svt::test {
namespace {

using nlohmann::json;

using Ids = std::set<std::string>;

// The tower of the samples: flats have rooms, inner walls and a balcony as members, storeys have flats as children.
class Units : public ::testing::Test {
protected:
    Units() {
        prepare(folder.path(), {"sample", "tower", "-o", "tower.gml", "--storeys", "2"});
        prepare(folder.path(), {"build", "tower.gml", "-o", "tower.svt", "--spacing", "0.12"});
    }

    // A feature, and all features that reach it through parents and groups.
    Ids partsOf(const std::string& id) {
        if (features_.empty()) {
            const json info = runSvtForJson(folder.path(), {"info", "tower.svt", "--json"});
            for (const char* list : {"objects", "features"})
                for (const json& feature : info[list]) features_[feature["id"]] = feature;
        }
        Ids parts{id};
        for (std::size_t before = 0; before != parts.size();) {
            before = parts.size();
            for (const auto& [own, feature] : features_) {
                bool isPart = feature["parent"].is_string() && parts.count(feature["parent"]) != 0;
                for (const json& group : feature.value("groups", json::array()))
                    isPart = isPart || parts.count(group) != 0;
                if (isPart) parts.insert(own);
            }
        }
        return parts;
    }

    struct Counted {
        std::uint64_t voxels = 0, west = 0, columns = 0;
        std::array<double, 3> low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    };

    // Sample by sample. \param border  world x; samples below count as west
    Counted count(const Ids& ids, double border = 0) {
        if (names_.empty()) {
            dense_ = readDense(folder, "tower.svt");
            names_ = dense_.names([](const json& object) { return object["id"].get<std::string>(); });
        }
        const json& grid = dense_.info["grid"];
        const std::size_t nx = grid["dimension"][0], ny = grid["dimension"][1];
        Counted counted;
        std::set<std::size_t> columns;
        for (std::size_t s = 0; s < names_.size(); ++s) {
            if (names_[s].empty() || ids.count(names_[s]) == 0) continue;
            ++counted.voxels;
            columns.insert(s % (nx * ny));
            const std::array<std::size_t, 3> at{s % nx, s / nx % ny, s / nx / ny};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double step = grid["spacing"][axis];
                const double world = grid["origin"][axis].get<double>() + double(at[axis]) * step;
                counted.low[axis] = std::min(counted.low[axis], world - step / 2);
                counted.high[axis] = std::max(counted.high[axis], world + step / 2);
                if (axis == 0 && world < border) ++counted.west;
            }
        }
        counted.columns = columns.size();
        return counted;
    }

    json ask(std::vector<std::string> more) {
        more.insert(more.begin(), {"query", "tower.svt"});
        more.emplace_back("--json");
        return runSvtForJson(folder.path(), more);
    }

    TemporaryFolder folder;
    std::map<std::string, json> features_;

private:
    DenseVolume dense_;
    std::vector<std::string> names_;
};

const char* const kFlat = "id=tower_S00_F1";

TEST_F(Units, HaveTheVoxelsBoxAndSurfaceOfTheirParts) {
    const json rows =
        ask({"class=BuildingUnit or class=Storey or class=Building or class=BuildingRoom", "--with", "surface,box"});
    ASSERT_EQ(rows.size(), 10u + 2 + 1 + 40);
    for (const json& row : rows) {
        const std::string id = row["id"];
        const Counted total = count(partsOf(id)), own = count({id});
        EXPECT_EQ(row["totalVoxels"], total.voxels) << id;
        EXPECT_EQ(row["ownVoxels"], own.voxels) << id;
        // Boxes of meshes end within a voxel of those of voxels.
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(row["totalBox"]["min"][axis].get<double>(), total.low[axis], 0.12) << id;
            EXPECT_NEAR(row["totalBox"]["max"][axis].get<double>(), total.high[axis], 0.12) << id;
        }
        if (id == "tower") {
            const std::array<double, 2> low{500000, 5399998.5}, high{500020.48, 5400018.38};
            for (std::size_t axis = 0; axis < 2; ++axis) {
                EXPECT_NEAR(row["totalBox"]["min"][axis].get<double>(), low[axis], 2e-6);
                EXPECT_NEAR(row["totalBox"]["max"][axis].get<double>(), high[axis], 2e-6);
            }
        }
        EXPECT_GT(row["totalSurface"]["area"].get<double>(), 1) << id;
    }
    // A flat of 197.266 m3 and its balcony of 1.427 m3.
    const json flat = ask({kFlat, "--with", "volume,surface"})[0];
    EXPECT_NEAR(flat["totalVolume"].get<double>(), 197.266 + 1.427, 0.01);
    EXPECT_NEAR(flat["solidVolume"].get<double>(), 197.266, 0.001);
    EXPECT_LT(flat["countedVolume"].get<double>(), 0.01);
    // 9.76 x 7.01 m and 2.83 m high, with the balcony: contacts between its rooms and inner walls are inside.
    EXPECT_NEAR(flat["totalSurface"]["area"].get<double>(), 260, 15);
}

TEST_F(Units, HaveNoMeasureWhereNoneIsKnown) {
    const json rows = ask({"class=Storey or class=CeilingSurface"});
    for (const json& row : rows) {
        EXPECT_TRUE(row["ownVolume"].is_null()) << row;
        EXPECT_EQ(row["totalVolume"].is_null(), row["class"] == "CeilingSurface") << row;
        EXPECT_TRUE(row["solidVolume"].is_null()) << row;
    }
}

struct Outline {
    double area = 0;
    std::array<double, 2> low{1e300, 1e300}, high{-1e300, -1e300};
};

Outline outlineOf(const json& feature) {
    Outline outline;
    const json& corner = feature["geometry"]["coordinates"][0][0];
    for (const json& ring : feature["geometry"]["coordinates"])
        for (std::size_t n = 0; n + 1 < ring.size(); ++n) {
            const auto at = [&](std::size_t point, std::size_t axis) { return ring[point][axis].get<double>(); };
            outline.area += ((at(n, 0) - corner[0].get<double>()) * (at(n + 1, 1) - corner[1].get<double>()) -
                             (at(n + 1, 0) - corner[0].get<double>()) * (at(n, 1) - corner[1].get<double>())) /
                            2;
            for (std::size_t axis = 0; axis < 2; ++axis) {
                outline.low[axis] = std::min(outline.low[axis], at(n, axis));
                outline.high[axis] = std::max(outline.high[axis], at(n, axis));
            }
        }
    return outline;
}

TEST_F(Units, HaveTheirOutlineAndPlanAreaInTables) {
    runSvtWell(folder.path(), {"convert", "tower.svt", "units.geojson", "--select", "class=BuildingUnit"});
    const json features = json::parse(readText(folder / "units.geojson"))["features"];
    ASSERT_EQ(features.size(), 10u);
    for (const json& feature : features) {
        const json& row = feature["properties"];
        const Counted total = count(partsOf(row["id"]));
        EXPECT_EQ(row["totalVoxels"], total.voxels);
        // The area and outline are those of the meshes without balconies, within a voxel of those of voxels.
        Ids ids = partsOf(row["id"]);
        std::erase_if(ids, [&](const std::string& id) { return features_[id]["class"] == "BuildingInstallation"; });
        const Counted inPlan = count(ids);
        EXPECT_NEAR(row["area"].get<double>(), double(inPlan.columns) * 0.12 * 0.12, 0.02 * row["area"].get<double>());
        // Heights of meshes lie within a voxel of those of voxels.
        EXPECT_NEAR(row["lowest"].get<double>(), total.low[2], 0.12);
        EXPECT_NEAR(row["highest"].get<double>(), total.high[2], 0.12);
        const Outline outline = outlineOf(feature);
        EXPECT_NEAR(outline.area, row["area"].get<double>(), 1e-6 * outline.area);
        for (std::size_t axis = 0; axis < 2; ++axis) {
            EXPECT_NEAR(outline.low[axis], inPlan.low[axis], 0.12);
            EXPECT_NEAR(outline.high[axis], inPlan.high[axis], 0.12);
        }
    }
    // The table of objects says the same.
    runSvtWell(folder.path(), {"convert", "tower.svt", "all.csv"});
    const std::string csv = readText(folder / "all.csv");
    const std::size_t at = csv.find(",tower_S00_F1,BuildingUnit,");
    ASSERT_NE(at, std::string::npos);
    const std::string line = csv.substr(at, csv.find("\r\n", at) - at);
    EXPECT_NE(line.find(fmt::format(",{},{},", count({"tower_S00_F1"}).voxels, count(partsOf("tower_S00_F1")).voxels)),
              std::string::npos)
        << line;
}

TEST_F(Units, AreDividedByParcelsWithAllTheirParts) {
    writeText(folder / "parcels.city.json", R"({"type":"CityJSON","version":"2.0",
        "transform":{"scale":[1,1,1],"translate":[500000,5400000,0]},"CityObjects":{
        "west":{"type":"GenericCityObject","geometry":[{"type":"Solid","lod":"1",
          "boundaries":[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]]}]}},
        "vertices":[[-9,-9,50],[8,-9,50],[8,40,50],[-9,40,50],[-9,-9,200],[8,-9,200],[8,40,200],[-9,40,200]]})");
    const json rows = ask({"class=BuildingUnit or class=Building", "--parcels", "parcels.city.json"});
    std::map<std::string, double> sums;
    bool isDivided = false;
    for (const json& row : rows) {
        const std::string id = row["id"];
        const Counted all = count(partsOf(id), 500008);
        sums[id] += row["part"].get<double>();
        const std::uint64_t expected = row["parcel"] == "west" ? all.west : all.voxels - all.west;
        EXPECT_EQ(row["voxels"], expected) << row;
        EXPECT_NEAR(row["part"].get<double>(), double(expected) / double(all.voxels), 0.02) << "by meshes: " << row;
        isDivided = isDivided || (id == "tower_S00_F1" && row["part"] > 0.7 && row["part"] < 0.85);
    }
    EXPECT_TRUE(isDivided) << "79 % of the flat lie in the west: " << rows;
    EXPECT_EQ(sums.size(), 11u);
    for (const auto& [id, sum] : sums) EXPECT_NEAR(sum, 1, 1e-9) << id;
}

TEST_F(Units, HaveNeighboursOutsideOfThem) {
    const json rows = ask({kFlat, "--neighbours"});
    const Ids parts = partsOf("tower_S00_F1");
    double sum = 0;
    for (const json& row : rows) {
        sum += row["area"].get<double>();
        EXPECT_TRUE(row["neighbour"].is_null() || parts.count(row["neighbour"]) == 0) << row;
    }
    const json flat = ask({kFlat, "--with", "surface"})[0];
    EXPECT_NEAR(sum, flat["totalSurface"]["area"].get<double>(), 1e-9 * sum);
    EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [](const json& row) {
        return row["neighbour"] == "tower_S00_wall_party_south_1" && row["area"] > 15;
    })) << rows;
}

TEST_F(Units, AreOneStretchOfARayAndHaveTheRoomsOfTheirAreas) {
    // Through living room, inner wall and bedroom of the flat, 2 m above the floor.
    const json rows = ask({kFlat, "--along", "0,3,2.5:1,0,0"});
    ASSERT_EQ(rows.size(), 1u) << rows;
    EXPECT_EQ(rows[0]["id"], "tower_S00_F1");
    EXPECT_NEAR(rows[0]["length"].get<double>(), 9.82, 0.3);
    std::size_t rooms = 0;
    for (const json& row : ask({kFlat, "--areas"})) rooms += row["kind"] == "room" ? 1 : 0;
    EXPECT_EQ(rooms, 4u);
}

TEST_F(Units, AreSummedByOwnerEachVoxelOnce) {
    std::map<std::string, json> byOwner;
    for (const json& row : ask({"all", "--by", "owner"}))
        if (row["owner"].is_string()) byOwner[row["owner"]] = row;
    ASSERT_TRUE(byOwner.count("F. Weber"));
    const json flat = ask({kFlat, "--sort", "area"})[0];
    EXPECT_NEAR(byOwner["F. Weber"]["area"].get<double>(), flat["area"].get<double>(), 1e-6) << "its rooms add nothing";
    EXPECT_NEAR(byOwner["F. Weber"]["totalVolume"].get<double>(), 198.69, 0.01);
    // All features together are the building: rooms are not added to flats, nor flats to storeys.
    const json all = ask({"all", "--by", "nothing"});
    const json building = ask({"class=Building"})[0];
    ASSERT_EQ(all.size(), 1u);
    // The list counts in voxels what solids lost to others. The sums are exact, on any grid.
    const double total = all[0]["totalVolume"].get<double>();
    EXPECT_NEAR(total, building["totalVolume"].get<double>(), 0.001 * total);
    EXPECT_NEAR(total, 2263.4405, 0.01);
    EXPECT_EQ(all[0]["countedVolume"], 0);
    double ofClasses = 0;
    for (const json& row : ask({"all", "--by", "class"}))
        ofClasses += row["totalVolume"].is_null() ? 0 : row["totalVolume"].get<double>();
    EXPECT_NEAR(ofClasses, all[0]["totalVolume"].get<double>(), 1e-6);
    EXPECT_EQ(all[0]["features"], features_.empty() ? all[0]["features"] : json(features_.size()));
}

TEST_F(Units, AreSummedByTheirClassNotByAnAttributeOfThatName) {
    for (const json& row : ask({"class=BuildingUnit", "--by", "class"})) EXPECT_EQ(row["class"], "BuildingUnit");
    for (const json& row : ask({"class=BuildingUnit", "--by", "\"class\""})) EXPECT_TRUE(row["\"class\""].is_null());
}

TEST_F(Units, BelongToSeveralOwnersByShares) {
    writeText(folder / "owners.csv",
              "feature,owner,share\ntower_S00_F1,Weber,1/2\ntower_S00_F1,Klein,50%\ntower_S00_F2,Weber\n"
              "tower_S00_storey,owners of the storey\ntower,all owners\n");
    const json report = ask({"id=tower_S00_F1", "--owners", "owners.csv"});
    std::map<std::string, double> own;
    double sum = report["unowned"].get<double>() + report["untouched"].get<double>();
    for (const json& owner : report["owners"]) {
        own[owner["owner"]] = owner["own"];
        sum += owner["total"].get<double>();
    }
    EXPECT_NEAR(own["Weber"], 198.69 / 2 + 198.69, 0.05);
    EXPECT_NEAR(own["Klein"], 198.69 / 2, 0.05);
    EXPECT_NEAR(sum + report["unownedSpaces"].get<double>(), report["all"].get<double>(), 1e-6);
    const json rows = ask({"id=tower or id=tower_S00_storey"});
    const double tower = rows[0]["totalVolume"], storey = rows[1]["totalVolume"];
    EXPECT_NEAR(report["all"].get<double>(), tower, 1e-6) << "each part once";
    EXPECT_NEAR(own["owners of the storey"], storey - 2 * 198.69, 0.1) << "the rest beside the flats";
    EXPECT_NEAR(own["all owners"], tower - storey, 1e-6);
    EXPECT_EQ(report["common"], json::array()) << "the building itself is in the table";

    writeText(folder / "twice.csv", "tower_S00_F1,Weber\ntower_S00_F1,Klein\n");
    const CommandResult twice = runSvt(folder.path(), {"query", "tower.svt", "all", "--owners", "twice.csv"});
    EXPECT_EQ(twice.exitCode, 3);
    EXPECT_NE(twice.err.find("a share, such as 1/2"), std::string::npos) << twice.err;
}

TEST_F(Units, AreShownHiddenAndCutOutAsAWhole) {
    const Ids parts = partsOf("tower_S00_F1");
    const std::uint64_t voxels = count(parts).voxels;
    const auto filled = [&](const std::string& file) {
        std::uint64_t sum = 0;
        const json info = runSvtForJson(folder.path(), {"info", file, "--json"});
        for (const json& object : info["objects"]) sum += object["ownVoxels"].get<std::uint64_t>();
        return sum;
    };
    runSvtWell(folder.path(), {"convert", "tower.svt", "flat.nrrd", "--select", kFlat});
    runSvtWell(folder.path(), {"build", "flat.nrrd", "-o", "flat.svt"});
    EXPECT_EQ(filled("flat.svt"), voxels);
    runSvtWell(folder.path(), {"build", "tower.gml", "-o", "only.svt", "--spacing", "0.12", "--only", kFlat});
    EXPECT_EQ(filled("only.svt"), voxels);

    const auto section = [&](const char* option) {
        return runSvtForJson(folder.path(), {"section", "tower.svt", "--plane", "z=2.5", option, kFlat, "--json"});
    };
    const json shown = section("--show"), hidden = section("--hide");
    EXPECT_GE(shown["components"].size(), 6u);
    for (const json& component : shown["components"]) EXPECT_TRUE(parts.count(component["id"])) << component;
    for (const json& component : hidden["components"]) EXPECT_FALSE(parts.count(component["id"])) << component;
    const auto flat = std::find_if(shown["spaces"].begin(), shown["spaces"].end(),
                                   [](const json& space) { return space["id"] == "tower_S00_F1"; });
    ASSERT_NE(flat, shown["spaces"].end()) << shown;
    EXPECT_NEAR((*flat)["area"].get<double>(), shown["area"].get<double>(), 1e-5);
    EXPECT_NEAR((*flat)["area"].get<double>(), 9.82 * 7, 2);

    const auto picture = [&](const std::string& name, const std::string& option, const std::string& query) {
        runSvtWell(folder.path(), {"render", "tower.svt", "-o", name, "--size", "160x120", option, query});
        return readText(folder / name);
    };
    for (const char* option : {"--show", "--hide", "--highlight"})
        EXPECT_TRUE(picture("id.png", option, kFlat) == picture("under.png", option, "under tower_S00_F1")) << option;
    // One opening for the whole flat.
    EXPECT_FALSE(picture("id.png", "--cutaway", kFlat) == picture("all.png", "--show", "all"));
}

TEST_F(Units, AreNamedOverTheirParts) {
    const CommandResult result =
        runSvt(folder.path(), {"render", "tower.svt", "-o", "names.png", "--size", "640x480", "--camera", "top",
                               "--ortho", "--section", "z=2", "--names", "class=BuildingUnit and name~S00"});
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_EQ(result.err.find("left out"), std::string::npos) << result.err;
}

// A CityJSON model of boxes: id, type, parent, and x0, x1, y0, y1, z1 in metres.
struct Part {
    std::string id, type, parent;
    std::array<double, 5> box;
};

std::string modelOf(const std::vector<Part>& parts, const std::string& more = {}) {
    std::string objects, vertices;
    for (const Part& part : parts) {
        const auto& [x0, x1, y0, y1, z1] = part.box;
        std::string children;
        for (const Part& child : parts)
            if (child.parent == part.id) children += (children.empty() ? "\"" : ",\"") + child.id + "\"";
        objects += fmt::format("{}\"{}\":{{\"type\":\"{}\"", objects.empty() ? "" : ",", part.id, part.type);
        if (!part.parent.empty()) objects += fmt::format(",\"parents\":[\"{}\"]", part.parent);
        if (!children.empty()) objects += ",\"children\":[" + children + "]";
        if (z1 > 0) {
            const auto n = std::count(vertices.begin(), vertices.end(), '[');
            std::string faces;
            for (const auto& face :
                 {std::array{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}})
                faces += fmt::format("{}[[{},{},{},{}]]", faces.empty() ? "" : ",", n + face[0], n + face[1],
                                     n + face[2], n + face[3]);
            objects += ",\"geometry\":[{\"type\":\"Solid\",\"lod\":\"3\",\"boundaries\":[[" + faces + "]]}]";
            for (const double z : {0.0, z1})
                for (const auto& [x, y] : {std::pair{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}})
                    vertices += fmt::format("{}[{:.0f},{:.0f},{:.0f}]", vertices.empty() ? "" : ",", 1000 * x, 1000 * y,
                                            1000 * z);
        }
        objects += "}";
    }
    return R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.001,0.001,0.001],"translate":[0,0,0]},)"
           "\"CityObjects\":{" +
           objects + more + "},\"vertices\":[" + vertices + "]}";
}

json checkedUnits(const TemporaryFolder& folder, const std::string& model, int exitCode) {
    writeText(folder / "model.json", model);
    const CommandResult result = runSvt(folder.path(), {"check", "model.json", "--json"});
    EXPECT_EQ(result.exitCode, exitCode) << result.toString();
    return result.json()["legalUnits"];
}

// Two flats of 8 x 8 x 3 m on one storey, 0.3 m from a corridor, each with a door.
std::vector<Part> storeyOfTwoFlats() {
    return {{"house", "Building", "", {}},
            {"ground", "BuildingStorey", "house", {}},
            {"west", "BuildingUnit", "ground", {0, 8, 0.3, 8, 3}},
            {"east", "BuildingUnit", "ground", {8, 16, 0.3, 8, 3}},
            {"corridor", "BuildingRoom", "ground", {0, 16, -2, 0, 3}},
            {"wall", "BuildingConstructiveElement", "ground", {0, 16, 0, 0.3, 3}},
            {"west_door", "+Door", "wall", {1, 2, 0, 0.3, 2.1}},
            {"east_door", "+Door", "wall", {12, 13, 0, 0.3, 2.1}}};
}

TEST(CheckedUnits, MayTouchButNotOverlap) {
    const TemporaryFolder folder;
    std::vector<Part> parts = storeyOfTwoFlats();
    json units = checkedUnits(folder, modelOf(parts), 0);
    EXPECT_EQ(units["overlaps"], json::array());
    EXPECT_EQ(units["gaps"], json::array());
    ASSERT_EQ(units["units"].size(), 2u);
    for (const json& unit : units["units"]) EXPECT_EQ(unit["access"], "common") << unit;
    // 0.1 x 7.7 x 3 m are claimed by both.
    parts[3].box[0] = 7.9;
    units = checkedUnits(folder, modelOf(parts), 4);
    ASSERT_EQ(units["overlaps"].size(), 1u);
    EXPECT_NEAR(units["overlaps"][0]["volume"].get<double>(), 2.31, 1e-3);
    EXPECT_LT(units["overlaps"][0]["bound"].get<double>(), 1e-3);
    // Thinner than a voxel, and within the tolerance.
    parts[3].box[0] = 7.998;
    EXPECT_EQ(checkedUnits(folder, modelOf(parts), 4)["overlaps"].size(), 1u);
    const CommandResult tolerant = runSvt(folder.path(), {"check", "model.json", "--json", "--overlap", "0.002"});
    EXPECT_EQ(tolerant.json()["legalUnits"]["overlaps"], json::array()) << tolerant.toString();
}

TEST(CheckedUnits, WithoutSolidsAreTheirRooms) {
    const TemporaryFolder folder;
    std::vector<Part> parts = storeyOfTwoFlats();
    parts[2].box = parts[3].box = {};
    parts.push_back({"west_room", "BuildingRoom", "west", {0, 8, 0.3, 8, 3}});
    parts.push_back({"east_room", "BuildingRoom", "east", {7.5, 16, 0.3, 8, 3}});
    const json units = checkedUnits(folder, modelOf(parts), 4);
    ASSERT_EQ(units["overlaps"].size(), 1u);
    EXPECT_EQ(units["overlaps"][0]["a"], "west");
    EXPECT_NEAR(units["overlaps"][0]["volume"].get<double>(), 0.5 * 7.7 * 3, 1e-3);
    for (const json& unit : units["units"]) EXPECT_EQ(unit["access"], "common") << unit;
}

TEST(CheckedUnits, FillTheirStorey) {
    const TemporaryFolder folder;
    std::vector<Part> parts = storeyOfTwoFlats();
    parts[1].box = {0, 16, -2, 8, 3};
    EXPECT_EQ(checkedUnits(folder, modelOf(parts), 0)["gaps"], json::array());
    parts[3].box[1] = 15;
    const json gaps = checkedUnits(folder, modelOf(parts), 4)["gaps"];
    ASSERT_EQ(gaps.size(), 1u);
    EXPECT_EQ(gaps[0]["storey"], "ground");
    EXPECT_NEAR(gaps[0]["volume"].get<double>(), 1 * 7.7 * 3, 0.05 * 23.1);
    EXPECT_NEAR(gaps[0]["box"]["min"][0].get<double>(), 15, 0.1);
}

TEST(CheckedUnits, AreReachedByACommonPart) {
    const TemporaryFolder folder;
    std::vector<Part> parts = storeyOfTwoFlats();
    const auto access = [&](int exitCode) {
        std::map<std::string, json> byId;
        const json units = checkedUnits(folder, modelOf(parts), exitCode);
        for (const json& unit : units["units"]) byId[unit["id"]] = unit["access"];
        return byId;
    };
    parts[7].type = "BuildingFurniture";
    auto found = access(4);
    EXPECT_EQ(found["west"], "common");
    EXPECT_EQ(found["east"], "none");
    // A door to the outside is a note, no defect.
    parts[7] = {"east_door", "+Door", "house", {16, 16.1, 3, 4, 2.1}};
    EXPECT_EQ(access(0)["east"], "outside");
    // Without doors it is unknown.
    parts.resize(6);
    found = access(0);
    EXPECT_TRUE(found["west"].is_null() && found["east"].is_null());
    EXPECT_NE(runSvt(folder.path(), {"check", "model.json", "-v"}).err.find("unknown whether a common part reaches 2"),
              std::string::npos);
    // A model without units has no tests of units.
    parts[2].type = parts[3].type = "BuildingRoom";
    EXPECT_TRUE(checkedUnits(folder, modelOf(parts), 0).is_null());
}

TEST(UnitsOfRealModels, RoomsHaveNoMaterialOfTheWallsAroundThem) {
    SVT_NEEDS_DATA(model, "sig3d_lod4_citygml2.gml");
    const TemporaryFolder folder;
    runSvtWell(folder.path(), {"build", model.string(), "-o", "b.svt", "--spacing", "0.1"});
    const json rows =
        runSvtForJson(folder.path(), {"query", "b.svt", "class=Building or class=BuildingRoom", "--json"});
    ASSERT_EQ(rows.size(), 2u);
    const double building = rows[0]["totalVolume"], room = rows[1]["totalVolume"];
    EXPECT_NEAR(room, 160.53, 1) << "walls, floor and ceiling of this model are bodies of 10 cm around the room";
    EXPECT_NEAR(building, 199.5, 4) << "they belong to the building, whose solid has 199.5 m3";
}

}  // namespace
}  // namespace svt::test

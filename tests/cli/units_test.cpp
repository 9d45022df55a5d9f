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
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(row["totalBox"]["min"][axis].get<double>(), total.low[axis], 1e-6) << id;
            EXPECT_NEAR(row["totalBox"]["max"][axis].get<double>(), total.high[axis], 1e-6) << id;
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

// The corners of the first ring, without repeating the first.
std::vector<std::array<double, 2>> ringOf(const json& feature) {
    std::vector<std::array<double, 2>> ring;
    for (const json& point : feature["geometry"]["coordinates"][0]) ring.push_back({point[0], point[1]});
    ring.pop_back();
    return ring;
}

TEST_F(Units, HaveTheirOutlineAndPlanAreaInTables) {
    runSvtWell(folder.path(), {"convert", "tower.svt", "units.geojson", "--select", "class=BuildingUnit"});
    const json features = json::parse(readText(folder / "units.geojson"))["features"];
    ASSERT_EQ(features.size(), 10u);
    for (const json& feature : features) {
        const json& row = feature["properties"];
        const Counted total = count(partsOf(row["id"]));
        EXPECT_EQ(row["totalVoxels"], total.voxels);
        EXPECT_NEAR(row["area"].get<double>(), double(total.columns) * 0.12 * 0.12, 1e-6);
        EXPECT_NEAR(row["lowest"].get<double>(), total.low[2], 1e-6);
        EXPECT_NEAR(row["highest"].get<double>(), total.high[2], 1e-6);
        std::array<double, 2> low{1e300, 1e300}, high{-1e300, -1e300};
        double twice = 0;
        const auto ring = ringOf(feature);
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const auto &a = ring[n], &b = ring[(n + 1) % ring.size()];
            twice += (a[0] - ring[0][0]) * (b[1] - ring[0][1]) - (b[0] - ring[0][0]) * (a[1] - ring[0][1]);
            for (std::size_t axis = 0; axis < 2; ++axis) {
                low[axis] = std::min(low[axis], a[axis]);
                high[axis] = std::max(high[axis], a[axis]);
            }
        }
        EXPECT_GE(twice / 2, row["area"].get<double>() - 1e-6) << "the outline is convex";
        for (std::size_t axis = 0; axis < 2; ++axis) {
            EXPECT_NEAR(low[axis], total.low[axis], 1e-6);
            EXPECT_NEAR(high[axis], total.high[axis], 1e-6);
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
        EXPECT_NEAR(row["part"].get<double>(), double(expected) / double(all.voxels), 1e-9);
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
    EXPECT_NEAR(byOwner["F. Weber"]["area"].get<double>(), double(count(partsOf("tower_S00_F1")).columns) * 0.12 * 0.12,
                1e-6);
    EXPECT_NEAR(byOwner["F. Weber"]["totalVolume"].get<double>(), 198.69, 0.01);
    // All features together are the building: rooms are not added to flats, nor flats to storeys.
    const json all = ask({"all", "--by", "nothing"});
    const json building = ask({"class=Building"})[0];
    ASSERT_EQ(all.size(), 1u);
    EXPECT_NEAR(all[0]["totalVolume"].get<double>(), building["totalVolume"].get<double>(), 1e-6);
    EXPECT_EQ(all[0]["features"], features_.empty() ? all[0]["features"] : json(features_.size()));
}

TEST_F(Units, AreShownHiddenAndCutOutAsAWhole) {
    const Ids parts = partsOf("tower_S00_F1");
    const std::uint64_t voxels = count(parts).voxels;
    const auto filled = [&](const std::string& file) {
        std::uint64_t sum = 0;
        for (const json& object : runSvtForJson(folder.path(), {"info", file, "--json"})["objects"])
            sum += object["ownVoxels"].get<std::uint64_t>();
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

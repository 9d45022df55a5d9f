// `svt shell`: volumes and meshes of hulls, and rejected requests.
#include "dense_volume.hpp"
#include "run_command.hpp"

#include <svt/core/test_data_test.hpp>

#include <cstring>

namespace svt::test {
namespace {

using nlohmann::json;

class Shell : public ::testing::Test {
protected:
    Shell() {
        prepare(folder.path(), {"sample", "tower", "-o", "tower.gml"});
        prepare(folder.path(), {"build", "tower.gml", "-o", "tower.svt", "--spacing", "0.25"});
    }
    json shell(const std::string& output, std::vector<std::string> options) {
        std::vector<std::string> arguments{"shell", "tower.svt", "-o", output, "--json"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return runSvtForJson(folder.path(), arguments);
    }
    // The JSON chunk of a .glb.
    json scene(const std::string& file) {
        const std::string bytes = readText(folder / file);
        EXPECT_EQ(bytes.substr(0, 4), "glTF");
        std::uint32_t length = 0;
        std::memcpy(&length, bytes.data() + 12, 4);
        return json::parse(bytes.substr(20, length));
    }
    std::uint64_t voxels(const std::string& volume, const std::string& query) {
        std::uint64_t sum = 0;
        for (const json& row : runSvtForJson(folder.path(), {"query", volume, query, "--json"}))
            sum += row.at("voxels").get<std::uint64_t>();
        return sum;
    }
    TemporaryFolder folder;
};

TEST_F(Shell, LevelsOfTheTower) {
    const json levels = runSvtForJson(folder.path(), {"shell", "tower.svt", "--levels", "--json"});
    ASSERT_EQ(levels.size(), 5u);
    const std::vector<std::string> names{"component", "room", "unit", "storey", "building"};
    for (std::size_t l = 0; l < names.size(); ++l) EXPECT_EQ(levels[l].at("level"), names[l]);
    EXPECT_EQ(levels[1].at("features"), 160);
    EXPECT_EQ(levels[2].at("features"), 40);  // four flats and the common area of eight storeys
    EXPECT_EQ(levels[3], (json{{"level", "storey"}, {"features", 8}, {"groups", 8}}));
    EXPECT_EQ(levels[4], (json{{"level", "building"}, {"features", 1}, {"groups", 1}}));
    for (std::size_t l = 1; l < levels.size(); ++l)
        EXPECT_LT(levels[l].at("groups").get<int>(), levels[l - 1].at("groups").get<int>());
}

TEST_F(Shell, EveryStepLeavesLess) {
    std::uint64_t before = 0;
    for (const char* level : {"component", "room", "unit", "storey", "building"}) {
        const json figures = shell(std::string(level) + ".svt", {"--level", level, "--thickness", "0.25"});
        const std::uint64_t left = figures.at("voxels");
        EXPECT_LT(left, before == 0 ? figures.at("voxelsBefore").get<std::uint64_t>() : before) << level;
        EXPECT_EQ(voxels(std::string(level) + ".svt", "voxels>0"), left);
        before = left;
    }
    // The interior is removed; labels and queries are kept.
    EXPECT_EQ(voxels("building.svt", "name~'wall of bath'"), 0u);
    EXPECT_GT(voxels("building.svt", "name~'Exterior wall'"), 0u);
    EXPECT_EQ(voxels("building.svt", "name~'Party wall'"), 0u);
    runSvtWell(folder.path(), {"render", "building.svt", "-o", "p.png", "--size", "80x60", "--hide", "class=Window"});
}

TEST_F(Shell, OutsideIsAsBefore) {
    // The first voxel of each column from below is the same as in the volume.
    shell("building.svt", {});
    const DenseVolume whole = readDense(folder, "tower.svt"), hull = readDense(folder, "building.svt");
    ASSERT_EQ(hull.scalars.size(), whole.scalars.size());
    const json& dimension = whole.info.at("grid").at("dimension");
    const std::size_t layer = dimension[0].get<std::size_t>() * dimension[1].get<std::size_t>();
    std::size_t columns = 0;
    for (std::size_t column = 0; column < layer; ++column) {
        std::size_t at = column;
        while (at < whole.scalars.size() && whole.scalars[at] == 0) at += layer;
        if (at >= whole.scalars.size()) continue;
        ++columns;
        ASSERT_EQ(hull.scalars[at], whole.scalars[at]);
    }
    EXPECT_GT(columns, 1000u);
}

TEST_F(Shell, OneFlatAlone) {
    shell("flat.svt", {"--level", "unit", "--of", "id=tower_S04_F2"});
    EXPECT_GT(voxels("flat.svt", "under tower_S04_F2"), 0u);
    EXPECT_GT(voxels("flat.svt", "name='S04 Flat 2 wall of hall'"), 0u);
    EXPECT_EQ(voxels("flat.svt", "name~'Party wall'"), 0u);
    EXPECT_EQ(voxels("flat.svt", "under tower_S04_F1"), 0u);
    // One label per group.
    shell("one.svt", {"--level", "unit", "--of", "id=tower_S04_F2", "--labels", "groups"});
    EXPECT_EQ(voxels("one.svt", "id=tower_S04_F2"), voxels("flat.svt", "voxels>0"));
}

TEST_F(Shell, MeshHasANodePerLabel) {
    const json figures = shell("building.glb", {});
    const json glb = scene("building.glb");
    EXPECT_EQ(figures.at("meshes"), glb.at("meshes").size());
    EXPECT_EQ(figures.at("bytes"), std::filesystem::file_size(folder / "building.glb"));
    std::uint64_t indices = 0;
    for (std::size_t accessor = 1; accessor < glb.at("accessors").size(); accessor += 2)
        indices += glb.at("accessors")[accessor].at("count").get<std::uint64_t>();
    EXPECT_EQ(indices, 3 * figures.at("triangles").get<std::uint64_t>());
    EXPECT_EQ(glb.at("nodes")[1].at("extras"), (json{{"id", "tower"}, {"class", "Building"}}));
    for (const json& node : glb.at("nodes"))
        if (node.contains("mesh")) {
            EXPECT_EQ(node.at("extras").at("id").get<std::string>().rfind("tower_", 0), 0u);
        }
}

TEST_F(Shell, WholeVolumeAsMesh) {
    runSvtWell(folder.path(), {"convert", "tower.svt", "tower.glb"});
    const json glb = scene("tower.glb");
    EXPECT_EQ(glb.at("meshes").size(),
              runSvtForJson(folder.path(), {"query", "tower.svt", "voxels>0", "--json"}).size());
}

TEST_F(Shell, FileDoesNotDependOnThreads) {
    for (const char* extension : {".svt", ".glb"}) {
        shell(std::string("one") + extension, {"--level", "storey", "--threads", "1"});
        shell(std::string("two") + extension, {"--level", "storey", "--threads", "2"});
        EXPECT_EQ(readText(folder / (std::string("one") + extension)),
                  readText(folder / (std::string("two") + extension)));
    }
}

TEST_F(Shell, BadArgumentsAreRefused) {
    const auto refused = [&](std::vector<std::string> options, int exitCode, const std::string& what) {
        std::vector<std::string> arguments{"shell", "tower.svt"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const CommandResult result = runSvt(folder.path(), arguments);
        EXPECT_EQ(result.exitCode, exitCode) << result.toString();
        EXPECT_NE(result.err.find(what), std::string::npos) << result.toString();
    };
    refused({}, 2, "--levels");
    refused({"-o", "s.svt", "--levels"}, 2, "--levels");
    refused({"-o", "s.obj"}, 2, ".svt, .glb");
    refused({"-o", "s.svt", "--level", "flat"}, 2, "storey");
    refused({"-o", "s.svt", "--thickness", "-1"}, 2, "at least 0");
    refused({"-o", "s.svt", "--thickness", "nan"}, 2, "not a number");
    refused({"-o", "s.svt", "--of", "class="}, 2, "E901");
    refused({"-o", "s.svt", "--of", "class=Windw"}, 2, "Window");
    refused({"-o", "no/s.svt"}, 5, "E404");
    refused({"-o", "no/s.glb"}, 5, "E404");
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    const CommandResult house =
        runSvt(folder.path(), {"shell", "house.gml", "--spacing", "0.25", "-o", "s.svt", "--level", "unit"});
    EXPECT_EQ(house.exitCode, 2);
    EXPECT_NE(house.err.find("component, room, storey, building"), std::string::npos) << house.toString();
    EXPECT_FALSE(std::filesystem::exists(folder / "s.svt"));
    const CommandResult meshes = runSvt(folder.path(), {"shell", "tower.svt", "-o", "s.glb", "--faces", "meshes"});
    EXPECT_EQ(meshes.exitCode, 0) << meshes.toString();
    EXPECT_NE(meshes.err.find("it is written as by --faces planes"), std::string::npos) << meshes.toString();
}

TEST(RealShell, HouseWithoutInside) {
    SVT_NEEDS_DATA(model, "fzk_haus_citygml3.gml");
    const TemporaryFolder folder;
    runSvtWell(folder.path(), {"build", model.string(), "-o", "house.svt", "--spacing", "0.05"});
    const json levels = runSvtForJson(folder.path(), {"shell", "house.svt", "--levels", "--json"});
    ASSERT_EQ(levels.size(), 3u);
    EXPECT_EQ(levels[0].at("groups"), 89);
    EXPECT_EQ(levels[1].at("features"), 7);
    EXPECT_EQ(levels[2], (json{{"level", "building"}, {"features", 1}, {"groups", 1}}));
    runSvtWell(folder.path(), {"shell", "house.svt", "-o", "hull.svt"});
    const auto voxels = [&](const std::string& query) {
        std::uint64_t sum = 0;
        for (const json& row : runSvtForJson(folder.path(), {"query", "hull.svt", query, "--json"}))
            sum += row.at("voxels").get<std::uint64_t>();
        return sum;
    };
    EXPECT_EQ(voxels("name=Unterzug-1 or name~'Wand-Int'"), 0u);
    // Of 1.9 million: those behind panes thinner than the hull.
    EXPECT_LT(voxels("class=BuildingRoom"), 4000u);
    for (const char* name : {"Dach-1", "Dach-2", "Bodenplatte", "Haustuer", "Wand-Ext-ERDG-1"})
        EXPECT_GT(voxels(std::string("name=") + name), 0u) << name;
}

}  // namespace
}  // namespace svt::test

/// Volumes in all formats against approved files in tests/golden/writers.

#include <svt/pipeline/sample_models_test.hpp>
#include <svt/samples/approved_test.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/writers/approved/file_record_test.hpp>
#include <svt/writers/city_tileset.hpp>
#include <svt/writers/volume_formats.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace svt::writers {
namespace {

using samples::SampleFormat, samples::SampleKind;
using volume::SemanticVolume;

struct FormatCase {
    std::string file;
    std::function<void(VolumeWriteOptions&)> set = [](VolumeWriteOptions&) {};
};

std::vector<FormatCase> denseCases() {
    const auto raw = [](VolumeWriteOptions& options) { options.isCompressed = false; };
    return {{"a.nrrd", raw},
            {"a.nrrd"},
            {"a.seg.nrrd", raw},
            {"a.vti", raw},
            {"a.vtm", raw},
            {"a.nii"},
            {"a.nii.gz"},
            {"a.tif", raw},
            {"a.ome.tiff", raw},
            {"two.zarr", [](auto& options) { options.zarr.version = 2; }},
            {"three.zarr", [](auto& options) { options.zarr.version = 3; }},
            {"a.precomputed"},
            {"meshes.precomputed", [](auto& options) { options.precomputed.hasMeshes = true; }},
            {"shards.precomputed", [](auto& options) { options.precomputed.isSharded = true; }}};
}

std::vector<FormatCase> textureCases() {
    std::vector<FormatCase> cases;
    for (const char* const ending : {".x3d", ".ade.gml"})
        for (const auto& [name, kind] : {std::pair("pixel", TextureKind::Pixel),
                                         {"image", TextureKind::Image},
                                         {"composed", TextureKind::Composed},
                                         {"atlas", TextureKind::Atlas}})
            if (kind != TextureKind::Atlas || std::string(ending) == ".x3d")
                cases.push_back({std::string(name) + ending, [kind = kind](VolumeWriteOptions& options) {
                                     options.texture = kind;
                                     options.isCompressed = false;
                                 }});
    cases.push_back({"old.ade.gml", [](auto& options) { options.cityGml.version = 2; }});
    return cases;
}

std::vector<FormatCase> sparseCases() {
    return {{"a.vdb"},
            {"levels.vdb", [](auto& options) { options.vdb.hasLevelSets = true; }},
            {"a.vox"},
            {"a.fds"},
            {"holes.fds",
             [](auto& options) {
                 options.boxes.holes = "class=Door";
                 options.boxes.vents = "class=Window";
             }},
            {"a.boxes.csv"},
            {"classes.boxes.json", [](auto& options) { options.boxes.mergeBy = MergeBy::Class; }},
            {"materials.boxes.csv", [](auto& options) { options.boxes.mergeBy = MergeBy::Material; }},
            {"a.adjacency.json"},
            {"a.graphml"},
            {"a.indoor.gml"},
            {"a.csv"},
            {"a.contacts.csv"},
            {"a.parquet"},
            {"a.contacts.parquet"}};
}

std::vector<FormatCase> triangleCases() {
    std::vector<FormatCase> cases;
    for (const char* const ending : {".glb", ".obj", ".ply", ".stl", ".usda", ".3dtiles"})
        for (const auto& [name, faces, from] : {std::tuple("planes", GlbFaces::Planes, SurfaceSource::Auto),
                                                {"voxels", GlbFaces::Voxels, SurfaceSource::Auto},
                                                {"meshes", GlbFaces::Meshes, SurfaceSource::Auto},
                                                {"planes_of_voxels", GlbFaces::Planes, SurfaceSource::Voxels},
                                                {"open", GlbFaces::Planes, SurfaceSource::Meshes}})
            cases.push_back({std::string(name) + ending, [faces = faces, from = from](VolumeWriteOptions& options) {
                                 options.faces = faces;
                                 options.from = from;
                                 options.tileset.place = Vec3d{49.1, 8.43, 110};
                                 options.tileset.lift = 47.5;
                             }});
    cases.push_back({"by_crs.3dtiles"});
    cases.push_back({"cells_by_crs.3dtiles", [](VolumeWriteOptions& options) { options.tileset.hasVoxels = true; }});
    cases.push_back({"cells.3dtiles", [](VolumeWriteOptions& options) {
                         options.tileset.hasVoxels = true;
                         options.tileset.place = Vec3d{49.1, 8.43, 110};
                     }});
    return cases;
}

void expectFiles(const std::string& name, const SemanticVolume& volume, const std::vector<FormatCase>& cases) {
    const test::TemporaryFolder folder;
    std::string text;
    for (const FormatCase& each : cases) {
        VolumeWriteOptions options;
        options.threads = 1;
        each.set(options);
        const auto place = folder.path() / fmt::format("{:016x}", test::digestOf(text));
        std::filesystem::create_directory(place);
        const auto written = writeVolume(volume, place / each.file, options);
        text += "== " + each.file + '\n';
        text += written ? approved::ofFile(place, "") : std::string(written.error().message()) + '\n';
        std::filesystem::remove_all(place);
    }
    test::expectApproved("writers/" + name, text);
}

void expectAllFiles(const std::string& name, const SemanticVolume& volume) {
    expectFiles(name + "_dense", volume, denseCases());
    expectFiles(name + "_textures", volume, textureCases());
    expectFiles(name + "_sparse", volume, sparseCases());
    expectFiles(name + "_triangles", volume, triangleCases());
}

const SemanticVolume& smallHouse() {
    static const SemanticVolume house = [] {
        SemanticVolume built = test::volumeOfSample(SampleKind::House, SampleFormat::Ifc4, 0.2);
        built.source = "house.ifc";
        return built;
    }();
    return house;
}

const SemanticVolume& towerOfTwo() {
    static const SemanticVolume tower = [] {
        samples::SampleOptions options;
        options.storeys = 2;
        options.turnDegrees = 20;
        SemanticVolume built = test::volumeOfSample(SampleKind::Tower, SampleFormat::CityGml3, 0.5, options, false);
        built.source = "tower.gml";
        return built;
    }();
    return tower;
}

TEST(ApprovedVolumes, OfASmallSample) { expectAllFiles("small", volume::test::sampleVolume({20, 17, 9})); }

TEST(ApprovedVolumes, OfAHouse) { expectAllFiles("house", smallHouse()); }

// More samples than a block, a chunk, a model or a piece of the formats holds.
TEST(ApprovedVolumes, OfManySamples) {
    SemanticVolume volume = volume::test::emptyVolume({270, 140, 75}, {0.1, 0.1, 0.1}, {1000, 2000, 50});
    volume.source = "many.gml";
    volume::test::addObject(volume, "ball", "BuildingRoom").name = "Ball";
    volume::test::addObject(volume, "slab", "BuildingConstructiveElement").color = {0.3f, 0.6f, 0.9f};
    volume::test::addObject(volume, "dust", "BuildingFurniture");
    volume::test::paint(volume, [](int i, int j, int k) {
        const int x = i - 131, y = j - 66, z = k - 35;
        if (x * x + 3 * y * y + 9 * z * z < 9000) return 1;
        if (k < 9 && (i + j) % 64 != 0) return 2;
        return (i * 7 + j * 13 + k * 29) % 4099 == 0 ? 3 : 0;
    });
    std::vector<FormatCase> cases = denseCases();
    cases.push_back({"a.vdb"});
    cases.push_back({"levels.vdb", [](auto& options) { options.vdb.hasLevelSets = true; }});
    cases.push_back({"a.vox"});
    cases.push_back({"a.stl"});
    expectFiles("many", volume, cases);
}

// Longer than a node of OpenVDB below the root, which has 4096 voxels on a side.
TEST(ApprovedVolumes, OfALongWall) {
    SemanticVolume volume = volume::test::emptyVolume({4200, 9, 9}, {0.1, 0.1, 0.1}, {1000, 2000, 50});
    volume.source = "long.gml";
    volume::test::addObject(volume, "wall", "BuildingConstructiveElement");
    volume::test::addObject(volume, "post", "BuildingFurniture");
    volume::test::paint(volume, [](int i, int j, int k) { return j == 4 ? 1 : i % 700 == 0 && k < 3 ? 2 : 0; });
    expectFiles("long", volume, {{"a.vdb"}});
}

TEST(ApprovedVolumes, OfATower) {
    expectFiles("tower_textures", towerOfTwo(), textureCases());
    expectFiles("tower_sparse", towerOfTwo(), sparseCases());
}

// A document names the level of detail that fits: 20 x 17 x 9 samples are 450 at level 1, 75 at level 2.
TEST(TextureFiles, NameTheLevelWhoseSamplesFit) {
    const test::TemporaryFolder folder;
    const auto volume = volume::test::sampleVolume({20, 17, 9});
    const auto messageFor = [&](std::uint64_t maxVoxels) {
        VolumeWriteOptions options;
        options.maxVoxels = maxVoxels;
        const auto written = writeVolume(volume, folder / "a.x3d", options);
        std::filesystem::remove(folder / "a.x3d");
        return written ? std::string() : std::string(written.error().message());
    };
    EXPECT_EQ(messageFor(3060), "");
    EXPECT_NE(messageFor(3059).find("by --texture image, or coarser by --level 1,"), std::string::npos);
    EXPECT_NE(messageFor(450).find("--level 1,"), std::string::npos);
    EXPECT_NE(messageFor(449).find("--level 2,"), std::string::npos);
    EXPECT_NE(messageFor(74).find("--level 3,"), std::string::npos);
}

// Two houses as squares of a city: the finest square, and the square around all that has fewer points.
void expectCity(const std::string& name, const std::string& crsName) {
    const test::TemporaryFolder folder;
    CityTilesetFrame frame;
    frame.corner = towerOfTwo().grid.origin() - Vec3d{30, 40, 0};
    frame.side = 200;
    frame.levels = 3;
    frame.source = "city.gml";
    frame.crsName = crsName;
    if (crsName.empty()) frame.write.tileset.place = Vec3d{49.1, 8.43, 110};
    frame.write.threads = 1;
    auto city = CityTileset::create(folder / "city.3dtiles", frame);
    ASSERT_TRUE(city) << city.error().toString();
    const auto contentOf = [&](std::vector<const SemanticVolume*> volumes, double error, double cell) {
        std::size_t next = 0;
        auto content = (*city)->make(
            [&]() -> Result<std::optional<SemanticVolume>> {
                if (next == volumes.size()) return std::optional<SemanticVolume>();
                return std::optional<SemanticVolume>(*volumes[next++]);
            },
            error, cell);
        EXPECT_TRUE(content) << content.error().toString();
        return content ? *content : TileContent{};
    };
    std::string text;
    const auto add = [&](QuadtreeNode node, const TileContent& content) {
        EXPECT_TRUE((*city)->add(node, content));
        text += fmt::format("{} features, voxels {}, error {}, box {:.4f} {:.4f} {:.4f} to {:.4f} {:.4f} {:.4f}\n",
                            content.features, content.hasVoxels, content.error, content.box.min.x, content.box.min.y,
                            content.box.min.z, content.box.max.x, content.box.max.y, content.box.max.z);
    };
    add({0, 0, 0}, contentOf({&smallHouse(), &towerOfTwo()}, 2, 1.5));
    add({2, 0, 0}, contentOf({&smallHouse()}, 0, 0));
    add({2, 1, 1}, contentOf({&towerOfTwo()}, 0, 0));
    const auto finished = (*city)->finish();
    ASSERT_TRUE(finished) << finished.error().toString();
    test::expectApproved("writers/" + name, text + approved::ofFile(folder / "city.3dtiles", "city"));
}

TEST(ApprovedVolumes, OfACity) {
    expectCity("city", "");
    expectCity("city_by_crs", "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783");
}

}  // namespace
}  // namespace svt::writers

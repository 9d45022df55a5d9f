// Surfaces of 3D Tiles and glTF from the faces of the model: their area and volume, the table of features, and bytes.
#include "../run_command.hpp"
#include "../small_model.hpp"

#include <svt/core/vec.hpp>

#include <bit>
#include <cmath>
#include <cstring>
#include <map>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

const Limits kLong = [] {
    Limits limits;
    limits.seconds = 120;
    return limits;
}();

struct Surface {
    double area = 0, volume = 0;
    std::size_t triangles = 0;
};

/// A .glb with tables of features.
class GlbFile {
public:
    explicit GlbFile(const fs::path& path) : bytes_(readText(path)) {
        std::uint32_t size = 0;
        std::memcpy(&size, bytes_.data() + 12, 4);
        json = nlohmann::json::parse(bytes_.substr(20, size));
        start_ = 28 + size;
    }

    /// Area and volume by feature of a tile; of other files by mesh.
    [[nodiscard]] std::map<std::size_t, Surface> surfaces() const {
        std::map<std::size_t, Surface> found;
        for (std::size_t m = 0; m < json["meshes"].size(); ++m)
            for (const auto& primitive : json["meshes"][m]["primitives"]) {
                const auto& attributes = primitive["attributes"];
                const auto places = numbers(attributes["POSITION"], 3), corners = numbers(primitive["indices"], 1);
                std::vector<double> features;
                if (attributes.contains("_FEATURE_ID_0")) features = numbers(attributes["_FEATURE_ID_0"], 1);
                const auto placeOf = [&](double corner) {
                    const auto v = 3 * static_cast<std::size_t>(corner);
                    return Vec3d{places[v], places[v + 1], places[v + 2]} * scale();
                };
                for (std::size_t n = 0; n + 2 < corners.size(); n += 3) {
                    const Vec3d a = placeOf(corners[n]), b = placeOf(corners[n + 1]), c = placeOf(corners[n + 2]);
                    const std::size_t feature = static_cast<std::size_t>(corners[n]);
                    Surface& surface = found[features.empty() ? m : static_cast<std::size_t>(features[feature])];
                    surface.area += length(cross(b - a, c - a)) / 2;
                    surface.volume += dot(a, cross(b, c)) / 6;
                    ++surface.triangles;
                }
            }
        return found;
    }
    [[nodiscard]] std::vector<std::string> strings(const char* name) const {
        const auto& table = json["extensions"]["EXT_structural_metadata"]["propertyTables"][0];
        std::vector<std::string> values;
        if (!hasColumn(name)) return std::vector<std::string>(table["count"].get<std::size_t>());
        const auto& column = table["properties"][name];
        const auto& enums = json["extensions"]["EXT_structural_metadata"]["schema"].value("enums", nlohmann::json());
        if (enums.contains(name)) {
            const std::size_t each = enums[name]["valueType"] == "UINT8" ? 1 : 2;
            for (std::size_t n = 0; n < table["count"].get<std::size_t>(); ++n) {
                std::uint32_t number = 0;
                std::memcpy(&number, bytes_.data() + viewOf(column["values"]) + n * each, each);
                values.push_back(enums[name]["values"][number]["name"]);
            }
            return values;
        }
        const std::vector<std::uint32_t> offsets = offsetsOf(column);
        for (std::size_t n = 0; n < table["count"].get<std::size_t>(); ++n)
            values.push_back(bytes_.substr(viewOf(column["values"]) + offsets[n], offsets[n + 1] - offsets[n]));
        return values;
    }
    [[nodiscard]] bool hasColumn(const char* name) const {
        return json["extensions"]["EXT_structural_metadata"]["propertyTables"][0]["properties"].contains(name);
    }
    [[nodiscard]] std::vector<double> reals(const char* name) const {
        const auto& table = json["extensions"]["EXT_structural_metadata"]["propertyTables"][0];
        const auto& classes = json["extensions"]["EXT_structural_metadata"]["schema"]["classes"];
        EXPECT_EQ(classes.begin().value()["properties"][name]["componentType"], "FLOAT32");
        std::vector<float> values(table["count"].get<std::size_t>());
        std::memcpy(values.data(), bytes_.data() + viewOf(table["properties"][name]["values"]), values.size() * 4);
        return {values.begin(), values.end()};
    }

    nlohmann::json json;

private:
    [[nodiscard]] double scale() const {
        return json["nodes"][0].contains("scale") ? json["nodes"][0]["scale"][0].get<double>() : 1;
    }
    [[nodiscard]] std::size_t viewOf(const nlohmann::json& number) const {
        return start_ + json["bufferViews"][number.get<std::size_t>()]["byteOffset"].get<std::size_t>();
    }
    // Offsets of texts, plain or as an index sequence of EXT_meshopt_compression: each number is the difference from one of
    // two former numbers, in groups of seven bits.
    [[nodiscard]] std::vector<std::uint32_t> offsetsOf(const nlohmann::json& column) const {
        const auto& view = json["bufferViews"][column["stringOffsets"].get<std::size_t>()];
        const std::size_t size = column.value("stringOffsetType", "UINT32") == "UINT16" ? 2 : 4;
        std::vector<std::uint32_t> offsets;
        if (!view.contains("extensions")) {
            const char* from = bytes_.data() + viewOf(column["stringOffsets"]);
            for (std::size_t n = 0; n < view["byteLength"].get<std::size_t>() / size; ++n) {
                offsets.push_back(0);
                std::memcpy(&offsets.back(), from + n * size, size);
            }
            return offsets;
        }
        const auto& packed = view["extensions"]["EXT_meshopt_compression"];
        EXPECT_EQ(packed["mode"], "INDICES");
        std::size_t at = start_ + packed["byteOffset"].get<std::size_t>() + 1;  // behind the header byte
        std::uint32_t last[2] = {0, 0};
        for (std::size_t n = 0; n < packed["count"].get<std::size_t>(); ++n) {
            std::uint32_t coded = 0;
            for (int shift = 0;; shift += 7) {
                const auto byte = static_cast<std::uint8_t>(bytes_[at++]);
                coded |= std::uint32_t(byte & 127) << shift;
                if (byte < 128) break;
            }
            std::uint32_t& base = last[coded & 1];
            coded >>= 1;
            base += coded >> 1 ^ (0u - (coded & 1));
            offsets.push_back(base);
        }
        return offsets;
    }
    [[nodiscard]] std::vector<double> numbers(const nlohmann::json& number, std::size_t each) const {
        const auto& accessor = json["accessors"][number.get<std::size_t>()];
        const auto& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        const int type = accessor["componentType"];
        const std::size_t size = type == 5123 ? 2 : 4, stride = view.value("byteStride", each * size);
        const std::size_t first = viewOf(accessor["bufferView"]) + accessor.value("byteOffset", std::size_t{0});
        std::vector<double> values;
        for (std::size_t n = 0; n < accessor["count"].get<std::size_t>(); ++n)
            for (std::size_t c = 0; c < each; ++c) {
                const char* from = bytes_.data() + first + n * stride + c * size;
                std::uint32_t whole = 0;
                std::memcpy(&whole, from, size);
                values.push_back(type == 5126 ? double(std::bit_cast<float>(whole)) : double(whole));
            }
        return values;
    }

    std::string bytes_;
    std::size_t start_ = 0;
};

/// The sums of all parts of each building, by its id. Rows name their parents.
std::map<std::string, Surface> byBuilding(const GlbFile& tile) {
    const auto ids = tile.strings("id"), parents = tile.strings("parent");
    std::map<std::string, std::string> parentOf;
    for (std::size_t n = 0; n < ids.size(); ++n) parentOf[ids[n]] = parents[n];
    std::map<std::string, Surface> sums;
    for (const auto& [feature, surface] : tile.surfaces()) {
        std::string id = ids[feature];
        while (!parentOf[id].empty()) id = parentOf[id];
        Surface& sum = sums[id];
        sum.area += surface.area;
        sum.volume += surface.volume;
    }
    return sums;
}

class ModelFaces : public ::testing::Test {
protected:
    CommandResult runWell(const std::vector<std::string>& arguments) {
        CommandResult result = runSvt(folder.path(), arguments, kLong);
        EXPECT_EQ(result.exitCode, 0) << result.toString();
        return result;
    }
    [[nodiscard]] double bytesOf(const std::string& name) const {
        double bytes = 0;
        for (const auto& file : fs::recursive_directory_iterator(folder / name))
            if (file.is_regular_file()) bytes += double(file.file_size());
        return bytes;
    }
    [[nodiscard]] double packedBytesOf(const std::string& name) {
        return std::stod(
            runShellWell(folder.path(), "for f in $(find " + name + " -type f); do gzip -6 -c $f; done | wc -c"));
    }
    TemporaryFolder folder;
};

constexpr double kBuildings = 100;
// Some of the generated buildings have rooms, and so the surface of their voxels. Others have installations, whose solids
// add to theirs.
constexpr std::size_t kMostSame = 90, kMostSameInCity = 60;

TEST_F(ModelFaces, TilesOfAVolumeHaveTheVolumeOfItsMeshes) {
    runWell({"sample", "city", "--profile", "3dbag", "--buildings", "100", "--files", "1", "-o", "files"});
    const fs::path model = fs::directory_iterator(folder / "files")->path();
    runWell({"build", model.string(), "-o", "m.svt", "--spacing", "0.5"});
    runWell({"convert", "m.svt", "m.3dtiles"});
    runWell({"convert", "m.svt", "v.3dtiles", "--from", "voxels"});
    const GlbFile tile(folder / "m.3dtiles/0.glb");
    // The rows are the same.
    EXPECT_GT(tile.strings("id").size(), 600u);
    for (const char* column : {"id", "name", "class", "parent", "storey", "attributes"}) {
        std::vector<std::string> ofVoxels;
        for (int n = 0; fs::exists(folder / ("v.3dtiles/" + std::to_string(n) + ".glb")); ++n)
            for (std::string& text : GlbFile(folder / ("v.3dtiles/" + std::to_string(n) + ".glb")).strings(column))
                ofVoxels.push_back(std::move(text));
        EXPECT_EQ(tile.strings(column), ofVoxels) << column;
    }
    // Buildings enclose the volume of their solids.
    const auto ids = tile.strings("id"), parents = tile.strings("parent");
    const auto volumes = tile.reals("volume");
    std::map<std::string, double> expected;
    std::map<std::string, std::string> parentOf;
    for (std::size_t n = 0; n < ids.size(); ++n) {
        parentOf[ids[n]] = parents[n];
        std::string id = ids[n];
        while (!parentOf[id].empty()) id = parentOf[id];
        expected[id] += volumes[n];
    }
    const auto found = byBuilding(tile);
    EXPECT_EQ(found.size(), kBuildings);
    std::size_t same = 0;
    for (const auto& [id, sum] : found) same += std::abs(sum.volume - expected[id]) <= 1e-3 * expected[id] ? 1 : 0;
    EXPECT_GE(same, kMostSame);
    EXPECT_LT(bytesOf("m.3dtiles") / kBuildings, 3150);
    EXPECT_LT(packedBytesOf("m.3dtiles") / kBuildings, 900);
    runWell({"convert", "m.svt", "c.3dtiles", "--meshopt"});
    EXPECT_LT(bytesOf("c.3dtiles") / kBuildings, 1950) << packedBytesOf("c.3dtiles");
    EXPECT_LT(packedBytesOf("c.3dtiles") / kBuildings, 520);
    const GlbFile compressed(folder / "c.3dtiles/0.glb");
    for (const char* column : {"id", "name", "class", "parent", "storey", "attributes"})
        EXPECT_EQ(compressed.strings(column), tile.strings(column)) << column;
    EXPECT_LT(bytesOf("m.3dtiles"), bytesOf("v.3dtiles") / 10);
    std::string said;
    if (!isRun(folder.path(), nodeOf("read_formats.mjs") + "tileset m.3dtiles", said)) GTEST_SKIP() << said;
}

TEST_F(ModelFaces, TilesOfACityHaveTheVolumeOfTheMeshes) {
    runWell({"sample", "city", "--profile", "berlin", "--buildings", "100", "--files", "2", "-o", "files"});
    runWell({"city", "plan", "files", "-o", "city", "--spacing", "0.5", "-q"});
    runWell({"city", "run", "city", "-q"});
    const CommandResult result = runWell({"convert", "city", "city.3dtiles"});
    EXPECT_EQ(result.err.find("have no meshes"), std::string::npos) << result.err;
    std::size_t finest = 0, same = 0;
    for (const auto& file : fs::recursive_directory_iterator(folder / "city.3dtiles/content")) {
        if (!file.is_regular_file()) continue;
        const GlbFile tile(file.path());
        if (!tile.hasColumn("attributes")) continue;  // a square around tiles
        const auto ids = tile.strings("id");
        for (const auto& [feature, surface] : tile.surfaces()) {
            const double expected = tile.reals("volume")[feature];
            EXPECT_NEAR(surface.volume, expected, 0.1 * expected) << ids[feature];
            same += std::abs(surface.volume - expected) <= 1e-3 * expected ? 1 : 0;
            ++finest;
        }
    }
    EXPECT_EQ(finest, kBuildings);
    EXPECT_GE(same, kMostSameInCity);
    EXPECT_LT(bytesOf("city.3dtiles") / kBuildings, 3600);
    EXPECT_LT(packedBytesOf("city.3dtiles") / kBuildings, 1100);
    // Simplified to points 1 m apart, all buildings are there with about their volume.
    runWell({"convert", "city", "coarse.3dtiles", "--level", "1"});
    EXPECT_LE(bytesOf("coarse.3dtiles"), bytesOf("city.3dtiles"));
    double expected = 0, simplified = 0, buildings = 0;
    for (const auto& file : fs::recursive_directory_iterator(folder / "coarse.3dtiles/content")) {
        if (!file.is_regular_file()) continue;
        const GlbFile tile(file.path());
        if (!tile.hasColumn("attributes")) continue;
        for (const auto& [feature, surface] : tile.surfaces()) {
            ++buildings;
            simplified += surface.volume;
            expected += tile.reals("volume")[feature];
        }
    }
    EXPECT_EQ(buildings, kBuildings);
    EXPECT_NEAR(simplified, expected, 0.1 * expected);
    runWell({"convert", "city", "voxels.3dtiles", "--from", "voxels"});
    EXPECT_GT(bytesOf("voxels.3dtiles"), 4 * bytesOf("city.3dtiles"));
}

// Two closed buildings, the second with a room. The second solid has the surface of its voxels, so that the room stays a hole.
TEST_F(ModelFaces, GlbHasClosedMeshesAndSaysWhatHasNone) {
    const std::string room = "<bldg:interiorRoom><bldg:Room gml:id=\"room\"><bldg:lod4Solid>" +
                             solid(boxFaces(500021, 5400001, 101, 500024, 5400004, 103)) +
                             "</bldg:lod4Solid></bldg:Room></bldg:interiorRoom>";
    writeText(folder / "m.gml",
              cityModel(building("plain", solid(boxFaces(500000, 5400000, 100, 500010, 5400007, 104))) +
                        building("roomy", solid(boxFaces(500020, 5400000, 100, 500026, 5400006, 104)), room)));
    runWell({"build", "m.gml", "-o", "m.svt", "--spacing", "0.5"});
    const CommandResult result = runWell({"convert", "m.svt", "m.glb"});
    EXPECT_NE(result.err.find("surfaces: 2 features have the faces of the model, 1 the surface of their voxels"),
              std::string::npos)
        << result.err;
    const GlbFile glb(folder / "m.glb");
    std::map<std::string, Surface> byId;
    const auto surfaces = glb.surfaces();
    for (const auto& node : glb.json["nodes"])
        if (node.contains("mesh")) byId[node["extras"]["id"]] = surfaces.at(node["mesh"]);
    ASSERT_EQ(byId.size(), 3u);
    EXPECT_EQ(byId["plain"].triangles, 12u);
    EXPECT_NEAR(byId["plain"].volume, 280, 1e-3);
    EXPECT_NEAR(byId["plain"].area, 276, 1e-3);
    EXPECT_EQ(byId["room"].triangles, 12u);
    EXPECT_NEAR(byId["room"].volume, 18, 1e-3);
    EXPECT_NEAR(byId["roomy"].volume, 144 - 18, 1) << "the room is a hole in it";
    // Voxels on request, for all.
    runWell({"convert", "m.svt", "v.glb", "--from", "voxels"});
    EXPECT_EQ(GlbFile(folder / "v.glb").surfaces().size(), 3u);
    // A volume without meshes.
    runWell({"build", "m.gml", "-o", "none.svt", "--spacing", "0.5", "--vectors", "none"});
    const CommandResult none = runWell({"convert", "none.svt", "n.glb", "--from", "meshes"});
    EXPECT_NE(none.err.find("surfaces: 0 features have the faces of the model, 3"), std::string::npos) << none.err;
    EXPECT_EQ(readText(folder / "n.glb"), readText(folder / "v.glb"));
    EXPECT_EQ(runSvt(folder.path(), {"convert", "m.svt", "x.glb", "--from", "nothing"}).exitCode, kUsage);
}

}  // namespace
}  // namespace svt::test

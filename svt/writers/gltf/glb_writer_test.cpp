#include <svt/core/file.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume/random_columns_test.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/writers/glb_writer.hpp>
#include <svt/writers/gltf/label_surface.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <map>
#include <numeric>

namespace svt::writers {
namespace {

using volume::ColumnVolume;
using volume::kNoLabel;
using volume::Scalar;
using volume::SemanticVolume;
using Json = nlohmann::json;

// Each edge of a surface is used equally often in both directions.
template <class Triangles>
::testing::AssertionResult isClosed(const Triangles& triangles) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (const auto& triangle : triangles)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t a = triangle[c], b = triangle[(c + 1) % 3];
            balance[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    for (const auto& [edge, count] : balance)
        if (count != 0)
            return ::testing::AssertionFailure() << "edge " << edge.first << "-" << edge.second << ": " << count;
    return ::testing::AssertionSuccess();
}

// Six times the enclosed volume in cubed half voxels, and twice the area perpendicular to each axis, summed over
// both directions.
struct Measure {
    std::int64_t volume = 0;
    std::array<std::int64_t, 3> area{};
    friend bool operator==(const Measure&, const Measure&) = default;
};

using Vec3l = Vec3<std::int64_t>;

Measure measureOf(const LabelSurface& surface) {
    Measure measure;
    for (const auto& triangle : surface.triangles) {
        std::array<Vec3l, 3> p;
        for (std::size_t c = 0; c < 3; ++c) {
            const Vec3i v = surface.vertices[triangle[c]];
            p[c] = {v.x, v.y, v.z};
        }
        const Vec3l normal = cross(p[1] - p[0], p[2] - p[0]);
        measure.volume += dot(p[0], cross(p[1], p[2]));
        int along = 0;
        for (int axis = 0; axis < 3; ++axis) {
            measure.area[std::size_t(axis)] += std::abs(normal[axis]);
            along += normal[axis] != 0 ? 1 : 0;
        }
        EXPECT_EQ(along, 1) << "a triangle without area, or oblique";
    }
    return measure;
}

// The same by counting voxels and their faces.
std::map<std::uint32_t, Measure> bruteForce(const ColumnVolume& columns, const std::vector<std::uint32_t>& labelOf) {
    std::map<std::uint32_t, Measure> measures;
    const Vec3i n = columns.dimension();
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) {
                const std::uint32_t label = labelOf[columns.scalarAt(i, j, k)];
                if (label == kNoLabel) continue;
                measures[label].volume += 6 * 8;
                for (int axis = 0; axis < 3; ++axis)
                    for (const int step : {-1, 1}) {
                        Vec3i p{i, j, k};
                        p[axis] += step;
                        const bool isOut = p[axis] < 0 || p[axis] >= n[axis];
                        if (isOut || labelOf[columns.scalarAt(p.x, p.y, p.z)] != label)
                            measures[label].area[std::size_t(axis)] += 2 * 4;
                    }
            }
    return measures;
}

TEST(LabelSurface, BoxHasTwelveTriangles) {
    std::vector<Scalar> dense(512, 0);
    for (std::size_t k = 1; k < 4; ++k)
        for (std::size_t j = 2; j < 8; ++j)
            for (std::size_t i = 0; i < 5; ++i) dense[i + 8 * (j + 8 * k)] = 1;
    const auto surfaces =
        labelSurfaces(ColumnVolume::fromDense({8, 8, 8}, dense), std::vector<std::uint32_t>{kNoLabel, 7});
    ASSERT_TRUE(surfaces);
    ASSERT_EQ(surfaces->size(), 1u);
    const LabelSurface& box = surfaces->front();
    EXPECT_EQ(box.label, 7u);
    EXPECT_EQ(box.vertices.size(), 8u);
    EXPECT_EQ(box.triangles.size(), 12u);
    EXPECT_TRUE(isClosed(box.triangles));
    EXPECT_EQ(measureOf(box), (Measure{6 * 8 * 5 * 6 * 3, {2 * 4 * 36, 2 * 4 * 30, 2 * 4 * 60}}));
}

TEST(LabelSurface, VoxelsThatMeetAtAnEdgeShareItFourTimes) {
    const auto surfaces = labelSurfaces(ColumnVolume::fromDense({2, 2, 2}, std::vector<Scalar>{1, 0, 0, 1, 0, 0, 0, 0}),
                                        std::vector<std::uint32_t>{kNoLabel, 0});
    ASSERT_TRUE(surfaces);
    EXPECT_TRUE(isClosed(surfaces->front().triangles));
    EXPECT_EQ(surfaces->front().vertices.size(), 14u);
    EXPECT_EQ(measureOf(surfaces->front()).volume, 2 * 48);
}

TEST(LabelSurface, IsClosedAndHasAllFacesOfItsVoxels) {
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        const ColumnVolume columns = volume::test::randomColumns({67, 66 + std::int32_t(seed), 19}, seed);
        std::vector<std::uint32_t> labelOf{kNoLabel};
        for (Scalar s = 1; s < volume::test::kRandomScalars; ++s) labelOf.push_back(s / 3);
        SurfaceOptions options;
        options.threads = 2;
        const auto surfaces = labelSurfaces(columns, labelOf, options);
        ASSERT_TRUE(surfaces);
        std::map<std::uint32_t, Measure> found;
        for (const LabelSurface& surface : *surfaces) {
            EXPECT_TRUE(isClosed(surface.triangles)) << "seed " << seed << " label " << surface.label;
            found[surface.label] = measureOf(surface);
        }
        EXPECT_EQ(found, bruteForce(columns, labelOf)) << "seed " << seed;
        options.threads = 1;
        const auto again = labelSurfaces(columns, labelOf, options);
        ASSERT_EQ(again->size(), surfaces->size());
        for (std::size_t s = 0; s < again->size(); ++s) {
            EXPECT_EQ((*again)[s].vertices, (*surfaces)[s].vertices);
            EXPECT_EQ((*again)[s].triangles, (*surfaces)[s].triangles);
        }
    }
}

TEST(LabelSurface, TooManyTrianglesAreRefused) {
    SurfaceOptions options;
    options.maxTriangles = 100;
    std::vector<std::uint32_t> labelOf(volume::test::kRandomScalars, 1);
    labelOf[0] = kNoLabel;
    const auto surfaces = labelSurfaces(volume::test::randomColumns({64, 64, 32}, 3), labelOf, options);
    ASSERT_FALSE(surfaces);
    EXPECT_EQ(surfaces.error().code(), Code::GridTooLarge);
}

// A .glb read back strictly by the standard.
struct Glb {
    Json json;
    std::string bin;

    static Glb read(const std::filesystem::path& path) {
        Glb glb;
        const auto file = FileBytes::read(path);
        EXPECT_TRUE(file);
        const std::string_view text = file->text();
        const auto word = [&](std::size_t at) {
            std::uint32_t value = 0;
            std::memcpy(&value, text.data() + at, 4);
            return value;
        };
        EXPECT_EQ(text.substr(0, 4), "glTF");
        EXPECT_EQ(word(4), 2u);
        EXPECT_EQ(word(8), text.size());
        const std::size_t jsonLength = word(12);
        EXPECT_EQ(text.substr(16, 4), "JSON");
        EXPECT_EQ(jsonLength % 4, 0u);
        glb.json = Json::parse(text.substr(20, jsonLength));
        const std::size_t binLength = word(20 + jsonLength);
        EXPECT_EQ(text.substr(24 + jsonLength, 4), std::string_view("BIN\0", 4));
        EXPECT_EQ(binLength % 4, 0u);
        EXPECT_EQ(28 + jsonLength + binLength, text.size());
        glb.bin = text.substr(28 + jsonLength);
        return glb;
    }

    // Numbers of an accessor; checks that it lies within its view, that the view lies within the buffer, and alignment.
    template <class T>
    std::vector<T> numbers(std::size_t accessor, const char* type, int componentType, int target) const {
        const Json& a = json["accessors"][accessor];
        const Json& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
        EXPECT_EQ(a["type"], type);
        EXPECT_EQ(a["componentType"], componentType);
        EXPECT_EQ(view["target"], target);
        const std::size_t components = a["type"] == "VEC3" ? 3 : 1;
        const std::size_t count = a["count"].get<std::size_t>() * components;
        const std::size_t offset = a["byteOffset"], viewOffset = view["byteOffset"], viewLength = view["byteLength"];
        EXPECT_EQ((offset + viewOffset) % 4, 0u);
        EXPECT_LE(offset + count * sizeof(T), viewLength);
        EXPECT_LE(viewOffset + viewLength, bin.size());
        if (components == 3) {
            EXPECT_EQ(view["byteStride"], 12);
        }
        std::vector<T> values(count);
        std::memcpy(values.data(), bin.data() + viewOffset + offset, count * sizeof(T));
        return values;
    }

    std::vector<std::uint32_t> indices(std::size_t accessor) const {
        if (json["accessors"][accessor]["componentType"] == 5123) {
            const auto shorts = numbers<std::uint16_t>(accessor, "SCALAR", 5123, 34963);
            return {shorts.begin(), shorts.end()};
        }
        return numbers<std::uint32_t>(accessor, "SCALAR", 5125, 34963);
    }
};

class GlbWriter : public ::testing::Test {
protected:
    Glb written(const SemanticVolume& volume) {
        const auto report = writeGlb(volume, folder / "v.glb");
        EXPECT_TRUE(report) << report.error().toString();
        EXPECT_EQ(report->bytes, std::filesystem::file_size(folder / "v.glb"));
        return Glb::read(folder / "v.glb");
    }
    test::TemporaryFolder folder;
};

TEST_F(GlbWriter, FileFollowsTheStandard) {
    const SemanticVolume volume = volume::test::sampleVolume();
    const Glb glb = written(volume);
    const Json& json = glb.json;
    EXPECT_EQ(json["asset"]["version"], "2.0");
    EXPECT_EQ(json["asset"]["extras"]["crs"], volume.crsName);
    const Vec3d corner = volume.grid.worldFromIndex({-0.5, -0.5, -0.5});
    EXPECT_EQ(json["asset"]["extras"]["origin"], Json({corner.x, corner.y, corner.z}));
    EXPECT_EQ(json["buffers"].size(), 1u);
    EXPECT_EQ(json["buffers"][0]["byteLength"], glb.bin.size());
    // Every node occurs once below the root, and all meshes, materials and accessors are used.
    std::vector<int> uses(json["nodes"].size(), 0);
    std::size_t meshes = 0;
    for (const Json& node : json["nodes"]) {
        for (const Json& child : node.value("children", Json::array())) ++uses[child.get<std::size_t>()];
        meshes += node.contains("mesh") ? 1 : 0;
    }
    uses[json["scenes"][0]["nodes"][0].get<std::size_t>()] += 1;
    EXPECT_EQ(uses, std::vector<int>(uses.size(), 1));
    EXPECT_EQ(meshes, 3u);
    EXPECT_EQ(json["meshes"].size(), 3u);
    EXPECT_EQ(json["materials"].size(), 3u);
    EXPECT_EQ(json["accessors"].size(), 6u);
    for (const Json& mesh : json["meshes"]) {
        const Json& primitive = mesh["primitives"][0];
        const std::size_t accessor = primitive["attributes"]["POSITION"];
        const auto positions = glb.numbers<float>(accessor, "VEC3", 5126, 34962);
        const auto indices = glb.indices(primitive["indices"]);
        ASSERT_EQ(indices.size() % 3, 0u);
        for (const std::uint32_t index : indices) ASSERT_LT(index, positions.size() / 3);
        std::array<float, 3> low{HUGE_VALF, HUGE_VALF, HUGE_VALF}, high{-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};
        for (std::size_t p = 0; p < positions.size(); ++p) {
            low[p % 3] = std::min(low[p % 3], positions[p]);
            high[p % 3] = std::max(high[p % 3], positions[p]);
        }
        EXPECT_EQ(json["accessors"][accessor]["min"].get<decltype(low)>(), low);
        EXPECT_EQ(json["accessors"][accessor]["max"].get<decltype(high)>(), high);
        std::vector<std::array<std::uint32_t, 3>> triangles;
        for (std::size_t t = 0; t < indices.size(); t += 3)
            triangles.push_back({indices[t], indices[t + 1], indices[t + 2]});
        EXPECT_TRUE(isClosed(triangles));
    }
}

TEST_F(GlbWriter, NodesAreTheSemanticTree) {
    const Glb glb = written(volume::test::sampleVolume());
    const Json& nodes = glb.json["nodes"];
    ASSERT_EQ(nodes.size(), 5u);  // root, building, two rooms, wall; the storey has no voxels below it
    EXPECT_EQ(nodes[1]["extras"], Json({{"id", "building"}, {"class", "Building"}}));
    EXPECT_FALSE(nodes[1].contains("mesh"));
    EXPECT_EQ(nodes[1]["children"], Json({2, 4}));
    EXPECT_EQ(nodes[2]["name"], "Küche");
    EXPECT_EQ(nodes[3]["extras"]["class"], "WallSurface");
    const Json& material = glb.json["materials"][1];
    EXPECT_EQ(material["alphaMode"], "BLEND");
    EXPECT_NEAR(material["pbrMetallicRoughness"]["baseColorFactor"][0].get<double>(), 0.01, 1e-4);
    EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorFactor"][2], 1.0);
    EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorFactor"][3], 0.25);
    // A room beside a wall is air.
    EXPECT_EQ(glb.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][3], 0);
}

TEST_F(GlbWriter, PanesHaveTheOpacityOfTheirMaterialAndRoomsAloneAreVisible) {
    volume::SemanticVolume volume = volume::test::sampleVolume();
    for (volume::Label& label : volume.labels.labels)
        if (label.className == "WallSurface") {
            label.className = "WindowPhase";
            label.opacity = 0.99f;
            label.attributes.push_back({"transparency", 0.7, ""});
        }
    const auto alphaOf = [](const Glb& glb, std::string_view name) {
        for (const Json& material : glb.json["materials"])
            if (material["name"] == name) return material["pbrMetallicRoughness"]["baseColorFactor"][3].get<double>();
        return -1.0;
    };
    const Glb glb = written(volume);
    const auto& labels = volume.labels.labels;
    const auto pane = std::find_if(labels.begin(), labels.end(),
                                   [](const volume::Label& label) { return label.className == "WindowPhase"; });
    ASSERT_NE(pane, labels.end());
    EXPECT_NEAR(alphaOf(glb, pane->name.empty() ? pane->id : pane->name), 0.3, 1e-4);
    for (volume::Label& label : volume.labels.labels)
        if (label.className == "WindowPhase") label.className = "BuildingRoom";
    const Glb rooms = written(volume);
    EXPECT_GT(alphaOf(rooms, "Küche"), 0);
}

// World position of a voxel: through the root's matrix, back to z up, plus the origin.
TEST_F(GlbWriter, CoordinatesLeadBackToTheWorld) {
    SemanticVolume volume = volume::test::sampleVolume({8, 8, 8});
    volume::test::paintBoxes(volume, {{1, {3, 2, 5}, {4, 3, 6}}});
    const Glb glb = written(volume);
    const auto positions = glb.numbers<float>(0, "VEC3", 5126, 34962);
    const auto matrix = glb.json["nodes"][0]["matrix"].get<std::vector<double>>();
    const auto origin = glb.json["asset"]["extras"]["origin"].get<std::vector<double>>();
    Vec3d middle;
    for (std::size_t p = 0; p < positions.size(); ++p) middle[int(p % 3)] += positions[p] / 8.0;
    Vec3d turned;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            turned[int(row)] += matrix[row + 4 * column] * middle[int(column)];
    const Vec3d world{origin[0] + turned.x, origin[1] - turned.z, origin[2] + turned.y};
    EXPECT_LT(length(world - volume.grid.worldFromIndex({3, 2, 5})), 1e-6);
    EXPECT_EQ(glb.indices(1).size(), 36u);
}

// A sheet that rises from 1 to 2 m, and a box: the sheet has the triangles of the model, the box those of its voxels.
TEST_F(GlbWriter, SheetsAreTheTrianglesOfTheModel) {
    SemanticVolume volume = volume::test::emptyVolume({40, 40, 40}, {0.1, 0.1, 0.1}, {0.05, 0.05, 0.05});
    volume::Label& sheet = volume::test::addObject(volume, "ground", "");
    sheet.filling = volume::Filling::Surface;
    volume::test::addObject(volume, "box", "");
    volume::test::paint(volume, [](int i, int j, int k) {
        if (i >= 10 && i < 20 && j >= 10 && j < 20 && k < 5) return 2;
        return k == 10 + i / 4 ? 1 : 0;
    });
    for (volume::Label& label : volume.labels.labels) label.voxels = 1000;
    volume::test::addQuad(volume, 0, {Vec3d{0, 0, 1}, Vec3d{4, 0, 2}, Vec3d{4, 4, 2}, Vec3d{0, 4, 1}});
    const auto trianglesOf = [&](GlbFaces faces) {
        GlbOptions options;
        options.faces = faces;
        EXPECT_TRUE(writeGlb(volume, folder / "v.glb", options));
        const Glb glb = Glb::read(folder / "v.glb");
        std::map<std::string, std::size_t> triangles;
        for (const Json& mesh : glb.json["meshes"])
            triangles[mesh["name"]] = glb.indices(mesh["primitives"][0]["indices"]).size() / 3;
        return std::pair(triangles, glb);
    };
    const auto& [triangles, glb] = trianglesOf(GlbFaces::Planes);
    EXPECT_EQ(triangles, (std::map<std::string, std::size_t>{{"box", 12}, {"ground", 2}}));
    const Json& primitive = glb.json["meshes"][1]["primitives"][0];
    EXPECT_EQ(glb.json["meshes"][1]["name"], "ground");
    EXPECT_EQ(glb.json["materials"][primitive["material"].get<std::size_t>()]["doubleSided"], true);
    const Json& accessor = glb.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
    const Vec3d corner = volume.grid.origin() - volume.grid.worldFromIndex({-0.5, -0.5, -0.5});
    EXPECT_NEAR(accessor["min"][2].get<double>(), 1 + corner.z, 1e-5);
    EXPECT_NEAR(accessor["max"][2].get<double>(), 2 + corner.z, 1e-5);
    EXPECT_NEAR(accessor["max"][0].get<double>(), 4 + corner.x, 1e-5);
    EXPECT_GT(trianglesOf(GlbFaces::Voxels).first["ground"], 100u);
}

// A slab under a slope: its oblique faces become flat and have the area of the slope; stairs have that of two sides.
TEST_F(GlbWriter, SlopesAreFlat) {
    SemanticVolume volume = volume::test::emptyVolume({40, 64, 60}, {0.1, 0.1, 0.1}, {0.05, 0.05, 0.05});
    volume::test::addObject(volume, "slab", "");
    // Between two planes that rise by 0.6 along y and 0.1 along x, bounded at the sides.
    volume::test::paint(volume, [](int i, int j, int k) {
        const double height = k + 0.5 - 0.6 * (j + 0.5) - 0.1 * (i + 0.5);
        return i >= 4 && i < 36 && j >= 4 && j < 60 && height > 3.3 && height < 12.3 ? 1 : 0;
    });
    std::array<double, 2> area{}, cubic{};
    for (const bool hasPlanes : {false, true}) {
        GlbOptions options;
        options.faces = hasPlanes ? GlbFaces::Planes : GlbFaces::Voxels;
        ASSERT_TRUE(writeGlb(volume, folder / "v.glb", options));
        const Glb glb = Glb::read(folder / "v.glb");
        const auto p = glb.numbers<float>(0, "VEC3", 5126, 34962);
        const auto indices = glb.indices(1);
        std::vector<std::array<std::uint32_t, 3>> triangles;
        for (std::size_t t = 0; t < indices.size(); t += 3) {
            triangles.push_back({indices[t], indices[t + 1], indices[t + 2]});
            std::array<Vec3d, 3> c;
            for (std::size_t v = 0; v < 3; ++v)
                c[v] = {p[3 * indices[t + v]], p[3 * indices[t + v] + 1], p[3 * indices[t + v] + 2]};
            area[hasPlanes] += length(cross(c[1] - c[0], c[2] - c[0])) / 2;
            cubic[hasPlanes] += dot(c[0], cross(c[1], c[2])) / 6;
        }
        EXPECT_TRUE(isClosed(triangles));
    }
    // Two slopes of 3.2 x 5.6 m in plan, and four vertical sides 0.9 m high.
    const double exact = 2 * 3.2 * 5.6 * std::sqrt(1 + 0.36 + 0.01) + 0.9 * 2 * (3.2 + 5.6);
    EXPECT_GT(area[0], 1.25 * exact);
    EXPECT_NEAR(area[1], exact, 0.02 * exact);
    EXPECT_NEAR(cubic[1], 3.2 * 5.6 * 0.9, 0.01 * 3.2 * 5.6 * 0.9);
}

// A thin layer extracted from a volume uses the volume's planes: its vertices are those of the volume.
TEST_F(GlbWriter, PlanesOfAnotherVolume) {
    const Vec3i n{24, 24, 24};
    SemanticVolume whole = volume::test::sampleVolume(n), layer = whole;
    const auto height = [](int j, int k) { return k - 0.7 * j - 0.2; };
    whole.columns = volume::test::paintedColumns(n, [&](int, int j, int k) { return height(j, k) < 0 ? 1 : 0; });
    layer.columns = volume::test::paintedColumns(
        n, [&](int, int j, int k) { return height(j, k) < 0 && height(j, k) > -1.5 ? 1 : 0; });
    GlbOptions options;
    options.planesOf = &whole;
    ASSERT_TRUE(writeGlb(layer, folder / "v.glb", options));
    const Glb glb = Glb::read(folder / "v.glb");
    const auto p = glb.numbers<float>(0, "VEC3", 5126, 34962);
    const Vec3d spacing = layer.grid.spacing();
    std::size_t onPlane = 0, between = 0;
    for (std::size_t v = 0; v < p.size(); v += 3) {
        // Distance from the plane of the upper side, in voxels.
        const double above = p[v + 2] / spacing.z - 0.5 - 0.7 * (p[v + 1] / spacing.y - 0.5) - 0.2;
        onPlane += std::abs(above) < 0.2 ? 1 : 0;
        between += above > 0.25 ? 1 : 0;
    }
    EXPECT_EQ(between, 0u);
    EXPECT_GT(onPlane, 2 * std::size_t(n.y) - 10);
    whole.columns = ColumnVolume::fromDense({2, 2, 2}, std::vector<Scalar>(8, 1));
    EXPECT_EQ(writeGlb(layer, folder / "v.glb", options).error().code(), Code::BadArgument);
}

TEST_F(GlbWriter, ManyVerticesGetWideIndices) {
    // A 3D checkerboard: voxels share edges only.
    const Vec3i n{40, 40, 40};
    SemanticVolume volume = volume::test::sampleVolume(n);
    volume.columns = volume::test::paintedColumns(n, [](int i, int j, int k) { return (i + j + k) % 2; });
    const Glb glb = written(volume);
    EXPECT_EQ(glb.json["accessors"][1]["componentType"], 5125);
    EXPECT_EQ(glb.indices(1).size(), 32000u * 36);
}

TEST_F(GlbWriter, BytesDoNotDependOnThreads) {
    const SemanticVolume volume = volume::test::sampleVolume();
    for (const int threads : {1, 2}) {
        GlbOptions options;
        options.threads = threads;
        ASSERT_TRUE(writeGlb(volume, folder / std::to_string(threads), options));
    }
    const auto one = FileBytes::read(folder / "1"), two = FileBytes::read(folder / "2");
    EXPECT_EQ(one->text(), two->text());
}

TEST_F(GlbWriter, NothingToWriteIsAnError) {
    SemanticVolume volume = volume::test::sampleVolume({8, 8, 8});
    volume.columns = ColumnVolume::fromDense({8, 8, 8}, std::vector<Scalar>(512, 0));
    EXPECT_EQ(writeGlb(volume, folder / "v.glb").error().code(), Code::NothingSelected);
    volume.columns = ColumnVolume::fromDense({8, 8, 4}, std::vector<Scalar>(256, 1));
    EXPECT_EQ(writeGlb(volume, folder / "v.glb").error().code(), Code::BadArgument);
    EXPECT_EQ(writeGlb(volume::test::sampleVolume(), folder / "no" / "v.glb").error().code(), Code::CannotWrite);
}

}  // namespace
}  // namespace svt::writers

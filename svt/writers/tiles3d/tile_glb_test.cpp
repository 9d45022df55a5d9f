#include <svt/writers/tiles3d/tile_glb.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace svt::writers {
namespace {

// A box with outward faces.
FeatureFaces boxFaces(Vec3d low, Vec3d high, VertexColor color = {255, 0, 0, 255}) {
    FeatureFaces faces;
    for (int corner = 0; corner < 8; ++corner)
        faces.points.push_back({corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z});
    faces.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {1, 3, 7}, {1, 7, 5}, {3, 2, 6}, {3, 6, 7}, {2, 0, 4}, {2, 4, 6}};
    faces.colors.assign(faces.triangles.size(), color);
    return faces;
}

struct Figures {
    double area = 0, volume = 0;
};

template <class Place>
Figures figuresOf(const std::vector<std::array<std::uint32_t, 3>>& triangles, const Place& placeOf) {
    Figures figures;
    for (const auto& triangle : triangles) {
        const Vec3d a = placeOf(triangle[0]), b = placeOf(triangle[1]), c = placeOf(triangle[2]);
        figures.area += length(cross(b - a, c - a)) / 2;
        figures.volume += dot(a, cross(b, c)) / 6;
    }
    return figures;
}

Figures figuresOf(const FeatureFaces& faces) {
    return figuresOf(faces.triangles, [&](std::uint32_t point) { return faces.points[point]; });
}

/// A written tile; places are metres with y up.
struct TileFile {
    nlohmann::json json;
    std::string binary;

    explicit TileFile(const std::string& file) {
        std::uint32_t size = 0;
        std::memcpy(&size, file.data() + 12, 4);
        json = nlohmann::json::parse(file.substr(20, size));
        binary = file.substr(28 + size);
    }
    template <class T>
    std::vector<T> numbers(std::size_t accessor, std::size_t each, std::size_t stride) const {
        const auto& view = json["bufferViews"][json["accessors"][accessor]["bufferView"].get<std::size_t>()];
        const auto count = json["accessors"][accessor]["count"].get<std::size_t>();
        std::vector<T> values(count * each);
        for (std::size_t n = 0; n < count; ++n)
            std::memcpy(values.data() + n * each, binary.data() + view["byteOffset"].get<std::size_t>() + n * stride,
                        each * sizeof(T));
        return values;
    }
    Figures figures() const {
        Figures sum;
        const auto& node = json["nodes"][0];
        for (const auto& primitive : json["meshes"][0]["primitives"]) {
            const auto at = primitive["attributes"]["POSITION"].get<std::size_t>();
            std::vector<double> values;
            if (json["accessors"][at]["componentType"] == 5126) {
                const auto floats = numbers<float>(at, 3, 12);
                values.assign(floats.begin(), floats.end());
            } else {
                for (const std::uint16_t step : numbers<std::uint16_t>(at, 3, 8))
                    values.push_back(step * node["scale"][0].get<double>());
            }
            std::vector<std::array<std::uint32_t, 3>> triangles;
            const auto indices = numbers<std::uint16_t>(primitive["indices"].get<std::size_t>(), 1, 2);
            for (std::size_t n = 0; n < indices.size(); n += 3)
                triangles.push_back({indices[n], indices[n + 1], indices[n + 2]});
            const Figures own = figuresOf(triangles, [&](std::uint32_t v) {
                return Vec3d{values[3 * v], values[3 * v + 1], values[3 * v + 2]};
            });
            sum.area += own.area;
            sum.volume += own.volume;
        }
        return sum;
    }
};

TileFile tileOf(const TileMesh& mesh, double mostStep = kFinestStep) {
    auto file = makeTileGlb(mesh, 2, [](GltfBuffer&) { return nlohmann::ordered_json::object(); }, {1, 2, 3},
                            {mostStep, false});
    EXPECT_TRUE(file) << file.error().message();
    return TileFile(*file);
}

TEST(TileGlb, PlacesKeepAreaAndVolume) {
    TileMesh mesh;
    const FeatureFaces house = boxFaces({100.123, 50.3, 4}, {112.456, 58.77, 10.9});
    mesh.append(house, 0);
    mesh.append(boxFaces({400, 300, 0}, {410, 310, 10}), 1);
    Figures expected = figuresOf(house);
    expected.area += 600;
    expected.volume += 1000;
    EXPECT_EQ(mesh.positions.size(), 48u);  // a corner for each of three normals
    const TileFile small = tileOf(mesh);
    EXPECT_EQ(small.json["accessors"][0]["componentType"], 5123);
    EXPECT_NEAR(small.figures().area, expected.area, 1e-3 * expected.area);
    EXPECT_NEAR(small.figures().volume, expected.volume, 1e-3 * expected.volume);
    // Steps of 1.5 cm would be too large.
    mesh.append(boxFaces({1000, 300, 0}, {1010, 310, 10}), 1);
    const TileFile large = tileOf(mesh);
    EXPECT_EQ(large.json["accessors"][0]["componentType"], 5126);
    EXPECT_NEAR(large.figures().volume, expected.volume + 1000, 1e-5 * expected.volume);
    EXPECT_EQ(tileOf(mesh, 0.1).json["accessors"][0]["componentType"], 5123);
}

TEST(TileGlb, StepsAreAsLargeAsTheDetailAllows) {
    const auto stepOf = [](const TileMesh& mesh, double mostStep = kFinestStep) {
        return tileOf(mesh, mostStep).json["nodes"][0]["scale"][0].get<double>();
    };
    TileMesh houses;
    houses.append(boxFaces({0, 0, 0}, {10, 8, 6}), 0);
    houses.append(boxFaces({250, 0, 0}, {260, 8, 6}), 1);
    EXPECT_NEAR(stepOf(houses), kFinestStep, 1e-6);
    EXPECT_NEAR(stepOf(houses, 0.05), 0.05, 1e-6);
    EXPECT_NEAR(stepOf(houses, 10), 6.0 / 64, 1e-6) << "a tenth of the edges is shorter than 6 m, or as long";
    // Bars of 5 cm need steps below a millimetre.
    TileMesh bars;
    for (int n = 0; n < 20; ++n) bars.append(boxFaces({n * 1.0, 0, 0}, {n + 0.05, 2, 0.05}), 0);
    EXPECT_NEAR(stepOf(bars), 0.05 / 64, 1e-6);
    bars.append(boxFaces({200, 0, 0}, {200.05, 2, 0.05}), 1);
    EXPECT_NEAR(stepOf(bars), 200.05 / 65535, 1e-6) << "16 bits have no smaller step";
}

TEST(TileGlb, RepeatedPlacesStayPlainInCompressedTiles) {
    const auto extensionsOf = [](const TileMesh& mesh) {
        auto file =
            makeTileGlb(mesh, 2, [](GltfBuffer&) { return nlohmann::ordered_json::object(); }, {}, {kFinestStep, true});
        EXPECT_TRUE(file) << file.error().message();
        const TileFile tile(*file);
        std::vector<bool> isPacked;
        for (const auto& view : tile.json["bufferViews"]) isPacked.push_back(view.contains("extensions"));
        return isPacked;
    };
    TileMesh box;  // each corner belongs to three faces
    box.append(boxFaces({0, 0, 0}, {10, 8, 6}), 0);
    EXPECT_EQ(extensionsOf(box), (std::vector<bool>{false, true, true, true}));
    TileMesh sheet;
    FeatureFaces faces;
    for (int n = 0; n < 20; ++n) faces.points.push_back({double(n / 2), double(n % 2), 0});
    for (std::uint32_t n = 0; n + 2 < 20; ++n)
        faces.triangles.push_back(n % 2 == 0 ? std::array{n, n + 2, n + 1} : std::array{n, n + 1, n + 2});
    faces.colors.assign(faces.triangles.size(), {255, 0, 0, 255});
    sheet.append(faces, 0);
    EXPECT_EQ(extensionsOf(sheet), (std::vector<bool>{true, true, true, true}));
}

TEST(TileGlb, AColorIsThatOfAMaterialUnlessThereAreMany) {
    TileMesh mesh;
    mesh.append(boxFaces({0, 0, 0}, {1, 1, 1}, {10, 20, 30, 128}), 0);
    for (std::uint8_t n = 0; n < 3; ++n) mesh.append(boxFaces({2, 0, 0}, {3, 1, 1}, {n, 0, 0, 255}), 1);
    const TileFile few = tileOf(mesh);
    ASSERT_EQ(few.json["materials"].size(), 4u);
    EXPECT_EQ(few.json["materials"][3]["alphaMode"], "BLEND") << "opaque ones come first";
    EXPECT_NEAR(few.json["materials"][3]["pbrMetallicRoughness"]["baseColorFactor"][3].get<double>(), 128 / 255.0,
                1e-4);
    EXPECT_FALSE(few.json["meshes"][0]["primitives"][0]["attributes"].contains("COLOR_0"));
    for (std::uint8_t n = 3; n < 20; ++n) mesh.append(boxFaces({2, 0, 0}, {3, 1, 1}, {n, 0, 0, 255}), 1);
    const TileFile many = tileOf(mesh);
    ASSERT_EQ(many.json["materials"].size(), 2u);
    EXPECT_TRUE(many.json["meshes"][0]["primitives"][0]["attributes"].contains("COLOR_0"));
    EXPECT_EQ(many.json["materials"][1]["alphaMode"], "BLEND");
    EXPECT_NEAR(many.figures().volume, 21, 0.03);
}

TEST(TileMesh, SimplifiedFacesLoseWhatIsSmall) {
    FeatureFaces house = boxFaces({1, 1, 1}, {11, 9, 7});
    const FeatureFaces chimney = boxFaces({4.1, 4.1, 7.1}, {4.6, 4.6, 7.9});
    for (auto triangle : chimney.triangles) {
        for (std::uint32_t& corner : triangle) corner += 8;
        house.triangles.push_back(triangle);
        house.colors.push_back({0, 0, 255, 255});
    }
    house.points.insert(house.points.end(), chimney.points.begin(), chimney.points.end());
    const FeatureFaces same = simplified(house, 0.25);
    EXPECT_EQ(same.triangles.size(), 24u);
    EXPECT_NEAR(figuresOf(same).volume, 480 + 0.2, 1e-9);
    const FeatureFaces coarse = simplified(house, 2);
    EXPECT_EQ(coarse.triangles.size(), 12u);
    EXPECT_NEAR(figuresOf(coarse).volume, 480, 1e-9);
    EXPECT_EQ(coarse.colors[0], house.colors[0]);
    EXPECT_TRUE(simplified(house, 100).triangles.empty());
}

}  // namespace
}  // namespace svt::writers

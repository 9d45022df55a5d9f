/// Joints of walls in plans: mitred corners, overlaps and abutting walls, generated as prisms.

#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace svt::drawing {
namespace {

/// Walls as prisms over polygons, 3 m high.
struct Walls : Boxes {
    volume::Label& addWall(const std::string& id, const std::vector<PlanePoint>& outline, double area,
                           const char* material = "Brick") {
        addLabel(id, "BuildingConstructiveElement", volume::Filling::Solid, 3 * area);
        const std::size_t count = outline.size();
        const auto at = [&](std::size_t n, double z) {
            const PlanePoint p = outline[n % count];
            return Vec3d{p.u, p.v, z};
        };
        for (std::size_t n = 0; n < count; ++n) addQuad({at(n, 0), at(n + 1, 0), at(n + 1, 3), at(n, 3)});
        for (std::size_t n = 1; n + 1 < count; n += 2) {
            addQuad({at(0, 0), at(n + 2, 0), at(n + 1, 0), at(n, 0)});
            addQuad({at(0, 3), at(n, 3), at(n + 1, 3), at(n + 2, 3)});
        }
        volume::Label& wall = volume.labels.labels.back();
        wall.attributes.push_back({"ifcType", std::string("IfcWallStandardCase"), ""});
        if (material != nullptr) wall.attributes.push_back({"material", std::string(material), ""});
        return wall;
    }
    [[nodiscard]] SectionDrawing plan(BeyondOptions beyond = {}) const {
        SectionOptions options;
        options.beyond = beyond;
        return *drawSection(volume, {{0, 0, 1}, volume.grid.origin() + Vec3d{0, 0, 1.1}}, options);
    }
};

/// Two walls of 0.3 m, mitred at the corner (0, 0).
Walls mitredCorner(const char* other = "Brick") {
    Walls walls;
    walls.addWall("south", {{0, 0}, {5, 0}, {5, 0.3}, {0.3, 0.3}}, 1.455);
    walls.addWall("west", {{0, 0}, {0.3, 0.3}, {0.3, 4}, {0, 4}}, 1.155, other);
    return walls;
}

std::size_t linesBetweenParts(const SectionDrawing& drawing) {
    std::size_t count = 0;
    for (const SectionBorder& border : drawing.borders)
        count += border.left != volume::kNoLabel && border.right != volume::kNoLabel ? 1 : 0;
    return count;
}

TEST(WallJoints, AMitreOfOneMaterialHasNoLine) {
    for (const bool withMeshes : {true, false}) {
        const Walls walls = mitredCorner();
        const SectionDrawing drawing = walls.plan({.visible = withMeshes});
        EXPECT_EQ(linesBetweenParts(drawing), 0u);
        ASSERT_EQ(drawing.components.size(), 2u) << "the walls stay apart";
        EXPECT_NEAR(drawing.components[0].area, 1.455, 1e-4);
        EXPECT_NEAR(drawing.components[1].area, 1.155, 1e-4);
        EXPECT_TRUE(drawing.beyond.empty()) << "nor does the edge below the cut take its place";
        double outline = 0;
        for (const SectionBorder& border : drawing.borders)
            for (std::size_t n = 0; n + 1 < border.points.size(); ++n)
                outline += std::hypot(border.points[n + 1].u - border.points[n].u,
                                      border.points[n + 1].v - border.points[n].v);
        EXPECT_NEAR(outline, 5 + 4 + 4.7 + 3.7 + 0.3 + 0.3, 1e-4);
    }
}

TEST(WallJoints, AbuttingAndOverlappingWallsHaveNoLine) {
    Walls walls = mitredCorner();
    walls.addWall("abutting", {{2, 0.3}, {2.2, 0.3}, {2.2, 4}, {2, 4}}, 0.74);
    walls.addWall("overlapping", {{3, 0.1}, {3.2, 0.1}, {3.2, 4}, {3, 4}}, 0.78);
    EXPECT_EQ(linesBetweenParts(walls.plan()), 0u);
}

TEST(WallJoints, OtherMaterialsKeepTheLine) {
    EXPECT_EQ(linesBetweenParts(mitredCorner("Concrete C25/30").plan()), 1u);
    EXPECT_EQ(linesBetweenParts(mitredCorner("Sand-lime brick").plan()), 1u) << "the same hatch, another material";
    EXPECT_EQ(linesBetweenParts(mitredCorner(nullptr).plan()), 1u) << "unknown is not the same";
}

TEST(WallJoints, OtherPartsKeepTheLine) {
    Walls walls = mitredCorner();
    walls.volume.labels.labels[1].attributes[0].value = std::string("IfcColumn");
    EXPECT_EQ(linesBetweenParts(walls.plan()), 1u);
    // Walls of two buildings, such as terraced houses.
    walls = mitredCorner();
    for (std::uint32_t l = 0; l < 2; ++l) {
        const std::string id = "house " + std::to_string(l);
        volume::test::addGroup(walls.volume, id, "Building");
    }
    auto& labels = walls.volume.labels.labels;
    std::swap(labels[0], labels[2]);
    std::swap(labels[1], labels[2]);  // house, wall, wall, house
    std::swap(labels[2], labels[3]);  // house, wall, house, wall
    labels[1].parent = 0;
    labels[3].parent = 2;
    for (auto& triangle : walls.volume.vectors.triangles) triangle.label = 2 * triangle.label + 1;
    for (std::uint32_t l = 0; l < 4; ++l) labels[l].subtreeEnd = l % 2 == 0 ? l + 2 : l + 1;
    EXPECT_EQ(linesBetweenParts(walls.plan()), 1u);
}

TEST(WallJoints, LayersOfTwoWallsJoinAndThoseOfOneWallDoNot) {
    Walls walls;
    const auto addLayer = [&](const std::string& id, std::uint32_t wall, const std::vector<PlanePoint>& outline,
                              double area) {
        volume::Label& layer = walls.addWall(id, outline, area, "Plasterboard");
        layer.attributes[0] = {"layer", std::int64_t{1}, ""};
        layer.parent = wall;
        walls.volume.labels.labels[wall].subtreeEnd = static_cast<std::uint32_t>(walls.volume.labels.labels.size());
    };
    walls.addWall("south", {{9, 9}, {9.1, 9}, {9.1, 9.1}, {9, 9.1}}, 0.01);
    addLayer("south 1", 0, {{0, 0}, {5, 0}, {5, 0.1}, {0.1, 0.1}}, 0.495);
    addLayer("south 2", 0, {{0.1, 0.1}, {5, 0.1}, {5, 0.2}, {0.2, 0.2}}, 0.485);
    EXPECT_EQ(linesBetweenParts(walls.plan()), 1u);
    walls.addWall("west", {{9.5, 9}, {9.6, 9}, {9.6, 9.1}, {9.5, 9.1}}, 0.01);
    addLayer("west 1", 3, {{0, 0}, {0.1, 0.1}, {0.1, 4}, {0, 4}}, 0.395);
    addLayer("west 2", 3, {{0.1, 0.1}, {0.2, 0.2}, {0.2, 4}, {0.1, 4}}, 0.385);
    EXPECT_EQ(linesBetweenParts(walls.plan()), 2u) << "one between the layers of each wall";
}

}  // namespace
}  // namespace svt::drawing

#include <svt/mesh/closing/closing.hpp>
#include <svt/mesh/closing/holes.hpp>
#include <svt/mesh/models_test.hpp>
#include <svt/mesh/polygons/edges.hpp>

#include <gtest/gtest.h>

namespace svt::mesh {
namespace {

using test::boxMesh;

// A box of 4 x 3 x 2 m without its top, whose corner 7 (4, 3, 2) is lifted.
ObjectMesh openBox(double lift = 0) {
    ObjectMesh mesh = boxMesh({0, 0, 0}, {4, 3, 2});
    std::erase_if(mesh.triangles, [](const Triangle& t) {
        return std::min({t.corners[0], t.corners[1], t.corners[2]}) >= 4;
    });
    mesh.vertices[7].z += lift;
    mesh.openEdges = findOpenEdges(mesh.triangles);
    return mesh;
}

TEST(CapHoles, CapFacesOutwardsAndIsRecorded) {
    ObjectMesh mesh = openBox();
    capHoles(mesh, 0.05);
    EXPECT_TRUE(mesh.openEdges.empty());
    EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), 24, 1e-12);
    ASSERT_EQ(mesh.caps.size(), 1u);
    EXPECT_NEAR(mesh.caps[0].area, 12, 1e-12);
    EXPECT_EQ(mesh.caps[0].center, (Vec3d{2, 1.5, 2}));
}

TEST(CapHoles, HoleFurtherFromItsPlaneStaysOpen) {
    ObjectMesh bent = openBox(0.16);  // 0.04 m from the mean plane
    capHoles(bent, 0.05);
    EXPECT_TRUE(bent.openEdges.empty());
    ObjectMesh torn = openBox(0.4);
    capHoles(torn, 0.05);
    EXPECT_EQ(torn.openEdges.size(), 4u);
    EXPECT_TRUE(torn.caps.empty());
}

TEST(CapHoles, HoleWithAnIslandIsClosedAroundIt) {
    // A tower without a bottom stands in the middle of the missing top: two loops in one plane.
    ObjectMesh mesh = openBox(), tower = boxMesh({1, 1, 2}, {2, 2, 4});
    std::erase_if(tower.triangles, [](const Triangle& t) {
        return std::max({t.corners[0], t.corners[1], t.corners[2]}) < 4;
    });
    test::append(mesh, tower);
    mesh.openEdges = findOpenEdges(mesh.triangles);
    capHoles(mesh, 0.05);
    EXPECT_TRUE(mesh.openEdges.empty());
    EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), 26, 1e-12);
}

class Neighbours : public ::testing::Test {
protected:
    // Prepared polygons of a model; the mesh consists of some of them.
    void prepare(const std::vector<model::PolygonIndex>& own) {
        own_ = own;
        polygons_ = prepareLocalPolygons(model_, std::vector<std::uint8_t>(model_.polygons.size(), 1), {}, nullptr);
        std::map<std::uint32_t, std::uint32_t> vertexOf;
        for (const model::PolygonIndex p : own)
            for (const auto& corners : polygons_.trianglesOf(p)) {
                mesh_.triangles.emplace_back();
                for (std::size_t c = 0; c < 3; ++c) {
                    const auto [it, isNew] = vertexOf.emplace(polygons_.pointIds[corners[c]], mesh_.vertices.size());
                    if (isNew) {
                        mesh_.vertices.push_back(polygons_.points[corners[c]]);
                        pointIds_.push_back(it->first);
                    }
                    mesh_.triangles.back().corners[c] = it->second;
                }
            }
        mesh_.openEdges = findOpenEdges(mesh_.triangles);
    }
    std::uint32_t complement() { return FaceFinder(polygons_, model_).complement(mesh_, pointIds_, own_); }

    model::BuildingModel model_;
    LocalPolygons polygons_;
    ObjectMesh mesh_;
    std::vector<std::uint32_t> pointIds_;
    std::vector<model::PolygonIndex> own_;
};

TEST_F(Neighbours, MissingFaceIsTakenInTheDirectionThatFits) {
    for (const bool isReversed : {false, true}) {
        model_ = {};
        mesh_ = {};
        pointIds_.clear();
        test::addBox(model_, {0, 0, 0}, {4, 3, 2}, {test::kEast});
        test::Ring east = test::boxRing({0, 0, 0}, {4, 3, 2}, test::kEast);
        if (isReversed) std::reverse(east.begin(), east.end());
        test::addRings(model_, {east});
        prepare({0, 1, 2, 3, 4});
        ASSERT_EQ(mesh_.openEdges.size(), 4u);
        EXPECT_EQ(complement(), 1u);
        EXPECT_TRUE(mesh_.openEdges.empty());
        EXPECT_NEAR(signedVolume(mesh_.vertices, mesh_.triangles), 24, 1e-12);
    }
}

TEST_F(Neighbours, FaceThatOpensMoreThanItClosesIsNotTaken) {
    test::addBox(model_, {0, 0, 0}, {4, 3, 2}, {test::kEast});
    // The floor of the next room touches the hole along one edge only.
    test::addRings(model_, {test::boxRing({4, 0, 0}, {9, 3, 2}, test::kBottom)});
    prepare({0, 1, 2, 3, 4});
    EXPECT_EQ(complement(), 0u);
    EXPECT_EQ(mesh_.openEdges.size(), 4u);
    EXPECT_EQ(mesh_.triangles.size(), 10u);
}

TEST_F(Neighbours, HoleOfSeveralFacesIsClosedFaceByFace) {
    test::addBox(model_, {0, 0, 0}, {4, 3, 2}, {test::kEast});
    // The missing face as two halves. The shell has the points where they meet its edges, above and below.
    model_.polygons[0] = {{{0, 0, 0}, {0, 3, 0}, {4, 3, 0}, {4, 1, 0}, {4, 0, 0}}, {5}, "", -1};
    model_.polygons[1] = {{{0, 0, 2}, {4, 0, 2}, {4, 1, 2}, {4, 3, 2}, {0, 3, 2}}, {5}, "", -1};
    test::addRings(model_, {{{4, 0, 0}, {4, 1, 0}, {4, 1, 2}, {4, 0, 2}}});
    test::addRings(model_, {{{4, 1, 0}, {4, 3, 0}, {4, 3, 2}, {4, 1, 2}}});
    prepare({0, 1, 2, 3, 4});
    EXPECT_EQ(mesh_.openEdges.size(), 6u);
    EXPECT_EQ(complement(), 2u);
    EXPECT_TRUE(mesh_.openEdges.empty());
    EXPECT_NEAR(signedVolume(mesh_.vertices, mesh_.triangles), 24, 1e-12);
}

}  // namespace
}  // namespace svt::mesh

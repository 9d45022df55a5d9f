#include <svt/mesh/closing/closing.hpp>
#include <svt/mesh/closing/holes.hpp>
#include <svt/mesh/models_test.hpp>
#include <svt/mesh/polygons/edges.hpp>
#include <svt/mesh/processor_time_test.hpp>

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

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

// What complement() is meant to choose, written down plainly: the first polygon that closes more edges than it opens, again
// and again. Returns the welded points of the corners of the faces that it adds.
std::vector<std::array<std::uint32_t, 3>> expectedFaces(const model::BuildingModel& model,
                                                        const LocalPolygons& polygons, const ObjectMesh& mesh,
                                                        const std::vector<std::uint32_t>& pointIds,
                                                        std::vector<model::PolygonIndex> taken) {
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    std::map<Edge, int> need;
    std::set<Edge> open;
    for (const OpenEdge& edge : mesh.openEdges) {
        const std::uint32_t from = pointIds[edge.from], to = pointIds[edge.to];
        ++need[{to, from}];
        open.insert({{from, to}, {to, from}});
    }
    std::vector<std::array<std::uint32_t, 3>> faces;
    for (;;) {
        model::PolygonIndex p = 0;
        for (; p < model.polygons.size(); ++p) {
            if (std::find(taken.begin(), taken.end(), p) != taken.end()) continue;
            std::array<std::uint32_t, 3> corners{};
            for (std::size_t c = 0; c < 3; ++c) corners[c] = polygons.pointIds[polygons.firstPoint[p] + c];
            int gain = 0, reversedGain = 0;
            bool isNear = false;
            for (std::size_t c = 0; c < 3; ++c) {
                const Edge edge{corners[c], corners[(c + 1) % 3]};
                isNear = isNear || open.contains(edge);
                gain += need[edge] > 0 ? 1 : -1;
                reversedGain += need[{edge.second, edge.first}] > 0 ? 1 : -1;
            }
            if (!isNear || std::max(gain, reversedGain) <= 0) continue;
            if (reversedGain > gain) std::swap(corners[1], corners[2]);
            for (std::size_t c = 0; c < 3; ++c) {
                const Edge edge{corners[c], corners[(c + 1) % 3]};
                if (need[edge] > 0)
                    --need[edge];
                else
                    ++need[{edge.second, edge.first}];
            }
            faces.push_back(corners);
            taken.push_back(p);
            break;
        }
        if (p == model.polygons.size()) return faces;
    }
}

TEST_F(Neighbours, RandomFacesAreChosenInTheOrderOfTheFile) {
    std::mt19937_64 random(11);
    std::size_t added = 0;
    for (int n = 0; n < 300; ++n) {
        model_ = {};
        mesh_ = {};
        pointIds_.clear();
        const std::uint64_t corners = 5 + random() % 6, count = 10 + random() % 80;
        const auto pointAt = [](std::uint64_t i) {
            return Vec3d{double(i), double(i * i % 7), double(i * i * i % 11)};
        };
        while (model_.polygons.size() < count) {
            const std::uint64_t a = random() % corners, b = random() % corners, c = random() % corners;
            if (a == b || b == c || a == c) continue;
            for (std::uint64_t i = random() % 3; i < 3; ++i)
                test::addRings(model_, {{pointAt(a), pointAt(b), pointAt(c)}});
        }
        prepare({0, 1, 2, 3, 4});
        const auto expected = expectedFaces(model_, polygons_, mesh_, pointIds_, own_);
        const std::size_t before = mesh_.triangles.size();
        ASSERT_EQ(complement(), expected.size()) << n;
        added += expected.size();
        for (std::size_t i = 0; i < expected.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                ASSERT_EQ(pointIds_[mesh_.triangles[before + i].corners[c]], expected[i][c]) << n;
    }
    EXPECT_GT(added, 500u);
}

TEST_F(Neighbours, CoincidentFacesOfVeryManyFeaturesTakeNoTime) {
    // A box without its eastern face, and that face in 20,000 other features: each of them may be asked for it, too.
    test::addBox(model_, {0, 0, 0}, {4, 3, 2}, {test::kEast});
    constexpr std::uint32_t kCount = 20'000;
    for (std::uint32_t i = 0; i < kCount; ++i)
        test::addRings(model_, {test::boxRing({0, 0, 0}, {4, 3, 2}, test::kEast)});
    prepare({0, 1, 2, 3, 4});
    const test::ProcessorTime time;
    const FaceFinder finder(polygons_, model_);
    for (std::uint32_t i = 0; i < kCount; ++i) {
        ObjectMesh mesh = mesh_;
        std::vector<std::uint32_t> pointIds = pointIds_;
        ASSERT_EQ(finder.complement(mesh, pointIds, own_), 1u);
        ASSERT_TRUE(mesh.openEdges.empty());
    }
    // 0.3 s; an hour where each asks all.
    EXPECT_LT(time.seconds(), 60);
}

TEST_F(Neighbours, ManyFacesAtOneEdgeTakeNoTime) {
    // The pages of a book share one edge with each of its boxes.
    test::addBox(model_, {0, 0, 0}, {4, 3, 2}, {test::kEast});
    test::addRings(model_, {test::boxRing({0, 0, 0}, {4, 3, 2}, test::kEast)});
    constexpr std::uint32_t kPages = 20'000;
    for (std::uint32_t i = 0; i < kPages; ++i) {
        const Vec3d out{5 + i * 1e-3, -1, 0};
        test::addRings(model_, {{{4, 0, 0}, {4, 0, 2}, out + Vec3d{0, 0, 2}, out}});
    }
    prepare({0, 1, 2, 3, 4});
    const test::ProcessorTime time;
    const FaceFinder finder(polygons_, model_);
    for (std::uint32_t i = 0; i < kPages; ++i) {
        ObjectMesh mesh = mesh_;
        std::vector<std::uint32_t> pointIds = pointIds_;
        ASSERT_EQ(finder.complement(mesh, pointIds, own_), 1u);
        ASSERT_TRUE(mesh.openEdges.empty());
    }
    EXPECT_LT(time.seconds(), 60);
}

}  // namespace
}  // namespace svt::mesh

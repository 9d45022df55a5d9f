#include <svt/mesh/models_test.hpp>
#include <svt/mesh/polygons/edge_uses.hpp>
#include <svt/mesh/polygons/edges.hpp>
#include <svt/mesh/processor_time_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <tuple>

namespace svt::mesh {
namespace {

using test::append;
using test::areaOf;
using test::boxMesh;
using test::meshOfRings;
using test::trianglesOf;

std::vector<std::pair<std::uint32_t, std::uint32_t>> pairsOf(const std::vector<OpenEdge>& edges) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const OpenEdge& edge : edges) pairs.emplace_back(edge.from, edge.to);
    return pairs;
}
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

const Vec3d kNear{0, 0, 0}, kFar{4, 3, 2};

TEST(CollectEdgeUses, AreSortedWhetherVerticesAreDenseOrSparse) {
    std::mt19937 random(5);
    for (const std::uint32_t vertexCount : {5u, 400u, 5'000'000u}) {
        std::vector<Triangle> triangles(600);
        for (Triangle& triangle : triangles)
            for (std::uint32_t& corner : triangle.corners) corner = random() % vertexCount;
        const std::vector<EdgeUse> uses = collectEdgeUses(triangles);
        ASSERT_EQ(uses.size(), 1800u);
        const auto placeOf = [](const EdgeUse& use) { return std::tuple(use.low, use.high, use.triangle); };
        for (std::size_t i = 1; i < uses.size(); ++i) EXPECT_LE(placeOf(uses[i - 1]), placeOf(uses[i]));
        std::vector<int> usesOf(triangles.size(), 0);
        for (const EdgeUse& use : uses) {
            ++usesOf[use.triangle];
            const auto& corners = triangles[use.triangle].corners;
            const std::uint32_t from = use.isForward ? use.low : use.high, to = use.isForward ? use.high : use.low;
            EXPECT_TRUE((corners[0] == from && corners[1] == to) || (corners[1] == from && corners[2] == to) ||
                        (corners[2] == from && corners[0] == to));
        }
        EXPECT_EQ(std::count(usesOf.begin(), usesOf.end(), 3), 600);
    }
    EXPECT_TRUE(collectEdgeUses({}).empty());
}

TEST(FindOpenEdges, ClosedBoxHasNone) {
    EXPECT_TRUE(findOpenEdges(boxMesh(kNear, kFar).triangles).empty());
    EXPECT_TRUE(findOpenEdges({}).empty());
}

TEST(FindOpenEdges, SingleTriangleIsOpenAllRound) {
    EXPECT_EQ(pairsOf(findOpenEdges(trianglesOf({{2, 0, 1}}))), (Pairs{{0, 1}, {1, 2}, {2, 0}}));
}

TEST(FindOpenEdges, MissingTriangleLeavesTheEdgesOfItsNeighbours) {
    auto triangles = boxMesh(kNear, kFar).triangles;
    const Triangle gone = triangles[5];
    triangles.erase(triangles.begin() + 5);
    Pairs expected;
    for (std::size_t c = 0; c < 3; ++c) expected.emplace_back(gone.corners[(c + 1) % 3], gone.corners[c]);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(pairsOf(findOpenEdges(triangles)), expected);
}

TEST(FindOpenEdges, AnEdgeIsListedAsOftenAsItIsMissing) {
    // Three triangles use the edge in the direction 0 -> 1, one in the direction 1 -> 0.
    EXPECT_EQ(pairsOf(findOpenEdges(trianglesOf({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {1, 0, 5}}))).front(),
              (std::pair{0u, 1u}));
    const auto open = pairsOf(findOpenEdges(trianglesOf({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {1, 0, 5}})));
    EXPECT_EQ(std::count(open.begin(), open.end(), std::pair{0u, 1u}), 2);
}

TEST(FindOpenEdges, FacesInsideThatCancelAreClosed) {
    // A wall inside of the box, used in both directions.
    auto mesh = boxMesh(kNear, kFar);
    for (const auto& t : trianglesOf({{0, 1, 7}, {1, 0, 7}})) mesh.triangles.push_back(t);
    EXPECT_TRUE(findOpenEdges(mesh.triangles).empty());
}

// A box of 4 x 3 x 2 m whose south face is divided at x = `at`, so that its bottom and top edges have T-junctions with
// the faces above and below.
ObjectMesh boxWithCutFace(double noise = 0) {
    auto mesh = boxMesh(kNear, kFar);
    std::erase_if(mesh.triangles, [](const Triangle& t) {  // south: corners 0, 1, 5, 4
        return std::all_of(t.corners.begin(), t.corners.end(),
                           [](std::uint32_t c) { return c == 0 || c == 1 || c == 4 || c == 5; });
    });
    mesh.vertices.push_back({1.7, noise, -noise});
    mesh.vertices.push_back({1.7, -noise, 2 + noise});
    const auto south = meshOfRings(mesh.vertices, {{0, 8, 9, 4}, {8, 1, 5, 9}});
    mesh.triangles.insert(mesh.triangles.end(), south.triangles.begin(), south.triangles.end());
    return mesh;
}

TEST(CutAtTJunctions, OnePointOnEachOfTwoEdges) {
    for (const double noise : {0.0, 1e-6}) {
        auto mesh = boxWithCutFace(noise);
        const double area = areaOf(mesh.vertices, mesh.triangles);
        EXPECT_EQ(findOpenEdges(mesh.triangles).size(), 6u);  // 0-1 and 4-5 against their halves
        EXPECT_EQ(cutAtTJunctions(mesh.vertices, mesh.triangles, 1e-4), 2u);
        EXPECT_TRUE(findOpenEdges(mesh.triangles).empty());
        EXPECT_EQ(mesh.vertices.size(), 10u);
        EXPECT_NEAR(areaOf(mesh.vertices, mesh.triangles), area, 1e-5);
        EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), 24, 1e-5);
    }
}

TEST(CutAtTJunctions, NoTriangleEndsWithoutArea) {
    auto mesh = boxWithCutFace();
    cutAtTJunctions(mesh.vertices, mesh.triangles, 1e-4);
    for (const Triangle& triangle : mesh.triangles) EXPECT_GT(areaOf(mesh.vertices, triangle), 1e-3);
}

TEST(CutAtTJunctions, PointFurtherThanTheDistanceStaysALeak) {
    auto mesh = boxWithCutFace(3e-4);
    EXPECT_EQ(cutAtTJunctions(mesh.vertices, mesh.triangles, 1e-4), 0u);
    EXPECT_EQ(findOpenEdges(mesh.triangles).size(), 6u);
}

// A wedge: two faces that meet along the edge from `a` to `b`, each with that edge divided at the given fractions, and
// two end triangles and a back without divisions.
ObjectMesh wedgeWithCuts(Vec3d a, Vec3d b, const std::vector<double>& left, const std::vector<double>& right,
                         double noise) {
    std::mt19937_64 random(41);
    std::uniform_real_distribution<double> uniform(-noise, noise);
    const Vec3d along = normalized(b - a);
    const Vec3d side = normalized(cross(along, Vec3d{0.3, -0.2, 1})), up = cross(side, along);
    ObjectMesh mesh;
    mesh.vertices = {a, b, a + side * 0.8 - up, b + side * 0.8 - up, a - side * 0.9 - up, b - side * 0.9 - up};
    std::vector<std::uint32_t> leftRing{2, 3, 1}, rightRing{5, 4, 0};
    const auto cut = [&](double fraction) {
        mesh.vertices.push_back(a + (b - a) * fraction +
                                Vec3d{uniform(random), uniform(random), uniform(random)} * 0.5);
        return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    };
    for (auto it = left.rbegin(); it != left.rend(); ++it) leftRing.push_back(cut(*it));
    leftRing.push_back(0);
    for (const double fraction : right) rightRing.push_back(cut(fraction));
    rightRing.push_back(1);
    // Fans from the far corners, so that no triangle is flat.
    const auto faces = meshOfRings(mesh.vertices, {leftRing, rightRing, {4, 5, 3, 2}, {0, 4, 2}, {1, 3, 5}});
    mesh.triangles = faces.triangles;
    return mesh;
}

TEST(CutAtTJunctions, SeveralPointsOnOneEdgeAndOnBothSides) {
    const Vec3d ends[][2] = {
        {{0, 0, 0}, {5, 0, 0}}, {{1, 2, 3}, {1, 2, 9}}, {{0.3, -1, 2}, {4.1, 3.7, 5.9}}, {{5, 1, 0}, {-2, 4, 0.5}}};
    for (const auto& [a, b] : ends) {
        for (const double noise : {0.0, 1e-6}) {
            for (const auto& [left, right] : std::vector<std::pair<std::vector<double>, std::vector<double>>>{
                     {{0.3}, {}},
                     {{}, {0.2, 0.5, 0.9}},
                     {{0.25, 0.75}, {0.5}},
                     {{0.1, 0.2, 0.3, 0.4}, {0.35, 0.6, 0.8}}}) {
                auto mesh = wedgeWithCuts(a, b, left, right, noise);
                const double area = areaOf(mesh.vertices, mesh.triangles),
                             volume = signedVolume(mesh.vertices, mesh.triangles);
                ASSERT_FALSE(findOpenEdges(mesh.triangles).empty());
                const std::size_t vertices = mesh.vertices.size();
                EXPECT_GT(cutAtTJunctions(mesh.vertices, mesh.triangles, 1e-4), 0u);
                EXPECT_TRUE(findOpenEdges(mesh.triangles).empty())
                    << left.size() << ' ' << right.size() << ' ' << noise;
                EXPECT_EQ(mesh.vertices.size(), vertices);
                EXPECT_NEAR(areaOf(mesh.vertices, mesh.triangles), area, 1e-4);
                EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), volume, 1e-5);
                for (const Triangle& triangle : mesh.triangles) EXPECT_GT(areaOf(mesh.vertices, triangle), 1e-3);
            }
        }
    }
}

TEST(CutAtTJunctions, ClosedMeshIsNotTouched) {
    auto mesh = boxMesh(kNear, kFar);
    const auto before = mesh.triangles;
    EXPECT_EQ(cutAtTJunctions(mesh.vertices, mesh.triangles, 1e-4), 0u);
    ASSERT_EQ(mesh.triangles.size(), before.size());
    for (std::size_t t = 0; t < before.size(); ++t) EXPECT_EQ(mesh.triangles[t].corners, before[t].corners);
}

// Seconds of processor time for the largest meshes of these tests: some tenths where work grows with them, a minute and more
// where each is held against each.
constexpr double kSeconds = 30;

TEST(CutAtTJunctions, VeryManyPointsOnOneEdge) {
    std::vector<double> fractions;
    for (int i = 1; i < 100'000; ++i) fractions.push_back(i / 100'000.0);
    auto mesh = wedgeWithCuts({0, 0, 0}, {5000, 300, 70}, fractions, {}, 0);
    const double volume = signedVolume(mesh.vertices, mesh.triangles);
    const test::ProcessorTime time;
    bool isUnfinished = true;
    EXPECT_GE(cutAtTJunctions(mesh.vertices, mesh.triangles, 1e-4, &isUnfinished), fractions.size());
    EXPECT_LT(time.seconds(), kSeconds);
    EXPECT_FALSE(isUnfinished);
    EXPECT_TRUE(findOpenEdges(mesh.triangles).empty());
    EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), volume, 1e-6 * volume);
}

TEST(CutAtTJunctions, VeryManyOpenEdgesInOnePlane) {
    // Squares that do not touch, in the plane x = 0.
    ObjectMesh mesh;
    std::vector<std::vector<std::uint32_t>> rings;
    for (int i = 0; i < 150; ++i)
        for (int j = 0; j < 150; ++j) {
            const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
            for (const auto& [y, z] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
                mesh.vertices.push_back({0, 2.0 * i + y, 2.0 * j + z});
            rings.push_back({first, first + 1, first + 2, first + 3});
        }
    mesh = meshOfRings(mesh.vertices, rings);
    const test::ProcessorTime time;
    EXPECT_EQ(cutAtTJunctions(mesh.vertices, mesh.triangles, 1e-4), 0u);
    EXPECT_LT(time.seconds(), kSeconds);
}

TEST(CutAtTJunctions, EdgesThatOverlapEachOtherAreGivenUp) {
    // Triangles whose bases lie on one line, each over all of the ones before it: over two million ends on edges.
    ObjectMesh mesh;
    constexpr std::uint32_t kCount = 1'500;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        mesh.vertices.push_back({-1.0 - i, 0, 0});
        mesh.vertices.push_back({1.0 + i, 0, 0});
        mesh.vertices.push_back({0, 5, 1.0 + i});
        Triangle triangle;
        triangle.corners = {3 * i, 3 * i + 1, 3 * i + 2};
        mesh.triangles.push_back(triangle);
    }
    bool isUnfinished = false;
    const test::ProcessorTime time;
    EXPECT_EQ(cutAtTJunctions(mesh.vertices, mesh.triangles, 1e-4, &isUnfinished), 0u);
    EXPECT_LT(time.seconds(), kSeconds);
    EXPECT_TRUE(isUnfinished);
    EXPECT_EQ(mesh.triangles.size(), kCount);
}

TEST(RemoveDoubledFaces, VeryManyDoubledFacesTakeNoTime) {
    // Boxes, each with its top once more by the other diagonal.
    constexpr std::uint32_t kCount = 20'000;
    ObjectMesh mesh;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const Vec3d low{5.0 * (i % 100), 4.0 * (i / 100), 0};
        ObjectMesh box = boxMesh(low, low + kFar);
        for (const auto& t : trianglesOf({{5, 7, 6}, {5, 6, 4}})) box.triangles.push_back(t);
        append(mesh, box);
    }
    const test::ProcessorTime time;
    EXPECT_EQ(removeDoubledFaces(mesh.vertices, mesh.triangles), 2 * kCount);
    EXPECT_LT(time.seconds(), kSeconds);
    EXPECT_TRUE(findOpenEdges(mesh.triangles).empty());
}

TEST(RemoveDoubledFaces, FaceWithTheOtherDiagonalGoes) {
    auto mesh = boxMesh(kNear, kFar);
    for (const auto& t : trianglesOf({{5, 7, 6}, {5, 6, 4}})) mesh.triangles.push_back(t);  // the top once more
    ASSERT_FALSE(findOpenEdges(mesh.triangles).empty());
    EXPECT_EQ(removeDoubledFaces(mesh.vertices, mesh.triangles), 2u);
    EXPECT_TRUE(findOpenEdges(mesh.triangles).empty());
    EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), 24, 1e-12);
}

TEST(RemoveDoubledFaces, HolesAndClosedMeshesAreLeftAlone) {
    auto closed = boxMesh(kNear, kFar).triangles;
    EXPECT_EQ(removeDoubledFaces(boxMesh(kNear, kFar).vertices, closed), 0u);
    EXPECT_EQ(closed.size(), 12u);
    auto open = boxMesh(kNear, kFar).triangles;
    open.resize(10);
    EXPECT_EQ(removeDoubledFaces(boxMesh(kNear, kFar).vertices, open), 0u);
    EXPECT_EQ(open.size(), 10u);
}

TEST(OrientConsistently, TurnedFacesAreTurnedBack) {
    for (const std::vector<std::size_t>& turned : {std::vector<std::size_t>{0}, {3, 4}, {1, 5, 8, 11}}) {
        auto mesh = boxMesh(kNear, kFar);
        for (const std::size_t t : turned) std::swap(mesh.triangles[t].corners[1], mesh.triangles[t].corners[2]);
        EXPECT_EQ(orientConsistently(mesh.triangles), turned.size());
        EXPECT_TRUE(findOpenEdges(mesh.triangles).empty());
        EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), 24, 1e-12);
    }
}

TEST(OrientConsistently, ComponentThatAgreesStays) {
    auto mesh = boxMesh(kNear, kFar);
    test::turnOver(mesh.triangles);  // facing inwards, but consistent
    append(mesh, boxMesh({10, 0, 0}, {11, 1, 1}));
    std::swap(mesh.triangles[12].corners[1], mesh.triangles[12].corners[2]);
    EXPECT_EQ(orientConsistently(mesh.triangles), 1u);
    EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), -24 + 1, 1e-12);
}

TEST(OrientConsistently, MoebiusStripStays) {
    // A Moebius strip: five quads, the last joined to the first with a twist.
    std::vector<std::array<std::uint32_t, 3>> corners;
    for (std::uint32_t i = 0; i < 4; ++i) {
        corners.push_back({2 * i, 2 * i + 2, 2 * i + 1});
        corners.push_back({2 * i + 1, 2 * i + 2, 2 * i + 3});
    }
    corners.push_back({8, 1, 9});
    corners.push_back({9, 1, 0});
    auto triangles = trianglesOf(corners);
    EXPECT_EQ(orientConsistently(triangles), 0u);
    for (std::size_t t = 0; t < corners.size(); ++t) EXPECT_EQ(triangles[t].corners, corners[t]);
}

TEST(OrientOutwards, InwardBoxIsTurned) {
    auto mesh = boxMesh(kNear, kFar);
    EXPECT_EQ(orientOutwards(mesh.vertices, mesh.triangles), 0u);
    test::turnOver(mesh.triangles);
    EXPECT_EQ(orientOutwards(mesh.vertices, mesh.triangles), 12u);
    EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), 24, 1e-12);
}

TEST(OrientOutwards, VoidsKeepFacingInwards) {
    auto hole = boxMesh({1, 1, 0.5}, {2, 2, 1.5});
    test::turnOver(hole.triangles);
    auto outerFirst = boxMesh(kNear, kFar);
    append(outerFirst, hole);
    auto voidFirst = hole;
    append(voidFirst, boxMesh(kNear, kFar));
    for (auto& mesh : {&outerFirst, &voidFirst}) {
        EXPECT_EQ(orientOutwards(mesh->vertices, mesh->triangles), 0u);
        EXPECT_NEAR(signedVolume(mesh->vertices, mesh->triangles), 23, 1e-12);
    }
}

TEST(OrientOutwards, CourtsOfFullHeightAreVoids) {
    // Their faces lie on the floor and the ceiling of the box, or on one of its walls.
    for (const auto& [low, high] : {std::pair<Vec3d, Vec3d>{{1, 1, 0}, {2, 2, 2}},
                                    {{1, 1, 0}, {2, 2, 1}},
                                    {{1, 1, 1}, {2, 2, 2}},
                                    {{0, 1, 0.5}, {1, 2, 1.5}}})
        for (std::ptrdiff_t first = 0; first < 12; ++first) {
            auto court = boxMesh(low, high);
            test::turnOver(court.triangles);
            std::rotate(court.triangles.begin(), court.triangles.begin() + first, court.triangles.end());
            auto mesh = boxMesh(kNear, kFar);
            append(mesh, court);
            EXPECT_EQ(orientOutwards(mesh.vertices, mesh.triangles), 0u) << low.z << ", first face " << first;
            const Vec3d size = high - low;
            EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), 24 - size.x * size.y * size.z, 1e-12);
        }
}

TEST(OrientOutwards, VeryManyVoidsInAFineShellTakeNoTime) {
    // Inward boxes in a box of very many triangles: every second of them outside of it.
    constexpr std::uint32_t kSide = 300;
    ObjectMesh mesh;
    std::vector<std::vector<std::uint32_t>> rings;
    for (const double z : {0.0, 4.0})
        for (std::uint32_t i = 0; i <= kSide; ++i)
            for (std::uint32_t j = 0; j <= kSide; ++j) mesh.vertices.push_back({double(i), double(j), z});
    const auto at = [](std::uint32_t level, std::uint32_t i, std::uint32_t j) {
        return (level * (kSide + 1) + i) * (kSide + 1) + j;
    };
    for (std::uint32_t i = 0; i < kSide; ++i) {
        for (std::uint32_t j = 0; j < kSide; ++j) {
            rings.push_back({at(1, i, j), at(1, i + 1, j), at(1, i + 1, j + 1), at(1, i, j + 1)});
            rings.push_back({at(0, i, j), at(0, i, j + 1), at(0, i + 1, j + 1), at(0, i + 1, j)});
        }
        rings.push_back({at(0, i, 0), at(0, i + 1, 0), at(1, i + 1, 0), at(1, i, 0)});
        rings.push_back({at(0, i + 1, kSide), at(0, i, kSide), at(1, i, kSide), at(1, i + 1, kSide)});
        rings.push_back({at(0, 0, i + 1), at(0, 0, i), at(1, 0, i), at(1, 0, i + 1)});
        rings.push_back({at(0, kSide, i), at(0, kSide, i + 1), at(1, kSide, i + 1), at(1, kSide, i)});
    }
    mesh = meshOfRings(mesh.vertices, rings);
    ASSERT_TRUE(findOpenEdges(mesh.triangles).empty());
    for (std::uint32_t i = 0; i < kSide; ++i)
        for (std::uint32_t j = 0; j < kSide; ++j) {
            const Vec3d low{i + 0.3, j + 0.2, (i + j) % 2 == 0 ? 1.0 : 6.0};
            ObjectMesh box = boxMesh(low, low + Vec3d{0.5, 0.5, 0.5});
            test::turnOver(box.triangles);
            append(mesh, box);
        }
    const test::ProcessorTime time;
    EXPECT_EQ(orientOutwards(mesh.vertices, mesh.triangles), 12u * kSide * kSide / 2);
    EXPECT_LT(time.seconds(), kSeconds);
}

TEST(OrientOutwards, InwardBoxBesideAnotherIsNoVoid) {
    // Its box lies in the bounding box of an L, but not in the L.
    ObjectMesh mesh;
    std::vector<Vec3d> plan{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}};
    for (const double z : {0.0, 3.0})
        for (const Vec3d& p : plan) mesh.vertices.push_back({p.x, p.y, z});
    std::vector<std::vector<std::uint32_t>> rings{{6, 7, 8, 9}, {6, 9, 10, 11}, {3, 2, 1, 0}, {5, 4, 3, 0}};
    for (std::uint32_t i = 0; i < 6; ++i) rings.push_back({i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i});
    mesh = meshOfRings(mesh.vertices, rings);
    ASSERT_TRUE(findOpenEdges(mesh.triangles).empty());
    auto inward = boxMesh({2, 2, 1}, {3, 3, 2});
    test::turnOver(inward.triangles);
    append(mesh, inward);
    EXPECT_EQ(orientOutwards(mesh.vertices, mesh.triangles), 12u);
    EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), 7 * 3 + 1, 1e-12);
}

TEST(FindComponents, NumbersGoByTheFirstTriangle) {
    auto mesh = boxMesh(kNear, kFar);
    append(mesh, boxMesh({10, 0, 0}, {11, 1, 1}));
    std::swap(mesh.triangles[1], mesh.triangles[13]);
    const auto component = findComponents(mesh.triangles);
    ASSERT_EQ(component.size(), 24u);
    for (std::size_t t = 0; t < 24; ++t) EXPECT_EQ(component[t], t == 1 || (t >= 12 && t != 13) ? 1u : 0u) << t;
}

TEST(FindComponents, ATouchingCornerJoinsNothing) {
    const auto component = findComponents(trianglesOf({{0, 1, 2}, {2, 3, 4}, {3, 2, 5}}));
    EXPECT_EQ(component, (std::vector<std::uint32_t>{0, 1, 1}));
}

TEST(FindBoundaryLoops, LoopBoundsTheMissingFace) {
    auto mesh = boxMesh(kNear, kFar);
    std::erase_if(mesh.triangles, [](const Triangle& t) {  // the top: corners 4 to 7
        return std::all_of(t.corners.begin(), t.corners.end(), [](std::uint32_t c) { return c >= 4; });
    });
    const auto loops = findBoundaryLoops(findOpenEdges(mesh.triangles));
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_EQ(loops[0], (std::vector<std::uint32_t>{4, 5, 7, 6}));  // counter-clockwise from above
}

TEST(FindBoundaryLoops, LoopsThatTouchInACornerAreTold) {
    // Two missing triangles that meet in corner 0; the edges of their neighbours run in reverse direction.
    const auto loops = findBoundaryLoops({{0, 2}, {0, 4}, {1, 0}, {2, 1}, {3, 0}, {4, 3}});
    ASSERT_EQ(loops.size(), 2u);
    for (const auto& loop : loops) EXPECT_EQ(loop.size(), 3u);
}

TEST(FindBoundaryLoops, VeryLongLoopTakesNoTime) {
    std::vector<OpenEdge> edges;
    constexpr std::uint32_t kCount = 300'000;
    for (std::uint32_t i = 0; i < kCount; ++i) edges.push_back({i, (i + 1) % kCount});
    const test::ProcessorTime time;
    const auto loops = findBoundaryLoops(edges);
    EXPECT_LT(time.seconds(), kSeconds);
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_EQ(loops[0].size(), kCount);
}

TEST(FindBoundaryLoops, ChainsThatDoNotCloseAreLeftOut) {
    EXPECT_TRUE(findBoundaryLoops({{0, 1}, {1, 2}, {2, 3}}).empty());
    const auto loops = findBoundaryLoops({{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}});
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_EQ(loops[0].size(), 3u);
}

TEST(SignedVolume, IsExactFarFromTheOrigin) {
    const Vec3d world{458877, 5438353, 111};
    const auto mesh = boxMesh(kNear + world, kFar + world);
    EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), 24, 1e-9);
    EXPECT_EQ(signedVolume({}, {}), 0);
}

}  // namespace
}  // namespace svt::mesh

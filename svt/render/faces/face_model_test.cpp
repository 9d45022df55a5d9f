#include <svt/render/camera_rays.hpp>
#include <svt/render/face_model.hpp>
#include <svt/render/faces/face_tree.hpp>
#include <svt/render/test_volume_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <random>

namespace svt::render {
namespace {

using test::frontFrame;
using test::stylesOf;
using volume::Filling;
using volume::test::addBoxMesh;
using volume::test::addObject;
using volume::test::addQuad;
using volume::test::emptyVolume;

constexpr Vec3d kModel{4, 4, 4};  // metres
const Style kRed{{0.9f, 0.2f, 0.2f}, 1}, kBlue{{0.2f, 0.2f, 0.9f}, 1}, kHidden{{1, 1, 1}, 0};

struct FacedBox {
    Vec3d low, high;
    [[nodiscard]] bool contains(Vec3d p) const noexcept {
        return p.x > low.x && p.x < high.x && p.y > low.y && p.y < high.y && p.z > low.z && p.z < high.z;
    }
};

// A volume of boxes, one label each, the first of the highest priority; its labels are in the same order.
struct BoxScene {
    volume::SemanticVolume volume;
    volume::BrickVolume bricks;
    std::unique_ptr<FaceModel> faces;
    std::vector<std::uint32_t> order;
    double spacing;

    BoxScene(double metres, const std::vector<FacedBox>& boxes) : spacing(metres) {
        const auto n = static_cast<std::int32_t>(std::lround(kModel.x / metres));
        volume = emptyVolume({n, n, n}, {metres, metres, metres}, Vec3d{0.5, 0.5, 0.5} * metres);
        for (const FacedBox& box : boxes) {
            addObject(volume, "box", "BuildingConstructiveElement").filling = Filling::Solid;
            const Vec3d origin = volume.grid.origin();
            addBoxMesh(volume, static_cast<std::uint32_t>(volume.labels.labels.size() - 1), box.low - origin,
                       box.high - origin);
        }
        paint(boxes);
    }
    void paint(const std::vector<FacedBox>& boxes) {
        volume::test::paint(volume, [&](std::int32_t i, std::int32_t j, std::int32_t k) {
            const Vec3d center{(i + 0.5) * spacing, (j + 0.5) * spacing, (k + 0.5) * spacing};
            for (std::size_t b = 0; b < boxes.size(); ++b)
                if (boxes[b].contains(center)) return static_cast<volume::Scalar>(b + 1);
            return volume::Scalar{0};
        });
        bricks = *volume::BrickVolume::fromColumns(volume.columns);
    }
    const FaceModel& make() {
        order.resize(volume.labels.labels.size());
        std::iota(order.begin(), order.end(), 0u);
        auto made = FaceModel::make(volume, order);
        EXPECT_TRUE(made);
        faces = std::move(*made);
        return *faces;
    }
    [[nodiscard]] Frame cast(const FrameSpec& spec) const {
        auto frame = castRays(DrawnVolume(bricks, volume.grid, faces.get()), spec);
        EXPECT_TRUE(frame) << (frame ? "" : frame.error().toString());
        return frame ? std::move(*frame) : Frame{};
    }
};

// Looks along +y at the whole model, 4 m wide and high.
FrameSpec frontOf(std::vector<Style> styles) { return frontFrame(64, 64, {2, 2, 2}, 4, stylesOf(std::move(styles))); }
Vec3d pixelPlace(std::int32_t x, std::int32_t y) { return {(x + 0.5) / 16, 0, 4 - (y + 0.5) / 16}; }
constexpr double kEyeY = 2 - 100;

TEST(FaceModel, FacesAreExactWhateverTheSpacing) {
    const FacedBox box{{1.03, 1.07, 0.51}, {3.02, 2.94, 2.03}};
    for (const double spacing : {0.5, 0.1}) {
        BoxScene scene(spacing, {box});
        EXPECT_EQ(scene.make().counts().solids, 1u);
        const Frame frame = scene.cast(frontOf({kRed}));
        for (std::int32_t y = 0; y < 64; ++y)
            for (std::int32_t x = 0; x < 64; ++x) {
                const Vec3d place = pixelPlace(x, y);
                const bool isIn = box.contains({place.x, 2, place.z});
                ASSERT_EQ(frame.label.at(x, y), isIn ? 1u : 0u) << x << ' ' << y << ' ' << spacing;
                if (isIn) {
                    ASSERT_NEAR(double(frame.depth.at(x, y)), 1.07 - kEyeY, 1e-5);
                }
            }
    }
}

TEST(FaceModel, HighestPriorityOwnsOverlapsAndCutFaces) {
    const FacedBox cupboard{{1.03, 0.8, 0.51}, {2.02, 1.6, 2.03}}, wall{{0.51, 1.13, 0.33}, {3.6, 2, 3.1}};
    BoxScene scene(0.5, {cupboard, wall});
    static_cast<void>(scene.make());
    FrameSpec spec = frontOf({kRed, kBlue});
    spec.passes[0].clips.push_back(ClipRegion::plane({0, -1, 0}, {0, 1.3, 0}));  // keeps y > 1.3: starts inside both
    const Frame cut = scene.cast(spec);
    spec.passes[0].styles[1] = kHidden;  // the hidden cupboard still owns its part of the wall
    const Frame hidden = scene.cast(spec);
    for (std::int32_t y = 0; y < 64; ++y)
        for (std::int32_t x = 0; x < 64; ++x) {
            const Vec3d place = pixelPlace(x, y);
            const bool isCupboard = cupboard.contains({place.x, 1.3, place.z}),
                       isWall = wall.contains({place.x, 1.3, place.z});
            ASSERT_EQ(cut.label.at(x, y), isCupboard ? 1u : isWall ? 2u : 0u);
            if (isWall || isCupboard) {
                ASSERT_NEAR(double(cut.depth.at(x, y)), 1.3 - kEyeY, 1e-5);
            }
            ASSERT_EQ(hidden.label.at(x, y), isWall ? 2u : 0u);
            if (isWall) {
                ASSERT_NEAR(double(hidden.depth.at(x, y)), (isCupboard ? 1.6 : 1.3) - kEyeY, 1e-5);
            }
        }
}

TEST(FaceModel, FacesOfTwoObjectsInOnePlaceShowTheFirst) {
    const FacedBox first{{1, 1.07, 1}, {3, 2, 3}}, second{{0.6, 1.07, 0.6}, {3.4, 3, 3.4}};
    BoxScene scene(0.5, {first, second});
    static_cast<void>(scene.make());
    const Frame frame = scene.cast(frontOf({kRed, kBlue}));
    EXPECT_EQ(frame.label.at(32, 32), 1u);
    EXPECT_EQ(frame.label.at(12, 12), 2u);
}

// A square at y = 1.37 before a box, both in one volume.
BoxScene sceneWithSheet(Filling filling) {
    BoxScene scene(0.5, {{{1.03, 2.07, 0.51}, {3.02, 2.94, 2.03}}});
    addObject(scene.volume, "sheet", "WindowSurface").filling = filling;
    const Vec3d o = scene.volume.grid.origin();
    addQuad(
        scene.volume, 1,
        {Vec3d{0.7, 1.37, 0.7} - o, Vec3d{3.3, 1.37, 0.7} - o, Vec3d{3.3, 1.37, 3.3} - o, Vec3d{0.7, 1.37, 3.3} - o});
    return scene;
}

TEST(FaceModel, SheetsAreMetAtTheirTriangles) {
    BoxScene scene = sceneWithSheet(Filling::Surface);
    EXPECT_EQ(scene.make().counts().sheets, 1u);
    const Frame frame = scene.cast(frontOf({kRed, kBlue}));
    EXPECT_EQ(frame.label.at(32, 32), 2u);
    EXPECT_NEAR(double(frame.depth.at(32, 32)), 1.37 - kEyeY, 1e-5);
    const Frame hidden = scene.cast(frontOf({kRed, kHidden}));
    EXPECT_EQ(hidden.label.at(32, 40), 1u);
    EXPECT_NEAR(double(hidden.depth.at(32, 40)), 2.07 - kEyeY, 1e-5);
}

TEST(FaceModel, TranslucentSheetsAbsorbLikeOneVoxel) {
    BoxScene scene = sceneWithSheet(Filling::Surface);
    static_cast<void>(scene.make());
    FrameSpec spec = frontOf({kHidden, {{0, 0, 0}, 0.75f}});
    spec.background.alpha = 0;
    const Frame frame = scene.cast(spec);
    EXPECT_EQ(frame.label.at(32, 20), 2u);
    EXPECT_NEAR(frame.color.at(32, 20).a, 255 * (1 - std::pow(0.25, 0.5)), 1.5);  // half a metre
    EXPECT_EQ(frame.color.at(2, 2).a, 0);
}

TEST(FaceModel, ClosedObjectsWithoutThicknessAreMetAsSurfaces) {
    for (const double thickness : {0.0, 2e-5, 5e-4}) {
        BoxScene scene(0.5, {{{1, 1.3, 1}, {3, 1.3 + thickness, 3}}});
        EXPECT_EQ(scene.make().counts().solids, 1u);
        const Frame frame = scene.cast(frontOf({kRed}));
        EXPECT_EQ(frame.label.at(32, 32), 1u) << thickness;
        EXPECT_NEAR(double(frame.depth.at(32, 32)), 1.3 - kEyeY, 1e-5);
        EXPECT_EQ(frame.label.at(4, 32), 0u);
    }
}

TEST(FaceModel, TranslucentBodiesAbsorbAtLeastLikeOneVoxel) {
    const auto alphaOf = [](double thickness) {
        BoxScene scene(0.5, {{{0.5, 1, 0.5}, {3.5, 1 + thickness, 3.5}}});
        static_cast<void>(scene.make());
        FrameSpec spec = frontOf({{{0, 0, 0}, 0.75f}});
        spec.background.alpha = 0;
        return scene.cast(spec).color.at(32, 20).a;
    };
    // The mean thickness of a pane of 3 m x 3 m x 0.1 m is twice its volume over its area.
    const double thickness = 2 * 0.9 / (18 + 1.2);
    EXPECT_NEAR(alphaOf(0.1), 255 * (1 - std::pow(0.25, 0.1 * 0.5 / thickness)), 1.5);
    EXPECT_NEAR(alphaOf(2), 255 * (1 - std::pow(0.25, 2)), 1.5) << "a thick body absorbs along the way through it";
}

TEST(FaceModel, ObjectsWithoutClosedMeshKeepTheirVoxels) {
    BoxScene scene(0.5, {{{1.03, 1.07, 0.51}, {3.02, 2.94, 2.03}}});
    scene.volume.vectors.triangles.pop_back();
    const FaceModel& faces = scene.make();
    EXPECT_EQ(faces.counts().byVoxels, 1u);
    EXPECT_EQ(faces.counts().solids, 0u);
    const Frame exact = scene.cast(frontOf({kRed}));
    const auto voxels = castRays(scene.bricks, scene.volume.grid, frontOf({kRed}));
    ASSERT_TRUE(voxels);
    EXPECT_EQ(exact.label, voxels->label);
    EXPECT_EQ(exact.depth, voxels->depth);
    EXPECT_EQ(exact.color, voxels->color);
}

TEST(FaceModel, VoxelsAndFacesShareOneOrderOfPriority) {
    // The open box comes first: its voxels own the overlap with the closed one.
    const FacedBox open{{1, 1, 1}, {3, 2, 3}}, closed{{0.6, 1.3, 0.6}, {3.4, 3, 3.4}};
    BoxScene scene(0.5, {open, closed});
    scene.volume.labels.labels[0].filling = Filling::Winding;
    const FaceModel& faces = scene.make();
    EXPECT_EQ(faces.counts().byVoxels, 1u);
    EXPECT_EQ(faces.counts().solids, 1u);
    FrameSpec spec = frontOf({kRed, kBlue});
    spec.passes[0].clips.push_back(ClipRegion::plane({0, -1, 0}, {0, 1.6, 0}));
    const Frame frame = scene.cast(spec);
    EXPECT_EQ(frame.label.at(32, 32), 1u);
    EXPECT_EQ(frame.label.at(12, 12), 2u);
    EXPECT_EQ(frame.label.at(2, 2), 0u);
}

TEST(FaceModel, MaterialBelongsToTheSurfacesOfAThematicBody) {
    const FacedBox hull{{1.03, 1.07, 0.51}, {3.02, 2.94, 2.03}};
    BoxScene scene(0.5, {hull});
    addObject(scene.volume, "south", "WallSurface", 0).filling = Filling::Body;
    addObject(scene.volume, "others", "WallSurface", 0).filling = Filling::Body;
    auto& triangles = scene.volume.vectors.triangles;
    const auto sides = triangles;
    for (std::size_t t = 0; t < sides.size(); ++t) {
        auto copy = sides[t];
        copy.label = t == 4 || t == 5 ? 1 : 2;
        triangles.push_back(copy);
    }
    std::stable_sort(triangles.begin(), triangles.end(),
                     [](const auto& a, const auto& b) { return a.label < b.label; });
    volume::test::paint(scene.volume, [&](std::int32_t i, std::int32_t j, std::int32_t k) {
        return hull.contains({(i + 0.5) * 0.5, (j + 0.5) * 0.5, (k + 0.5) * 0.5}) ? j < 4 ? 2u : 3u : 0u;
    });
    scene.bricks = *volume::BrickVolume::fromColumns(scene.volume.columns);
    // Surfaces come before their building.
    scene.order = {1, 2, 0};
    auto made = FaceModel::make(scene.volume, scene.order);
    ASSERT_TRUE(made);
    scene.faces = std::move(*made);
    EXPECT_EQ(scene.faces->counts().byVoxels, 0u);
    const Frame whole = scene.cast(frontOf({kRed, kBlue, kBlue}));
    EXPECT_EQ(whole.label.at(32, 40), 2u);
    EXPECT_NEAR(double(whole.depth.at(32, 40)), 1.07 - kEyeY, 1e-5);
    FrameSpec spec = frontOf({kRed, kBlue, kBlue});
    spec.passes[0].clips.push_back(ClipRegion::plane({0, -1, 0}, {0, 2.4, 0}));
    const Frame cut = scene.cast(spec);
    EXPECT_EQ(cut.label.at(32, 40), 3u) << "the label of the voxel where the section starts";
    EXPECT_NEAR(double(cut.depth.at(32, 40)), 2.4 - kEyeY, 1e-5);
}

TEST(FaceModel, ShadowsAndSamplesWorkAsWithVoxels) {
    BoxScene scene(0.25, {{{1, 1, 0.5}, {3, 3, 2}}});
    static_cast<void>(scene.make());
    FrameSpec spec = frontOf({kRed});
    spec.samplesPerPixel = 4;
    spec.light.hasShadows = true;
    const auto exact =
        castRays(DrawnVolume(scene.bricks, scene.volume.grid, scene.faces.get()), spec, {.isAdaptive = true});
    const auto voxels = castRays(scene.bricks, scene.volume.grid, spec, {.isAdaptive = true});
    ASSERT_TRUE(exact && voxels);  // faces lie between voxels, so both show the same
    EXPECT_EQ(exact->label, voxels->label);
    std::size_t different = 0;
    for (std::size_t p = 0; p < exact->color.pixels().size(); ++p)
        different += std::abs(exact->color.pixels()[p].r - voxels->color.pixels()[p].r) > 3;
    EXPECT_LE(different, 8u);
}

// The reference walks each ray by itself.
TEST(FaceModel, RaysOfACellGiveThePictureOfSingleRays) {
    const FacedBox cupboard{{1.03, 0.8, 0.51}, {2.02, 1.6, 2.03}}, wall{{0.51, 1.13, 0.33}, {3.6, 2, 3.1}},
        plaster{{0.6, 1.13 - 4e-5, 0.4}, {3.5, 1.5, 3}};
    BoxScene scene(0.25, {cupboard, wall, plaster});
    static_cast<void>(scene.make());
    for (const double cut : {0.5, 1.3, 1.13 - 2e-5})  // the last one ends between two faces in one place
        for (const float opacity : {1.0f, 0.4f}) {
            FrameSpec spec = frontOf({{kRed.color, opacity}, {kBlue.color, opacity}, {kRed.color, opacity}});
            spec.camera.projection = Camera::Projection::Perspective;
            spec.camera.eye = {1.1, -6, 3.2};
            spec.passes[0].clips.push_back(ClipRegion::plane({0, cut == 0.5 ? -1.0 : 1.0, 0}, {0, cut, 0}));
            const Frame picture = scene.cast(spec);
            const DrawnVolume drawn(scene.bricks, scene.volume.grid, scene.faces.get());
            const auto single = castRaysReference(std::span(&drawn, 1), spec);
            ASSERT_TRUE(single);
            for (std::int32_t y = 0; y < 64; ++y)
                for (std::int32_t x = 0; x < 64; ++x) {
                    ASSERT_EQ(picture.label.at(x, y), single->label.at(x, y)) << x << ' ' << y << ' ' << cut;
                    ASSERT_EQ(picture.depth.at(x, y), single->depth.at(x, y));
                    ASSERT_EQ(picture.color.at(x, y), single->color.at(x, y));
                }
        }
}

TEST(FaceModel, RefusesAVolumeWithoutMeshes) {
    const volume::SemanticVolume volume = emptyVolume({4, 4, 4}, {1, 1, 1});
    const auto made = FaceModel::make(volume, {});
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code(), Code::BadArgument);
}

// A closed mesh of many triangles: a bumpy ball around the middle of `size` voxels.
FaceTree ball(double size, std::vector<Vec3d>& points) {
    constexpr std::uint32_t kRings = 24, kAround = 40;
    std::vector<FaceTriangle> triangles;
    const auto at = [&](std::uint32_t ring, std::uint32_t n) {
        return ring == 0 ? 0 : ring == kRings ? 1 : 2 + (ring - 1) * kAround + n % kAround;
    };
    points = {{size / 2, size / 2, size * 0.9}, {size / 2, size / 2, size * 0.1}};
    for (std::uint32_t ring = 1; ring < kRings; ++ring)
        for (std::uint32_t n = 0; n < kAround; ++n) {
            const double polar = 3.14159265 * ring / kRings, turn = 2 * 3.14159265 * n / kAround;
            const double radius = size * (0.35 + 0.04 * std::sin(5 * turn) * std::sin(polar));
            points.push_back(
                Vec3d{size / 2, size / 2, size / 2} +
                Vec3d{std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)} * radius);
        }
    for (std::uint32_t ring = 0; ring < kRings; ++ring)
        for (std::uint32_t n = 0; n < kAround; ++n) {
            if (ring > 0) triangles.push_back({{at(ring, n), at(ring + 1, n), at(ring, n + 1)}, 0});
            if (ring + 1 < kRings) triangles.push_back({{at(ring, n + 1), at(ring + 1, n), at(ring + 1, n + 1)}, 0});
        }
    return {points, triangles};
}

std::vector<FaceCrossing> crossingsOf(const FaceTree& tree, const VoxelRay& ray, std::size_t most = 5) {
    std::vector<FaceCrossing> all;
    FaceCrossing last;
    for (FaceTree::Batch batch;;) {
        const std::size_t count = tree.findNext(ray, last, std::numeric_limits<double>::infinity(), most, batch);
        all.insert(all.end(), batch.begin(), batch.begin() + static_cast<std::ptrdiff_t>(count));
        if (count < most) return all;
        last = batch[most - 1];
    }
}

TEST(FaceTree, RaysThroughCornersAndEdgesEnterAClosedMeshAsOftenAsTheyLeaveIt) {
    std::vector<Vec3d> points;
    const FaceTree tree = ball(64, points);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-1, 1);
    std::size_t met = 0;
    for (int n = 0; n < 3000; ++n) {
        const Vec3d direction =
            n % 3 == 0 ? Vec3d{0, 1, 0} : normalized(Vec3d{place(random), place(random), place(random)});
        // At a corner, the middle of an edge, or any point.
        const std::size_t p = static_cast<std::size_t>(n) % points.size();
        const Vec3d target = n % 4 < 2 ? points[p]
                             : n % 4 == 2
                                 ? (points[p] + points[(p + 1) % points.size()]) * 0.5
                                 : Vec3d{32 + 30 * place(random), 32 + 30 * place(random), 32 + 30 * place(random)};
        const VoxelRay ray(target - direction * 100, direction);
        int winding = 0;
        double before = -std::numeric_limits<double>::infinity();
        for (const FaceCrossing& crossing : crossingsOf(tree, ray)) {
            winding += crossing.isEntry ? 1 : -1;
            EXPECT_LE(before, crossing.t);
            before = crossing.t;
            ++met;
        }
        EXPECT_EQ(winding, 0) << n;
    }
    EXPECT_GT(met, 3000u);
}

// Boxes along the axes, which some rays see edge-on.
FaceTree boxesAlongAxes(std::vector<Vec3d>& points) {
    std::vector<FaceTriangle> triangles;
    constexpr std::uint32_t kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& [low, high] :
         {std::pair(Vec3d{10, 12, 8}, Vec3d{50, 16, 40}), std::pair(Vec3d{10, 16, 8}, Vec3d{14, 48, 40}),
          std::pair(Vec3d{8, 10, 4}, Vec3d{52, 50, 8}), std::pair(Vec3d{20, 20, 8}, Vec3d{32, 31, 30})}) {
        const auto first = static_cast<std::uint32_t>(points.size());
        for (int corner = 0; corner < 8; ++corner)
            points.push_back({(corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                              (corner & 4) != 0 ? high.z : low.z});
        for (const auto& face : kFaces) {
            triangles.push_back({{first + face[0], first + face[1], first + face[2]}, 0});
            triangles.push_back({{first + face[0], first + face[2], first + face[3]}, 0});
        }
    }
    return {points, triangles};
}

// The list of a beam gives the crossings of the tree, bit for bit. Returns the sizes of all lists together.
std::size_t expectSameCrossings(const FaceTree& tree, const Camera& camera, std::size_t& crossings) {
    const volume::Grid grid = emptyVolume({64, 64, 64}, {1, 1, 1}, {0.5, 0.5, 0.5}).grid;
    FrameSpec spec = frontFrame(64, 48, {32, 32, 32}, 80, stylesOf({kRed}));
    spec.camera = camera;
    const CameraRays rays(spec, grid);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> within(0, 1);
    std::size_t inLists = 0;
    for (double left = -1; left < 1; left += 0.125)
        for (double bottom = -1; bottom < 1; bottom += 0.25) {
            std::vector<BeamTriangle> list;
            EXPECT_TRUE(tree.collect(FaceBeam(rays, left, left + 0.125, bottom, bottom + 0.25), 100000, list));
            inLists += list.size();
            for (int n = 0; n < 12; ++n) {
                const double u = n < 4 ? left + 0.125 * (n & 1) : left + 0.125 * within(random),
                             v = n < 4 ? bottom + 0.125 * (n & 2) : bottom + 0.25 * within(random);
                const VoxelRay ray = rays.at(u, v).voxelRay;
                const BeamPlace place{static_cast<float>((u - left) / 0.0625 - 1),
                                      static_cast<float>((v - bottom) / 0.125 - 1)};
                const std::vector<FaceCrossing> all = crossingsOf(tree, ray);
                std::vector<FaceCrossing> ofList;
                for (const BeamTriangle& triangle : list) {
                    FaceCrossing crossing;
                    if (!tree.cross(triangle, place, ray, RayAcross(ray), crossing)) continue;
                    EXPECT_GE(crossing.t, triangle.from);
                    ofList.push_back(crossing);
                }
                std::ranges::sort(ofList, [](const auto& a, const auto& b) { return a.isBefore(b); });
                EXPECT_EQ(all.size(), ofList.size()) << u << ' ' << v;
                crossings += all.size();
                for (std::size_t c = 0; c < std::min(all.size(), ofList.size()); ++c) {
                    EXPECT_EQ(all[c].t, ofList[c].t);
                    EXPECT_EQ(all[c].triangle, ofList[c].triangle);
                    EXPECT_EQ(all[c].isEntry, ofList[c].isEntry);
                }
            }
        }
    return inLists;
}

TEST(FaceTree, RaysOfABeamFindTheSameCrossingsInItsList) {
    std::vector<Vec3d> points, corners;
    const FaceTree curved = ball(64, points), straight = boxesAlongAxes(corners);
    std::size_t crossings = 0, inLists = 0, cameras = 0;
    // From outside, from inside, in the plane of faces, along an axis.
    for (const Vec3d eye :
         {Vec3d{-40, -70, 90}, Vec3d{30, 35, 28}, Vec3d{32, 32, 61}, Vec3d{33, -70, 30}, Vec3d{10, -20, 8}})
        for (const auto projection : {Camera::Projection::Perspective, Camera::Projection::Orthographic}) {
            Camera camera = frontFrame(64, 48, {32, 32, 32}, 80, stylesOf({kRed})).camera;
            camera.projection = projection;
            camera.eye = eye;
            camera.target = eye.x == 10 ? Vec3d{10, 60, 20} : Vec3d{33, 31, 30};
            inLists += expectSameCrossings(curved, camera, crossings);
            static_cast<void>(expectSameCrossings(straight, camera, crossings));
            ++cameras;
        }
    EXPECT_GT(crossings, 10000u);
    EXPECT_LT(inLists, cameras * 128 * 200) << "of 1840 triangles for each of 128 beams";
    // A limit of the list.
    const volume::Grid grid = emptyVolume({64, 64, 64}, {1, 1, 1}, {0.5, 0.5, 0.5}).grid;
    const FrameSpec spec = frontFrame(8, 8, {32, 32, 32}, 80, stylesOf({kRed}));
    std::vector<BeamTriangle> list;
    EXPECT_FALSE(curved.collect(FaceBeam(CameraRays(spec, grid), -1, 1, -1, 1), 100, list));
}

TEST(FaceTree, FindsAllCrossingsInOrder) {
    // More crossings than a batch holds: squares one behind the other, two of them in one place.
    std::vector<Vec3d> points;
    std::vector<FaceTriangle> triangles;
    for (std::uint32_t n = 0; n < 40; ++n) {
        const double y = n == 20 ? 19 : n;
        for (const Vec3d corner : {Vec3d{0, y, 0}, Vec3d{9, y, 0}, Vec3d{9, y, 9}, Vec3d{0, y, 9}})
            points.push_back(corner);
        triangles.push_back({{4 * n, 4 * n + 1, 4 * n + 2}, n});
        triangles.push_back({{4 * n, 4 * n + 2, 4 * n + 3}, n});
    }
    const FaceTree tree(points, triangles);
    const VoxelRay ray({6, -5, 3}, {0, 1, 0});
    const auto all = crossingsOf(tree, ray);
    EXPECT_EQ(crossingsOf(tree, ray, FaceTree::kBatch).size(), all.size());
    EXPECT_EQ(crossingsOf(tree, ray, 1).size(), all.size());
    ASSERT_EQ(all.size(), 40u);
    std::vector<int> seen(40, 0);
    for (std::size_t n = 0; n < all.size(); ++n) {
        EXPECT_NEAR(all[n].t, (n == 20 ? 19 : double(n)) + 5, 1e-9);
        EXPECT_TRUE(all[n].isEntry);
        ++seen[tree.triangle(all[n].triangle).object];
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 40);
    FaceTree::Batch batch;
    EXPECT_EQ(tree.findNext(ray, {}, 7.5, FaceTree::kBatch, batch), 3u) << "none beyond the end";
    EXPECT_EQ(FaceTree().findNext(ray, {}, 7.5, FaceTree::kBatch, batch), 0u);
}

}  // namespace
}  // namespace svt::render

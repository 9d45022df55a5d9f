#include <svt/render/camera_presets.hpp>
#include <svt/render/test_volume_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace svt::render {
namespace {

using test::cast;
using test::kTurn;
using test::makeTurnedHouse;
using test::makeVolume;
using test::stylesOf;
using test::TestVolume;

// The planes of its faces.
std::vector<volume::FacePlane> facesOfTurnedHouse() {
    const Vec3d along{std::cos(kTurn), std::sin(kTurn), 0}, across{-std::sin(kTurn), std::cos(kTurn), 0};
    const Vec3d middle{48.5, 48.5, 0.5};
    std::vector<volume::FacePlane> faces;
    const auto add = [&](Vec3d normal, double height) {
        volume::FacePlane& face = faces.emplace_back();
        const double scale = 1 / length(normal);
        face.plane = {normal * scale, -(dot(normal, middle) + height) * scale};
        face.max = {96, 96, 72};
    };
    for (const double x : {-34.0, -28.0, 4.0, 9.0, 28.0, 34.0}) add(along, x);
    for (const double y : {-26.0, -20.0, 20.0, 26.0}) add(across, y);
    for (const double slope : {-0.9, 0.9})
        for (const double top : {60.0, 66.0}) add(Vec3d{0, 0, 1} + across * slope, top);
    for (const double z : {2.5, 29.5, 35.5}) add({0, 0, 1}, z);
    return faces;
}

std::vector<Style> styles(float opacity) {
    std::vector<Style> result;
    for (int n = 0; n < 5; ++n) result.push_back({{0.2f + 0.15f * float(n), 0.8f - 0.1f * float(n), 0.5f}, opacity});
    return stylesOf(std::move(result));
}

FrameSpec view(const TestVolume& volume, const char* name, float opacity) {
    return test::presetFrame(131, 87, name, volume, styles(opacity));
}

void expectSame(const TestVolume& volume, const FrameSpec& spec) {
    const Frame frame = cast(volume, spec);
    const auto reference = castRaysReference(volume.bricks, volume.grid, spec);
    ASSERT_TRUE(reference.hasValue());
    EXPECT_EQ(frame.label, reference->label);
    EXPECT_EQ(frame.depth, reference->depth);
    EXPECT_EQ(frame.color, reference->color);
}

void expectThePictureOfThePlainCaster(const TestVolume& volume) {
    for (const char* name : {"iso", "front", "left", "top", "iso-nw"}) {
        if (!cameraPreset(name, volume.grid)) continue;
        for (const float opacity : {1.0f, 0.4f, 0.02f}) {
            SCOPED_TRACE(name);
            FrameSpec spec = view(volume, name, opacity);
            expectSame(volume, spec);
            spec.passes[0].clips = {ClipRegion::plane({0.2, -1, 0.3}, {4.8, 5, 3}),
                                    ClipRegion::box({{1, 1, 1}, {5, 5, 3}}, ClipRegion::Mode::CutAway)};
            expectSame(volume, spec);
            spec.passes.push_back({styles(0.1f), {}, Pass::Join::Depth});
            spec.samplesPerPixel = 4;
            spec.borders.strength = 0.7f;
            expectSame(volume, spec);
            spec.passes[0].clips.push_back(
                {{{{}, {RoundBody::ball({5, 4, 3}, 2.5)}},
                  {{}, {RoundBody::cone({5, 5, 1}, {-1, -1, 1}, {0.5, -0.5, 0}, {1, 1, 2})}}},
                 ClipRegion::Mode::CutAway});
            for (std::size_t s = 1; s < 5; ++s) spec.passes[0].styles[s].hatch = static_cast<Hatch>(s);
            spec.hatches.spacing = 0.3;
            spec.borders.width = 2;
            spec.borders.cutWidth = 5;
            spec.borders.color = {0.1f, 0.2f, 0.6f};
            expectSame(volume, spec);
        }
    }
}

TEST(PacketCaster, GivesTheVeryPictureOfThePlainCaster) { expectThePictureOfThePlainCaster(makeTurnedHouse()); }

TEST(PacketCaster, GivesItWhereFacesMeetByThrees) {
    TestVolume volume = makeTurnedHouse();
    const std::vector<volume::FacePlane> faces = facesOfTurnedHouse();
    volume.bricks = *volume::BrickVolume::fromColumns(volume.columns, {.planes = faces});
    const auto codes = volume.bricks.arrays().codes;
    ASSERT_GT(std::count_if(codes.begin(), codes.end(),
                            [](const auto& code) { return code.plane[2] != volume::BrickVolume::kNoPlane; }),
              10);
    EXPECT_LE(volume.bricks.planes().size(), faces.size());
    expectThePictureOfThePlainCaster(volume);
}

// A shell of four voxels: six faces meet at each corner, more than a code has places for planes.
TEST(PacketCaster, GivesItWherePlanesTakeThePlaceOfCuts) {
    const Vec3d low{9.8, 10.3, 10.1}, high{69.6, 62.1, 46.3};
    constexpr double kWidth = 3.7;
    TestVolume volume = makeVolume({80, 80, 56}, {0.125, 0.125, 0.125}, [&](int i, int j, int k) {
        const Vec3d p{i + 0.5, j + 0.5, k + 0.5};
        const auto isIn = [&](double inset) {
            for (int axis = 0; axis < 3; ++axis)
                if (p[axis] < low[axis] + inset || p[axis] > high[axis] - inset) return false;
            return true;
        };
        return isIn(kWidth) ? (i < 37 ? 3u : 2u) : isIn(0) ? 1u : 0u;
    });
    std::vector<volume::FacePlane> faces;
    for (int axis = 0; axis < 3; ++axis)
        for (const double at : {low[axis], low[axis] + kWidth, high[axis] - kWidth, high[axis]}) {
            volume::FacePlane& face = faces.emplace_back();
            face.plane.normal[axis] = 1;
            face.plane.offset = -at;
            face.max = {80, 80, 56};
        }
    volume.bricks = *volume::BrickVolume::fromColumns(volume.columns, {.planes = faces});
    const auto codes = volume.bricks.arrays().codes;
    ASSERT_GT(std::count_if(codes.begin(), codes.end(),
                            [](const auto& code) { return code.planeInCut(0) != volume::BrickVolume::kNoPlane; }),
              7);
    expectThePictureOfThePlainCaster(volume);
}

// Passes are cast from the last to the first; rays for which a later pass hides all before it are skipped.
TEST(PacketCaster, LightsRaysOfMoreLabelsThanItKeeps) {
    TestVolume volume = makeVolume({96, 40, 40}, {0.1, 0.1, 0.1}, [](std::int32_t i, std::int32_t j, std::int32_t k) {
        return static_cast<volume::Scalar>(1 + (i + (j * j + k) / 7) % 5);
    });
    for (const volume::BrickFaces faces : {volume::BrickFaces::Planes, volume::BrickFaces::Voxels}) {
        volume.bricks = *volume::BrickVolume::fromColumns(volume.columns, {.faces = faces});
        for (const char* name : {"left", "iso"})
            for (const float opacity : {0.02f, 0.5f, 0.97f}) {
                SCOPED_TRACE(testing::Message() << name << ' ' << opacity);
                FrameSpec spec = view(volume, name, opacity);
                expectSame(volume, spec);
                spec.samplesPerPixel = 4;
                expectSame(volume, spec);
            }
    }
}

TEST(PacketCaster, JoinsPassesAsThePlainCasterDoes) {
    const TestVolume volume = makeTurnedHouse();
    for (const Pass::Join second : {Pass::Join::Over, Pass::Join::Replace, Pass::Join::Depth})
        for (const Pass::Join third : {Pass::Join::Over, Pass::Join::Replace, Pass::Join::Depth})
            for (const float opacity : {1.0f, 0.3f}) {
                FrameSpec spec = view(volume, "iso", 0.4f);
                spec.passes.push_back({styles(opacity), {ClipRegion::plane({0, 0, 1}, {0, 0, 3})}, second});
                spec.passes.push_back(
                    {styles(1), {ClipRegion::box({{2, 2, 1}, {6, 4, 3}}, ClipRegion::Mode::KeepOnly)}, third});
                expectSame(volume, spec);
            }
}

// A fine target in a coarse context: each pass has a grid of its own, and the joins go by metres.
TEST(PacketCaster, PassesOfSeveralVolumesJoinAsThePlainCasterJoinsThem) {
    const TestVolume volume = makeTurnedHouse();
    const auto levels = *volume::buildLodPyramid(volume.columns, volume.grid, 2);
    const std::vector<DrawnVolume> volumes{{volume.bricks, volume.grid}, levels[1], levels[0]};
    for (const Pass::Join join : {Pass::Join::Over, Pass::Join::Replace, Pass::Join::Depth})
        for (const float opacity : {1.0f, 0.3f}) {
            FrameSpec spec = view(volume, "iso", opacity);
            spec.samplesPerPixel = 4;
            spec.borders.strength = 0.6f;
            spec.passes[0].volume = 1;
            spec.passes.push_back({styles(0.5f), {ClipRegion::plane({0, 0, 1}, {0, 0, 3})}, join, 0});
            spec.passes.push_back({styles(1), {ClipRegion::plane({1, 0, 0}, {4, 0, 0})}, join, 2});
            const auto frame = castRays(volumes, spec), reference = castRaysReference(volumes, spec);
            ASSERT_TRUE(frame && reference);
            EXPECT_EQ(frame->label, reference->label);
            EXPECT_EQ(frame->depth, reference->depth);
            EXPECT_EQ(frame->color, reference->color);
            spec.passes[1].volume = 3;
            EXPECT_EQ(castRays(volumes, spec).error().code(), Code::BadFrame);
        }
}

TEST(PacketCaster, APassLooksTheSameWhateverVolumesOthersDraw) {
    const TestVolume volume = makeTurnedHouse();
    const auto levels = *volume::buildLodPyramid(volume.columns, volume.grid, 2);
    FrameSpec spec = view(volume, "iso-nw", 1);
    const Frame alone = cast(volume, spec);
    spec.passes.insert(spec.passes.begin(), Pass{styles(0), {}, Pass::Join::Over, 0});
    spec.passes[1].volume = 1;
    const std::vector<DrawnVolume> volumes{levels[1], {volume.bricks, volume.grid}};
    const auto beside = castRays(volumes, spec);
    ASSERT_TRUE(beside);
    EXPECT_EQ(beside->label, alone.label);
    EXPECT_EQ(beside->depth, alone.depth);
    EXPECT_EQ(beside->color, alone.color);
}

TEST(PacketCaster, GivesThePictureOfThePlainCasterFromInside) {
    const TestVolume volume = makeTurnedHouse();
    for (int round = 0; round < 12; ++round) {
        FrameSpec spec = view(volume, "iso", round % 2 == 0 ? 1.0f : 0.3f);
        spec.camera.eye = {2.5 + 0.4 * round, 4.1 + 0.1 * round, 1.0 + 0.3 * round};
        spec.camera.target = spec.camera.eye + Vec3d{std::cos(round), std::sin(round), 0.2 * (round % 3 - 1)};
        spec.camera.verticalFovDegrees = 75;
        SCOPED_TRACE(round);
        expectSame(volume, spec);
    }
}

// Planes move a face by less than a voxel, so the label that a ray hits is that of one of the samples around the point.
// Where two planes meet, it may be none of these; then, with rare exceptions, it is that of a sample next to them.
TEST(PacketCaster, HitsALabelThatASampleAroundThePointHas) {
    const TestVolume volume = makeTurnedHouse();
    const FrameSpec spec = view(volume, "iso", 1);
    const Frame frame = cast(volume, spec);
    const Vec3d forward = normalized(spec.camera.target - spec.camera.eye);
    const Vec3d right = normalized(cross(forward, spec.camera.up)), up = cross(right, forward);
    const double half = std::tan(spec.camera.verticalFovDegrees * 3.14159265358979 / 360);
    std::size_t hits = 0, near = 0, beside = 0;
    for (std::int32_t y = 0; y < spec.height; ++y)
        for (std::int32_t x = 0; x < spec.width; ++x) {
            const volume::Scalar label = frame.label.at(x, y);
            if (label == 0) continue;
            ++hits;
            const double u = (2 * (x + 0.5) / spec.width - 1) * half * spec.width / spec.height,
                         v = (1 - 2 * (y + 0.5) / spec.height) * half;
            const Vec3d world =
                spec.camera.eye + (forward + right * u + up * v) * static_cast<double>(frame.depth.at(x, y));
            const Vec3d index = volume.grid.indexFromWorld(world);
            // Samples around the point, and samples next to those.
            bool isBeside = false, isNear = false;
            for (std::int32_t n = 0; n < 64; ++n) {
                const Vec3i away{n % 4 - 1, n / 4 % 4 - 1, n / 16 - 1};
                Vec3i at;
                for (int axis = 0; axis < 3; ++axis)
                    at[axis] = std::clamp(static_cast<std::int32_t>(std::floor(index[axis])) + away[axis], 0,
                                          volume.grid.dimension()[axis] - 1);
                if (volume.columns.scalarAt(at.x, at.y, at.z) != label) continue;
                isNear = true;
                const auto isNext = [](std::int32_t a) { return a == 0 || a == 1; };
                isBeside = isBeside || (isNext(away.x) && isNext(away.y) && isNext(away.z));
            }
            near += isNear ? 1 : 0;
            beside += isBeside ? 1 : 0;
        }
    EXPECT_GT(hits, 1000u);
    EXPECT_GT(double(near), 0.998 * double(hits));
    EXPECT_GT(double(beside), 0.99 * double(hits));
}

TEST(PacketCaster, AnObliqueWallIsFlatFromNearerThanAVoxel) {
    const Vec3d normal = normalized({0.5, -0.8, 0.33});
    const TestVolume volume = makeVolume({64, 64, 64}, {1, 1, 1}, [&](auto i, auto j, auto k) {
        return dot(normal, Vec3d{i + 0.5, j + 0.5, k + 0.5} - Vec3d{32, 32, 32}) < 0 ? 1u : 0u;
    });
    FrameSpec spec;
    spec.width = spec.height = 64;
    spec.camera.eye = Vec3d{32, 32, 32} + normal * 0.9;
    spec.camera.target = {32, 32, 32};
    spec.camera.verticalFovDegrees = 60;
    spec.passes.push_back({styles(1), {}, Pass::Join::Over});
    const Frame frame = cast(volume, spec);
    for (const float depth : frame.depth.pixels()) EXPECT_NEAR(depth, 0.9, 0.1);
    // Uniform light: no voxel steps.
    for (const image::Rgba8 pixel : frame.color.pixels()) {
        EXPECT_NEAR(pixel.r, frame.color.at(32, 32).r, 3);
        EXPECT_NEAR(pixel.g, frame.color.at(32, 32).g, 3);
    }
}

TEST(PacketCaster, AdaptiveSamplesAreThoseOfAllPixelsButForWhatIsSmallerThanAPixel) {
    const TestVolume volume = makeTurnedHouse();
    FrameSpec spec = view(volume, "iso", 1);
    spec.width = 400;
    spec.height = 266;
    spec.samplesPerPixel = 9;
    spec.borders.strength = 0.6f;
    CastOptions adaptive;
    adaptive.isAdaptive = true;
    const Frame all = cast(volume, spec), some = cast(volume, spec, adaptive);
    EXPECT_EQ(all.label, some.label);
    EXPECT_EQ(all.depth, some.depth);
    std::size_t differ = 0;
    for (std::size_t n = 0; n < all.color.pixels().size(); ++n) {
        const image::Rgba8 a = all.color.pixels()[n], b = some.color.pixels()[n];
        differ += std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) > 12 ? 1 : 0;
    }
    EXPECT_LT(double(differ), 0.004 * double(all.color.pixels().size()));
}

TEST(LevelForView, GrowsWithTheSizeOfAPixelInVoxels) {
    const TestVolume volume = makeTurnedHouse();  // voxels of 0.11 m at most
    FrameSpec spec = view(volume, "iso", 1);
    spec.camera.projection = Camera::Projection::Orthographic;
    const auto levelAt = [&](double pixel) {
        spec.camera.orthographicHeight = pixel * spec.height;
        return levelForView(spec, volume.grid);
    };
    EXPECT_EQ(levelAt(0.05), 0);
    EXPECT_EQ(levelAt(0.43), 0);
    EXPECT_EQ(levelAt(0.45), 1);
    EXPECT_EQ(levelAt(0.9), 2);
    EXPECT_EQ(levelAt(100), 6);
    spec.camera.projection = Camera::Projection::Perspective;
    spec.camera.eye = {4, 4, 3};  // inside
    EXPECT_EQ(levelForView(spec, volume.grid), 0);
}

}  // namespace
}  // namespace svt::render

#include <svt/image/color.hpp>
#include <svt/render/camera_presets.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/render/test_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace svt::render {
namespace {

using test::cast;
using test::countLabel;
using test::frontFrame;
using test::makeBody;
using test::makeVolume;
using test::stylesOf;
using test::TestVolume;

const Style kOpaque{{0.9f, 0.5f, 0.2f}, 1};

int largestChannel(image::Rgba8 a, image::Rgba8 b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b), std::abs(a.a - b.a)});
}

// A house of walls, floor, roof and rooms with `labels`, and a spread of opacities.
TestVolume house() {
    return makeVolume({61, 53, 47}, {0.1, 0.12, 0.15}, [](std::int32_t i, std::int32_t j, std::int32_t k) {
        if (k < 3) return 1u;
        const bool isRoof = std::abs(j - 26) + (k - 20) < 22 && k >= 20;
        if (i < 5 || i >= 56 || j < 5 || j >= 48) return isRoof && i > 2 && i < 58 && k > 22 ? 2u : 0u;
        if (k < 24) return i < 8 || i >= 53 || j < 8 || j >= 45 ? 3u + unsigned(k > 14) : i < 30 ? 5u : 6u;
        return isRoof ? (std::abs(j - 26) + (k - 20) < 19 ? 7u : 2u) : 0u;
    });
}

std::vector<Style> houseStyles(bool isGlass) {
    std::vector<Style> styles;
    for (int n = 0; n < 7; ++n)
        styles.push_back({{0.3f + 0.1f * float(n), 0.9f - 0.1f * float(n), 0.5f},
                          isGlass && n != 0 ? 0.2f + 0.1f * float(n)
                          : n < 4           ? 1.0f
                                            : 0.0f});
    return stylesOf(styles);
}

void expectSameFrame(const TestVolume& volume, const FrameSpec& spec, const CastOptions& options = {}) {
    const Frame frame = cast(volume, spec, options);
    const auto reference = castRaysReference(volume.bricks, volume.grid, spec, options);
    ASSERT_TRUE(reference.hasValue());
    EXPECT_EQ(frame.label, reference->label);
    EXPECT_EQ(frame.depth, reference->depth);
    int largest = 0;
    for (std::size_t n = 0; n < frame.color.pixels().size(); ++n)
        largest = std::max(largest, largestChannel(frame.color.pixels()[n], reference->color.pixels()[n]));
    EXPECT_LE(largest, 1);
}

TEST(RayCaster, EqualsTheReferenceFromAllSides) {
    const TestVolume volume = house();
    for (const std::string_view name : cameraPresetNames())
        for (const bool isGlass : {false, true})
            for (const auto projection : {Camera::Projection::Perspective, Camera::Projection::Orthographic}) {
                FrameSpec spec;
                spec.width = 97;
                spec.height = 61;
                PresetOptions preset;
                preset.projection = projection;
                preset.aspect = 97.0 / 61;
                spec.camera = *cameraPreset(name, volume.grid, preset);
                spec.passes.push_back({houseStyles(isGlass), {}, Pass::Join::Over});
                SCOPED_TRACE(name);
                expectSameFrame(volume, spec);
            }
}

TEST(RayCaster, EqualsTheReferenceFromInsideAndOnVoxelBorders) {
    const TestVolume volume = house();
    std::mt19937 random(12);
    for (int round = 0; round < 40; ++round) {
        const auto pick = [&](double size, double step) {
            return round % 2 == 0 ? step * double(random() % unsigned(size / step))
                                  : size * double(random() % 1000) / 1000;
        };
        FrameSpec spec;
        spec.width = spec.height = 24;
        spec.camera.verticalFovDegrees = 80;
        spec.camera.eye = {pick(6.1, 0.1), pick(6.36, 0.12), pick(7.05, 0.15)};
        spec.camera.target = {pick(6.1, 0.1), pick(6.36, 0.12), pick(7.05, 0.15) + 1e-3};
        spec.camera.up = {0.1, 0.2, 1};
        spec.samplesPerPixel = 4;
        spec.borders.strength = 0.5f;
        spec.passes.push_back({houseStyles(round % 3 != 0), {}, Pass::Join::Over});
        if (round % 4 == 1) spec.passes[0].clips.push_back(ClipRegion::plane({0.3, -1, 0.2}, {3, 3, 3}));
        CastOptions options;
        options.labelAt = round % 5 == 0 ? 0.4f : 0;
        SCOPED_TRACE(round);
        expectSameFrame(volume, spec, options);
    }
}

TEST(RayCaster, EqualsTheReferenceInNoise) {
    std::mt19937 random(8);
    const TestVolume volume = makeVolume(
        {40, 33, 37}, {1, 1, 1}, [&](auto, auto, auto k) { return k < 20 && random() % 4 != 0 ? 0u : random() % 12; });
    std::vector<Style> styles;
    for (int n = 0; n < 11; ++n)
        styles.push_back({{0.1f * float(n), 0.5f, 0.5f}, n == 3 ? 1.0f : 0.08f * float(n % 4)});
    for (const std::string_view name : {"iso", "left", "top"}) {
        FrameSpec spec;
        spec.width = 90;
        spec.height = 70;
        spec.camera = *cameraPreset(name, volume.grid);
        spec.passes.push_back({stylesOf(styles), {}, Pass::Join::Over});
        spec.samplesPerPixel = 9;
        SCOPED_TRACE(name);
        expectSameFrame(volume, spec);
    }
}

TEST(RayCaster, BoxHasItsExactPixelsAndDepth) {
    // 20 m wide, 10 m high; 10 pixels a metre, borders on pixel borders.
    const TestVolume volume = makeBody({60, 40, 40}, {0.5, 0.5, 0.5}, [](Vec3d p) {
        return p.x > 5 && p.x < 25 && p.y > 3 && p.y < 12 && p.z > 4 && p.z < 14;
    });
    FrameSpec spec = frontFrame(400, 200, {15, 0, 10}, 20, stylesOf({kOpaque}));
    const Frame frame = cast(volume, spec);
    EXPECT_EQ(countLabel(frame, 1), 200u * 100u);
    EXPECT_EQ(frame.label.at(99, 100), 0u);
    EXPECT_EQ(frame.label.at(100, 100), 1u);
    EXPECT_EQ(frame.label.at(200, 59), 0u);
    EXPECT_EQ(frame.label.at(200, 60), 1u);
    for (std::size_t n = 0; n < frame.depth.pixels().size(); ++n) {
        const bool isHit = frame.label.pixels()[n] != 0;
        EXPECT_EQ(frame.depth.pixels()[n], isHit ? 103.0f : std::numeric_limits<float>::infinity());
    }
    EXPECT_EQ(frame.color.at(5, 5), (image::Rgba8{255, 255, 255, 255}));
}

TEST(RayCaster, SphereHasItsAreaAndDepth) {
    const Vec3d middle{4, 4, 4};
    const TestVolume volume =
        makeBody({160, 160, 160}, {0.05, 0.05, 0.05}, [&](Vec3d p) { return length(p - middle) < 3; });
    const Frame frame = cast(volume, frontFrame(200, 200, middle, 8, stylesOf({kOpaque})));
    const double area = double(countLabel(frame, 1)) * 0.04 * 0.04;
    EXPECT_NEAR(area, std::numbers::pi * 9, 0.01 * std::numbers::pi * 9);
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; ++x) {
            const double dx = (x + 0.5 - 100) * 0.04, dz = (y + 0.5 - 100) * 0.04, r = 9 - dx * dx - dz * dz;
            if (r < 2) continue;  // where the sphere is steep, one voxel sideways is many in depth
            EXPECT_NEAR(double(frame.depth.at(x, y)), 100 - std::sqrt(r), 0.12);
        }
}

TEST(RayCaster, PerspectiveSeesAHalfSpaceAtItsDepthEverywhere) {
    const TestVolume volume = makeBody({80, 40, 80}, {0.5, 0.5, 0.5}, [](Vec3d p) { return p.y > 10; });
    FrameSpec spec = frontFrame(64, 48, {20, 10, 20}, 1, stylesOf({kOpaque}));
    spec.camera.projection = Camera::Projection::Perspective;
    spec.camera.eye = {20, -10, 20};
    spec.camera.verticalFovDegrees = 40;
    const Frame frame = cast(volume, spec);
    EXPECT_EQ(countLabel(frame, 1), 64u * 48u);
    for (const float depth : frame.depth.pixels()) EXPECT_NEAR(double(depth), 20, 1e-5);
}

TEST(RayCaster, ColorIsBeerLambertOverTheLength) {
    // 3 m of glass that stops 30 % a metre, before white: 0.7^3 of the white comes through.
    const TestVolume volume = makeBody({40, 40, 40}, {0.25, 0.25, 0.25}, [](Vec3d p) { return p.y > 2 && p.y < 5; });
    FrameSpec spec = frontFrame(8, 8, {5, 0, 5}, 2, stylesOf({{{0, 0, 0}, 0.3f}}));
    const Frame frame = cast(volume, spec);
    const auto expected = std::lround(255 * image::srgbFromLinear(0.7f * 0.7f * 0.7f));
    EXPECT_NEAR(frame.color.at(4, 4).r, expected, 1);
    spec.background.alpha = 0;
    const Frame bare = cast(volume, spec);
    EXPECT_NEAR(bare.color.at(4, 4).a, std::lround(255 * (1 - 0.343)), 1);
    EXPECT_EQ(bare.color.at(4, 4).r, 0);
}

TEST(RayCaster, OpacityDoesNotDependOnTheSpacing) {
    const auto body = [](Vec3d p) {
        return p.x > 2 && p.x < 8 && p.y > 2 && p.y < 8 && p.z > 2 && p.z < 8 && !(p.y > 4 && p.y < 5);
    };
    FrameSpec spec = frontFrame(64, 64, {5, 5, 5}, 10, stylesOf({{{0.2f, 0.6f, 0.9f}, 0.15f}}));
    const Frame coarse = cast(makeBody({20, 20, 20}, {0.5, 0.5, 0.5}, body), spec);
    const Frame fine = cast(makeBody({80, 40, 100}, {0.125, 0.25, 0.1}, body), spec);
    int largest = 0;
    for (std::size_t n = 0; n < coarse.color.pixels().size(); ++n)
        largest = std::max(largest, largestChannel(coarse.color.pixels()[n], fine.color.pixels()[n]));
    EXPECT_LE(largest, 1);
    EXPECT_EQ(coarse.label, fine.label);
}

TEST(RayCaster, GlassOfTheSameObjectHasNoSurfaceInside) {
    // Two phases of one object look like one body; two objects do not.
    const auto phases = makeVolume({20, 20, 20}, {0.5, 0.5, 0.5}, [](auto, auto j, auto) { return j < 10 ? 1u : 2u; });
    const auto whole = makeVolume({20, 20, 20}, {0.5, 0.5, 0.5}, [](auto, auto, auto) { return 1u; });
    const Style glass{{0.3f, 0.4f, 0.8f}, 0.1f};
    FrameSpec spec = frontFrame(16, 16, {5, 5, 5}, 8, stylesOf({glass, glass}));
    spec.objectOfScalar = {0, 1, 1};
    const Frame a = cast(phases, spec), b = cast(whole, spec);
    for (std::size_t n = 0; n < a.color.pixels().size(); ++n)
        EXPECT_LE(largestChannel(a.color.pixels()[n], b.color.pixels()[n]), 1);
}

TEST(RayCaster, ClipPlaneShowsTheLabelThatItCuts) {
    const auto volume =
        makeVolume({40, 40, 40}, {0.25, 0.25, 0.25}, [](auto i, auto, auto) { return i < 20 ? 1u : 2u; });
    FrameSpec spec = frontFrame(40, 40, {5, 5, 5}, 8, stylesOf({kOpaque, {{0, 0.5f, 0}, 1}}));
    spec.passes[0].clips.push_back(ClipRegion::plane({0, -1, 0}, {0, 3.1, 0}));
    const Frame frame = cast(volume, spec);
    EXPECT_EQ(countLabel(frame, 1), 800u);
    EXPECT_EQ(countLabel(frame, 2), 800u);
    for (const float depth : frame.depth.pixels()) EXPECT_NEAR(double(depth), 98.1, 1e-5);
    spec.passes[0].clips.push_back(ClipRegion::plane({1, 0, 0}, {2.5, 0, 0}));
    EXPECT_EQ(countLabel(cast(volume, spec), 2), 0u);
}

TEST(RayCaster, CutFacesAreLitByThePlane) {
    // An oblique cut is one flat colour, with no steps of voxels.
    const TestVolume volume = makeBody({40, 40, 40}, {0.25, 0.25, 0.25}, [](Vec3d) { return true; });
    FrameSpec spec = frontFrame(40, 40, {5, 5, 5}, 4, stylesOf({kOpaque}));
    spec.light.ambientOcclusion = 0;
    spec.passes[0].clips.push_back(ClipRegion::plane({0.3, -1, 0.7}, {5, 5, 5}));
    const Frame frame = cast(volume, spec);
    for (const image::Rgba8 pixel : frame.color.pixels()) EXPECT_EQ(pixel, frame.color.at(0, 0));
}

TEST(RayCaster, HiddenLabelsAreNotThere) {
    const TestVolume volume = house();
    FrameSpec spec = frontFrame(50, 50, {3, 3, 3}, 8, houseStyles(false));
    const Frame all = cast(volume, spec);
    EXPECT_GT(countLabel(all, 3), 0u);
    spec.passes[0].styles[3].opacity = 0;
    EXPECT_EQ(countLabel(cast(volume, spec), 3), 0u);
    spec.passes[0].styles.resize(2);
    const Frame few = cast(volume, spec);
    EXPECT_EQ(countLabel(few, 1) + countLabel(few, 0), 2500u);
    spec.passes.clear();
    EXPECT_EQ(countLabel(cast(volume, spec), 0), 2500u);
}

TEST(RayCaster, LabelAtLooksThroughGhosts) {
    const auto volume = makeVolume({20, 20, 20}, {1, 1, 1}, [](auto, auto j, auto) { return j < 10 ? 1u : 2u; });
    const FrameSpec spec = frontFrame(4, 4, {10, 0, 10}, 4, stylesOf({{{1, 1, 1}, 0.01f}, kOpaque}));
    EXPECT_EQ(cast(volume, spec).label.at(1, 1), 1u);
    CastOptions options;
    options.labelAt = 0.5f;
    const Frame through = cast(volume, spec, options);
    EXPECT_EQ(through.label.at(1, 1), 2u);
    EXPECT_FLOAT_EQ(through.depth.at(1, 1), 110);
}

TEST(RayCaster, AnEyeInsideABodySeesItAtOnce) {
    const TestVolume volume = makeBody({20, 20, 20}, {1, 1, 1}, [](Vec3d) { return true; });
    FrameSpec spec = frontFrame(5, 5, {10, 10, 10}, 4, stylesOf({kOpaque}));
    spec.camera.eye = {10, 5, 10};
    const Frame frame = cast(volume, spec);
    EXPECT_EQ(countLabel(frame, 1), 25u);
    for (const float depth : frame.depth.pixels()) EXPECT_EQ(depth, 0);
}

TEST(RayCaster, RaysAlongVoxelBordersAndOutsideAreWellBehaved) {
    // The middle ray runs exactly on the planes between voxels; the others pass beside the volume.
    const TestVolume volume = makeBody({16, 16, 16}, {1, 1, 1}, [](Vec3d) { return true; });
    for (const std::string_view name : {"front", "top", "left", "back", "bottom", "right"}) {
        PresetOptions preset;
        preset.aspect = 1;
        preset.projection = Camera::Projection::Orthographic;
        preset.margin = 0.25;
        FrameSpec spec;
        spec.width = spec.height = 33;
        spec.camera = *cameraPreset(name, volume.grid, preset);
        spec.passes.push_back({stylesOf({kOpaque}), {}, Pass::Join::Over});
        const Frame frame = cast(volume, spec);
        EXPECT_EQ(countLabel(frame, 1), 17u * 17u) << name;  // |u| < 0.5: pixels 8 to 24
        EXPECT_EQ(frame.label.at(16, 16), 1u);
    }
}

TEST(RayCaster, PassesJoinAsAsked) {
    const auto volume = makeVolume({20, 20, 20}, {1, 1, 1}, [](auto i, auto j, auto) {
        return j >= 5 && j < 8 ? 1u : j >= 12 && i < 10 ? 2u : 0u;
    });
    FrameSpec spec = frontFrame(20, 20, {10, 0, 10}, 20, {});
    const Style front{{1, 0, 0}, 1}, back{{0, 1, 0}, 0.9f};
    spec.passes = {{stylesOf({front}), {}, Pass::Join::Over}, {stylesOf({{{}, 0}, back}), {}, Pass::Join::Over}};
    const auto labelsOf = [&](Pass::Join join) {
        spec.passes[1].join = join;
        const Frame frame = cast(volume, spec);
        return std::pair{frame.label.at(5, 10), frame.label.at(15, 10)};
    };
    EXPECT_EQ(labelsOf(Pass::Join::Over), (std::pair{2u, 1u}));
    EXPECT_EQ(labelsOf(Pass::Join::Replace), (std::pair{2u, 1u}));
    EXPECT_EQ(labelsOf(Pass::Join::Depth), (std::pair{1u, 1u}));
    // Replace drops what is behind: transparent before nothing.
    spec.background.alpha = 0;
    spec.passes[1].styles[2].opacity = 0.1f;
    spec.passes[1].join = Pass::Join::Replace;
    EXPECT_LT(cast(volume, spec).color.at(5, 10).a, 255);
    spec.passes[1].join = Pass::Join::Over;
    EXPECT_EQ(cast(volume, spec).color.at(5, 10).a, 255);
}

TEST(RayCaster, PassesThatDoNotMeetAreTheSameInAnyOrder) {
    const TestVolume volume = house();
    FrameSpec spec = frontFrame(60, 60, {3, 3, 3}, 8, {});
    spec.camera.eye = {-20, -30, 25};
    auto ground = houseStyles(false), rest = houseStyles(false);
    for (std::size_t n = 2; n < ground.size(); ++n) ground[n].opacity = 0;
    rest[1].opacity = 0;
    spec.light.ambientOcclusion = 0;
    spec.passes = {{ground, {}, Pass::Join::Depth}, {rest, {}, Pass::Join::Depth}};
    const Frame a = cast(volume, spec);
    std::swap(spec.passes[0], spec.passes[1]);
    const Frame b = cast(volume, spec);
    EXPECT_EQ(a.label, b.label);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.color, b.color);
}

TEST(RayCaster, DoesNotDependOnTheThreads) {
    const TestVolume volume = house();
    FrameSpec spec;
    spec.width = 211;
    spec.height = 133;
    spec.samplesPerPixel = 4;
    spec.borders.strength = 0.7f;
    spec.camera = *cameraPreset("iso-nw", volume.grid);
    spec.passes.push_back({houseStyles(true), {ClipRegion::plane({1, 1, 0}, {3, 3, 3})}, Pass::Join::Over});
    CastOptions one, many;
    one.threads = 1;
    many.threads = 4;
    const Frame a = cast(volume, spec, one), b = cast(volume, spec, many);
    EXPECT_EQ(a.color, b.color);
    EXPECT_EQ(a.label, b.label);
    EXPECT_EQ(a.depth, b.depth);
}

TEST(RayCaster, TilesLeaveNoSeams) {
    // With border lines and samples across tiles: a picture is the same as the middle of a larger one.
    const TestVolume volume = house();
    FrameSpec small = frontFrame(64, 64, {3, 3, 3}, 8, houseStyles(true));
    small.borders.strength = 0.8f;
    small.samplesPerPixel = 4;
    FrameSpec large = small;
    large.width = large.height = 96;  // 16 pixels more on each side
    large.camera.orthographicHeight = 12;
    const Frame a = cast(volume, small), b = cast(volume, large);
    int differing = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            differing += a.label.at(x, y) != b.label.at(x + 16, y + 16) ||
                         largestChannel(a.color.at(x, y), b.color.at(x + 16, y + 16)) > 2;
    EXPECT_LE(differing, 8);  // rays that rounding moves over a voxel's border
}

TEST(RayCaster, EdgesDarkenBordersOnly) {
    const auto volume =
        makeVolume({40, 40, 40}, {0.25, 0.25, 0.25}, [](auto i, auto, auto) { return i < 20 ? 1u : 2u; });
    FrameSpec spec = frontFrame(40, 40, {5, 5, 5}, 8, stylesOf({kOpaque, kOpaque}));
    const Frame plain = cast(volume, spec);
    spec.borders.strength = 1;
    const Frame lined = cast(volume, spec);
    for (int x = 0; x < 40; ++x) {
        const bool isBorder = x == 19;
        EXPECT_EQ(lined.color.at(x, 20) == plain.color.at(x, 20), !isBorder) << x;
    }
    EXPECT_EQ(lined.color.at(19, 20), (image::Rgba8{0, 0, 0, 255}));
    spec.objectOfScalar = {0, 1, 1};
    EXPECT_EQ(cast(volume, spec).color, plain.color);
}

TEST(RayCaster, SamplesSmoothBordersInLinearLight) {
    const TestVolume volume = makeBody({40, 40, 40}, {0.25, 0.25, 0.25}, [](Vec3d p) { return p.x > 5; });
    FrameSpec spec = frontFrame(3, 3, {5, 5, 5}, 3, stylesOf({{{0, 0, 0}, 1}}));
    spec.samplesPerPixel = 16;
    const Frame frame = cast(volume, spec);
    EXPECT_EQ(frame.color.at(0, 1).r, 255);
    EXPECT_EQ(frame.color.at(1, 1).r, 188);  // half of the light
    EXPECT_EQ(frame.color.at(2, 1).r, 0);
}

TEST(RayCaster, SurfacesFacingTheLightAreBrighter) {
    const TestVolume volume = makeBody({40, 40, 40}, {0.25, 0.25, 0.25}, [](Vec3d p) {
        return length(p - Vec3d{5, 5, 5}) < 4;
    });
    FrameSpec spec = frontFrame(101, 101, {5, 5, 5}, 10, stylesOf({kOpaque}));
    const Frame frame = cast(volume, spec);
    EXPECT_GT(frame.color.at(38, 30).r, frame.color.at(50, 50).r);
    EXPECT_GT(frame.color.at(50, 50).r, frame.color.at(65, 75).r + 20);
    spec.light.space = Light::Space::World;
    spec.light.direction = {1, 0, -1};
    const Frame below = cast(volume, spec);
    EXPECT_LT(below.color.at(38, 30).r, below.color.at(65, 75).r);
}

// The same wall inside and outside: the rim of a Replace pass is drawn even where nothing else changes.
TEST(RayCaster, ALensHasARim) {
    const TestVolume volume = makeBody({40, 40, 40}, {0.25, 0.25, 0.25}, [](Vec3d p) { return p.y > 5; });
    FrameSpec spec = frontFrame(100, 100, {5, 5, 5}, 10, stylesOf({kOpaque}));
    spec.light.ambientOcclusion = 0;
    spec.borders.strength = 1;
    spec.passes.push_back(spec.passes[0]);
    spec.passes[1].clips = {ClipRegion::box({{2.5, 0, 2.5}, {7.5, 10, 7.5}}, ClipRegion::Mode::KeepOnly)};
    const Frame over = cast(volume, spec);
    EXPECT_EQ(over.color.at(25, 50), over.color.at(50, 50));
    spec.passes[1].join = Pass::Join::Replace;
    const Frame lens = cast(volume, spec);
    EXPECT_EQ(lens.color.at(50, 50), over.color.at(50, 50));
    EXPECT_EQ(lens.color.at(24, 50), over.color.at(50, 50));  // outside
    for (const auto& [x, y] : {std::pair{25, 50}, {74, 50}, {50, 25}, {50, 74}}) EXPECT_LT(lens.color.at(x, y).r, 10);
}

TEST(RayCaster, CornersAreDarker) {
    const TestVolume volume = makeBody({80, 80, 80}, {0.25, 0.25, 0.25}, [](Vec3d p) { return p.z < 5 || p.y > 15; });
    FrameSpec spec = frontFrame(100, 100, {10, 5, 10}, 14, stylesOf({kOpaque}));
    const Frame frame = cast(volume, spec);
    EXPECT_LT(frame.color.at(50, 84).r + 15, frame.color.at(50, 40).r);
    spec.light.ambientOcclusion = 0;
    const Frame plain = cast(volume, spec);
    EXPECT_EQ(plain.color.at(50, 84), plain.color.at(50, 40));
}

TEST(RayCaster, BackgroundIsAGradientWithAlpha) {
    const TestVolume volume = makeBody({4, 4, 4}, {1, 1, 1}, [](Vec3d) { return false; });
    FrameSpec spec = frontFrame(4, 100, {2, 2, 2}, 10, {});
    spec.background = {{1, 1, 1}, {0, 0, 0}, 0.5f};
    const Frame frame = cast(volume, spec);
    EXPECT_GT(frame.color.at(0, 0).r, 250);
    EXPECT_NEAR(frame.color.at(0, 50).r, 188, 2);
    EXPECT_LT(frame.color.at(0, 99).r, 25);
    EXPECT_EQ(frame.color.at(0, 50).a, 128);
    spec.background.alpha = 0;
    EXPECT_EQ(cast(volume, spec).color.at(0, 0), (image::Rgba8{0, 0, 0, 0}));
}

TEST(RayCaster, SizesAndValuesOutOfRangeAreBadFrames) {
    const TestVolume volume = makeBody({4, 4, 4}, {1, 1, 1}, [](Vec3d) { return true; });
    const FrameSpec good = frontFrame(1, 1, {2, 2, 2}, 4, stylesOf({kOpaque}));
    EXPECT_EQ(cast(volume, good).label.at(0, 0), 1u);
    const auto codeOf = [&](const std::function<void(FrameSpec&)>& change) {
        FrameSpec spec = good;
        change(spec);
        const auto frame = castRays(volume.bricks, volume.grid, spec);
        return frame ? Code::Internal : frame.error().code();
    };
    const auto nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(codeOf([](FrameSpec& s) { s.width = 0; }), Code::BadFrame);
    EXPECT_EQ(codeOf([](FrameSpec& s) { s.height = 16385; }), Code::BadFrame);
    EXPECT_EQ(codeOf([](FrameSpec& s) { s.samplesPerPixel = 2; }), Code::BadFrame);
    EXPECT_EQ(codeOf([](FrameSpec& s) { s.borders.strength = 1.5f; }), Code::BadFrame);
    EXPECT_EQ(codeOf([](FrameSpec& s) { s.light.direction = {}; }), Code::BadFrame);
    EXPECT_EQ(codeOf([](FrameSpec& s) { s.background.alpha = -1; }), Code::BadFrame);
    EXPECT_EQ(codeOf([](FrameSpec& s) { s.passes[0].styles[1].opacity = 1.1f; }), Code::BadFrame);
    EXPECT_EQ(codeOf([](FrameSpec& s) { s.passes[0].clips = {ClipRegion{}}; }), Code::BadFrame);
    EXPECT_EQ(codeOf([](FrameSpec& s) { s.passes[0].clips = {ClipRegion::plane({}, {})}; }), Code::BadFrame);
    EXPECT_EQ(codeOf([](FrameSpec& s) {
                  s.passes[0].clips.assign(Pass::kMaxClipParts + 1, ClipRegion::plane({1, 0, 0}, {}));
              }),
              Code::BadFrame);
    EXPECT_EQ(codeOf([](FrameSpec& s) { s.camera.up = {}; }), Code::BadCamera);
    EXPECT_EQ(codeOf([](FrameSpec& s) { s.camera.up = {0, 1, 0}; }), Code::BadCamera);
    EXPECT_EQ(codeOf([](FrameSpec& s) { s.camera.target = s.camera.eye; }), Code::BadCamera);
    EXPECT_EQ(codeOf([&](FrameSpec& s) { s.camera.eye.x = nan; }), Code::BadCamera);
    EXPECT_EQ(codeOf([](FrameSpec& s) { s.camera.orthographicHeight = 0; }), Code::BadCamera);
    EXPECT_EQ(codeOf([](FrameSpec& s) {
                  s.camera.projection = Camera::Projection::Perspective;
                  s.camera.verticalFovDegrees = 180;
              }),
              Code::BadCamera);
    EXPECT_EQ(
        castRays(volume.bricks, *volume::Grid::fromDimension({{0, 0, 0}, {1, 1, 1}}, {4, 4, 5}), good).error().code(),
        Code::BadArgument);
    CastOptions options;
    options.opaqueAt = 0;
    EXPECT_EQ(castRays(volume.bricks, volume.grid, good, options).error().code(), Code::BadArgument);
}

TEST(RayCaster, TheWidestPictureIsPossible) {
    const TestVolume volume = makeBody({4, 4, 4}, {1, 1, 1}, [](Vec3d) { return true; });
    const Frame frame = cast(volume, frontFrame(16384, 1, {2, 2, 2}, 4.0 / 16384, stylesOf({kOpaque})));
    EXPECT_EQ(countLabel(frame, 1), 16384u);
}

TEST(RayCaster, FarCoordinatesAreAsExactAsNearOnes) {
    const TestVolume near = house();
    TestVolume far = near;
    const Vec3d shift{458877, 5438353, 111};
    far.grid = *volume::Grid::fromParts(near.grid.dimension(), near.grid.spacing(), near.grid.origin() + shift,
                                        near.grid.axes());
    FrameSpec spec = frontFrame(80, 80, {3, 3, 3}, 8, houseStyles(true));
    spec.camera.eye = {-20, -30, 25};
    const Frame a = cast(near, spec);
    spec.camera.eye = spec.camera.eye + shift;
    spec.camera.target = spec.camera.target + shift;
    const Frame b = cast(far, spec);
    int differing = 0;
    for (std::size_t n = 0; n < a.label.pixels().size(); ++n) differing += a.label.pixels()[n] != b.label.pixels()[n];
    EXPECT_LE(differing, 3);
}

TEST(RayCaster, CanBeCancelled) {
    const TestVolume volume = makeBody({4, 4, 4}, {1, 1, 1}, [](Vec3d) { return true; });
    Progress progress;
    progress.cancel = true;
    CastOptions options;
    options.progress = &progress;
    const auto frame =
        castRays(volume.bricks, volume.grid, frontFrame(8, 8, {2, 2, 2}, 4, stylesOf({kOpaque})), options);
    EXPECT_EQ(frame.error().code(), Code::Cancelled);
}

TEST(LodFrame, AWallOneVoxelThickStaysVisibleAtEachLevel) {
    const TestVolume volume =
        makeVolume({64, 64, 64}, {0.1, 0.1, 0.1}, [](auto, auto j, auto) { return j == 37 ? 1u : 0u; });
    FrameSpec spec = frontFrame(20, 20, {3.2, 3.2, 3.2}, 6, stylesOf({{{0.8f, 0.1f, 0.1f}, 1}}));
    spec.background.alpha = 0;
    const auto levels = *volume::buildLodPyramid(volume.columns, volume.grid, 4);
    for (const volume::LodLevel& level : levels) {
        const auto frame = castRays(level, spec);
        ASSERT_TRUE(frame.hasValue());
        EXPECT_EQ(countLabel(*frame, 1), 400u) << level.level;
        EXPECT_GE(frame->color.at(10, 10).a, 250) << level.level;
    }
}

TEST(LodFrame, LooksLikeTheVolume) {
    const TestVolume volume = house();
    FrameSpec spec;
    spec.width = 240;
    spec.height = 160;
    spec.samplesPerPixel = 4;
    spec.camera = *cameraPreset("iso", volume.grid);
    spec.passes.push_back({houseStyles(false), {}, Pass::Join::Over});
    const auto levels = *volume::buildLodPyramid(volume.columns, volume.grid, 2);
    const Frame fine = cast(volume, spec);
    double previous = 0;
    for (const volume::LodLevel& level : levels) {
        const image::ImageDifference difference = image::compareImages(fine.color, castRays(level, spec)->color);
        EXPECT_LT(difference.mean, 0.03 * level.level);
        EXPECT_GT(difference.mean, previous);
        previous = difference.mean;
    }
}

TEST(LodFrame, GlassKeepsItsOpacity) {
    const TestVolume volume = makeBody({64, 64, 64}, {0.1, 0.1, 0.1}, [](Vec3d p) { return p.y > 2.2 && p.y < 4.1; });
    FrameSpec spec = frontFrame(20, 20, {3.2, 3.2, 3.2}, 5, stylesOf({{{0, 0, 0}, 0.3f}}));
    const Frame fine = cast(volume, spec);
    const auto levels = *volume::buildLodPyramid(volume.columns, volume.grid, 4);
    for (const volume::LodLevel& level : levels)
        EXPECT_NEAR(castRays(level, spec)->color.at(10, 10).r, fine.color.at(10, 10).r, 2) << level.level;
}

// A face of 8 x 8 voxels, seen face on at 10 pixels each: dark lines on their borders, plain faces between.
TEST(RayCaster, DrawsTheEdgesOfCells) {
    const TestVolume volume = makeVolume({8, 8, 8}, {0.1, 0.1, 0.1},
                                         [](std::int32_t, std::int32_t j, std::int32_t) { return j > 3 ? 1u : 0u; });
    FrameSpec spec = frontFrame(100, 100, {0.4, 0.4, 0.4}, 1, stylesOf({kOpaque}));
    spec.passes[0].hasCells = true;
    spec.light.ambientOcclusion = 0;
    expectSameFrame(volume, spec);
    const Frame frame = cast(volume, spec);
    int onEdge = 0, between = 0;
    for (int n = 1; n < 8; ++n) {
        onEdge = std::max(onEdge, int(frame.color.at(10 + 10 * n, 15).r));
        between = std::max(between, 255 - int(frame.color.at(15 + 10 * n - 10, 15).r));
    }
    EXPECT_LT(onEdge, 200);
    EXPECT_LT(between, 60);
}

// Three boxes beside each other behind a plate of glass, as parts of one pass: as if they were one volume.
TEST(RayCaster, PartsAreSortedByDepth) {
    const TestVolume volume = house();
    FrameSpec spec = test::presetFrame(120, 90, "iso", volume, houseStyles(true));
    const Frame whole = cast(volume, spec);
    const ClipRegion boxes[] = {ClipRegion::box({{1, 1, 1}, {3, 3, 3}}, ClipRegion::Mode::KeepOnly),
                                ClipRegion::box({{3.5, 2, 0.5}, {5, 5, 5}}, ClipRegion::Mode::KeepOnly)};
    const Pass pass = spec.passes[0];
    spec.passes.clear();
    for (std::uint32_t gap = 0; gap < 3; ++gap) {
        ClipRegion outside{{boxes[0].parts[0], boxes[1].parts[0]}, ClipRegion::Mode::Gap, gap};
        spec.passes.push_back(pass);
        spec.passes.back().clips.push_back(outside);
        if (gap > 0) spec.passes.back().join = Pass::Join::Part;
    }
    for (const ClipRegion& box : boxes) {
        spec.passes.push_back(pass);
        spec.passes.back().clips.push_back(box);
        spec.passes.back().join = Pass::Join::Part;
    }
    expectSameFrame(volume, spec);
    const Frame parts = cast(volume, spec);
    // Where a part begins within a label it is lit once more, as a face: labels and depths are what is compared.
    std::size_t others = 0;
    for (std::size_t n = 0; n < whole.label.pixels().size(); ++n)
        others += whole.label.pixels()[n] != parts.label.pixels()[n] ||
                          std::abs(whole.depth.pixels()[n] - parts.depth.pixels()[n]) > 1e-4f
                      ? 1
                      : 0;
    EXPECT_LE(others, whole.label.pixels().size() / 200);
}

}  // namespace
}  // namespace svt::render

#include <svt/image/color.hpp>
#include <svt/render/camera_presets.hpp>
#include <svt/render/test_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace svt::render {
namespace {

using test::cast;
using test::frontFrame;
using test::makeVolume;
using test::stylesOf;
using test::TestVolume;

const Style kWall{{0.9f, 0.5f, 0.2f}, 1};
const Style kGlass{{0.2f, 0.5f, 0.9f}, 0.4f};

// 4 x 4 x 4 m: y below 2 is label 1, beyond it label 2.
TestVolume twoBlocks() {
    return makeVolume({40, 40, 40}, {0.1, 0.1, 0.1},
                      [](std::int32_t, std::int32_t j, std::int32_t) { return j < 20 ? 1u : 2u; });
}

// The front, 4 m on 80 pixels: a pixel is 5 cm.
FrameSpec frontOf(std::vector<Style> styles) { return frontFrame(80, 80, {2, 2, 2}, 4, stylesOf(std::move(styles))); }

// An upright line over the middle of pixel column 40, `y` metres deep.
LineSet uprightLine(double y, HiddenLines hidden = HiddenLines::None, float width = 1) {
    LineSet set;
    set.lines.push_back({{2.025, y, 0.5}, {2.025, y, 3.5}, 1});
    set.color = {0, 0, 0};
    set.width = width;
    set.hidden = hidden;
    return set;
}

void expectSameAsReference(const TestVolume& volume, const FrameSpec& spec, const CastOptions& options = {}) {
    const Frame frame = cast(volume, spec, options);
    const auto reference = castRaysReference(volume.bricks, volume.grid, spec, options);
    ASSERT_TRUE(reference.hasValue());
    EXPECT_EQ(frame.label, reference->label);
    EXPECT_EQ(frame.depth, reference->depth);
    EXPECT_EQ(frame.color, reference->color);
}

double luminance(image::Rgba8 pixel) { return double(image::linearFromSrgb(float(pixel.r) / 255)); }

TEST(Lines, OnASurfaceAreSeenAndBehindItAreNot) {
    const TestVolume volume = twoBlocks();
    FrameSpec spec = frontOf({kWall, kWall});
    const Frame bare = cast(volume, spec);
    spec.passes[0].lines = {uprightLine(0)};
    EXPECT_EQ(cast(volume, spec).color.at(40, 40), (image::Rgba8{0, 0, 0, 255}));
    spec.passes[0].lines = {uprightLine(2)};
    EXPECT_EQ(cast(volume, spec).color, bare.color);
    spec.passes[0].lines = {uprightLine(-1)};
    EXPECT_EQ(cast(volume, spec).color.at(40, 40), (image::Rgba8{0, 0, 0, 255})) << "before the volume";
}

TEST(Lines, BehindSomethingOpaqueAreFaintOrDashed) {
    const TestVolume volume = twoBlocks();
    FrameSpec spec = frontOf({kWall, kWall});
    const double bare = luminance(cast(volume, spec).color.at(40, 40));
    spec.passes[0].lines = {uprightLine(2, HiddenLines::Faint)};
    spec.passes[0].lines[0].hiddenOpacity = 0.25f;
    EXPECT_NEAR(luminance(cast(volume, spec).color.at(40, 40)), 0.75 * bare, 0.01);

    spec.passes[0].lines = {uprightLine(2, HiddenLines::Dashed)};
    spec.passes[0].lines[0].hiddenOpacity = 1;
    const Frame dashed = cast(volume, spec);
    // 60 pixels from row 69 upwards, in tens: six of a dash, four of a gap.
    int dark = 0, changes = 0;
    for (std::int32_t y = 10; y < 70; ++y) {
        const bool isDark = dashed.color.at(40, y).r == 0;
        dark += isDark;
        if (y > 10) changes += isDark != (dashed.color.at(40, y - 1).r == 0);
    }
    EXPECT_NEAR(dark, 36, 2);
    EXPECT_EQ(changes, 11);
    EXPECT_EQ(dashed.color.at(40, 69).r, 0) << "begins with a dash";
}

// Translucent material in front of a line attenuates it like all other light.
TEST(Lines, AreTintedByWhatLiesBeforeThem) {
    const TestVolume volume = twoBlocks();
    FrameSpec spec = frontOf({kGlass, kWall});
    spec.light.ambientOcclusion = 0;
    const Frame bare = cast(volume, spec);
    spec.passes[0].lines = {uprightLine(1.15)};
    const image::Rgba8 seen = cast(volume, spec).color.at(40, 40);
    // Lines lie 1.5 voxels and twice the width in pixels before their place.
    const double length = 1.15 - 0.15 - 4 * 0.5 * 0.05, through = std::pow(0.6, length), behind = std::pow(0.6, 2.0);
    // The picture of only the glass before the line, as a share of the picture with the wall behind it.
    FrameSpec glass = frontOf({kGlass, {{0, 0, 0}, 1}});
    glass.light = spec.light;
    const double color = luminance(cast(volume, glass).color.at(40, 40));
    EXPECT_NEAR(luminance(seen), color * (1 - through) / (1 - behind), 0.01);
    EXPECT_LT(luminance(seen), luminance(bare.color.at(40, 40)));
}

TEST(Lines, CoverAsMuchOfAPixelAsTheyAreWide) {
    const TestVolume volume = twoBlocks();
    FrameSpec spec = frontOf({kWall, kWall});
    const double bare = luminance(cast(volume, spec).color.at(40, 40));
    for (const float width : {0.5f, 1.0f, 2.5f, 6.0f})
        for (const double aside : {0.0, 0.01, 0.02}) {
            spec.passes[0].lines = {uprightLine(0, HiddenLines::None, width)};
            spec.passes[0].lines[0].lines[0].from.x += aside;
            spec.passes[0].lines[0].lines[0].to.x += aside;
            const Frame frame = cast(volume, spec);
            double covered = 0;
            for (std::int32_t x = 30; x < 50; ++x) covered += 1 - luminance(frame.color.at(x, 40)) / bare;
            EXPECT_NEAR(covered, double(width), 0.12) << width << " " << aside;
        }
}

TEST(Lines, ChangeNoLabelAndNoDepth) {
    const TestVolume volume = twoBlocks();
    for (const int samples : {1, 4}) {
        FrameSpec spec = frontOf({kGlass, kWall});
        spec.samplesPerPixel = samples;
        const Frame bare = cast(volume, spec, {.labelAt = 0.5f});
        spec.passes[0].lines = {uprightLine(0), uprightLine(1), uprightLine(2)};
        const Frame frame = cast(volume, spec, {.labelAt = 0.5f});
        EXPECT_EQ(frame.label, bare.label);
        EXPECT_EQ(frame.depth, bare.depth);
    }
}

TEST(Lines, LyingOnEachOtherAreOne) {
    const TestVolume volume = twoBlocks();
    FrameSpec spec = frontOf({kWall, kWall});
    spec.passes[0].lines = {uprightLine(0, HiddenLines::Faint, 0.6f)};
    const Frame one = cast(volume, spec);
    spec.passes[0].lines[0].lines.resize(5, spec.passes[0].lines[0].lines[0]);
    EXPECT_EQ(cast(volume, spec).color, one.color);
}

TEST(Lines, OfHiddenLabelsAreDrawnWhereAskedFor) {
    const TestVolume volume = twoBlocks();
    FrameSpec spec = frontOf({{{0, 0, 0}, 0}, kWall});
    const Frame bare = cast(volume, spec);
    spec.passes[0].lines = {uprightLine(1)};
    EXPECT_EQ(cast(volume, spec).color, bare.color);
    spec.passes[0].lines[0].withHiddenLabels = true;
    EXPECT_EQ(cast(volume, spec).color.at(40, 40), (image::Rgba8{0, 0, 0, 255}));
}

TEST(Lines, AreClippedAsTheVolumeIs) {
    const TestVolume volume = twoBlocks();
    FrameSpec spec = frontOf({kWall, kWall});
    spec.passes[0].clips = {ClipRegion::plane({0, 0, 1}, {0, 0, 2})};
    const Frame bare = cast(volume, spec);
    spec.passes[0].lines = {uprightLine(0)};
    const Frame frame = cast(volume, spec);
    for (std::int32_t y = 0; y < 80; ++y) {
        const bool isDark = frame.color.at(40, y).r == 0;
        if (y < 38 || y > 71) {
            EXPECT_EQ(frame.color.at(40, y), bare.color.at(40, y)) << y;
        } else if (y > 41 && y < 69) {
            EXPECT_TRUE(isDark) << y;
        }
    }
}

// A box of twelve triangles.
std::vector<MeshTriangle> boxTriangles(Vec3d low, Vec3d high, volume::Scalar scalar) {
    static constexpr int kSides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
    const auto at = [&](int i) {
        return Vec3d{i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    };
    std::vector<MeshTriangle> triangles;
    for (const auto& side : kSides) {
        triangles.push_back({{at(side[0]), at(side[1]), at(side[2])}, scalar});
        triangles.push_back({{at(side[0]), at(side[2]), at(side[3])}, scalar});
    }
    return triangles;
}

// A room (label 1) with a chest (label 2) of whole voxels in it.
TestVolume roomWithChest() {
    return makeVolume({40, 40, 40}, {0.1, 0.1, 0.1}, [](std::int32_t i, std::int32_t j, std::int32_t k) {
        const bool isChest = i >= 10 && i < 22 && j >= 15 && j < 25 && k >= 8 && k < 20;
        return isChest ? 2u : 1u;
    });
}
const Box3d kChest{{1, 1.5, 0.8}, {2.2, 2.5, 2}};

TEST(Meshes, OfABoxShowWhatItsVoxelsShow) {
    const TestVolume volume = roomWithChest();
    for (const char* view : {"iso", "front", "top", "left"}) {
        SCOPED_TRACE(view);
        for (const float opacity : {0.1f, 0.0f}) {
            FrameSpec spec = frontOf({{{0.3f, 0.5f, 0.8f}, opacity}, kWall});
            spec.camera = *cameraPreset(view, volume.grid);
            spec.light.ambientOcclusion = 0;
            const Frame voxels = cast(volume, spec, {.labelAt = 0.9f});
            spec.passes[0].triangles = boxTriangles(kChest.min, kChest.max, 2);
            const Frame mesh = cast(volume, spec, {.labelAt = 0.9f});
            std::size_t otherLabels = 0, otherColors = 0, otherDepths = 0;
            for (std::size_t n = 0; n < mesh.label.pixels().size(); ++n) {
                const image::Rgba8 a = mesh.color.pixels()[n], b = voxels.color.pixels()[n];
                otherLabels += mesh.label.pixels()[n] != voxels.label.pixels()[n];
                otherColors += std::abs(a.r - b.r) > 2 || std::abs(a.g - b.g) > 2 || std::abs(a.b - b.b) > 2;
                const float near = mesh.depth.pixels()[n], far = voxels.depth.pixels()[n];
                otherDepths += near != far && !(std::abs(near - far) < 1e-4f * far);
            }
            EXPECT_LE(otherLabels, 12u);
            EXPECT_LE(otherColors, 12u);
            EXPECT_LE(otherDepths, 12u);
            EXPECT_GT(test::countLabel(mesh, 2), 100u);
        }
    }
}

TEST(Meshes, StandInForTheVoxelsOfTheirObject) {
    const TestVolume volume = roomWithChest();
    FrameSpec spec = frontOf({{{0.3f, 0.5f, 0.8f}, 0}, kWall});
    // A small part of the chest.
    spec.passes[0].triangles = boxTriangles({1, 1.5, 0.8}, {1.2, 1.7, 1}, 2);
    EXPECT_EQ(test::countLabel(cast(volume, spec), 2), 16u) << "0.2 m are 4 pixels";
}

TEST(Meshes, AreCutOpenWithACutFace) {
    const TestVolume volume = roomWithChest();
    FrameSpec spec = frontOf({{{0.3f, 0.5f, 0.8f}, 0}, kWall});
    spec.light.ambientOcclusion = 0;
    spec.passes[0].clips = {ClipRegion::plane({0, -1, 0}, {0, 2, 0})};
    const Frame voxels = cast(volume, spec);
    spec.passes[0].triangles = boxTriangles(kChest.min, kChest.max, 2);
    const Frame mesh = cast(volume, spec);
    EXPECT_EQ(mesh.label, voxels.label);
    EXPECT_EQ(mesh.depth, voxels.depth);
    EXPECT_EQ(mesh.color, voxels.color);
}

// A sheet before the cut, which a ray enters and never leaves.
TEST(Meshes, CutAwaySheetsHaveNoCutFace) {
    const TestVolume volume = roomWithChest();
    FrameSpec spec = frontOf({{{0.3f, 0.5f, 0.8f}, 0}, kWall});
    spec.passes[0].clips = {ClipRegion::plane({0, -1, 0}, {0, 2, 0})};
    const Vec3d a{0.5, 1, 0.5}, b{3.5, 1, 0.5}, c{3.5, 1, 3.5}, d{0.5, 1, 3.5};
    spec.passes[0].triangles = {{{a, b, c}, 2}, {{a, c, d}, 2}};
    EXPECT_EQ(test::countLabel(cast(volume, spec), 2), 0u);
    spec.passes[0].clips.clear();
    EXPECT_EQ(test::countLabel(cast(volume, spec), 2), 3600u);
}

TEST(Meshes, OfGlassArePanes) {
    const TestVolume volume = roomWithChest();
    FrameSpec spec = frontOf({{{0.3f, 0.5f, 0.8f}, 0}, {{1, 1, 1}, 0.5f}});
    spec.light = {.key = 0, .ambient = 0, .ambientOcclusion = 0};
    spec.background = {{0, 0, 0}, {0, 0, 0}, 1};
    spec.passes[0].triangles = boxTriangles(kChest.min, kChest.max, 2);
    // The mean thickness is 2 x 1.44 m3 / 7.68 m2; in the dark half of the colour is left.
    EXPECT_NEAR(luminance(cast(volume, spec).color.at(30, 50)), (1 - std::pow(0.5, 0.375)) * 0.5, 0.01);
}

// The opacity of a material is stored per metre, so that of a thin pane is nearly 1.
TEST(Meshes, OfAThinPaneStopTheLightOfItsVoxels) {
    const auto isPane = [](std::int32_t i, std::int32_t j, std::int32_t k) {
        return i >= 10 && i < 30 && j == 15 && k >= 10 && k < 30;
    };
    const TestVolume volume =
        makeVolume({40, 40, 40}, {0.1, 0.1, 0.1}, [&](std::int32_t i, std::int32_t j, std::int32_t k) {
            return j >= 30 ? 2u : isPane(i, j, k) ? 3u : 1u;
        });
    const float perMetre = 1 - float(std::pow(0.8, 10));  // a spacing stops a fifth
    FrameSpec spec = frontOf({{{0, 0, 0}, 0}, {{1, 1, 1}, 1}, {{0, 0, 0}, perMetre}});
    spec.light.ambientOcclusion = 0;
    const auto seen = [&] { return luminance(cast(volume, spec).color.at(40, 40)); };
    const double voxels = seen();
    spec.passes[0].triangles = boxTriangles({1, 1.5, 1}, {3, 1.504, 3}, 3);
    const double mesh = seen();
    const auto& box = spec.passes[0].triangles;
    spec.passes[0].triangles = {box[4], box[5]};  // a sheet: the front
    const double sheet = seen();
    spec.passes[0].styles[3].opacity = 0;
    const double bare = seen();
    EXPECT_NEAR(voxels, 0.8 * bare, 0.01);
    EXPECT_NEAR(mesh, 0.8 * bare, 0.01);
    EXPECT_NEAR(sheet, 0.8 * bare, 0.01);
}

// A fan whose edges pass through the middles of pixels, and the same plate of two triangles.
TEST(Meshes, LeaveNoGapBetweenTriangles) {
    const TestVolume volume = roomWithChest();
    FrameSpec spec = frontOf({{{0, 0, 0}, 0}, kWall});
    spec.width = spec.height = 160;
    for (const char* view : {"top", "iso"})
        for (const auto projection : {Camera::Projection::Orthographic, Camera::Projection::Perspective}) {
            spec.camera = *cameraPreset(view, volume.grid, {.projection = projection});
            std::vector<MeshTriangle> fan;
            const auto rim = [](int m) {
                const double angle = 2 * 3.14159265358979 * m / 24;
                return Vec3d{2 + 30 * std::cos(angle), 2 + 30 * std::sin(angle), 2};
            };
            for (int n = 0; n < 24; ++n) fan.push_back({{Vec3d{2, 2, 2}, rim(n), rim(n + 1)}, 2});
            spec.passes[0].triangles = fan;
            const Frame frame = cast(volume, spec);
            const Vec3d a{-9, -9, 2}, b{9, -9, 2}, c{9, 9, 2}, d{-9, 9, 2};
            spec.passes[0].triangles = {{{a, b, c}, 2}, {{a, c, d}, 2}};
            const Frame plate = cast(volume, spec);
            std::size_t others = 0;
            for (std::size_t n = 0; n < plate.label.pixels().size(); ++n)
                others += frame.label.pixels()[n] != plate.label.pixels()[n];
            EXPECT_EQ(others, 0u) << view;
            EXPECT_GT(test::countLabel(frame, 2), 4000u) << view;
        }
}

// All at once: lines and meshes over translucent voxels, cut, in two passes, several samples, from several sides.
FrameSpec busyFrame(const TestVolume& volume, const char* view, float opacity) {
    FrameSpec spec = frontOf({{{0.3f, 0.5f, 0.8f}, opacity}, kWall});
    spec.width = 117;
    spec.height = 93;
    spec.camera = *cameraPreset(view, volume.grid);
    for (const HiddenLines hidden : {HiddenLines::Faint, HiddenLines::Dashed}) {
        LineSet set;
        set.hidden = hidden;
        set.width = hidden == HiddenLines::Faint ? 1.0f : 2.2f;
        set.color = hidden == HiddenLines::Faint ? Vec3f{0, 0, 0} : Vec3f{0.8f, 0, 0};
        for (int n = 0; n < 60; ++n) {
            const auto at = [n](int m) {
                return Vec3d{2 + 2.2 * std::sin(1.7 * n + m), 2 + 2.2 * std::cos(2.9 * n + 3 * m),
                             2 + 2.2 * std::sin(0.3 * n * m + m)};
            };
            set.lines.push_back({at(1), at(2), static_cast<volume::Scalar>(1 + n % 2)});
        }
        spec.passes[0].lines.push_back(set);
    }
    spec.passes[0].triangles = boxTriangles({0.9, 1.4, 0.7}, {2.1, 2.6, 2.15}, 2);
    return spec;
}

TEST(Shapes, GiveTheVeryPictureOfThePlainCaster) {
    const TestVolume volume = roomWithChest();
    for (const char* view : {"iso", "front", "top", "iso-nw"})
        for (const float opacity : {0.3f, 0.02f, 0.0f, 1.0f}) {
            SCOPED_TRACE(view);
            FrameSpec spec = busyFrame(volume, view, opacity);
            expectSameAsReference(volume, spec);
            expectSameAsReference(volume, spec, {.labelAt = 0.5f});
            spec.passes[0].triangles.clear();
            expectSameAsReference(volume, spec);
            spec = busyFrame(volume, view, opacity);
            spec.passes[0].clips = {ClipRegion::plane({0.2, -1, 0.3}, {2, 2, 1.5}),
                                    ClipRegion::box({{1, 1, 1}, {3, 3, 1.5}}, ClipRegion::Mode::CutAway)};
            expectSameAsReference(volume, spec);
            spec.passes.push_back(spec.passes[0]);
            spec.passes[1].styles[2].opacity = 0.5f;
            spec.passes[1].join = Pass::Join::Depth;
            spec.samplesPerPixel = 4;
            spec.borders.strength = 0.7f;
            expectSameAsReference(volume, spec);
        }
}

TEST(Shapes, GiveThePictureOfThePlainCasterFromInside) {
    const TestVolume volume = roomWithChest();
    for (int round = 0; round < 8; ++round) {
        FrameSpec spec = busyFrame(volume, "iso", 0.1f);
        spec.camera.eye = {0.6 + 0.3 * round, 0.5, 0.4 + 0.4 * round};
        spec.camera.target = spec.camera.eye + Vec3d{std::cos(round), std::sin(round), 0.2};
        spec.camera.verticalFovDegrees = 80;
        SCOPED_TRACE(round);
        expectSameAsReference(volume, spec);
    }
}

TEST(Shapes, GiveTheSamePictureForAnyNumberOfThreads) {
    const TestVolume volume = roomWithChest();
    FrameSpec spec = busyFrame(volume, "iso", 0.2f);
    spec.samplesPerPixel = 4;
    for (const bool isAdaptive : {false, true}) {
        const Frame one = cast(volume, spec, {.threads = 1, .isAdaptive = isAdaptive});
        const Frame four = cast(volume, spec, {.threads = 4, .isAdaptive = isAdaptive});
        EXPECT_EQ(one.color, four.color);
        EXPECT_EQ(one.label, four.label);
    }
}

TEST(Shapes, OutOfRangeAreRefused) {
    const TestVolume volume = roomWithChest();
    const auto codeOf = [&](const auto& change) {
        FrameSpec spec = busyFrame(volume, "iso", 0.2f);
        change(spec.passes[0]);
        const auto frame = castRays(volume.bricks, volume.grid, spec);
        return frame ? Code::Internal : frame.error().code();
    };
    const double nan = std::nan("");
    EXPECT_EQ(codeOf([](Pass& pass) { pass.lines[0].width = 0; }), Code::BadFrame);
    EXPECT_EQ(codeOf([](Pass& pass) { pass.lines[0].dash = 0; }), Code::BadFrame);
    EXPECT_EQ(codeOf([](Pass& pass) { pass.lines[1].color.x = 2; }), Code::BadFrame);
    EXPECT_EQ(codeOf([&](Pass& pass) { pass.lines[0].lines[3].to.y = nan; }), Code::BadFrame);
    EXPECT_EQ(codeOf([&](Pass& pass) { pass.triangles[3].corners[1].z = nan; }), Code::BadFrame);
}

TEST(Shapes, FarAwayOrWithoutExtentAreLeftOut) {
    const TestVolume volume = twoBlocks();
    FrameSpec spec = frontOf({kWall, kWall});
    const Frame bare = cast(volume, spec);
    LineSet set;
    set.lines = {{{1, 1, 1}, {1, 1, 1}, 1}, {{1e9, 0, 0}, {2e9, 5, 1e300}, 1}, {{2, -500, 2}, {2, -400, 2}, 1}};
    spec.passes[0].lines = {set};
    EXPECT_EQ(cast(volume, spec).color, bare.color);
    spec.passes[0].lines.clear();
    spec.passes[0].triangles = {{{Vec3d{1, 1, 1}, {1, 1, 1}, {2, 2, 2}}, 7}};
    EXPECT_EQ(cast(volume, spec).color, bare.color);
}

}  // namespace
}  // namespace svt::render

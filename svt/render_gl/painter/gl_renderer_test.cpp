#include <svt/core/test_data_test.hpp>
#include <svt/image/png.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/render/camera_presets.hpp>
#include <svt/render_gl/compare_test.hpp>
#include <svt/samples/sample.hpp>

#include <GLES3/gl3.h>

#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>

namespace svt::render_gl {
namespace {

using render::ClipRegion;
using render::FrameSpec;
using render::Hatch;
using render::Pass;
using render::RoundBody;
using render::Style;

/// Largest difference of a channel between OpenGL and the CPU, of 255.
constexpr int kColorBound = 3;

/// A volume to draw.
struct Model {
    volume::BrickVolume bricks;
    volume::Grid grid;
};
using ModelPointer = std::shared_ptr<const Model>;

ModelPointer modelOf(const volume::ColumnVolume& columns, const volume::Grid& grid,
                     std::span<const volume::FacePlane> planes = {}) {
    return std::make_shared<Model>(Model{*volume::BrickVolume::fromColumns(columns, {.planes = planes}), grid});
}

volume::ColumnVolume columnsOf(Vec3i n, const std::function<volume::Scalar(Vec3i)>& labelAt) {
    std::vector<volume::Scalar> scalars;
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) scalars.push_back(labelAt({i, j, k}));
    return volume::ColumnVolume::fromDense(n, scalars);
}

constexpr Vec3i kBodies{93, 70, 61};

// A ball over a slab, a slanted roof, a pillar, and small cubes of many labels.
volume::ColumnVolume columnsOfBodies() {
    return columnsOf(kBodies, [](Vec3i v) -> volume::Scalar {
        const int x = v.x - 30, y = v.y - 34, z = v.z - 28;
        if (v.z < 6) return 1;
        if (x * x + y * y + z * z < 18 * 18) return x * x + y * y + z * z < 9 * 9 ? 3 : 2;
        if (v.x > 55 && v.z < 50 && 2 * v.z > 3 * (90 - v.x) - 30 && 2 * v.z < 3 * (90 - v.x)) return 4;
        if (v.y < 10 && v.x > 20 && v.x < 30) return 5;
        if (v.y > 55 && v.z > 20)
            return (v.x / 3 + v.y / 2 + v.z / 5) % 4 == 0 ? 6 + volume::Scalar(v.x / 3 + v.z / 5) % 9 : 0;
        return 0;
    });
}

ModelPointer bodies() {
    static const ModelPointer made =
        modelOf(columnsOfBodies(), *volume::Grid::fromParts(kBodies, {0.1, 0.12, 0.11}, {0.05, 0.06, 0.055},
                                                            {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}));
    return made;
}

ModelPointer built(std::span<const std::filesystem::path> files, Vec3i dimension) {
    pipeline::BuildOptions options;
    options.dimension = dimension;
    const auto output = pipeline::buildVolume(files, options);
    if (!output) throw std::runtime_error(output.error().toString());
    return modelOf(output->volume.columns, output->volume.grid, output->volume.planes);
}

ModelPointer house(double turnDegrees) {
    samples::SampleOptions options;
    options.turnDegrees = turnDegrees;
    const auto text = *samples::writeSample(samples::SampleKind::House, samples::SampleFormat::CityGml3, options);
    auto model = *readers::readModel(std::as_bytes(std::span(text)), "house.gml");
    pipeline::BuildOptions build;
    build.dimension = Vec3i{240, 210, 150};
    const auto output = *pipeline::buildVolume(model, build);
    return modelOf(output.volume.columns, output.volume.grid, output.volume.planes);
}

// Colours that tell labels apart; 0 hidden.
std::vector<Style> styles(const Model& model, float opacity = 1) {
    std::vector<Style> all(model.bricks.scalarCount());
    for (std::size_t n = 0; n < all.size(); ++n)
        all[n] = {{0.3f + float(n * 37 % 70) / 100, 0.3f + float(n * 61 % 70) / 100, 0.3f + float(n * 17 % 70) / 100},
                  n == 0 ? 0 : opacity};
    return all;
}

// Every third label opaque, the others glass.
std::vector<Style> mixedStyles(const Model& model) {
    std::vector<Style> all = styles(model, 0.4f);
    for (std::size_t n = 3; n < all.size(); n += 3) all[n].opacity = 1;
    return all;
}

struct Sizes {
    Vec3d middle, size;  // of the volume, world space
};
Sizes sizesOf(const Model& model) {
    const Vec3i n = model.grid.dimension();
    const Vec3d low = model.grid.worldFromIndex({-0.5, -0.5, -0.5});
    const Vec3d high = model.grid.worldFromIndex({n.x - 0.5, n.y - 0.5, n.z - 0.5});
    return {(low + high) * 0.5, high - low};
}

FrameSpec frameOf(const Model& model, const char* view = "iso") {
    FrameSpec spec;
    spec.width = 320;
    spec.height = 180;
    spec.camera = *render::cameraPreset(view, model.grid, {.margin = 0.06});
    spec.passes.push_back({styles(model), {}, Pass::Join::Over});
    return spec;
}

struct Look {
    const char* name;
    std::function<FrameSpec(const Model&)> frame;
};

ClipRegion halfOpen(const Model& model) { return ClipRegion::plane({0.2, -1, 0.1}, sizesOf(model).middle); }

// A fan of lines through the volume, some on each other, in two looks.
std::vector<render::LineSet> lines(const Model& model) {
    const auto [middle, size] = sizesOf(model);
    std::vector<render::LineSet> sets(2);
    sets[1].color = {0.8f, 0.1f, 0.1f};
    sets[1].width = 3;
    sets[1].hidden = render::HiddenLines::Dashed;
    sets[1].withHiddenLabels = true;
    for (int n = 0; n < 40; ++n) {
        const Vec3d end{std::cos(n * 0.7) * size.x * 0.5, std::sin(n * 0.9) * size.y * 0.5,
                        std::cos(n * 1.3) * size.z * 0.5};
        sets[static_cast<std::size_t>(n % 2)].lines.push_back(
            {middle - end * 0.9, middle + end, static_cast<volume::Scalar>(n % 5)});
    }
    return sets;
}

// Two octahedra around the middle, one of an opaque label and one of label 4; in mixedStyles() a pane.
std::vector<render::MeshTriangle> octahedra(const Model& model) {
    const auto [middle, size] = sizesOf(model);
    std::vector<render::MeshTriangle> triangles;
    for (const volume::Scalar label : {3u, 4u})
        for (int n = 0; n < 8; ++n) {
            const Vec3d center = middle + size * (label == 3 ? 0.113 : -0.107);
            const Vec3d x{(n & 1) != 0 ? size.x * 0.3 : -size.x * 0.3, 0, 0},
                y{0, (n & 2) != 0 ? size.y * 0.3 : -size.y * 0.3, 0};
            const Vec3d z{0, 0, (n & 4) != 0 ? size.z * 0.4 : -size.z * 0.4};
            const bool isTurned = ((n & 1) + (n >> 1 & 1) + (n >> 2)) % 2 == 0;
            triangles.push_back({{center + x, center + (isTurned ? z : y), center + (isTurned ? y : z)}, label});
        }
    return triangles;
}

// A table, one entry for each look.
// NOLINTNEXTLINE(readability-function-size)
const std::vector<Look>& lineStyles() {
    static const std::vector<Look> all{
        {"Opaque", [](const Model& m) { return frameOf(m); }},
        {"OpaqueWithoutOcclusion",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.light.ambientOcclusion = 0;
             spec.light.space = render::Light::Space::World;
             spec.light.direction = {1, -2, 3};
             return spec;
         }},
        {"Front",
         [](const Model& m) {
             FrameSpec spec = frameOf(m, "front");
             spec.camera.projection = render::Camera::Projection::Orthographic;
             spec.camera.orthographicHeight = 1.1 * sizesOf(m).size.z;
             return spec;
         }},
        {"FromInside",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.camera.eye = sizesOf(m).middle + sizesOf(m).size * 0.0123;
             spec.camera.target = spec.camera.eye + Vec3d{1, 0.4, -0.1};
             spec.camera.verticalFovDegrees = 80;
             spec.passes[0].styles = mixedStyles(m);
             return spec;
         }},
        {"Section",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.passes[0].clips = {halfOpen(m)};
             return spec;
         }},
        {"KeptBox",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             const auto [middle, size] = sizesOf(m);
             spec.passes[0].clips = {
                 ClipRegion::box({middle - size * 0.2973, middle + size * 0.3117}, ClipRegion::Mode::KeepOnly)};
             return spec;
         }},
        {"RoundClips",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             const auto [middle, size] = sizesOf(m);
             const Vec3d toEye = normalized(spec.camera.eye - middle);
             const double radius = 0.25 * std::min({size.x, size.y, size.z});
             ClipRegion cone{{{{}, {RoundBody::cone(middle, toEye, Vec3d{0, 0, 0.3}, cross(toEye, Vec3d{0, 0, 0.3}))}}},
                             ClipRegion::Mode::CutAway};
             const Vec3d u = normalized(cross(toEye, Vec3d{0, 0, 1}));
             cone.parts[0].rounds[0] = RoundBody::cone(middle, toEye, u * 0.25, cross(toEye, u) * 0.2);
             ClipRegion balls{{{{}, {RoundBody::ball(middle + Vec3d{0, 0, size.z * 0.4}, radius)}},
                               {{}, {RoundBody::ball(middle + Vec3d{radius, 0, size.z * 0.35}, radius)}},
                               {{}, {RoundBody::cylinder(middle - size * 0.3, {0, 1, 0.2}, 0.5 * radius)}}},
                              ClipRegion::Mode::CutAway};
             spec.passes[0].clips = {cone, balls};
             return spec;
         }},
        {"KeptRound",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             const auto [middle, size] = sizesOf(m);
             spec.passes[0].clips = {{{{{}, {RoundBody::cylinder(middle, {0, 0, 1}, 0.3 * size.y)}},
                                       {{}, {RoundBody::ball(middle + Vec3d{0.3 * size.x, 0, 0}, 0.3 * size.y)}}},
                                      ClipRegion::Mode::KeepOnly},
                                     halfOpen(m)};
             return spec;
         }},
        {"Translucent",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.passes[0].styles = styles(m, 0.3f);
             return spec;
         }},
        {"Mixed",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.passes[0].styles = mixedStyles(m);
             spec.background = {{0.2f, 0.3f, 0.5f}, {0.9f, 0.9f, 0.8f}, 0.5f};
             return spec;
         }},
        {"MixedSection",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.passes[0].styles = mixedStyles(m);
             spec.passes[0].clips = {halfOpen(m)};
             return spec;
         }},
        {"Phases",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.passes[0].styles = mixedStyles(m);
             for (std::uint32_t n = 0; n < m.bricks.scalarCount(); ++n) spec.objectOfScalar.push_back(n - n % 2);
             spec.borders.strength = 0.8f;
             return spec;
         }},
        {"PassesOver",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.passes[0].styles = mixedStyles(m);
             spec.passes.push_back({styles(m, 0.5f), {halfOpen(m)}, Pass::Join::Over});
             return spec;
         }},
        {"PassesReplace",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             const auto [middle, size] = sizesOf(m);
             const ClipRegion lens{{{{}, {RoundBody::ball(middle, 0.4 * size.z)}}}, ClipRegion::Mode::KeepOnly};
             spec.passes.push_back({mixedStyles(m), {lens, halfOpen(m)}, Pass::Join::Replace});
             spec.borders = {0.8f, 1, 4, {0.1f, 0.1f, 0.1f}};
             return spec;
         }},
        {"PassesDepth",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.passes[0].clips = {halfOpen(m)};
             const auto [middle, size] = sizesOf(m);
             spec.passes.push_back(
                 {styles(m, 0.6f),
                  {ClipRegion::box({middle - size, middle + size * 0.0137}, ClipRegion::Mode::KeepOnly)},
                  Pass::Join::Depth});
             spec.passes.push_back(
                 {styles(m),
                  {ClipRegion::box({middle - size * 0.0151, middle + size * 0.2031}, ClipRegion::Mode::KeepOnly)},
                  Pass::Join::Depth});
             return spec;
         }},
        {"NoPass",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.passes.clear();
             spec.background.bottom = {0.2f, 0.4f, 0.1f};
             return spec;
         }},
        {"Borders",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.borders.strength = 0.9f;
             spec.passes[0].clips = {halfOpen(m)};
             return spec;
         }},
        {"WideBordersOfFourSamples",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.samplesPerPixel = 4;
             spec.borders = {0.9f, 2, 4, {0.1f, 0, 0}};
             spec.passes[0].clips = {halfOpen(m)};
             spec.passes[0].styles = mixedStyles(m);
             return spec;
         }},
        {"NineSamples",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.samplesPerPixel = 9;
             spec.width = 160;
             spec.height = 90;
             return spec;
         }},
        {"SixteenSamples",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.samplesPerPixel = 16;
             spec.width = 120;
             spec.height = 80;
             spec.borders.strength = 0.5f;
             return spec;
         }},
        {"Lines",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.passes[0].styles = mixedStyles(m);
             spec.passes[0].lines = lines(m);
             return spec;
         }},
        {"LinesOfASection",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.samplesPerPixel = 4;
             spec.passes[0].lines = lines(m);
             spec.passes[0].clips = {halfOpen(m)};
             return spec;
         }},
        {"Meshes",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.passes[0].styles = mixedStyles(m);
             spec.passes[0].triangles = octahedra(m);
             spec.passes[0].lines = lines(m);
             return spec;
         }},
        {"MeshesCutOpen",
         [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.passes[0].triangles = octahedra(m);
             spec.passes[0].clips = {halfOpen(m)};
             spec.borders.strength = 1;
             for (Style& style : spec.passes[0].styles) style.hatch = Hatch::Masonry;
             spec.hatches.spacing = 0.05 * sizesOf(m).size.x;
             return spec;
         }},
        {"Hatches", [](const Model& m) {
             FrameSpec spec = frameOf(m);
             spec.width = 640;
             spec.height = 360;
             spec.passes[0].clips = {halfOpen(m)};
             for (std::size_t n = 1; n < spec.passes[0].styles.size(); ++n)
                 spec.passes[0].styles[n].hatch = static_cast<Hatch>(1 + n % 9);
             spec.hatches.spacing = 0.02 * sizesOf(m).size.x;
             return spec;
         }}};
    return all;
}

void expectSame(const Model& model, GlRenderer& renderer, const Look& look, const std::string& name) {
    const FrameSpec spec = look.frame(model);
    const auto drawn = renderer.read(spec);
    ASSERT_TRUE(drawn) << drawn.error().toString();
    const auto cast = render::castRays(model.bricks, model.grid, spec);
    ASSERT_TRUE(cast) << cast.error().toString();
    const auto difference = test::compare(model.bricks, model.grid, spec, *drawn, *cast, kColorBound);
    const auto place = "at " + std::to_string(difference.x) + ", " + std::to_string(difference.y);
    EXPECT_EQ(difference.labels, 0u) << place;
    EXPECT_EQ(difference.depths, 0u) << place;
    EXPECT_EQ(difference.colors, 0u) << place << ", up to " << difference.largestColor;
    // Few pixels may differ at edges.
    EXPECT_LE(difference.edges, 10u);
    EXPECT_LE(difference.colorEdges, 20u);
    if (const char* folder = std::getenv("SVT_TEST_PICTURES"); folder != nullptr) {
        (void)image::writePng(std::string(folder) + "/" + name + "_gl.png", drawn->color);
        (void)image::writePng(std::string(folder) + "/" + name + "_cpu.png", cast->color);
    }
}

// One renderer draws all looks, so state left over from one frame would show in the next.
void expectAllSame(const Model& model, const std::string& name) {
    auto renderer = GlRenderer::make(model.bricks, model.grid);
    ASSERT_TRUE(renderer) << renderer.error().toString();
    for (const Look& look : lineStyles()) {
        SCOPED_TRACE(look.name);
        expectSame(model, *renderer, look, name + look.name);
    }
}

TEST(GlRenderer, DrawsBodiesAsTheCpu) {
    SVT_NEEDS_GL();
    expectAllSame(*bodies(), "bodies");
}

TEST(GlRenderer, DrawsTheHouseAsTheCpu) {
    SVT_NEEDS_GL();
    expectAllSame(*house(0), "house");
}

TEST(GlRenderer, DrawsTheTurnedHouseAsTheCpu) {
    SVT_NEEDS_GL();
    expectAllSame(*house(30), "turned");
}

TEST(GlRenderer, DrawsTheFzkHausAsTheCpu) {
    SVT_NEEDS_GL();
    SVT_NEEDS_DATA(file, "fzk_haus_citygml3.gml");
    expectAllSame(*built(std::span(&file, 1), {400, 350, 200}), "fzk");
}

// Where nothing is coded by planes, every normal is fitted to voxels.
TEST(GlRenderer, DrawsAVolumeOfVoxelsAsTheCpu) {
    SVT_NEEDS_GL();
    const volume::ColumnVolume columns = columnsOfBodies();
    const Model model{*volume::BrickVolume::fromColumns(columns, {.faces = volume::BrickFaces::Voxels}),
                      bodies()->grid};
    auto renderer = GlRenderer::make(model.bricks, model.grid);
    ASSERT_TRUE(renderer) << renderer.error().toString();
    expectSame(model, *renderer, lineStyles()[0], "voxelsOpaque");
    expectSame(model, *renderer, lineStyles()[9], "voxelsMixed");
}

// Wider than a tile, with lines that reach from one into the next.
TEST(GlRenderer, LeavesNoSeamsBetweenTiles) {
    SVT_NEEDS_GL();
    const Look wide{"Wide", [](const Model& m) {
                        FrameSpec spec = frameOf(m);
                        spec.width = 1100;
                        spec.height = 90;
                        spec.samplesPerPixel = 4;
                        spec.camera.verticalFovDegrees = 6;
                        spec.borders = {1, 3, 6, {}};
                        spec.passes[0].clips = {halfOpen(m)};
                        return spec;
                    }};
    auto renderer = GlRenderer::make(bodies()->bricks, bodies()->grid);
    ASSERT_TRUE(renderer) << renderer.error().toString();
    expectSame(*bodies(), *renderer, wide, "bodiesWide");
}

TEST(GlRenderer, PicksWhatItDraws) {
    SVT_NEEDS_GL();
    auto renderer = GlRenderer::make(bodies()->bricks, bodies()->grid);
    ASSERT_TRUE(renderer) << renderer.error().toString();
    for (const int samples : {1, 4}) {
        FrameSpec spec = frameOf(*bodies());
        spec.samplesPerPixel = samples;
        const auto frame = renderer->read(spec);
        ASSERT_TRUE(frame) << frame.error().toString();
        for (std::int32_t y = 5; y < spec.height; y += 34)
            for (std::int32_t x = 3; x < spec.width; x += 41) {
                const auto picked = renderer->pick(spec, x, y);
                ASSERT_TRUE(picked) << picked.error().toString();
                EXPECT_EQ(picked->label, frame->label.at(x, y));
                EXPECT_EQ(picked->depth, frame->depth.at(x, y));
            }
    }
    const auto outside = renderer->pick(frameOf(*bodies()), 320, 0);
    ASSERT_FALSE(outside);
    EXPECT_EQ(outside.error().code(), Code::BadArgument);
}

TEST(GlRenderer, LooksThroughGhostsAsTheCpu) {
    SVT_NEEDS_GL();
    FrameSpec spec = frameOf(*bodies());
    spec.passes[0].styles = mixedStyles(*bodies());
    auto renderer = GlRenderer::make(bodies()->bricks, bodies()->grid, {.labelAt = 0.6f});
    ASSERT_TRUE(renderer) << renderer.error().toString();
    const auto drawn = renderer->read(spec);
    ASSERT_TRUE(drawn) << drawn.error().toString();
    const auto cast = render::castRays(bodies()->bricks, bodies()->grid, spec, {.labelAt = 0.6f});
    ASSERT_TRUE(cast) << cast.error().toString();
    std::size_t apart = 0, other = 0;
    const auto plain = render::castRays(bodies()->bricks, bodies()->grid, spec);
    for (std::size_t n = 0; n < cast->label.pixels().size(); ++n) {
        apart += drawn->label.pixels()[n] != cast->label.pixels()[n];
        other += plain->label.pixels()[n] != cast->label.pixels()[n];
    }
    // A ray may reach the share exactly.
    EXPECT_LE(apart, 5u);
    EXPECT_GT(other, 1000u);
}

TEST(GlRenderer, DrawsIntoTheCurrentFramebuffer) {
    SVT_NEEDS_GL();
    FrameSpec spec = frameOf(*bodies());
    auto renderer = GlRenderer::make(bodies()->bricks, bodies()->grid);
    ASSERT_TRUE(renderer) << renderer.error().toString();
    const auto frame = renderer->read(spec);
    ASSERT_TRUE(frame) << frame.error().toString();
    GLuint target = 0, picture = 0;
    glGenTextures(1, &picture);
    glBindTexture(GL_TEXTURE_2D, picture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 400, 200, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glGenFramebuffers(1, &target);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture, 0);
    glClearColor(0, 1, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ASSERT_TRUE(renderer->draw(spec));
    GLint bound = 0;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    EXPECT_EQ(static_cast<GLuint>(bound), target);
    std::vector<image::Rgba8> rows(400 * 200);
    glReadPixels(0, 0, 400, 200, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
    std::size_t apart = 0, touched = 0;
    for (std::int32_t y = 0; y < 200; ++y)
        for (std::int32_t x = 0; x < 400; ++x) {
            const image::Rgba8 pixel = rows[static_cast<std::size_t>(x + 400 * y)];
            if (x < spec.width && y < spec.height)
                apart += pixel != frame->color.at(x, spec.height - 1 - y);
            else
                touched += pixel != image::Rgba8{0, 255, 0, 255};
        }
    EXPECT_EQ(apart, 0u);
    EXPECT_EQ(touched, 0u);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &target);
    glDeleteTextures(1, &picture);
}

TEST(GlRenderer, SaysWhatIsOutOfRange) {
    SVT_NEEDS_GL();
    const auto codeOf = [](const auto& result) { return result ? Code::Internal : result.error().code(); };
    const auto other = *volume::Grid::fromParts({3, 3, 3}, {1, 1, 1}, {}, bodies()->grid.axes());
    EXPECT_EQ(codeOf(GlRenderer::make(bodies()->bricks, other)), Code::BadArgument);
    EXPECT_EQ(codeOf(GlRenderer::make(bodies()->bricks, bodies()->grid, {.labelAt = 1})), Code::BadArgument);
    auto renderer = GlRenderer::make(bodies()->bricks, bodies()->grid);
    ASSERT_TRUE(renderer) << renderer.error().toString();
    FrameSpec spec = frameOf(*bodies());
    spec.samplesPerPixel = 5;
    EXPECT_EQ(codeOf(renderer->read(spec)), Code::BadFrame);
    spec.samplesPerPixel = 1;
    spec.camera.target = spec.camera.eye;
    EXPECT_EQ(codeOf(renderer->draw(spec)), Code::BadCamera);
    FrameSpec shaded = frameOf(*bodies()), cells = shaded;
    shaded.light.hasShadows = true;
    EXPECT_EQ(codeOf(renderer->read(shaded)), Code::BadFrame) << "drawn by the CPU alone, and never without a word";
    cells.passes[0].hasCells = true;
    EXPECT_EQ(codeOf(renderer->read(cells)), Code::BadFrame);
    // And goes on.
    EXPECT_TRUE(renderer->read(frameOf(*bodies())));
}

}  // namespace
}  // namespace svt::render_gl

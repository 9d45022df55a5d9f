#include <svt/core/test_data_test.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/render/camera_presets.hpp>
#include <svt/render/png.hpp>
#include <svt/render_gl/compare_test.hpp>
#include <svt/samples/sample.hpp>

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

ModelPointer modelOf(const volume::ColumnVolume& columns, const volume::Grid& grid) {
    return std::make_shared<Model>(Model{*volume::BrickVolume::fromColumns(columns), grid});
}

ModelPointer modelOf(Vec3i n, Vec3d spacing, const std::function<volume::Scalar(Vec3i)>& labelAt) {
    std::vector<volume::Scalar> scalars;
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) scalars.push_back(labelAt({i, j, k}));
    return modelOf(
        volume::ColumnVolume::fromDense(n, scalars),
        *volume::Grid::fromParts(n, spacing, spacing * 0.5, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}));
}

// A ball over a slab, a slanted roof, a pillar, and small cubes of many labels.
ModelPointer bodies() {
    static const ModelPointer made = modelOf({93, 70, 61}, {0.1, 0.12, 0.11}, [](Vec3i v) -> volume::Scalar {
        const int x = v.x - 30, y = v.y - 34, z = v.z - 28;
        if (v.z < 6) return 1;
        if (x * x + y * y + z * z < 18 * 18) return x * x + y * y + z * z < 9 * 9 ? 3 : 2;
        if (v.x > 55 && v.z < 50 && 2 * v.z > 3 * (90 - v.x) - 30 && 2 * v.z < 3 * (90 - v.x)) return 4;
        if (v.y < 10 && v.x > 20 && v.x < 30) return 5;
        if (v.y > 55 && v.z > 20)
            return (v.x / 3 + v.y / 2 + v.z / 5) % 4 == 0 ? 6 + volume::Scalar(v.x / 3 + v.z / 5) % 9 : 0;
        return 0;
    });
    return made;
}

ModelPointer built(std::span<const std::filesystem::path> files, Vec3i dimension) {
    pipeline::BuildOptions options;
    options.dimension = dimension;
    const auto output = pipeline::buildVolume(files, options);
    if (!output) throw std::runtime_error(output.error().toString());
    return modelOf(output->volume.columns, output->volume.grid);
}

ModelPointer house(double turnDegrees) {
    samples::SampleOptions options;
    options.turnDegrees = turnDegrees;
    const auto text = *samples::writeSample(samples::SampleKind::House, samples::SampleFormat::CityGml3, options);
    auto model = *readers::readModel(std::as_bytes(std::span(text)), "house.gml");
    pipeline::BuildOptions build;
    build.dimension = Vec3i{240, 210, 150};
    const auto output = *pipeline::buildVolume(model, build);
    return modelOf(output.volume.columns, output.volume.grid);
}

ModelPointer straightHouse() {
    static const ModelPointer made = house(0);
    return made;
}
ModelPointer turnedHouse() {
    static const ModelPointer made = house(30);
    return made;
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
    spec.camera = *render::cameraPreset(view, model.grid);
    spec.passes.push_back({styles(model), {}, Pass::Join::Over});
    return spec;
}

struct Look {
    const char* name;
    std::function<FrameSpec(const Model&)> frame;
    int colorBound = kColorBound;
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

const std::vector<Look>& looks() {
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
             spec.hatches.spacing = 0.02 * sizesOf(m).size.x;
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

void expectSame(const Model& model, const Look& look, const std::string& name) {
    const FrameSpec spec = look.frame(model);
    auto renderer = GlRenderer::make(model.bricks, model.grid);
    ASSERT_TRUE(renderer) << renderer.error().toString();
    const auto drawn = renderer->read(spec);
    ASSERT_TRUE(drawn) << drawn.error().toString();
    const auto cast = render::castRays(model.bricks, model.grid, spec);
    ASSERT_TRUE(cast) << cast.error().toString();
    const auto difference = test::compare(model.bricks, model.grid, spec, *drawn, *cast, look.colorBound);
    EXPECT_EQ(difference.labels, 0u) << "at " << difference.x << ", " << difference.y;
    EXPECT_EQ(difference.depths, 0u) << "at " << difference.x << ", " << difference.y;
    EXPECT_EQ(difference.colors, 0u) << "at " << difference.x << ", " << difference.y << ", up to "
                                     << difference.largestColor;
    // What is let through at edges is little.
    EXPECT_LT(difference.edges, cast->label.pixels().size() / 500 + 5);
    EXPECT_LT(difference.colorEdges, cast->label.pixels().size() / 100 + 5);
    if (const char* folder = std::getenv("SVT_TEST_PICTURES"); folder != nullptr) {
        (void)render::writePng(std::string(folder) + "/" + name + "_gl.png", drawn->color);
        (void)render::writePng(std::string(folder) + "/" + name + "_cpu.png", cast->color);
    }
}

class Looks : public testing::TestWithParam<std::size_t> {};

TEST_P(Looks, OfBodies) {
    SVT_NEEDS_GL();
    expectSame(*bodies(), looks()[GetParam()], std::string("bodies") + looks()[GetParam()].name);
}
TEST_P(Looks, OfTheHouse) {
    SVT_NEEDS_GL();
    expectSame(*straightHouse(), looks()[GetParam()], std::string("house") + looks()[GetParam()].name);
}
TEST_P(Looks, OfTheTurnedHouse) {
    SVT_NEEDS_GL();
    expectSame(*turnedHouse(), looks()[GetParam()], std::string("turned") + looks()[GetParam()].name);
}
TEST_P(Looks, OfTheFzkHaus) {
    SVT_NEEDS_GL();
    SVT_NEEDS_DATA(file, "fzk_haus_citygml3.gml");
    static const ModelPointer made = built(std::span(&file, 1), {400, 350, 200});
    expectSame(*made, looks()[GetParam()], std::string("fzk") + looks()[GetParam()].name);
}

INSTANTIATE_TEST_SUITE_P(GlRenderer, Looks, testing::Range(std::size_t{0}, looks().size()),
                         [](const auto& look) { return std::string(looks()[look.param].name); });

}  // namespace
}  // namespace svt::render_gl

#include <svt/fields/field.hpp>
#include <svt/fields/node_field_test.hpp>
#include <svt/illustrate/annotate/field_paint.hpp>
#include <svt/illustrate/scene_painter.hpp>
#include <svt/image/color.hpp>
#include <svt/image/color_map.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace svt::illustrate {
namespace {

using volume::SemanticVolume;
using volume::test::addObject;
using volume::test::emptyVolume;
using volume::test::paintBoxes;

constexpr Vec3i kSize{42, 22, 22};
constexpr double kStep = 0.1;
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

// Scalars: 1 wall, 2 and 3 rooms to the west and east of a wall of two voxels.
SemanticVolume twoRooms() {
    SemanticVolume volume = emptyVolume(kSize, {kStep, kStep, kStep});
    addObject(volume, "wall", "WallSurface");
    addObject(volume, "west", "BuildingRoom");
    addObject(volume, "east", "BuildingRoom");
    paintBoxes(volume, {{1, {0, 0, 0}, kSize}, {2, {2, 2, 2}, {20, 20, 20}}, {3, {22, 2, 2}, {40, 20, 20}}});
    return volume;
}

fields::Field fieldOf(const std::string& medium, const std::function<double(Vec3d)>& valueAt) {
    return fields::test::nodeField("t", medium, kSize, kStep, valueAt);
}

// A plan cut at 1 m, from above.
Scene planScene() {
    Scene scene;
    scene.width = 420;
    scene.height = 220;
    scene.samples = 1;
    scene.camera.preset = "top";
    scene.camera.isParallel = true;
    scene.passes[0].cut = "z>1.03";
    scene.hasLegend = false;
    scene.lines.strength = 0.0f;
    scene.ambientOcclusion = 0.0f;
    scene.field.emplace();
    scene.field->name = "t";
    return scene;
}

Painting painted(const SemanticVolume& volume, const fields::Field& field, const Scene& scene) {
    ScenePainter painter(volume);
    const auto shown = painter.showField(&field);
    EXPECT_TRUE(shown) << (shown ? "" : shown.error().toString());
    auto painting = painter.paint(scene);
    EXPECT_TRUE(painting) << (painting ? "" : painting.error().toString());
    return painting ? std::move(*painting) : Painting{};
}

// The hue of a pixel without its brightness.
Vec3f hueOf(image::Rgba8 pixel) {
    const Vec3f linear = image::linearFromSrgb(Vec3f{float(pixel.r), float(pixel.g), float(pixel.b)} * (1 / 255.0f));
    return linear * (1 / std::max(1e-6f, linear.x + linear.y + linear.z));
}
Vec3f hueOfShare(double share) {
    const Vec3f linear = image::linearFromSrgb(image::mapColor(image::ColorMap::Viridis, share));
    return linear * (1 / (linear.x + linear.y + linear.z));
}
double difference(Vec3f a, Vec3f b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

TEST(FieldPaint, EachRoomHasItsColourAndTheWallsKeepTheirs) {
    const SemanticVolume volume = twoRooms();
    const fields::Field field = fieldOf("air", [](Vec3d p) { return p.x < 2.05 ? 20 : 30; });
    Scene scene = planScene();
    const Painting painting = painted(volume, field, scene);
    Scene plain = scene;
    plain.field.reset();
    ScenePainter painter(volume);
    const auto before = painter.paint(plain);
    ASSERT_TRUE(before);
    std::size_t west = 0, east = 0, wall = 0;
    for (std::int32_t y = 0; y < scene.height; ++y)
        for (std::int32_t x = 0; x < scene.width; ++x) {
            const auto label = painting.frame.label.at(x, y);
            const image::Rgba8 pixel = painting.frame.color.at(x, y);
            if (label == 2) {
                ++west;
                EXPECT_LT(difference(hueOf(pixel), hueOfShare(0)), 0.02) << x << " " << y;
            }
            if (label == 3) {
                ++east;
                EXPECT_LT(difference(hueOf(pixel), hueOfShare(1)), 0.02) << x << " " << y;
            }
            if (label == 1) {
                ++wall;
                EXPECT_EQ(pixel, before->frame.color.at(x, y)) << x << " " << y;
            }
        }
    EXPECT_GT(west, 10000u);
    EXPECT_NEAR(double(west), double(east), 0.02 * double(west));
    EXPECT_GT(wall, 10000u);
}

TEST(FieldPaint, SolidsShowALinearField) {
    const SemanticVolume volume = twoRooms();
    const fields::Field field = fieldOf("solid", [](Vec3d p) { return p.x; });
    const Scene scene = planScene();
    const Painting painting = painted(volume, field, scene);
    const render::CameraRays rays(painting.spec, volume.grid);
    std::size_t caps = 0;
    for (std::int32_t y = 0; y < scene.height; ++y)
        for (std::int32_t x = 0; x < scene.width; ++x) {
            if (painting.frame.label.at(x, y) != 1) continue;
            const Vec3d at = rays.worldAt(2 * (x + 0.5) / scene.width - 1, 1 - 2 * (y + 0.5) / scene.height,
                                          double(painting.frame.depth.at(x, y)));
            if (at.z < 1.0) continue;
            ++caps;
            // Beyond the centres of the first and the last voxel, the value is theirs.
            const double share = std::clamp(at.x, 0.0, 4.1) / 4.1;
            EXPECT_LT(difference(hueOf(painting.frame.color.at(x, y)), hueOfShare(share)), 0.03) << at.x;
        }
    EXPECT_GT(caps, 5000u);
}

TEST(FieldPaint, PacketsAndSingleRaysAgree) {
    const SemanticVolume volume = twoRooms();
    const auto bricks = volume::BrickVolume::fromColumns(volume.columns);
    ASSERT_TRUE(bricks);
    const fields::Field field = fieldOf("all", [](Vec3d p) { return p.x + p.y * p.z; });
    const auto view = FieldView::make(field, volume);
    ASSERT_TRUE(view);
    Scene scene = planScene();
    scene.camera.preset = "iso";
    scene.samples = 4;
    scene.field->isolines = 0.5;
    scene.passes[0].styles.push_back({"id=west", {}, 0.5f, {}, false});
    Scene plain = scene;
    plain.field.reset();
    const auto spec = makeFrameSpec(plain, volume);
    ASSERT_TRUE(spec);
    const auto paint = FieldPaint::make(*view, *scene.field, *spec);
    ASSERT_TRUE(paint);
    render::DrawnVolume drawn(*bricks, volume.grid);
    const auto unpainted = render::castRays(drawn, *spec);
    drawn.paintBy(&*paint);
    const auto fast = render::castRays(drawn, *spec), slow = render::castRaysReference(std::span(&drawn, 1), *spec);
    ASSERT_TRUE(fast && slow && unpainted);
    std::size_t others = 0, changed = 0;
    for (std::size_t n = 0; n < fast->color.pixels().size(); ++n) {
        others += fast->color.pixels()[n] != slow->color.pixels()[n];
        changed += fast->color.pixels()[n] != unpainted->color.pixels()[n];
    }
    EXPECT_EQ(others, 0u);
    EXPECT_GT(changed, 1000u);
    EXPECT_EQ(fast->label.pixels().size(), unpainted->label.pixels().size());
}

TEST(FieldPaint, MissingValuesAreGreyAndTheLegendSaysSo) {
    const SemanticVolume volume = twoRooms();
    const fields::Field field = fieldOf("air", [](Vec3d p) { return p.x < 2.05 ? 20 : kMissing; });
    Scene scene = planScene();
    const Painting painting = painted(volume, field, scene);
    for (std::int32_t y = 0; y < scene.height; y += 7)
        for (std::int32_t x = 0; x < scene.width; x += 7) {
            if (painting.frame.label.at(x, y) != 3) continue;
            const image::Rgba8 pixel = painting.frame.color.at(x, y);
            EXPECT_TRUE(pixel.r == pixel.g && pixel.g == pixel.b);
        }
    const auto view = FieldView::make(field, volume);
    ASSERT_TRUE(view);
    scene.field->isolines = 0.5;
    scene.field->range = {18, 22};
    const auto paint = FieldPaint::make(*view, *scene.field, painting.spec);
    ASSERT_TRUE(paint);
    EXPECT_EQ(paint->scale().title, "t (\u00B0C)");
    EXPECT_EQ(paint->scale().low, 18);
    EXPECT_EQ(paint->scale().missingText, "no value");
    EXPECT_EQ(paint->scale().notes, std::vector<std::string>{"lines every 0.5 \u00B0C"});
}

TEST(FieldPaint, LinesLieAtTheirValues) {
    const SemanticVolume volume = twoRooms();
    const fields::Field field = fieldOf("air", [](Vec3d p) { return 10 * p.x; });
    Scene scene = planScene();
    const Painting without = painted(volume, field, scene);
    scene.field->isolines = 5;
    const Painting with = painted(volume, field, scene);
    const render::CameraRays rays(with.spec, volume.grid);
    std::size_t lines = 0;
    const std::int32_t y = scene.height / 2;
    for (std::int32_t x = 0; x < scene.width; ++x) {
        if (with.frame.color.at(x, y) == without.frame.color.at(x, y)) continue;
        ++lines;
        const double at = rays.worldAt(2 * (x + 0.5) / scene.width - 1, 0, 0).x;
        EXPECT_LT(std::abs(std::remainder(10 * at, 5)), 10 * 1.3 * with.spec.camera.orthographicHeight / scene.height);
    }
    EXPECT_GE(lines, 6u);  // 5, 10, 15 and 25, 30, 35
    EXPECT_LE(lines, 18u);
}

TEST(FieldPaint, WhatCannotShowAFieldSaysSo) {
    const SemanticVolume volume = twoRooms();
    const fields::Field field = fieldOf("air", [](Vec3d) { return 20; });
    Scene scene = planScene();
    ScenePainter painter(volume);
    EXPECT_FALSE(painter.paint(scene)) << "no field is loaded";
    EXPECT_FALSE(painter.paintDraft(scene));
    EXPECT_FALSE(makeFrameSpec(scene, volume));
    ASSERT_TRUE(painter.showField(&field));
    EXPECT_TRUE(painter.paint(scene));
    EXPECT_TRUE(painter.paintDraft(scene));
    const ScenePainter::Draw other = [](auto volumes, const auto& spec) { return render::castRays(volumes, spec); };
    EXPECT_FALSE(painter.paint(scene, other)) << "another renderer";
    for (const auto& change : std::vector<std::function<void(Scene&)>>{
             [](Scene& s) { s.field->name = "u"; }, [](Scene& s) { s.colorBy = "class"; },
             [](Scene& s) { s.explode = 1; }, [](Scene& s) { s.field->time = 5; },
             [](Scene& s) {
                 s.field->isolines = 1e-9;
                 s.field->range = {0, 1};
             }}) {
        Scene wrong = scene;
        change(wrong);
        const auto refused = painter.paint(wrong);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code(), Code::BadArgument);
    }
}

TEST(FieldPaint, VectorsShowTheirLengths) {
    const SemanticVolume volume = twoRooms();
    const auto size = [](Vec3d p) { return 1 + p.x; };
    const fields::Field lengths = fieldOf("air", size);
    fields::Field vectors = lengths;
    vectors.head.components = 3;
    vectors.values.clear();
    for (const float part : {0.6f, 0.0f, -0.8f})
        for (const float value : lengths.values) vectors.values.push_back(part * value);
    const auto numbers = FieldView::make(lengths, volume), lengthsOfVectors = FieldView::make(vectors, volume);
    ASSERT_TRUE(numbers && lengthsOfVectors);
    EXPECT_EQ(lengthsOfVectors->head().components, 1);
    for (double x = 0.3; x < 2; x += 0.1) {
        const FieldView::Surface cap{2, {x, 1, 1}, {0, 0, 1}, true};
        EXPECT_NEAR(lengthsOfVectors->valueAt(cap, 0), numbers->valueAt(cap, 0), 1e-5) << x;
    }
}

TEST(FieldPaint, ComponentsShowTheirFigures) {
    const SemanticVolume volume = twoRooms();
    const fields::Field field = fieldOf("air", [](Vec3d p) { return p.x < 2.05 ? p.x : 2 * p.x; });
    Scene scene = planScene();
    const auto view = FieldView::make(field, volume);
    ASSERT_TRUE(view);
    // Samples 2 to 19 and 22 to 39 along x.
    for (const auto& [figure, west, east] :
         {std::tuple(FieldFigure::Mean, 1.05, 6.1), std::tuple(FieldFigure::Max, 1.9, 7.8),
          std::tuple(FieldFigure::Min, 0.2, 4.4)}) {
        std::optional<std::pair<float, float>> range;
        const auto values = view->figures(figure, 0, range);
        ASSERT_TRUE(values);
        EXPECT_TRUE(std::isnan(values->at(0))) << "walls are not air";
        EXPECT_NEAR(values->at(1), west, 1e-5);
        EXPECT_NEAR(values->at(2), east, 1e-5);
        ASSERT_TRUE(range);
        EXPECT_NEAR(range->second, east, 1e-5);
    }
    scene.field->per = FieldFigure::Mean;
    const Painting painting = painted(volume, field, scene);
    for (std::int32_t y = 0; y < scene.height; ++y)
        for (std::int32_t x = 0; x < scene.width; ++x) {
            const auto label = painting.frame.label.at(x, y);
            if (label != 2 && label != 3) continue;
            EXPECT_LT(difference(hueOf(painting.frame.color.at(x, y)), hueOfShare(label == 3 ? 1 : 0)), 0.02);
        }
    ScenePainter painter(volume);
    ASSERT_TRUE(painter.showField(&field));
    scene.field->isolines = 1;
    EXPECT_FALSE(painter.paint(scene)) << "one value per component has no lines";
}

TEST(FieldPaint, ScenesKeepTheirField) {
    Scene scene = planScene();
    scene.field->time = 12.5;
    scene.field->range = {-5, 24};
    scene.field->isolines = 1;
    scene.field->map = image::ColorMap::Vik;
    const auto read = parseScene(writeScene(scene));
    ASSERT_TRUE(read) << read.error().toString();
    EXPECT_EQ(*read, scene);
    EXPECT_FALSE(parseScene(R"({"passes":[{}],"field":{"name":"t","range":[3,3]}})"));
    EXPECT_FALSE(parseScene(R"({"passes":[{}],"field":{"time":3}})"));
}

}  // namespace
}  // namespace svt::illustrate

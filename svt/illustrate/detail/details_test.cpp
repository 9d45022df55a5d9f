#include <svt/illustrate/details.hpp>

#include <svt/illustrate/scene_painter.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/volume/volume_part.hpp>

#include <gtest/gtest.h>

#include <functional>

namespace svt::illustrate {
namespace {

using LabelAt = std::function<volume::Scalar(Vec3d)>;

// Samples of `at` in a box, metres; labels named after their scalars.
volume::SemanticVolume sampled(Vec3d low, Vec3d high, double spacing, const std::vector<const char*>& ids,
                               const LabelAt& at) {
    Vec3i n;
    for (int axis = 0; axis < 3; ++axis) n[axis] = static_cast<std::int32_t>((high[axis] - low[axis]) / spacing + 0.5);
    const Vec3d half{spacing / 2, spacing / 2, spacing / 2};
    volume::SemanticVolume volume = volume::test::emptyVolume(n, {spacing, spacing, spacing}, low + half);
    for (const char* id : ids) {
        volume::Label& label = volume::test::addObject(volume, id, "BuildingConstructiveElement");
        label.color = {0.3f * float(label.first), 0.5f, 0.2f};
    }
    volume::test::paint(volume, [&](int i, int j, int k) {
        return at(volume.grid.worldFromIndex({double(i), double(j), double(k)}));
    });
    return volume;
}

// A wall (1) across a block of air with a post (2) before it and glass (3) in front; faces lie on samples of 0.4 m.
volume::Scalar model(Vec3d p) {
    if (p.y > 6.4 && p.y < 7.2) return 1;
    if (p.x > 3.2 && p.x < 4.8 && p.y > 3.2 && p.y < 4.8) return 2;
    if (p.y > 0.8 && p.y < 1.6) return 3;
    return 0;
}

render::Frame painted(ScenePainter& painter, const Scene& scene) {
    const auto painting = painter.paint(scene);
    EXPECT_TRUE(painting) << (painting ? "" : painting.error().toString());
    return painting ? painting->frame : render::Frame{};
}

Scene scene() {
    Scene scene;
    scene.width = 160;
    scene.height = 120;
    scene.samples = 1;
    scene.lines.strength = 0;
    scene.ambientOcclusion = 0;
    scene.camera.fit = Fit::All;
    scene.passes[0].styles.push_back({"id=glass", {}, 0.3f, {}, false});
    return scene;
}

// Glass that goes on in another volume is lit once more where that begins.
constexpr int kLitAgain = 24;

std::size_t differences(const render::Frame& a, const render::Frame& b) {
    std::size_t count = 0;
    for (std::size_t n = 0; n < a.label.pixels().size(); ++n)
        count += a.label.pixels()[n] != b.label.pixels()[n] ||
                         std::abs(a.depth.pixels()[n] - b.depth.pixels()[n]) > 0.01f ||
                         std::abs(a.color.pixels()[n].r - b.color.pixels()[n].r) > kLitAgain
                     ? 1
                     : 0;
    return count;
}

// What both have sampled alike is drawn alike: a box of the model sampled four times finer, in the middle of all.
TEST(Details, BoxesAreDrawnAsOneWithTheVolume) {
    const std::vector<const char*> ids{"wall", "post", "glass"};
    volume::SemanticVolume tower = sampled({0, 0, 0}, {8, 8, 8}, 0.4, ids, model);
    std::vector<volume::SemanticVolume> details;
    details.push_back(sampled({2, 2, 2}, {6, 7, 6}, 0.1, {"post", "wall"}, [](Vec3d p) {
        const volume::Scalar scalar = model(p);
        return scalar == 0 ? 0 : 3 - scalar;
    }));
    details.push_back(sampled({0.8, 0.4, 0.8}, {2, 8, 6}, 0.1, ids, model));
    const volume::SemanticVolume alone = tower;
    ASSERT_TRUE(joinLabels(tower, details));
    EXPECT_EQ(tower.labels, alone.labels) << "no label is new";
    EXPECT_TRUE(placeOfDetail(tower, details[0]).box) << "the wall reaches beyond";
    ScenePainter plain(alone), joined(tower);
    for (const auto& detail : details) joined.addDetail(detail);
    for (const char* preset : {"iso", "front", "iso-nw", "left"}) {
        Scene wanted = scene();
        wanted.camera.preset = preset;
        const render::Frame frame = painted(joined, wanted), expected = painted(plain, wanted);
        EXPECT_LT(differences(frame, expected), 160u) << preset << ": pixels on edges";
        wanted.passes[0].cut = "z>4";
        EXPECT_LT(differences(painted(joined, wanted), painted(plain, wanted)), 160u) << preset << ", cut";
    }
}

// A component that the detail has as a whole replaces that of the volume: here it is smaller, so the wall is seen beside it.
TEST(Details, WholeComponentsReplaceTheirs) {
    volume::SemanticVolume tower = sampled({0, 0, 0}, {8, 8, 8}, 0.4, {"wall", "post", "glass"}, model);
    std::vector<volume::SemanticVolume> details;
    details.push_back(sampled({3.2, 3.2, 0}, {4.8, 4.8, 8}, 0.1, {"post", "knob"},
                              [](Vec3d p) { return p.x > 3.9 && p.x < 4.1 ? p.z > 6 ? 2u : 1u : 0u; }));
    ASSERT_TRUE(joinLabels(tower, details));
    ASSERT_EQ(tower.labels.labels.size(), 4u);
    EXPECT_EQ(tower.labels.labels[3].id, "knob");
    EXPECT_EQ(tower.labels.labels[3].first, 4u);
    EXPECT_EQ(placeOfDetail(tower, details[0]).replaced, (std::vector<volume::Scalar>{2}));
    ScenePainter joined(tower);
    joined.addDetail(details[0]);
    Scene wanted = scene();
    wanted.camera.preset = "front";
    wanted.camera.isParallel = true;
    wanted.passes[0].hide = {"id=glass"};
    const render::Frame frame = painted(joined, wanted);
    std::size_t post = 0, knob = 0;
    for (int x = 0; x < 160; ++x) {
        post += frame.label.at(x, 80) == 2;
        knob += frame.label.at(x, 20) == 4;
    }
    // 8 m fill 110 pixels of the height: 0.2 m are 3.
    EXPECT_NEAR(static_cast<double>(post), 3, 1);
    EXPECT_NEAR(static_cast<double>(knob), 3, 1);
}

// A model that is divided among volumes is drawn as if it were whole, also from an empty volume around it.
TEST(Details, PartsAreDrawnAsTheWhole) {
    const std::vector<const char*> ids{"wall", "post", "glass"};
    const volume::SemanticVolume whole = sampled({0, 0, 0}, {8, 8, 8}, 0.4, ids, model);
    volume::SemanticVolume frame = sampled({0, 0, 0}, {8, 8, 8}, 0.4, {}, [](Vec3d) { return 0u; });
    std::vector<volume::SemanticVolume> parts;
    for (volume::Scalar own = 1; own <= 3; ++own)
        parts.push_back(
            sampled({0, 0, 0}, {8, 8, 8}, 0.4, {ids[own - 1]}, [own](Vec3d p) { return model(p) == own ? 1u : 0u; }));
    for (std::size_t n = 0; n < 3; ++n) parts[n].labels.labels[0].color = whole.labels.labels[n].color;
    ASSERT_TRUE(joinLabels(frame, parts));
    ScenePainter plain(whole), divided(frame);
    for (const auto& part : parts) divided.addPart(part);
    for (const char* preset : {"iso", "front", "iso-nw", "left"}) {
        Scene wanted = scene();
        wanted.camera.preset = preset;
        EXPECT_EQ(differences(painted(divided, wanted), painted(plain, wanted)), 0u) << preset;
        wanted.passes[0].cut = "z>4";
        EXPECT_EQ(differences(painted(divided, wanted), painted(plain, wanted)), 0u) << preset << ", cut";
    }
}

TEST(Details, OtherReferenceSystemsAreRefused) {
    volume::SemanticVolume tower = sampled({0, 0, 0}, {8, 8, 8}, 0.4, {"wall", "post", "glass"}, model);
    std::vector<volume::SemanticVolume> details{tower};
    tower.crsName = "EPSG:25832";
    details[0].crsName = "EPSG:25833";
    EXPECT_EQ(joinLabels(tower, details).error().code(), Code::BadArgument);
}

}  // namespace
}  // namespace svt::illustrate

#include <svt/illustrate/view.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

namespace svt::illustrate {
namespace {

// Two cubes of 1 m (labels a and b), 6 m apart along x.
volume::SemanticVolume twoCubes() {
    volume::SemanticVolume volume = volume::test::emptyVolume({16, 4, 4}, {0.5, 0.5, 0.5}, {1000, 2000, 30});
    for (const char* const id : {"a", "b"}) volume::test::addObject(volume, id, "Furniture");
    volume::test::paintBoxes(volume, {{1, {1, 1, 1}, {3, 3, 3}}, {2, {13, 1, 1}, {15, 3, 3}}});
    return volume;
}

void expectSameView(const SceneCamera& camera, const SceneCamera& expected, const volume::SemanticVolume& volume) {
    Scene a, b;
    a.camera = camera;
    b.camera = expected;
    const auto first = makeFrameSpec(a, volume), second = makeFrameSpec(b, volume);
    ASSERT_TRUE(first && second);
    EXPECT_LT(length(first->camera.eye - second->camera.eye), 1e-6);
    EXPECT_LT(length(first->camera.target - second->camera.target), 1e-6);
    if (!camera.isParallel) return;
    EXPECT_NEAR(first->camera.orthographicHeight, second->camera.orthographicHeight, 1e-6);
}

TEST(View, IsThatOfThePreset) {
    const auto volume = twoCubes();
    for (const bool isParallel : {false, true}) {
        SceneCamera wanted;
        wanted.preset = "front";
        wanted.around = "id=b";
        wanted.isParallel = isParallel;
        SceneCamera now;
        now.isParallel = isParallel;
        now.zoom = 3;
        const auto view = makeView("id=b", "front", now, 16.0 / 9, volume);
        ASSERT_TRUE(view) << view.error().toString();
        ASSERT_TRUE(view->eye && view->target);
        expectSameView(*view, wanted, volume);
    }
}

TEST(View, GoesOnFromWhereTheCameraLooks) {
    const auto volume = twoCubes();
    for (const bool isParallel : {false, true}) {
        SceneCamera front;
        front.preset = "front";
        front.isParallel = isParallel;
        front.zoom = 2;
        SceneCamera expected = front;
        expected.zoom = 1;
        expected.around = "id=a";
        SceneCamera now = front;
        // The same direction from elsewhere, told by points, under another preset.
        now.preset = "iso";
        now.target = Vec3d{3, 1, 1};
        now.eye = Vec3d{3, -9, 1};
        const auto view = makeView("id=a", "", now, 16.0 / 9, volume);
        ASSERT_TRUE(view) << view.error().toString();
        expectSameView(*view, expected, volume);
    }
}

TEST(View, TellsWhatIsWrong) {
    const auto volume = twoCubes();
    EXPECT_EQ(makeView("id=c", "front", {}, 1, volume).error().code(), Code::NothingSelected);
    EXPECT_EQ(makeView("", "sideways", {}, 1, volume).error().code(), Code::BadCamera);
    EXPECT_EQ(makeView("", "front", {}, 0, volume).error().code(), Code::BadCamera);
}

}  // namespace
}  // namespace svt::illustrate

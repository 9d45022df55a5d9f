#include <svt/illustrate/motion.hpp>

#include <svt/illustrate/motion/interpolate.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace svt::illustrate {
namespace {

volume::SemanticVolume block() {
    volume::SemanticVolume volume = volume::test::emptyVolume({41, 21, 11}, {0.5, 0.5, 0.5}, {10, 20, 30});
    volume::test::addObject(volume, "block", "block");
    volume::test::paint(volume, [](int, int, int) { return 1; });
    return volume;
}

Scene sceneOf(const std::string& json) {
    const auto scene = parseScene(json);
    EXPECT_TRUE(scene) << (scene ? "" : scene.error().toString());
    return scene ? *scene : Scene{};
}

Scene at(const Scene& scene, double seconds) {
    const auto found = sceneAt(scene, seconds, block());
    EXPECT_TRUE(found) << (found ? "" : found.error().toString());
    return found ? *found : Scene{};
}

TEST(Motion, NumbersOfRegionsGoFromTheSceneToItsKeys) {
    const Scene scene = sceneOf(R"json({"passes":[{"cut":"z>6 and not box(2,2,0,4,4,3)"}],"motion":{
    "seconds" : 4, "pace" : "even",
                            "keys" : [ {"at" : 2, "scene" : {"passes" : [ {"cut" : "z>1 and not box(2,2,0,4,4,3)"} ]}} ]
}
})json");
    EXPECT_EQ(at(scene, 0).passes[0].cut, "z>6 and not box(2,2,0,4,4,3)");
    EXPECT_EQ(at(scene, 1).passes[0].cut, "z>3.5 and not box(2,2,0,4,4,3)");
    EXPECT_EQ(at(scene, 2).passes[0].cut, "z>1 and not box(2,2,0,4,4,3)");
    EXPECT_EQ(at(scene, 4).passes[0].cut, "z>1 and not box(2,2,0,4,4,3)");
    EXPECT_EQ(at(scene, -1).passes[0].cut, at(scene, 0).passes[0].cut);
    EXPECT_EQ(at(scene, 9).passes[0].cut, at(scene, 4).passes[0].cut);
    EXPECT_FALSE(at(scene, 1).motion) << "a moment does not move";
}

TEST(Motion, ALensInBetweenIsInBetween) {
    const Scene scene = sceneOf(R"json({"passes":[{"keep":"view(0.3,0.5,0.2)"}],"motion":{"seconds":2,"pace":"even",
        "keys":[{"at":2,"scene":{"passes":[{"keep":"view(0.7,0.25,0.4)"}]}}]}})json");
    EXPECT_EQ(at(scene, 0).passes[0].keep, "view(0.3,0.5,0.2)");
    EXPECT_EQ(at(scene, 1).passes[0].keep, "view(0.5,0.375,0.3)");
    EXPECT_EQ(at(scene, 2).passes[0].keep, "view(0.7,0.25,0.4)");
}

TEST(Motion, SmoothPaceIsGentleAtBothEndsAndHalfwayInTheMiddle) {
    const Scene scene = sceneOf(R"json({"passes":[{"cut":"z>0"}],"motion":{"seconds":1,
        "keys":[{"at":1,"scene":{"passes":[{"cut":"z>100"}]}}]}})json");
    EXPECT_EQ(at(scene, 0.5).passes[0].cut, "z>50");
    EXPECT_EQ(at(scene, 0.1).passes[0].cut, "z>2.8");  // 3 s^2 - 2 s^3
    EXPECT_EQ(at(scene, 0.9).passes[0].cut, "z>97.2");
}

TEST(Motion, OpacitiesColoursAndZoomGoWhatIsNamedJumps) {
    const Scene scene = sceneOf(
        R"json({"look":"paper","background":"#000000","passes":[{"styles":[{"select":"class=block","opacity":1}]}],
        "motion":{"seconds":2,"pace":"even","keys":[{"at":1,"scene":{"look":"dark","background":"#ff8000","camera":{"zoom":2},
        "passes":[{"styles":[{"opacity":0.5}]}]}},{"at":2,"scene":{"camera":{"zoom":4},"names":["class=block"]}}]}})json");
    const Scene half = at(scene, 0.5);
    EXPECT_EQ(half.look, Look::Paper);
    ASSERT_EQ(half.passes[0].styles.size(), 1u);
    EXPECT_FLOAT_EQ(*half.passes[0].styles[0].opacity, 0.75f);
    EXPECT_NEAR(half.background->x, 0.5, 0.003);
    EXPECT_NEAR(half.background->y, 0.25, 0.003);
    EXPECT_EQ(half.camera.zoom, 1.5);
    EXPECT_EQ(at(scene, 1).look, Look::Dark);
    EXPECT_EQ(at(scene, 1.5).camera.zoom, 3);
    EXPECT_TRUE(at(scene, 1.9).names.empty());
    EXPECT_EQ(at(scene, 2).names, std::vector<std::string>{"class=block"});
}

TEST(Motion, WholeNumbersJumpAtTheirKeys) {
    const Scene scene =
        sceneOf(R"json({"samples":4,"passes":[{"level":0}],"motion":{"seconds":2,"keys":[{"at":2,"scene":
        {"samples":16,"camera":{"zoom":2},"passes":[{"level":3}]}}]}})json");
    EXPECT_EQ(at(scene, 1.3).samples, 4);
    EXPECT_EQ(at(scene, 1.3).passes[0].representation.level, 0);
    EXPECT_EQ(at(scene, 2).samples, 16);
    EXPECT_EQ(at(scene, 2).passes[0].representation.level, 3);
}

TEST(Motion, TheEyeGoesAroundItsTargetTheShorterWay) {
    // From the east over the south (-90 degrees) to the west: 10 m and 40 m away, at the geometric mean halfway.
    const Scene scene = sceneOf(R"json({"camera":{"eye":[10,-0.001,0],"target":[0,0,0]},"motion":{"seconds":2,
        "keys":[{"at":2,"scene":{"camera":{"eye":[-40,-0.001,0],"target":[0,0,0]}}}]}})json");
    const Vec3d eye = *at(scene, 1).camera.eye;
    EXPECT_NEAR(eye.x, 0, 0.01);
    EXPECT_NEAR(eye.y, -20, 0.01);
    EXPECT_NEAR(eye.z, 0, 1e-9);
    EXPECT_NEAR(at(scene, 2).camera.eye->x, -40, 1e-9);
}

TEST(Motion, ATurnOfANamedViewKeepsTheVolumeInThePictureAllTheWay) {
    const volume::SemanticVolume volume = block();
    Scene scene = sceneOf(R"json({"size":[640,360],"motion":{"seconds":4,"turn":360}})json");
    double fullest = 0;
    for (int n = 0; n <= 72; ++n) {
        const Scene now = at(scene, n / 18.0);
        const Vec3d eye = *now.camera.eye, target = *now.camera.target;
        const Vec3d forward = normalized(target - eye);
        const Vec3d right = normalized(cross(forward, {0, 0, 1})), up = cross(right, forward);
        const double half = std::tan(now.camera.fieldOfView * std::numbers::pi / 360);
        for (int c = 0; c < 8; ++c) {
            const Vec3d corner{(c & 1) != 0 ? 20.25 : -0.25, (c & 2) != 0 ? 10.25 : -0.25, (c & 4) != 0 ? 5.25 : -0.25};
            const Vec3d from = corner - eye;
            const double depth = dot(from, forward);
            ASSERT_GT(depth, 0);
            const double x = std::abs(dot(from, right)) / (depth * half * 640 / 360),
                         y = std::abs(dot(from, up)) / (depth * half);
            fullest = std::max({fullest, x, y});
        }
    }
    EXPECT_LE(fullest, 0.97);
    EXPECT_GE(fullest, 0.95) << "as large as the margin allows somewhere on the way";
    const Vec3d first = *at(scene, 0).camera.eye, last = *at(scene, 4).camera.eye, half = *at(scene, 2).camera.eye;
    const Vec3d target = *at(scene, 0).camera.target;
    EXPECT_LT(length(first - last), 1e-9);
    EXPECT_LT(length((first - target) + (half - target) - Vec3d{0, 0, 2 * (first - target).z}), 1e-9);
}

TEST(Motion, IsReadAndWritten) {
    const std::string text = R"json({"format":"svt-scene","version":1,"size":[640,360],"passes":[{"cut":"z>6"}],
        "motion":{"seconds":4,"rate":30,"turn":-90,"pace":"even","keys":[{"at":1,"scene":{"passes":[{"cut":"z>1"}]}}]}})json";
    const Scene scene = sceneOf(text);
    ASSERT_TRUE(scene.motion);
    EXPECT_EQ(pictureCount(*scene.motion), 120);
    const auto again = parseScene(writeScene(scene));
    ASSERT_TRUE(again) << again.error().toString();
    EXPECT_EQ(*again, scene);
}

TEST(Motion, MembersThatAreLeftOutBeginAtTheirDefaults) {
    const Scene scene = sceneOf(
        R"json({"passes":[{}],"motion":{"seconds":2,"pace":"even","keys":[{"at":2,"scene":{"explode":4,"camera":{"zoom":3}}}]}})json");
    const auto now = sceneAt(scene, 1, {});
    ASSERT_TRUE(now) << now.error().toString();
    EXPECT_EQ(now->explode, 2);
    EXPECT_EQ(now->camera.zoom, 2);
    EXPECT_EQ(sceneAt(scene, 0, {})->camera.zoom, 1);
}

TEST(Motion, ADefaultMakesNothingThatAKeyBrings) {
    const Scene sunny = sceneOf(
        R"json({"passes":[{}],"motion":{"seconds":2,"keys":[{"at":1,"scene":{"sun":{"time":"2026-06-21 15:00","size":2}}}]}})json");
    const auto before = sceneAt(sunny, 0.5, {});
    ASSERT_TRUE(before) << before.error().toString();
    EXPECT_FALSE(before->sun);
    EXPECT_EQ(sceneAt(sunny, 1, {})->sun->size, 2);
    const Scene lined = sceneOf(
        R"json({"passes":[{}],"motion":{"seconds":2,"keys":[{"at":1,"scene":{"passes":[{"lines":[{"select":"all","width":2}]}]}}]}})json");
    EXPECT_TRUE(sceneAt(lined, 0.5, {})->passes[0].lines.empty());
    EXPECT_EQ(sceneAt(lined, 1, {})->passes[0].lines.size(), 1u);
}

TEST(Motion, WrongKeysAreNamed) {
    const auto messageOf = [](const std::string& motion) {
        const auto scene = parseScene("{\"passes\":[{}],\"motion\":" + motion + "}", "s.json");
        EXPECT_FALSE(scene);
        return scene ? std::string() : scene.error().toString();
    };
    const auto has = [](const std::string& message, const char* text) {
        EXPECT_NE(message.find(text), std::string::npos) << message;
    };
    has(messageOf(R"json({"keys":[{"at":1}]})json"), "/motion/keys/0: needs \"scene\"");
    has(messageOf(R"json({"keys":[{"at":1,"scene":{}},{"at":1,"scene":{}}]})json"),
        "/motion/keys/1/at: expected a later time");
    has(messageOf(R"json({"seconds":2,"keys":[{"at":3,"scene":{}}]})json"), "after the end of the motion at 2 s");
    has(messageOf(R"json({"keys":[{"at":1,"scene":{"passes":[{"cutt":"z>1"}]}}]})json"),
        "/motion/keys/0/scene: /passes/0: unknown member 'cutt'");
    has(messageOf(R"json({"keys":[{"at":1,"scene":{"motion":{}}}]})json"), "/motion/keys/0/scene/motion");
    has(messageOf(R"json({"keys":[{"at":1,"scene":{"size":[320,180]}}]})json"), "/motion/keys/0/scene/size");
    has(messageOf(R"json({"rate":0})json"), "/motion/rate");
    has(messageOf(R"json({"keys":[{"at":0,"scene":{"passes":[{"styles":[{"opacity":0.5}]}]}}]})json"),
        "needs \"select\"");
}

TEST(Motion, OnlyNumbersOfEqualTextsGo) {
    EXPECT_EQ(textBetween("z>6", "z>1", 0.5), "z>3.5");
    EXPECT_EQ(textBetween("ball(6,3,-3,2)", "ball(8,3,3,1e1)", 0.5), "ball(7,3,0,6)");
    EXPECT_EQ(textBetween("storey(EG1)", "storey(EG2)", 0.5), "storey(EG1)") << "a digit of a name is none of a number";
    EXPECT_EQ(textBetween("z>6", "y>1", 0.5), "z>6");
    EXPECT_EQ(textBetween("storey='Floor 1'+1.1", "storey='Floor 1'+2.1", 0.5), "storey='Floor 1'+1.6");
    EXPECT_EQ(textBetween("storey=1.OG+0", "storey=1.OG+2", 0.5), "storey=1.OG+1") << "what is equal stays as it is";
    EXPECT_EQ(textBetween("", "z>1", 0.5), "");
}

TEST(Motion, CutsMoveToAKey) {
    Scene scene = sceneOf(R"json({"passes":[{"cut":"y<3"},{"cut":"z=6"}]})json");
    ASSERT_TRUE(addCutKey(scene, std::vector<std::string>{"y<3", "z=1"}, 4));
    ASSERT_TRUE(scene.motion);
    EXPECT_EQ(scene.motion->pace, Motion::Pace::Even);
    EXPECT_EQ(at(scene, 0).passes[1].cut, "z=6");
    EXPECT_EQ(at(scene, 1).passes[1].cut, "z=4.75");
    EXPECT_EQ(at(scene, 4).passes[1].cut, "z=1");
    EXPECT_EQ(at(scene, 1).passes[0].cut, "y<3");
    EXPECT_EQ(sceneOf(writeScene(scene)), scene);
}

TEST(Motion, CutKeysStandBetweenThoseOfTheScene) {
    const std::string json = R"json({"passes":[{"cut":"z=6"}],"motion":{"seconds":4,"keys":[
        {"at":1,"scene":{"explode":1}},{"at":2,"scene":{"explode":2}},{"at":4,"scene":{"explode":0}}]}})json";
    for (const double seconds : {2.0, 3.0}) {
        Scene scene = sceneOf(json);
        ASSERT_TRUE(addCutKey(scene, std::vector<std::string>{"z=1"}, seconds));
        EXPECT_EQ(scene.motion->keys.size(), seconds == 2 ? 3u : 4u);
        EXPECT_EQ(scene.motion->pace, Motion::Pace::Smooth) << "that of the scene";
        EXPECT_EQ(at(scene, 2).explode, 2);
        EXPECT_EQ(at(scene, seconds).passes[0].cut, "z=1");
        EXPECT_EQ(sceneOf(writeScene(scene)), scene);
    }
    Scene moving = sceneOf(R"json({"passes":[{"cut":"z=6"}],"motion":{"seconds":4,"keys":[
        {"at":1,"scene":{"passes":[{"cut":"z=2"}]}}]}})json");
    const auto added = addCutKey(moving, std::vector<std::string>{"z=1"}, 4);
    ASSERT_FALSE(added);
    EXPECT_EQ(added.error().code(), Code::BadArgument);
}

}  // namespace
}  // namespace svt::illustrate

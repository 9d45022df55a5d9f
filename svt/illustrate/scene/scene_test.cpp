#include <svt/core/text.hpp>
#include <svt/illustrate/scene_members.hpp>
#include <svt/illustrate/scene_painter.hpp>
#include <svt/render/camera_presets.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::illustrate {
namespace {

// A room (1) in a house of walls (2) with a beam (3).
volume::SemanticVolume house() {
    volume::SemanticVolume volume = volume::test::emptyVolume({20, 20, 20}, {0.5, 0.5, 0.5}, {10, 20, 30});
    volume::test::addObject(volume, "room", "BuildingRoom").opacity = 0.1f;
    volume::test::addObject(volume, "wall", "WallSurface");
    volume::test::addObject(volume, "beam", "BuildingConstructiveElement");
    volume::test::paintBoxes(
        volume, {{2, {0, 0, 0}, {20, 20, 20}}, {1, {2, 2, 2}, {18, 18, 18}}, {3, {2, 2, 10}, {18, 18, 11}}});
    return volume;
}

render::FrameSpec frame(const Scene& scene) {
    const auto spec = makeFrameSpec(scene, house());
    EXPECT_TRUE(spec) << (spec ? "" : spec.error().toString());
    return spec ? *spec : render::FrameSpec{};
}

TEST(Scene, AsItIsShowsAllLabelsExceptRooms) {
    const render::FrameSpec spec = frame({});
    ASSERT_EQ(spec.passes.size(), 1u);
    ASSERT_EQ(spec.passes[0].styles.size(), 4u);
    EXPECT_EQ(spec.passes[0].styles[0].opacity, 0);
    EXPECT_EQ(spec.passes[0].styles[1].opacity, 0);
    EXPECT_EQ(spec.passes[0].styles[2].opacity, 1);
    EXPECT_TRUE(spec.passes[0].clips.empty());
    EXPECT_EQ(spec.passes[0].styles[2].hatch, render::Hatch::None);
    EXPECT_EQ(spec.objectOfScalar, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(Scene, ShowHideAndStylesAreApplied) {
    Scene scene;
    ScenePass& pass = scene.passes[0];
    pass.show = {"class=BuildingRoom", "id=beam"};
    pass.hide = {"id=beam"};
    pass.styles = {{"all", Vec3f{1, 0, 0}, {}, {}, false}, {"id=room", {}, 0.5f, render::Hatch::Earth, false}};
    const render::FrameSpec spec = frame(scene);
    EXPECT_EQ(spec.passes[0].styles[1].opacity, 0.5f);
    EXPECT_EQ(spec.passes[0].styles[1].hatch, render::Hatch::Earth);
    EXPECT_EQ(spec.passes[0].styles[1].color, (Vec3f{1, 0, 0}));
    EXPECT_EQ(spec.passes[0].styles[2].opacity, 0);
    EXPECT_EQ(spec.passes[0].styles[3].opacity, 0);
}

TEST(Scene, PaperHatchesWhatIsCut) {
    Scene scene;
    scene.look = Look::Paper;
    scene.passes[0].cut = "z>5";
    const render::FrameSpec spec = frame(scene);
    EXPECT_EQ(spec.passes[0].styles[2].hatch, render::Hatch::Masonry);
    EXPECT_EQ(spec.passes[0].styles[1].hatch, render::Hatch::None);
    ASSERT_EQ(spec.passes[0].clips.size(), 1u);
    EXPECT_EQ(spec.passes[0].clips[0], render::ClipRegion::plane({0, 0, 1}, {10, 20, 35}));
    EXPECT_GT(spec.borders.cutWidth, spec.borders.width);
    scene.hatches.show = false;
    EXPECT_EQ(frame(scene).passes[0].styles[2].hatch, render::Hatch::None);
}

TEST(Scene, ALensCutsWithinItsRegionAlone) {
    Scene scene;
    scene.passes[0].cut = "x>9";
    addLens(scene, "ball(5,5,5,2)", "y<4", Context::Ghost);
    const render::FrameSpec spec = frame(scene);
    ASSERT_EQ(spec.passes.size(), 2u);
    const auto& [around, detail] = std::tie(spec.passes[0], spec.passes[1]);
    EXPECT_EQ(around.clips.size(), 1u);
    EXPECT_LT(around.styles[2].opacity, 0.5f);
    EXPECT_GT(around.styles[2].opacity, 0);
    EXPECT_EQ(around.styles[1].opacity, 0);
    ASSERT_EQ(detail.clips.size(), 2u);
    EXPECT_EQ(detail.clips[0].mode, render::ClipRegion::Mode::KeepOnly);
    EXPECT_EQ(detail.clips[1].parts.size(), 2u);
    EXPECT_EQ(detail.styles[2].opacity, 1);
    EXPECT_EQ(detail.join, render::Pass::Join::Replace);
    Scene alone;
    addLens(alone, "ball(5,5,5,2)", "", Context::None);
    EXPECT_EQ(frame(alone).passes.size(), 1u);
}

TEST(Scene, AHighlightIsSolidBeforeItsContext) {
    Scene scene;
    addHighlight(scene, {"id=room", "id=beam"}, Context::Solid);
    const render::FrameSpec spec = frame(scene);
    ASSERT_EQ(spec.passes.size(), 2u);
    EXPECT_EQ(spec.passes[0].styles[1].opacity, 0);
    EXPECT_EQ(spec.passes[0].styles[2].opacity, 1);
    EXPECT_EQ(spec.passes[0].styles[3].opacity, 0);
    EXPECT_EQ(spec.passes[1].styles[1].opacity, 1);
    EXPECT_EQ(spec.passes[1].styles[2].opacity, 0);
    EXPECT_EQ(spec.passes[1].join, render::Pass::Join::Over);
}

TEST(Scene, PassesDrawFormsOfTheirOwn) {
    Scene scene;
    addHighlight(scene, {"id=room"}, Context::Shell);
    scene.passes[0].representation.level = 3;
    scene.passes.push_back(scene.passes[0]);
    EXPECT_EQ(volumeRepresentations(scene), (std::vector<VolumeRepresentation>{{ShellLevel::Building, 3}, {}}));
    const render::FrameSpec spec = frame(scene);
    ASSERT_EQ(spec.passes.size(), 3u);
    EXPECT_EQ(spec.passes[0].volume, 0u);
    EXPECT_EQ(spec.passes[1].volume, 1u);
    EXPECT_EQ(spec.passes[2].volume, 0u);
    // Glass: a hull of two voxels stops a tenth.
    EXPECT_NEAR(1 - std::pow(1 - spec.passes[0].styles[2].opacity, 2 * 0.5f), 0.10, 1e-4);
}

TEST(Scene, APainterKeepsTheFormsThatScenesNeed) {
    volume::SemanticVolume volume = house();
    volume::Label building;
    building.id = "building";
    building.className = "Building";
    building.subtreeEnd = 4;
    for (volume::Label& label : volume.labels.labels) {
        label.parent = 0;
        ++label.subtreeEnd;
        label.voxels = 1;
    }
    volume.labels.labels.insert(volume.labels.labels.begin(), building);
    ScenePainter painter(volume, 1);
    Scene scene;
    scene.width = scene.height = 40;
    scene.passes[0].hide = {"id=room"};
    const auto plain = painter.paint(scene);
    ASSERT_TRUE(plain) << plain.error().toString();
    scene.passes[0].representation.shell = ShellLevel::Building;
    const auto shell = painter.paint(scene);
    ASSERT_TRUE(shell) << shell.error().toString();
    EXPECT_EQ(plain->frame.label, shell->frame.label);  // from outside the hull looks the same
    scene.passes[0].cut = "z>5.2";
    const auto open = painter.paint(scene);
    ASSERT_TRUE(open);
    scene.passes[0].representation.shell.reset();
    EXPECT_NE(painter.paint(scene)->frame.label, open->frame.label);  // the beam is gone from the hull
    const auto representation = painter.representation({}, plain->spec),
               again = painter.representation({}, plain->spec);
    ASSERT_TRUE(representation && again);
    EXPECT_EQ(&representation->bricks(), &again->bricks());
    EXPECT_EQ(painter.representation({ShellLevel::Building, 2}, plain->spec)->level()->level, 2);
}

TEST(Scene, ADraftShowsWhatThePictureShows) {
    const volume::SemanticVolume volume = house();
    ScenePainter painter(volume, 1);
    Scene scene;
    scene.width = scene.height = 60;
    scene.passes[0].cut = "z>5.2";
    const auto draft = painter.paintDraft(scene), picture = painter.paint(scene);
    ASSERT_TRUE(draft) << draft.error().toString();
    ASSERT_TRUE(picture) << picture.error().toString();
    EXPECT_EQ(draft->frame.label, picture->frame.label);
    // The finest level, whatever the picture would have.
    scene.passes[0].representation.level = 2;
    const auto coarse = painter.paint(scene), again = painter.paintDraft(scene);
    ASSERT_TRUE(coarse && again);
    EXPECT_NE(coarse->frame.label, draft->frame.label);
    EXPECT_EQ(again->frame.label, draft->frame.label);
}

TEST(Scene, ACutawayLeavesItsTargetWhole) {
    Scene scene;
    addCutaway(scene, "id=beam", 0.1);
    const render::FrameSpec spec = frame(scene);
    ASSERT_EQ(spec.passes.size(), 2u);
    ASSERT_EQ(spec.passes[0].clips.size(), 1u);
    EXPECT_EQ(spec.passes[0].clips[0].parts[0].rounds.size(), 1u);
    EXPECT_TRUE(spec.passes[1].clips.empty());
    EXPECT_EQ(spec.passes[1].styles[2].opacity, 0);
}

TEST(Scene, TheViewMayShowAPart) {
    Scene scene;
    scene.camera.around = "id=beam";
    scene.camera.isParallel = true;
    scene.camera.preset = "front";
    const render::FrameSpec spec = frame(scene);
    // The beam is 8 m wide and half a metre high around z = 35.
    EXPECT_NEAR(spec.camera.target.z, 35, 1e-9);
    EXPECT_LT(spec.camera.orthographicHeight, 6);
}

TEST(Scene, AirThatIsShownAloneIsSolid) {
    Scene scene;
    ScenePass& pass = scene.passes[0];
    pass.show = {"class=BuildingRoom"};
    EXPECT_EQ(frame(scene).passes[0].styles[1].opacity, 1);
    // Not with something solid beside it, nor against the scene's own words.
    pass.show = {"class=BuildingRoom", "id=beam"};
    EXPECT_EQ(frame(scene).passes[0].styles[1].opacity, 0.1f);
    pass.show = {"class=BuildingRoom"};
    pass.styles = {{"all", {}, 0.2f, {}, false}};
    EXPECT_EQ(frame(scene).passes[0].styles[1].opacity, 0.2f);
    // Not where all is shown and the solid is hidden: air that is looked through.
    pass = {};
    pass.hide = {"id=wall", "id=beam"};
    EXPECT_EQ(frame(scene).passes[0].styles[1].opacity, 0.1f);
}

TEST(Scene, RoomsAreDrawnWhereAQueryAsksForThem) {
    const auto opacityOfRoom = [](const ScenePass& pass) {
        Scene scene;
        scene.passes = {pass};
        return frame(scene).passes[0].styles[1].opacity;
    };
    EXPECT_EQ(opacityOfRoom({}), 0);
    ScenePass pass;
    pass.show = {"id=wall", "class=BuildingRoom"};
    EXPECT_EQ(opacityOfRoom(pass), 0.1f);
    pass = {};
    pass.styles = {{"class=BuildingRoom", Vec3f{1, 0, 0}, {}, {}, false}};
    EXPECT_EQ(opacityOfRoom(pass), 0.1f);
    pass.styles = {{"id=room", {}, 0.4f, {}, false}};
    EXPECT_EQ(opacityOfRoom(pass), 0.4f);
    // A style of all labels, or a hatch, does not ask for rooms.
    pass.styles = {{"all", {}, 0.4f, {}, false}};
    EXPECT_EQ(opacityOfRoom(pass), 0);
    pass.styles = {{"id=room", {}, {}, render::Hatch::Earth, false}};
    EXPECT_EQ(opacityOfRoom(pass), 0);
    Scene named;
    named.names = {"class=BuildingRoom"};
    EXPECT_EQ(frame(named).passes[0].styles[1].opacity, 0.1f);
}

TEST(Scene, GhostsLoseMostOfTheirColour) {
    Scene scene;
    ScenePass& pass = scene.passes[0];
    pass.styles = {{"id=wall", Vec3f{1, 0, 0}, {}, {}, false}, {"id=wall", {}, {}, {}, true}};
    const Vec3f color = frame(scene).passes[0].styles[2].color;
    EXPECT_NEAR(color.x - color.y, 0.3f, 1e-6f);
    EXPECT_EQ(color.y, color.z);
}

// Share of a picture's width and height that is not background.
std::pair<double, double> filledShares(const Scene& scene) {
    const volume::SemanticVolume volume = house();
    ScenePainter painter(volume, 1);
    const auto painting = painter.paint(scene);
    EXPECT_TRUE(painting) << (painting ? "" : painting.error().toString());
    if (!painting) return {};
    const auto& seen = painting->frame.label;
    std::int32_t left = seen.width(), right = 0, top = seen.height(), bottom = 0;
    for (std::int32_t y = 0; y < seen.height(); ++y)
        for (std::int32_t x = 0; x < seen.width(); ++x)
            if (seen.at(x, y) != 0) {
                left = std::min(left, x);
                right = std::max(right, x + 1);
                top = std::min(top, y);
                bottom = std::max(bottom, y + 1);
            }
    return {double(right - left) / seen.width(), double(bottom - top) / seen.height()};
}

// The picture is filled up to the margin of 4 % on each side along one axis at least.
void expectFitted(const Scene& scene, const char* what) {
    const auto [width, height] = filledShares(scene);
    EXPECT_NEAR(std::max(width, height), 0.92, 0.02) << what;
}

TEST(Scene, TheCameraIsFittedToWhatIsVisible) {
    for (const bool isParallel : {false, true}) {
        Scene scene;
        scene.width = 300;
        scene.height = 200;
        scene.samples = 1;
        scene.camera.isParallel = isParallel;
        for (const char* preset : {"iso", "front", "top", "iso-nw"}) {
            scene.camera.preset = preset;
            scene.passes[0] = {};
            expectFitted(scene, "all");
            scene.passes[0].show = {"id=beam"};
            expectFitted(scene, "one object");
            scene.passes[0] = {};
            scene.passes[0].cut = "z>1";
            expectFitted(scene, "a section");
            scene.passes[0].cut = "not box(6,6,6,8,9,7)";
            expectFitted(scene, "a corner");
            scene.passes[0].cut = "not box(6,6,5.1,6.2,6.3,5.2)";
            expectFitted(scene, "a part of a voxel");
            scene.passes[0].cut = "1,0,-1,-5 or -1,0,-1,5 or z>6";
            expectFitted(scene, "a wedge that stands on its edge");
            scene.passes[0].cut = "z>9";
            scene.passes[0].keep = "view(0.5,0.5,0.1)";
            const auto [width, height] = filledShares(scene);
            EXPECT_NEAR(height, 0.2, 0.06) << "a region of the picture follows the camera";
        }
    }
}

TEST(Scene, TheCameraStaysWhereItIsPutOrFittedToAll) {
    Scene scene, hidden;
    scene.camera.fit = hidden.camera.fit = Fit::All;
    hidden.passes[0].show = {"id=beam"};
    EXPECT_EQ(frame(hidden).camera, frame(scene).camera);
    scene.camera.fit = hidden.camera.fit = Fit::Visible;
    EXPECT_NE(frame(hidden).camera, frame(scene).camera);
    scene.camera.eye = hidden.camera.eye = Vec3d{-20, -30, 40};
    EXPECT_EQ(frame(hidden).camera, frame(scene).camera);
    // What shows nothing has the camera of all.
    Scene nothing;
    nothing.passes[0].hide = {"all"};
    scene = {};
    scene.camera.fit = Fit::All;
    EXPECT_EQ(frame(nothing).camera, frame(scene).camera);
}

Scene everything() {
    Scene scene;
    scene.width = 640;
    scene.height = 480;
    scene.samples = 9;
    scene.look = Look::Blueprint;
    scene.camera = {"front", "id=beam", Fit::All, true, 40, 1.5, Vec3d{1, -2.5, 3}, Vec3d{0.1, 0, 0}};
    scene.background = Vec3f{1, 0, 0.2f};
    scene.colorBy = "volume";
    scene.title = "Plan";
    scene.hasScaleBar = scene.hasNorthArrow = true;
    scene.isTransparent = true;
    scene.lines.strength = 0.4f;
    scene.lines.width = 1.5f;
    scene.lines.cutWidth = 3;
    scene.lines.color = Vec3f{0, 0.2f, 0};
    scene.hatches.show = true;
    scene.hatches.spacing = 0.05;
    scene.ambientOcclusion = 0.3f;
    scene.names = {"class=WallSurface"};
    ScenePass pass;
    pass.show = {"class=WallSurface"};
    pass.hide = {"id=\"a \\\"b\\\"\""};
    pass.styles = {{"all", {}, {}, {}, true}, {"id=x", Vec3f{0, 0, 1}, 0.1f, render::Hatch::Timber, false}};
    pass.cut = "z>1.2";
    pass.keep = "storey(EG)";
    pass.join = render::Pass::Join::Replace;
    pass.lines = {{"", 1, {}, render::HiddenLines::Faint}, {"id=x", 1.5f, Vec3f{1, 1, 1}, render::HiddenLines::Dashed}};
    pass.meshes = {"size<0.5"};
    pass.representation = {ShellLevel::Storey, 2};
    scene.passes = {ScenePass{}, pass};
    return scene;
}

TEST(Scene, GoesThroughJsonUnchanged) {
    const Scene scene = everything();
    const std::string json = writeScene(scene);
    const auto read = parseScene(json);
    ASSERT_TRUE(read) << read.error().toString();
    EXPECT_EQ(*read, scene);
    EXPECT_EQ(writeScene(*read), json);
    EXPECT_EQ(*parseScene(writeScene({})), Scene{});
    EXPECT_EQ(*parseScene("{}"), Scene{});
}

TEST(Scene, JsonErrorsNameTheMember) {
    const auto errorOf = [](const char* json) {
        const auto scene = parseScene(json, "s.json");
        return scene ? std::string() : scene.error().toString();
    };
    EXPECT_NE(errorOf("{").find("E105 BadJson"), std::string::npos);
    EXPECT_NE(errorOf("[]").find("E504 BadScene: s.json: /: expected an object"), std::string::npos);
    EXPECT_NE(errorOf(R"({"pases": []})").find("unknown member 'pases'; possible are"), std::string::npos);
    EXPECT_NE(errorOf(R"({"version": 2})").find("/version: expected 1, found 2"), std::string::npos);
    EXPECT_NE(errorOf(R"({"size": [0, 9]})").find("/size/0: expected a number from 1 to 16384"), std::string::npos);
    EXPECT_NE(errorOf(R"({"size": [1.5, 9]})").find("whole number"), std::string::npos);
    EXPECT_NE(errorOf(R"({"look": "nice"})").find("/look: 'nice' is not possible; possible are plain"),
              std::string::npos);
    EXPECT_NE(errorOf(R"({"camera": {"eye": [1, 2]}})").find("/camera/eye"), std::string::npos);
    EXPECT_NE(errorOf(R"({"passes": []})").find("/passes: expected an array of 1 to 64"), std::string::npos);
    EXPECT_NE(errorOf(R"({"passes": [{"cut": 4}]})").find("/passes/0/cut: expected a text, found 4"),
              std::string::npos);
    EXPECT_NE(errorOf(R"({"passes": [{"styles": [{"color": "red"}]}]})").find("/passes/0/styles/0: needs \"select\""),
              std::string::npos);
    EXPECT_NE(
        errorOf(R"({"passes": [{"styles": [{"select": "all", "hatch": "bricks"}]}]})").find("/hatch: 'bricks' is not"),
        std::string::npos);
    EXPECT_NE(errorOf(R"({"passes": [{"shell": "roof"}]})").find("/shell: 'roof' is not possible"), std::string::npos);
    EXPECT_NE(errorOf(R"({"passes": [{"level": 7}]})").find("/passes/0/level: expected a number from 0 to 6"),
              std::string::npos);
    EXPECT_NE(errorOf(R"({"passes": [{"join": "under"}]})").find("/passes/0/join"), std::string::npos);
}

TEST(Scene, WhatCannotBeShownSaysWhy) {
    const auto codeOf = [](auto&& change) {
        Scene scene;
        change(scene);
        const auto spec = makeFrameSpec(scene, house());
        return spec ? Code::Internal : spec.error().code();
    };
    EXPECT_EQ(codeOf([](Scene& s) { s.width = 0; }), Code::BadFrame);
    EXPECT_EQ(codeOf([](Scene& s) { s.height = 100000; }), Code::BadFrame);
    EXPECT_EQ(codeOf([](Scene& s) { s.samples = 3; }), Code::BadFrame);
    EXPECT_EQ(codeOf([](Scene& s) { s.camera.preset = "up"; }), Code::BadCamera);
    EXPECT_EQ(codeOf([](Scene& s) { s.camera.zoom = 0; }), Code::BadCamera);
    EXPECT_EQ(codeOf([](Scene& s) { s.camera.around = "id=x"; }), Code::NothingSelected);
    EXPECT_EQ(codeOf([](Scene& s) { s.passes[0].cut = "z>99"; }), Code::BadSection);
    EXPECT_EQ(codeOf([](Scene& s) { s.passes[0].hide = {"clas=Door"}; }), Code::NothingSelected);
    EXPECT_EQ(codeOf([](Scene& s) { s.passes[0].hide = {"(("}; }), Code::BadQuery);
    EXPECT_EQ(codeOf([](Scene& s) { addHighlight(s, {"id=y"}, Context::Ghost); }), Code::NothingSelected);
    EXPECT_EQ(codeOf([](Scene& s) { addCutaway(s, "id=y", 0); }), Code::NothingSelected);
}

// The JSON that has `value` as the member `pointer`, in a scene that is as by default otherwise.
std::string jsonWith(std::string_view pointer, std::string value) {
    while (!pointer.empty()) {
        const std::size_t slash = pointer.rfind('/');
        const std::string_view name = pointer.substr(slash + 1);
        if (name == "*")
            value = "[" + value + "]";
        else if (pointer.find("/styles/") != std::string_view::npos && name != "select")
            value = R"({"select": "all", ")" + std::string(name) + "\": " + value + "}";
        else if (pointer.starts_with("/sun/") && name != "time")
            value = R"({"time": "2026-06-21 15:00", ")" + std::string(name) + "\": " + value + "}";
        else if (pointer.starts_with("/field/") && name != "name")
            value = R"({"name": "t", ")" + std::string(name) + "\": " + value + "}";
        else if (name == "at")
            value = R"({"scene": {}, "at": )" + value + "}";
        else if (name == "keys")
            value = R"({"seconds": 3600, "keys": )" + value + "}";
        else
            value = "{\"" + std::string(name) + "\": " + value + "}";
        pointer = pointer.substr(0, slash);
    }
    return value;
}

std::string jsonText(const Option& member, std::string_view text) {
    const bool isText = member.kind == OptionKind::Text;
    return isText ? "\"" + std::string(text) + "\"" : std::string(text);
}

TEST(SceneMembers, DefaultsAreThoseOfTheStructures) {
    for (const Option& member : sceneMembers()) {
        if (member.byDefault.empty()) continue;
        std::string value = jsonText(member, member.byDefault);
        if (member.count > 1) value = "[" + value + "]";
        const std::string json = jsonWith(member.name, value);
        const auto scene = parseScene(json);
        ASSERT_TRUE(scene) << json << scene.error().message();
        Scene plain;
        if (member.name.find("/lines/*") != std::string_view::npos) plain.passes[0].lines.emplace_back();
        if (member.name.find("/styles/*") != std::string_view::npos)
            plain.passes[0].styles.emplace_back().select = "all";
        if (member.name.starts_with("/motion/")) plain.motion.emplace();
        if (member.name.starts_with("/sun/")) plain.sun.emplace().time = "2026-06-21 15:00";
        if (member.name.starts_with("/field/")) plain.field.emplace().name = "t";
        if (member.name.starts_with("/insets/")) plain.insets.emplace_back();
        if (member.name == "/ambientOcclusion") plain.ambientOcclusion = 0.6f;
        EXPECT_EQ(*scene, plain) << json;
    }
    EXPECT_EQ(double(render::Light().ambientOcclusion), double(0.6f)) << "the default that the table states";
}

TEST(SceneMembers, EveryChoiceIsRead) {
    for (const Option& member : sceneMembers())
        for (const std::string_view choice : splitChoices(member.choices)) {
            const std::string json = jsonWith(member.name, jsonText(member, choice));
            EXPECT_TRUE(parseScene(json)) << json;
        }
}

TEST(SceneMembers, ChoicesAreAllThatThereAre) {
    const auto expectSame = [](std::string_view member, std::vector<std::string> names) {
        std::vector<std::string> choices;
        for (const std::string_view choice : splitChoices(sceneMember(member).choices)) choices.emplace_back(choice);
        std::ranges::sort(choices);
        std::ranges::sort(names);
        EXPECT_EQ(choices, names) << member;
    };
    const auto texts = [](const auto& names) { return std::vector<std::string>(names.begin(), names.end()); };
    expectSame("/camera/preset", texts(render::cameraPresetNames()));
}

TEST(SceneMembers, LimitsAreHeldToTheirEnds) {
    for (const Option& member : sceneMembers()) {
        const bool isNumber = member.kind == OptionKind::Number || member.kind == OptionKind::Whole;
        if (!isNumber || member.count > 1 || !member.choices.empty()) continue;
        const auto read = [&](double value) {
            return parseScene(jsonWith(member.name, std::to_string(value))).hasValue();
        };
        EXPECT_TRUE(read(member.least) && read(member.most)) << member.name;
        EXPECT_FALSE(read(member.least - 1) || read(member.most + 1)) << member.name;
    }
}

}  // namespace
}  // namespace svt::illustrate

#include <svt/illustrate/scene.hpp>

#include <svt/core/text.hpp>
#include <svt/illustrate/motion.hpp>
#include <svt/illustrate/scene_members.hpp>
#include <svt/image/color_text.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace svt::illustrate {
namespace {

using Json = nlohmann::ordered_json;
using Join = render::Pass::Join;

constexpr int kVersion = 1;
constexpr std::size_t kMaxPasses = render::FrameSpec::kMaxPasses;
// The values of members that have choices, by name.
constexpr std::pair<render::HiddenLines, std::string_view> kHidden[] = {{render::HiddenLines::None, "none"},
                                                                        {render::HiddenLines::Faint, "faint"},
                                                                        {render::HiddenLines::Dashed, "dashed"}};
constexpr std::pair<Motion::Pace, std::string_view> kPaces[] = {{Motion::Pace::Smooth, "smooth"},
                                                                {Motion::Pace::Even, "even"}};
constexpr std::pair<Inset::Corner, std::string_view> kCorners[] = {{Inset::Corner::TopRight, "top-right"},
                                                                   {Inset::Corner::BottomRight, "bottom-right"},
                                                                   {Inset::Corner::TopLeft, "top-left"},
                                                                   {Inset::Corner::BottomLeft, "bottom-left"}};
constexpr std::pair<Join, std::string_view> kJoins[] = {
    {Join::Over, "over"}, {Join::Replace, "replace"}, {Join::Depth, "depth"}};

// Reads members one by one. The first error is kept, and nothing is read after it.
class Reader {
public:
    explicit Reader(std::string name) : name_(std::move(name)) {}

    [[nodiscard]] bool isFine() const noexcept { return error_.empty(); }
    [[nodiscard]] Error error() const { return Error(Code::BadScene, fmt::format("{}: {}", name_, error_)); }

    void fail(const std::string& path, const std::string& what) {
        if (error_.empty()) error_ = fmt::format("{}: {}", path.empty() ? "/" : path, what);
    }

    // Unknown members are errors, so that typing errors do not go unnoticed.
    bool object(const Json& value, const std::string& path) {
        if (!value.is_object()) {
            fail(path, fmt::format("expected an object, found {}", value.type_name()));
            return false;
        }
        const std::vector<std::string_view> known = sceneMembersOf(path);
        for (const auto& [key, member] : value.items())
            if (std::ranges::find(known, key) == known.end())
                fail(path, fmt::format("unknown member '{}'; possible are {}", key, fmt::join(known, ", ")));
        return isFine();
    }
    template <class T>
    void number(const Json& value, const std::string& path, T& to) {
        number(value, path, sceneMember(path), to);
    }
    template <class T>
    void number(const Json& value, const std::string& path, const Option& member, T& to) {
        const double least = member.least, most = member.most;
        if (!value.is_number() || !(value.get<double>() >= least && value.get<double>() <= most))
            return fail(path, fmt::format("expected a number from {} to {}, found {}", least, most, shorten(value)));
        if constexpr (std::is_integral_v<T>) {
            if (value.get<double>() != std::floor(value.get<double>()))
                return fail(path, fmt::format("expected a whole number, found {}", shorten(value)));
        }
        to = static_cast<T>(value.get<double>());
    }
    void text(const Json& value, const std::string& path, std::string& to) {
        if (!value.is_string()) return fail(path, fmt::format("expected a text, found {}", shorten(value)));
        to = value.get<std::string>();
    }
    void flag(const Json& value, const std::string& path, bool& to) {
        if (!value.is_boolean()) return fail(path, fmt::format("expected true or false, found {}", shorten(value)));
        to = value.get<bool>();
    }
    void color(const Json& value, const std::string& path, std::optional<Vec3f>& to) {
        std::string name;
        text(value, path, name);
        if (!isFine()) return;
        const auto parsed = image::parseColor(name);
        if (!parsed) return fail(path, parsed.error().message());
        to = *parsed;
    }
    void point(const Json& value, const std::string& path, std::optional<Vec3d>& to) {
        Vec3d p;
        if (!value.is_array() || value.size() != 3) return fail(path, "expected [x, y, z] in metres");
        for (int axis = 0; axis < 3; ++axis)
            number(value[static_cast<std::size_t>(axis)], fmt::format("{}/{}", path, axis), sceneMember(path), p[axis]);
        to = p;
    }
    void texts(const Json& value, const std::string& path, std::vector<std::string>& to) {
        if (!value.is_array()) return fail(path, fmt::format("expected an array of texts, found {}", shorten(value)));
        for (std::size_t n = 0; n < value.size(); ++n) text(value[n], fmt::format("{}/{}", path, n), to.emplace_back());
    }

    // One of the member's choices; `what` names its kind in the message.
    bool choice(const Json& value, const std::string& path, std::string_view what, std::string& to) {
        text(value, path, to);
        if (!isFine()) return false;
        const auto choices = splitChoices(sceneMember(path).choices);
        if (std::ranges::find(choices, to) != choices.end()) return true;
        fail(path, fmt::format("unknown {} '{}'; possible are {}", what, to, fmt::join(choices, ", ")));
        return false;
    }
    template <class T, std::size_t N>
    void choice(const Json& value, const std::string& path, std::string_view what,
                const std::pair<T, std::string_view> (&names)[N], T& to) {
        std::string name;
        if (!choice(value, path, what, name)) return;
        to = std::ranges::find(names, std::string_view(name), [](const auto& known) { return known.second; })->first;
    }

    static std::string shorten(const Json& value) {
        return value.dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 40);
    }

private:
    std::string name_, error_;
};

void readCamera(Reader& read, const Json& json, SceneCamera& camera) {
    const std::string path = "/camera";
    if (!read.object(json, path)) return;
    for (const auto& [key, value] : json.items()) {
        const std::string at = path + "/" + key;
        if (key == "preset") read.text(value, at, camera.preset);
        if (key == "around") read.text(value, at, camera.around);
        if (std::string name; key == "fit" && read.choice(value, at, "fit", name))
            camera.fit = name == "all" ? Fit::All : Fit::Visible;
        if (key == "parallel") read.flag(value, at, camera.isParallel);
        if (key == "fieldOfView") read.number(value, at, camera.fieldOfView);
        if (key == "zoom") read.number(value, at, camera.zoom);
        if (key == "eye") read.point(value, at, camera.eye);
        if (key == "target") read.point(value, at, camera.target);
    }
}

void readStyle(Reader& read, const Json& json, const std::string& path, SceneStyle& style) {
    if (!read.object(json, path)) return;
    if (!json.contains("select")) return read.fail(path, "needs \"select\", a query");
    for (const auto& [key, value] : json.items()) {
        const std::string at = path + "/" + key;
        if (key == "select") read.text(value, at, style.select);
        if (key == "color") read.color(value, at, style.color);
        if (key == "opacity") read.number(value, at, style.opacity.emplace());
        if (key == "ghost") read.flag(value, at, style.isGhost);
        if (std::string name; key == "hatch" && read.choice(value, at, "hatch", name))
            style.hatch = render::hatchFromName(name);
    }
}

void readSceneLines(Reader& read, const Json& json, const std::string& path, SceneLines& lines) {
    if (!read.object(json, path)) return;
    for (const auto& [key, value] : json.items()) {
        const std::string at = path + "/" + key;
        if (key == "select") read.text(value, at, lines.select);
        if (key == "width") read.number(value, at, lines.width);
        if (key == "color") read.color(value, at, lines.color);
        if (key == "hidden") read.choice(value, at, "way to draw hidden lines", kHidden, lines.hidden);
    }
}

void readPass(Reader& read, const Json& json, const std::string& path, ScenePass& pass) {
    if (!read.object(json, path)) return;
    for (const auto& [key, value] : json.items()) {
        const std::string at = path + "/" + key;
        if (key == "show") read.texts(value, at, pass.show);
        if (key == "hide") read.texts(value, at, pass.hide);
        if (key == "cut") read.text(value, at, pass.cut);
        if (key == "keep") read.text(value, at, pass.keep);
        if (key == "meshes") read.texts(value, at, pass.meshes);
        if (key == "cells") read.flag(value, at, pass.form.hasCells);
        if (key == "level") read.number(value, at, pass.form.level.emplace());
        if (std::string level; key == "shell" && read.choice(value, at, "level of hulls", level))
            pass.form.shell = shellLevelFromName(level);
        if (key == "lines") {
            if (!value.is_array()) return read.fail(at, "expected an array of lines");
            for (std::size_t n = 0; n < value.size() && read.isFine(); ++n)
                readSceneLines(read, value[n], fmt::format("{}/{}", at, n), pass.lines.emplace_back());
        }
        if (key == "join") read.choice(value, at, "way to join", kJoins, pass.join);
        if (key == "styles") {
            if (!value.is_array()) return read.fail(at, "expected an array of styles");
            for (std::size_t n = 0; n < value.size() && read.isFine(); ++n)
                readStyle(read, value[n], fmt::format("{}/{}", at, n), pass.styles.emplace_back());
        }
    }
}

void readLines(Reader& read, const Json& json, Scene& scene) {
    if (!read.object(json, "/lines")) return;
    for (const auto& [key, value] : json.items()) {
        const std::string at = "/lines/" + key;
        if (key == "strength") read.number(value, at, scene.lineStrength.emplace());
        if (key == "width") read.number(value, at, scene.lineWidth.emplace());
        if (key == "cutWidth") read.number(value, at, scene.cutWidth.emplace());
        if (key == "color") read.color(value, at, scene.lineColor);
    }
}

void readHatches(Reader& read, const Json& json, Scene& scene) {
    if (!read.object(json, "/hatches")) return;
    for (const auto& [key, value] : json.items()) {
        const std::string at = "/hatches/" + key;
        if (key == "show") read.flag(value, at, scene.hasHatches.emplace());
        if (key == "spacing") read.number(value, at, scene.hatchSpacing.emplace());
    }
}

void readKey(Reader& read, const Json& json, const std::string& path, Motion& motion) {
    if (!read.object(json, path)) return;
    if (!json.contains("at") || !json.contains("scene"))
        return read.fail(path, "needs \"at\", seconds, and \"scene\", the members that have other values then");
    Motion::Key key;
    read.number(json["at"], path + "/at", key.at);
    if (!json["scene"].is_object() || json["scene"].contains("motion"))
        return read.fail(path + "/scene", "expected an object with members of a scene, but no motion");
    if (json["scene"].contains("size"))
        return read.fail(path + "/scene/size", "all pictures of a motion have the size of the scene; leave it out");
    key.scene = json["scene"].dump();
    if (!motion.keys.empty() && key.at <= motion.keys.back().at)
        return read.fail(path + "/at", "expected a later time than that of the key before");
    motion.keys.push_back(std::move(key));
}

void readMotion(Reader& read, const Json& json, Motion& motion) {
    if (!read.object(json, "/motion")) return;
    for (const auto& [key, value] : json.items()) {
        const std::string at = "/motion/" + key;
        if (key == "seconds") read.number(value, at, motion.seconds);
        if (key == "rate") read.number(value, at, motion.rate);
        if (key == "turn") read.number(value, at, motion.turn);
        if (key == "pace") read.choice(value, at, "pace", kPaces, motion.pace);
        if (key == "keys") {
            if (!value.is_array()) return read.fail(at, "expected an array of keys");
            for (std::size_t n = 0; n < value.size() && read.isFine(); ++n)
                readKey(read, value[n], fmt::format("{}/{}", at, n), motion);
        }
    }
    if (read.isFine() && !motion.keys.empty() && motion.keys.back().at > motion.seconds)
        read.fail("/motion/keys", fmt::format("the last key is at {} s, after the end of the motion at {} s; change "
                                              "\"seconds\"",
                                              motion.keys.back().at, motion.seconds));
}

void readSun(Reader& read, const Json& json, Sun& sun) {
    if (!read.object(json, "/sun")) return;
    if (!json.contains("time")) return read.fail("/sun", "needs \"time\", such as \"2026-06-21 15:00\"");
    for (const auto& [key, value] : json.items()) {
        const std::string at = "/sun/" + key;
        if (key == "time") read.text(value, at, sun.time);
        if (key == "size") read.number(value, at, sun.size);
        if (key != "place") continue;
        if (!value.is_array() || value.size() != 2) return read.fail(at, "expected [latitude, longitude] in degrees");
        auto& place = sun.place.emplace();
        for (std::size_t n = 0; n < 2; ++n)
            read.number(value[n], fmt::format("{}/{}", at, n), sceneMember(at), place[n]);
    }
}

void readInset(Reader& read, const Json& json, const std::string& path, Inset& inset) {
    if (!read.object(json, path)) return;
    for (const auto& [key, value] : json.items()) {
        const std::string at = path + "/" + key;
        if (key == "corner") read.choice(value, at, "corner", kCorners, inset.corner);
        if (key == "size") read.number(value, at, inset.size);
        if (key == "title") read.text(value, at, inset.title);
        if (key == "mark") read.flag(value, at, inset.hasMark);
        if (key != "scene") continue;
        if (!value.is_object()) return read.fail(at, "expected an object with members of a scene");
        for (const char* member : {"size", "motion", "insets"})
            if (value.contains(member))
                return read.fail(at + "/" + member, "an inset has none of its own; leave it out");
        inset.scene = value.dump();
    }
}

void readInsets(Reader& read, const Json& json, Scene& scene) {
    const std::size_t most = std::size(kCorners);
    if (!json.is_array() || json.size() > most)
        return read.fail("/insets", fmt::format("expected an array of at most {} insets", most));
    for (std::size_t n = 0; n < json.size() && read.isFine(); ++n)
        readInset(read, json[n], fmt::format("/insets/{}", n), scene.insets.emplace_back());
}

void readScene(Reader& read, const Json& json, Scene& scene) {
    if (!read.object(json, "")) return;
    for (const auto& [key, value] : json.items()) {
        const std::string at = "/" + key;
        if (key == "format" && value != "svt-scene") read.fail(at, "expected \"svt-scene\"");
        if (key == "version" && value != kVersion)
            read.fail(at, fmt::format("expected {}, found {}; a newer program may have written it", kVersion,
                                      Reader::shorten(value)));
        if (key == "size") {
            if (!value.is_array() || value.size() != 2) return read.fail(at, "expected [width, height] in pixels");
            read.number(value[0], at + "/0", sceneMember(at), scene.width);
            read.number(value[1], at + "/1", sceneMember(at), scene.height);
        }
        if (key == "samples") read.number(value, at, scene.samples);
        if (std::string name; key == "look" && read.choice(value, at, "look", name)) scene.look = *lookFromName(name);
        if (key == "title") read.text(value, at, scene.title);
        if (key == "scaleBar") read.flag(value, at, scene.hasScaleBar);
        if (key == "northArrow") read.flag(value, at, scene.hasNorthArrow);
        if (key == "colorBy") read.text(value, at, scene.colorBy);
        if (key == "legend") read.flag(value, at, scene.hasLegend);
        if (key == "explode") read.number(value, at, scene.explode);
        if (key == "sun") readSun(read, value, scene.sun.emplace());
        if (key == "insets") readInsets(read, value, scene);
        if (key == "camera") readCamera(read, value, scene.camera);
        if (key == "background") read.color(value, at, scene.background);
        if (key == "transparent") read.flag(value, at, scene.isTransparent);
        if (key == "lines") readLines(read, value, scene);
        if (key == "hatches") readHatches(read, value, scene);
        if (key == "ambientOcclusion") read.number(value, at, scene.ambientOcclusion.emplace());
        if (key == "names") read.texts(value, at, scene.names);
        if (key == "motion") readMotion(read, value, scene.motion.emplace());
        if (key == "passes") {
            if (!value.is_array() || value.empty() || value.size() > kMaxPasses)
                return read.fail(at, fmt::format("expected an array of 1 to {} passes", kMaxPasses));
            scene.passes.clear();
            for (std::size_t n = 0; n < value.size() && read.isFine(); ++n)
                readPass(read, value[n], fmt::format("{}/{}", at, n), scene.passes.emplace_back());
        }
        if (!read.isFine()) return;
    }
}

Json jsonOf(const SceneCamera& camera) {
    const SceneCamera plain;
    Json json = Json::object();
    if (camera.preset != plain.preset) json["preset"] = camera.preset;
    if (!camera.around.empty()) json["around"] = camera.around;
    if (camera.fit == Fit::All) json["fit"] = "all";
    if (camera.isParallel) json["parallel"] = true;
    if (camera.fieldOfView != plain.fieldOfView) json["fieldOfView"] = camera.fieldOfView;
    if (camera.zoom != plain.zoom) json["zoom"] = camera.zoom;
    if (camera.eye) json["eye"] = {camera.eye->x, camera.eye->y, camera.eye->z};
    if (camera.target) json["target"] = {camera.target->x, camera.target->y, camera.target->z};
    return json;
}

Json jsonOf(const Motion& motion) {
    const Motion plain;
    Json json = Json::object();
    if (motion.seconds != plain.seconds) json["seconds"] = motion.seconds;
    if (motion.rate != plain.rate) json["rate"] = motion.rate;
    if (motion.turn != plain.turn) json["turn"] = motion.turn;
    if (motion.pace == Motion::Pace::Even) json["pace"] = "even";
    for (const Motion::Key& key : motion.keys)
        json["keys"].push_back(Json{{"at", key.at}, {"scene", Json::parse(key.scene, nullptr, false)}});
    return json;
}

Json jsonOf(const Sun& sun) {
    Json json{{"time", sun.time}};
    if (sun.place) json["place"] = {(*sun.place)[0], (*sun.place)[1]};
    if (sun.size != Sun().size) json["size"] = sun.size;
    return json;
}

Json jsonOf(const Inset& inset) {
    const Inset plain;
    Json json = Json::object();
    for (const auto& [corner, name] : kCorners)
        if (corner == inset.corner && corner != plain.corner) json["corner"] = name;
    if (inset.size != plain.size) json["size"] = inset.size;
    if (!inset.title.empty()) json["title"] = inset.title;
    if (!inset.hasMark) json["mark"] = false;
    json["scene"] = Json::parse(inset.scene, nullptr, false);
    return json;
}

// The shortest decimal number that reads back as the same float.
double shortest(float value) { return parseNumber(fmt::format("{}", value)).value_or(value); }

Json jsonOf(const SceneStyle& style) {
    Json json{{"select", style.select}};
    if (style.isGhost) json["ghost"] = true;
    if (style.color) json["color"] = image::colorText(*style.color);
    if (style.opacity) json["opacity"] = shortest(*style.opacity);
    if (style.hatch) json["hatch"] = render::hatchName(*style.hatch);
    return json;
}

Json jsonOf(const SceneLines& lines) {
    Json json = Json::object();
    if (!lines.select.empty()) json["select"] = lines.select;
    if (lines.width != 1) json["width"] = shortest(lines.width);
    if (lines.color) json["color"] = image::colorText(*lines.color);
    for (const auto& [hidden, name] : kHidden)
        if (hidden == lines.hidden && hidden != render::HiddenLines::Faint) json["hidden"] = name;
    return json;
}

Json jsonOf(const ScenePass& pass) {
    Json json = Json::object();
    if (!pass.show.empty()) json["show"] = pass.show;
    if (!pass.hide.empty()) json["hide"] = pass.hide;
    for (const SceneStyle& style : pass.styles) json["styles"].push_back(jsonOf(style));
    if (!pass.cut.empty()) json["cut"] = pass.cut;
    if (!pass.keep.empty()) json["keep"] = pass.keep;
    for (const auto& [join, name] : kJoins)
        if (join == pass.join && join != Join::Over) json["join"] = name;
    if (pass.form.shell) json["shell"] = shellLevelName(*pass.form.shell);
    if (pass.form.level) json["level"] = *pass.form.level;
    for (const SceneLines& lines : pass.lines) json["lines"].push_back(jsonOf(lines));
    if (!pass.meshes.empty()) json["meshes"] = pass.meshes;
    if (pass.form.hasCells) json["cells"] = true;
    return json;
}

}  // namespace

Result<Scene> parseScene(std::string_view json, const std::string& name) {
    const Json parsed = Json::parse(json, nullptr, false);
    if (parsed.is_discarded()) return Error(Code::BadJson, fmt::format("{}: not well-formed JSON", name));
    Reader read(name);
    Scene scene;
    readScene(read, parsed, scene);
    if (!read.isFine()) return read.error();
    if (auto checked = checkMotion(scene, name); !checked) return checked.error();
    for (const Inset& inset : scene.insets)
        if (const auto made = insetScene(scene, inset); !made) return made.error();
    return scene;
}

std::string cameraJson(const SceneCamera& camera) { return Json{{"camera", jsonOf(camera)}}.dump(); }

Result<Scene> insetScene(const Scene& scene, const Inset& inset) {
    Scene base = scene;
    base.camera = {};
    base.insets.clear();
    base.motion.reset();
    base.names.clear();
    base.title.clear();
    base.hasScaleBar = base.hasNorthArrow = base.hasLegend = false;
    Json json = Json::parse(writeScene(base), nullptr, false);
    json.merge_patch(Json::parse(inset.scene, nullptr, false));
    auto made = parseScene(json.dump(), "scene of an inset");
    if (!made) return made;
    const auto share = [&](std::int32_t pixels) {
        return std::max(16, static_cast<std::int32_t>(std::lround(inset.size * pixels)));
    };
    made->width = share(scene.width);
    made->height = share(scene.height);
    if (!inset.title.empty()) made->title = inset.title;
    return made;
}

std::string writeScene(const Scene& scene) {
    const Scene plain;
    Json json{{"format", "svt-scene"}, {"version", kVersion}};
    json["size"] = {scene.width, scene.height};
    if (scene.samples != plain.samples) json["samples"] = scene.samples;
    if (scene.look != plain.look) json["look"] = lookName(scene.look);
    if (!scene.title.empty()) json["title"] = scene.title;
    if (scene.hasScaleBar) json["scaleBar"] = true;
    if (scene.hasNorthArrow) json["northArrow"] = true;
    if (!scene.colorBy.empty()) json["colorBy"] = scene.colorBy;
    if (!scene.hasLegend) json["legend"] = false;
    if (scene.explode != 0) json["explode"] = scene.explode;
    if (scene.sun) json["sun"] = jsonOf(*scene.sun);
    for (const Inset& inset : scene.insets) json["insets"].push_back(jsonOf(inset));
    if (scene.camera != plain.camera) json["camera"] = jsonOf(scene.camera);
    if (scene.background) json["background"] = image::colorText(*scene.background);
    if (scene.isTransparent) json["transparent"] = true;
    if (scene.lineStrength) json["lines"]["strength"] = shortest(*scene.lineStrength);
    if (scene.lineWidth) json["lines"]["width"] = shortest(*scene.lineWidth);
    if (scene.cutWidth) json["lines"]["cutWidth"] = shortest(*scene.cutWidth);
    if (scene.lineColor) json["lines"]["color"] = image::colorText(*scene.lineColor);
    if (scene.hasHatches) json["hatches"]["show"] = *scene.hasHatches;
    if (scene.hatchSpacing) json["hatches"]["spacing"] = *scene.hatchSpacing;
    if (scene.ambientOcclusion) json["ambientOcclusion"] = shortest(*scene.ambientOcclusion);
    if (!scene.names.empty()) json["names"] = scene.names;
    json["passes"] = Json::array();
    for (const ScenePass& pass : scene.passes) json["passes"].push_back(jsonOf(pass));
    if (scene.motion) json["motion"] = jsonOf(*scene.motion);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace svt::illustrate

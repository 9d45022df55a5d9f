#include <svt/illustrate/scene.hpp>

#include <svt/illustrate/motion.hpp>
#include <svt/illustrate/scene/scene_record.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace svt::illustrate {

using record::Json;

Result<Scene> parseScene(std::string_view json, const std::string& name) {
    auto scene = record::parseRecord<Scene>(json, name, Code::BadScene);
    if (!scene) return scene;
    SVT_DO(checkMotion(*scene, name));
    for (const Inset& inset : scene->insets)
        if (const auto made = insetScene(*scene, inset); !made) return made.error();
    return scene;
}

std::string cameraJson(const SceneCamera& camera) { return Json{{"camera", record::writeRecord(camera)}}.dump(); }

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

std::string writeScene(const Scene& scene) { return record::recordText(scene); }

}  // namespace svt::illustrate

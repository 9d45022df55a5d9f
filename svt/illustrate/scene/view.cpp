#include <svt/analyze/label_measures.hpp>
#include <svt/analyze/selection.hpp>
#include <svt/illustrate/view.hpp>
#include <svt/render/camera_presets.hpp>

#include <fmt/format.h>

#include <cmath>

namespace svt::illustrate {
namespace {

// The render camera of a scene's camera, for a picture of any size with this aspect.
Result<render::Camera> drawnCamera(const SceneCamera& camera, double aspect, const volume::SemanticVolume& volume,
                                   const analyze::LabelRows& rows) {
    Scene scene;
    scene.camera = camera;
    scene.camera.fit = Fit::All;  // visible parts are unknown here, and must not move the camera
    scene.height = 1000;
    scene.width = static_cast<std::int32_t>(std::lround(scene.height * aspect));
    SVT_TRY(frame, makeFrameSpec(scene, volume, rows));
    return frame->camera;
}

Result<Box3d> boxOf(const std::string& query, const volume::SemanticVolume& volume, const analyze::LabelRows& rows) {
    const Vec3i n = volume.grid.dimension();
    analyze::SampleBox box{{0, 0, 0}, {n.x - 1, n.y - 1, n.z - 1}};
    if (!query.empty()) {
        SVT_TRY(selected, analyze::selectWithParts(rows, query));
        SVT_TRY(around, analyze::boxAround(*selected, volume, fmt::format("the selection of the query '{}'", query)));
        box = *around;
    }
    return analyze::worldBox(box, volume.grid);
}

}  // namespace

Result<SceneCamera> makeView(const std::string& query, const std::string& preset, const SceneCamera& now, double aspect,
                             const volume::SemanticVolume& volume, const volume::Grid* frame) {
    if (!(aspect > 0.01 && aspect < 100))
        return Error(Code::BadCamera, fmt::format("an aspect of {} is out of range; 0.01 to 100 are possible", aspect));
    const analyze::LabelRows rows(volume);
    const Vec3d origin = (frame != nullptr ? *frame : volume.grid).origin();
    SceneCamera view = now;
    view.around = query;
    view.zoom = 1;
    view.eye = view.target = {};
    if (!preset.empty()) view.preset = preset;
    SVT_TRY(named, drawnCamera(view, aspect, volume, rows));
    view.eye = named->eye - origin;
    view.target = named->target - origin;
    if (!preset.empty()) return view;

    SVT_TRY(before, drawnCamera(now, aspect, volume, rows));
    SVT_TRY(box, boxOf(query, volume, rows));
    render::PresetOptions options;
    options.aspect = aspect;
    options.projection = named->projection;
    options.verticalFovDegrees = named->verticalFovDegrees;
    SVT_TRY(camera, render::cameraAlong(before->target - before->eye, before->up, *box, options));
    // A parallel view has its preset's height divided by the zoom, which also moves the eye.
    if (view.isParallel) view.zoom = named->orthographicHeight / camera->orthographicHeight;
    view.target = camera->target - origin;
    view.eye = *view.target + (camera->eye - camera->target) * view.zoom;
    return view;
}

}  // namespace svt::illustrate

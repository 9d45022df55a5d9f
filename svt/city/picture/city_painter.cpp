#include <svt/city/city_painter.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/illustrate/view.hpp>
#include <svt/render/ray_caster.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace svt::city {

Result<void> checkCityScene(const illustrate::Scene& scene) {
    const auto isIn = [&](auto has) { return std::ranges::any_of(scene.passes, has); };
    const std::pair<bool, const char*> needs[] = {
        {scene.explode != 0, "explode"},
        {scene.field.has_value(), "a field (--field)"},
        {!scene.insets.empty(), "insets"},
        {isIn([](const auto& pass) { return !pass.lines.empty(); }), "lines of a pass (--wireframe)"},
        {isIn([](const auto& pass) { return !pass.meshes.empty(); }), "meshes of a pass (--vectors)"}};
    for (const auto& [isGiven, member] : needs)
        if (isGiven)
            return Error(Code::BadArgument,
                         fmt::format("{}: for one volume only; take a part of the city (svt city extract)", member));
    return {};
}

Result<CameraView> viewOf(const illustrate::Scene& scene, const volume::SemanticVolume& frame) {
    // Only the camera and the light matter: queries find nothing in the frame.
    std::vector<std::string> ignored;
    illustrate::Scene plain = scene;
    plain.colorBy.clear();
    SVT_TRY(spec, illustrate::makeFrameSpec(plain, frame, analyze::LabelRows(frame, &ignored)));
    return cameraViewOf(*spec, frame.grid);
}

Result<CityPainter> CityPainter::make(City city, const CityPaintOptions& options) {
    SVT_TRY(frame, frameVolume(city));
    return CityPainter(std::move(city), std::move(*frame), options);
}

// A view of buildings by id becomes a camera, since the frame has no labels that it could be fitted to.
Result<void> CityPainter::lookAround(illustrate::Scene& scene) const {
    if (scene.camera.around.empty()) return {};
    if (!scene.camera.around.starts_with("id="))
        return Error(Code::BadArgument, "around: of a city, a building by its id is known: id=ID");
    Extract extract;
    extract.ids.push_back(scene.camera.around.substr(3));
    SVT_TRY(part, extractVolume(city_, extract));
    illustrate::SceneCamera now = scene.camera;
    now.around.clear();
    SVT_TRY(camera, illustrate::makeView("", now.preset, now, double(scene.width) / scene.height, *part, &frame_.grid));
    scene.camera = *camera;
    return {};
}

namespace {

// Depths of surfaces that hide everything behind them: the depths of a picture, infinity at translucent surfaces.
std::vector<float> hidingDepths(const render::Frame& frame, const render::FrameSpec& spec) {
    std::vector<bool> isTranslucent;
    for (const render::Pass& pass : spec.passes) {
        isTranslucent.resize(std::max(isTranslucent.size(), pass.styles.size()), false);
        for (std::size_t s = 0; s < pass.styles.size(); ++s)
            if (pass.styles[s].opacity > 0 && pass.styles[s].opacity < 1) isTranslucent[s] = true;
    }
    const auto depths = frame.depth.pixels();
    const auto labels = frame.label.pixels();
    std::vector<float> hiding(depths.begin(), depths.end());
    for (std::size_t n = 0; n < hiding.size(); ++n)
        if (labels[n] < isTranslucent.size() && isTranslucent[labels[n]])
            hiding[n] = std::numeric_limits<float>::infinity();
    return hiding;
}

}  // namespace

// Reads the chosen tiles.
Result<JoinedTiles> CityPainter::read() const {
    SVT_TRY(parts, readTiles(city_, chosen_, options_.threads, options_.progress));
    return joinTiles(city_, frame_, chosen_, std::move(*parts));
}

Result<illustrate::Painting> CityPainter::draw(const illustrate::Scene& scene, const render::CastOptions& options) {
    SVT_TRY(tiles, read());
    nothing_.clear();
    illustrate::ScenePainter painter(tiles->frame, options_.threads);
    painter.tolerateNothing(&nothing_);
    painter.reportTo(options_.progress);
    tiles->addTo(painter);
    return painter.paint(scene, options);
}

// Draws the nearest tiles small and plain, and removes the tiles behind them from the choice. In a street, that is most
// of a city.
Result<void> CityPainter::leaveOutHidden(illustrate::Scene scene, const CameraView& view,
                                         const render::CastOptions& options) {
    constexpr double kShare = 0.15;
    constexpr int kSmaller = 2;
    leftOut_.clear();
    if (!view.isPerspective || view.eye.z > city_.box().max.z || chosen_.entries.size() < 4) return {};
    const ChosenTiles all = chosen_;
    chosen_ = nearestOf(city_, view, all, kShare);
    chosen_.near = 0;
    SVT_TRY(tiles, read());
    scene.width = std::max(1, scene.width / kSmaller);
    scene.height = std::max(1, scene.height / kSmaller);
    scene.samples = 1;
    scene.names.clear();
    scene.title.clear();
    scene.colorBy.clear();
    scene.insets.clear();
    std::vector<std::string> ignored;
    illustrate::ScenePainter painter(tiles->frame, options_.threads);
    painter.tolerateNothing(&ignored);
    tiles->addTo(painter);
    const auto painting = painter.paint(scene, [&](auto volumes, const render::FrameSpec& spec) {
        render::FrameSpec plain = spec;
        plain.light.ambientOcclusion = 0;
        plain.light.hasShadows = false;
        plain.borders.strength = 0;
        return render::castRays(volumes, plain, options);
    });
    if (!painting) return painting.error();
    chosen_ = all;
    const std::vector<float> depth = hidingDepths(painting->frame, painting->spec);
    const auto hidden = areHidden(city_, view, {scene.width, scene.height, depth}, chosen_.entries);
    ChosenTiles seen;
    for (std::size_t n = 0; n < hidden.size(); ++n) (hidden[n] ? leftOut_ : seen.entries).push_back(chosen_.entries[n]);
    seen.pixels = all.pixels;
    chosen_ = nearestOf(city_, view, seen, INFINITY);
    return {};
}

// Restores tiles that were left out but could be visible in the picture drawn without them. \return whether there are
// any
bool CityPainter::takeBack(const CameraView& view, const illustrate::Painting& painting) {
    const std::vector<float> depth = hidingDepths(painting.frame, painting.spec);
    const SeenDepths seen{painting.spec.width, painting.spec.height, depth};
    const auto hidden = areHidden(city_, view, seen, leftOut_);
    std::vector<IndexEntry> still;
    for (std::size_t n = 0; n < hidden.size(); ++n) (hidden[n] ? still : chosen_.entries).push_back(leftOut_[n]);
    const bool isAny = still.size() < leftOut_.size();
    leftOut_ = std::move(still);
    if (isAny) chosen_ = nearestOf(city_, view, chosen_, INFINITY);
    return isAny;
}

Result<illustrate::Painting> CityPainter::paint(illustrate::Scene scene, const render::CastOptions& options) {
    SVT_DO(checkCityScene(scene));
    SVT_DO(lookAround(scene));
    SVT_TRY(view, viewOf(scene, frame_));
    SVT_TRY(chosen, chooseTiles(city_, *view, options_.memoryBytes));
    chosen_ = std::move(*chosen);
    SVT_DO(leaveOutHidden(scene, *view, options));
    for (;;) {
        auto painting = draw(scene, options);
        if (!painting || leftOut_.empty() || !takeBack(*view, *painting)) return painting;
    }
}

}  // namespace svt::city

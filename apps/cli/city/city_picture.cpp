#include <apps/cli/city/city_input.hpp>

#include <svt/city/city_levels.hpp>
#include <svt/core/machine.hpp>
#include <svt/illustrate/details.hpp>
#include <svt/illustrate/view.hpp>

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>

namespace svt::cli {
namespace {

constexpr std::uint64_t kTileMemory = 1'000'000'000;

}  // namespace

std::uint64_t tileMemory() {
    const MemoryFigures memory = memoryFigures();
    return memory.limitedBy == "--memory" && memory.limitBytes ? *memory.limitBytes / 2 : kTileMemory;
}

Result<CityPicture> CityPicture::open(const std::filesystem::path& folder, const BuildArguments& build,
                                      const Progress* progress) {
    auto city = city::City::open(folder);
    if (!city) return city.error();
    auto frame = city::frameVolume(*city);
    if (!frame) return frame.error();
    return CityPicture(std::move(*city), std::move(*frame), build, progress);
}

// A view of buildings by id becomes a camera, since the frame has no labels that it could be fitted to.
Result<void> CityPicture::lookAround(illustrate::Scene& scene) const {
    if (scene.camera.around.empty()) return {};
    if (!scene.camera.around.starts_with("id="))
        return Error(Code::BadArgument, "--around: of a city, a building by its id is known: --around id=ID");
    city::Extract extract;
    extract.ids.push_back(scene.camera.around.substr(3));
    const auto part = city::extractVolume(city_, extract);
    if (!part) return part.error();
    illustrate::SceneCamera now = scene.camera;
    now.around.clear();
    auto camera = illustrate::makeView("", now.preset, now, double(scene.width) / scene.height, *part);
    if (!camera) return camera.error();
    const Vec3d by = part->grid.origin() - frame_.grid.origin();
    if (camera->eye) camera->eye = *camera->eye + by;
    if (camera->target) camera->target = *camera->target + by;
    scene.camera = *camera;
    return {};
}

namespace {

// Where a surface hides all that is behind it: the depths of a picture, infinity where what is seen is translucent.
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

// Reads what is chosen, with one table of labels, and what their mixtures are made of.
Result<void> CityPicture::read() {
    shown_ = frame_;
    shown_.labels = city::classTable(city_);
    auto parts = city::readTiles(city_, chosen_, build_.threads, progress_);
    if (!parts) return parts.error();
    parts_ = std::move(*parts);
    std::map<std::string, std::vector<std::pair<std::string, int>>> coverage;
    for (const volume::SemanticVolume& part : parts_) {
        if (part.grid.spacing().x < city::spacingOf(city::kFirstClassDetail + 1, city_.spacing()).x) continue;
        for (const volume::Label& label : part.labels.labels)
            if (label.count > 0) coverage[label.id] = city::coverageOf(label);
    }
    if (auto joined = illustrate::joinLabels(shown_, parts_); !joined) return joined;
    std::map<std::string, volume::Scalar> scalarOf;
    for (const volume::Label& label : shown_.labels.labels)
        if (label.count > 0) scalarOf.emplace(label.id, label.first);
    mixtures_.clear();
    for (const auto& [id, shares] : coverage) {
        illustrate::ScenePainter::StyleMixture& mixture = mixtures_.emplace_back();
        mixture.scalar = scalarOf.at(id);
        for (const auto& [name, eighths] : shares)
            if (const auto known = scalarOf.find(name); known != scalarOf.end())
                mixture.parts.emplace_back(known->second, float(eighths));
        int covered = 0;
        for (const auto& [name, eighths] : shares) covered += eighths;
        mixture.empty = float(city::kCoverageSteps - covered) * gaps_;
        // A class that city.json does not list: the label's own style.
        if (mixture.parts.size() < shares.size()) mixtures_.pop_back();
    }
    return {};
}

Result<illustrate::Painting> CityPicture::draw(const illustrate::Scene& scene, const render::CastOptions& options) {
    if (auto done = read(); !done) return done.error();
    nothing_.clear();
    illustrate::ScenePainter painter(shown_, build_.threads);
    painter.tolerateNothing(&nothing_);
    painter.reportTo(progress_);
    painter.mixStyles(mixtures_);
    for (const volume::SemanticVolume& part : parts_)
        painter.addPart(part, chosen_.near > 0 && &part == &parts_.back());
    return painter.paint(scene, options);
}

// Draws what is nearest small and plain, and leaves out of the choice what is behind it. In a street that is most of a city.
Result<void> CityPicture::leaveOutHidden(illustrate::Scene scene, const city::CameraView& view,
                                         const render::CastOptions& options) {
    constexpr double kShare = 0.15;
    constexpr int kSmaller = 2;
    leftOut_.clear();
    if (!view.isPerspective || view.eye.z > city_.box().max.z || chosen_.entries.size() < 4) return {};
    const city::ChosenTiles all = chosen_;
    chosen_ = city::nearestOf(city_, view, all, kShare);
    chosen_.near = 0;
    if (auto done = read(); !done) return done;
    scene.width = std::max(1, scene.width / kSmaller);
    scene.height = std::max(1, scene.height / kSmaller);
    scene.samples = 1;
    scene.names.clear();
    scene.title.clear();
    scene.colorBy.clear();
    scene.insets.clear();
    std::vector<std::string> ignored;
    illustrate::ScenePainter painter(shown_, build_.threads);
    painter.tolerateNothing(&ignored);
    painter.mixStyles(mixtures_);
    for (const volume::SemanticVolume& part : parts_) painter.addPart(part, false);
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
    const auto hidden = city::areHidden(city_, view, {scene.width, scene.height, depth}, chosen_.entries);
    city::ChosenTiles seen;
    for (std::size_t n = 0; n < hidden.size(); ++n) (hidden[n] ? leftOut_ : seen.entries).push_back(chosen_.entries[n]);
    seen.pixels = all.pixels;
    chosen_ = city::nearestOf(city_, view, seen, INFINITY);
    return {};
}

// Takes back what was left out, but could be seen in a picture that is drawn without it. \return whether there is any
bool CityPicture::takeBack(const city::CameraView& view, const illustrate::Painting& painting) {
    const std::vector<float> depth = hidingDepths(painting.frame, painting.spec);
    const city::SeenDepths seen{painting.spec.width, painting.spec.height, depth};
    const auto hidden = city::areHidden(city_, view, seen, leftOut_);
    std::vector<city::IndexEntry> still;
    for (std::size_t n = 0; n < hidden.size(); ++n) (hidden[n] ? still : chosen_.entries).push_back(leftOut_[n]);
    const bool isAny = still.size() < leftOut_.size();
    leftOut_ = std::move(still);
    if (isAny) chosen_ = city::nearestOf(city_, view, chosen_, INFINITY);
    return isAny;
}

Result<illustrate::Painting> CityPicture::paint(illustrate::Scene scene, const render::CastOptions& options) {
    if (auto looked = lookAround(scene); !looked) return looked.error();
    // The camera alone: queries find nothing in the frame.
    std::vector<std::string> ignored;
    illustrate::Scene plain = scene;
    plain.colorBy.clear();
    const auto spec = illustrate::makeFrameSpec(plain, frame_, analyze::LabelRows(frame_.labels, &ignored));
    if (!spec) return spec.error();
    const city::CameraView view = city::cameraViewOf(*spec, frame_.grid);
    auto chosen = city::chooseTiles(city_, view, tileMemory());
    if (!chosen) return chosen.error();
    chosen_ = std::move(*chosen);
    // Between houses the ground is seen from above; from lower than some 30 degrees walls hide more and more of it.
    gaps_ = static_cast<float>(std::clamp(-2 * view.forward.z, 0.0, 1.0));
    if (auto done = leaveOutHidden(scene, view, options); !done) return done.error();
    for (;;) {
        auto painting = draw(scene, options);
        if (!painting || leftOut_.empty() || !takeBack(view, *painting)) return painting;
    }
}

}  // namespace svt::cli

#include <apps/cli/city/city_input.hpp>

#include <svt/core/machine.hpp>
#include <svt/illustrate/details.hpp>
#include <svt/illustrate/view.hpp>
#include <svt/render/camera_rays.hpp>

#include <fmt/format.h>

#include <cstdlib>

namespace svt::cli {
namespace {

constexpr std::uint64_t kTileMemory = 1'000'000'000;

city::CameraView viewOf(const render::FrameSpec& spec, const volume::Grid& grid) {
    const render::CameraRays rays(spec, grid);
    const auto basis = rays.basis();
    city::CameraView view;
    view.isPerspective = rays.isPerspective();
    view.eye = spec.camera.eye;
    view.forward = basis.forward;
    view.right = basis.right;
    view.up = basis.up;
    view.halfWidth = basis.halfWidth;
    view.halfHeight = basis.halfHeight;
    view.pixel = rays.pixelSize(1);
    if (spec.light.hasShadows && spec.light.space == render::Light::Space::World && spec.light.key > 0)
        view.towardsLight = normalized(spec.light.direction);
    return view;
}

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

Result<void> CityPicture::read(const render::FrameSpec& spec) {
    auto chosen = city::chooseTiles(city_, viewOf(spec, frame_.grid), tileMemory());
    if (!chosen) return chosen.error();
    chosen_ = std::move(*chosen);
    shown_ = frame_;
    auto parts = city::readTiles(city_, chosen_, build_.threads, progress_);
    if (!parts) return parts.error();
    parts_ = std::move(*parts);
    return illustrate::joinLabels(shown_, parts_);
}

Result<illustrate::Painting> CityPicture::paint(illustrate::Scene scene, const render::CastOptions& options) {
    if (auto looked = lookAround(scene); !looked) return looked.error();
    nothing_.clear();
    // The camera alone: queries find nothing in the frame.
    std::vector<std::string> ignored;
    illustrate::Scene view = scene;
    view.colorBy.clear();
    const auto spec = illustrate::makeFrameSpec(view, frame_, analyze::LabelRows(frame_.labels, &ignored));
    if (!spec) return spec.error();
    if (auto done = read(*spec); !done) return done.error();
    illustrate::ScenePainter painter(shown_, build_.threads);
    painter.tolerateNothing(&nothing_);
    painter.reportTo(progress_);
    // Voxels of all but the nearest are at most a pixel wide.
    const double finest = parts_.empty() ? 0 : parts_.back().grid.spacing().x;
    for (const volume::SemanticVolume& part : parts_) painter.addPart(part, part.grid.spacing().x <= finest);
    return painter.paint(scene, options);
}

}  // namespace svt::cli

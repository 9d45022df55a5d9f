#include "picture_errors.hpp"

#include "mesh_tracer.hpp"

#include <svt/analyze/solid_overlaps.hpp>
#include <svt/image/color.hpp>
#include <svt/model/classes.hpp>
#include <svt/model/phases.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/render/camera_presets.hpp>
#include <svt/render/face_model.hpp>
#include <svt/render/ray_caster.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

namespace svt::test {
namespace {

struct View {
    std::string name;
    render::Camera camera;
    std::optional<render::HalfSpace> cut{};
};

render::HalfSpace halfSpace(Vec3d normal, Vec3d point) { return {normal, -dot(normal, point)}; }

render::Camera closeUp(Vec3d target, Vec3d fromTarget) {
    render::Camera camera;
    camera.target = target;
    camera.eye = target + fromTarget;
    return camera;
}

// Four from outside, two close by, a plan and an oblique section.
Result<std::vector<View>> viewsOf(const Box3d& bounds, const PictureOptions& options) {
    const double aspect = double(options.width) / options.height;
    std::vector<View> views;
    for (const std::string name : {"iso-se", "iso-nw", "front", "left"}) {
        SVT_TRY(camera, render::cameraPreset(name, bounds, {.aspect = aspect}));
        views.push_back({name, *camera});
    }
    const Vec3d size = bounds.size(), center = bounds.center();
    const Vec3d top{center.x, center.y, bounds.max.z - 0.1 * size.z};
    views.push_back({"ridge", closeUp(top, {2.2, -2.8, 1.3})});
    const Vec3d eave{bounds.min.x + 0.1 * size.x, bounds.min.y + 0.1 * size.y, bounds.min.z + 0.6 * size.z};
    views.push_back({"eave", closeUp(eave, {-2.5, -3.1, 1.7})});
    SVT_TRY(above, render::cameraPreset("top", bounds, {.aspect = aspect}));
    const Vec3d level{center.x, center.y, bounds.min.z + 0.437 * size.z};
    views.push_back({"plan", *above, halfSpace({0, 0, 1}, level)});
    views.push_back({"section", views.front().camera, halfSpace({0.31, -0.94, 0.13}, center)});
    return views;
}

/// A volume with its bricks, and the scalars that its pictures hide.
struct Drawn {
    const volume::SemanticVolume& volume;
    const volume::BrickVolume& bricks;
    std::vector<char> isHidden;  ///< by scalar
    const render::RunSource* faces = nullptr;
};

render::FrameSpec frameOf(const Drawn& drawn, const View& view, const PictureOptions& options) {
    render::FrameSpec spec;
    spec.width = options.width;
    spec.height = options.height;
    spec.camera = view.camera;
    spec.light.space = render::Light::Space::World;
    spec.light.key = 1;
    spec.light.ambient = 0;
    spec.light.ambientOcclusion = 0;
    render::Pass pass;
    for (const char isHidden : drawn.isHidden)
        pass.styles.push_back({.color = {1, 1, 1}, .opacity = isHidden ? 0.f : 1.f});
    if (view.cut) {
        render::ConvexPart part;
        part.halfSpaces.push_back(*view.cut);
        render::ClipRegion region;
        region.parts.push_back(part);
        pass.clips.push_back(region);
    }
    spec.passes.push_back(std::move(pass));
    return spec;
}

/// The buffers of a picture, with its normals: each of six lights along the axes of the world gives
/// one component where it shines.
struct Picture {
    render::Frame frame;
    image::Image<Vec3d> normals;
};

Result<Picture> draw(const Drawn& drawn, const View& view, const PictureOptions& options) {
    Picture picture;
    picture.normals = {options.width, options.height};
    render::FrameSpec spec = frameOf(drawn, view, options);
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        spec.light.direction = {};
        spec.light.direction[axis] = side % 2 == 0 ? 1 : -1;
        SVT_TRY(frame, render::castRays(render::DrawnVolume(drawn.bricks, drawn.volume.grid, drawn.faces), spec));
        for (std::size_t p = 0; p < frame->color.pixels().size(); ++p) {
            const auto gray = static_cast<float>(frame->color.pixels()[p].g) / 255;
            const double share = static_cast<double>(image::linearFromSrgb(gray));
            picture.normals.pixels()[p][axis] += side % 2 == 0 ? share : -share;
        }
        picture.frame = std::move(*frame);
    }
    for (Vec3d& normal : picture.normals.pixels()) normal = normalized(normal);
    return picture;
}

/// Adds one pixel to the errors, and gives its colour in the map.
image::Rgba8 addPixel(const SeenSurface& seen, volume::Scalar label, double depth, Vec3d normal,
                      PictureErrors& errors) {
    // The six lights give a normal within half a degree.
    static const double kLeastCosine = std::cos(1.5 * std::numbers::pi / 180);
    if (!seen.isDecided) {
        ++errors.undecided;
        return {230, 230, 160, 255};
    }
    if (seen.scalars.empty() && label == 0) return {255, 255, 255, 255};
    ++errors.pixels;
    if (seen.scalars.empty() || label == 0) {
        ++errors.outline;
        return {220, 0, 0, 255};
    }
    errors.depths.push_back(static_cast<float>(std::abs(seen.depth - depth)));
    if (std::ranges::find(seen.scalars, label) == seen.scalars.end()) {
        ++errors.label;
        return {0, 60, 220, 255};
    }
    if (dot(seen.normal, normal) < kLeastCosine) {
        ++errors.normal;
        return {255, 140, 0, 255};
    }
    if (errors.depths.back() > 0.01f) return {200, 160, 230, 255};
    const auto gray = static_cast<std::uint8_t>(190 + 20 * seen.normal.z - 15 * seen.normal.x);
    return {gray, gray, gray, 255};
}

Result<PictureErrors> measure(const MeshTracer& tracer, const Drawn& drawn, const View& view,
                              const PictureOptions& options) {
    SVT_TRY(picture, draw(drawn, view, options));
    const render::FrameSpec spec = frameOf(drawn, view, options);
    PictureErrors errors;
    errors.camera = view.name;
    errors.map = {options.width, options.height};
    for (std::int32_t y = 0; y < options.height; ++y)
        for (std::int32_t x = 0; x < options.width; ++x) {
            const render::ViewRay ray =
                render::viewRay(spec, drawn.volume.grid, (x + 0.5) / options.width, (y + 0.5) / options.height);
            errors.map.at(x, y) =
                addPixel(tracer.trace(ray, view.cut), picture->frame.label.at(x, y),
                         static_cast<double>(picture->frame.depth.at(x, y)), picture->normals.at(x, y), errors);
        }
    return errors;
}

}  // namespace

void PictureErrors::add(const PictureErrors& other) {
    pixels += other.pixels;
    undecided += other.undecided;
    outline += other.outline;
    label += other.label;
    normal += other.normal;
    depths.insert(depths.end(), other.depths.begin(), other.depths.end());
}

double PictureErrors::depthAt(double share) const {
    if (depths.empty()) return 0;
    std::vector<float> ordered = depths;
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(ordered.size() - 1));
    std::ranges::nth_element(ordered, ordered.begin() + place);
    return static_cast<double>(ordered[static_cast<std::size_t>(place)]);
}

Result<std::vector<PictureErrors>> measurePictures(const model::BuildingModel& given, const PictureOptions& options) {
    model::BuildingModel model = given;
    pipeline::BuildOptions build;
    build.spacing = Vec3d{options.spacing, options.spacing, options.spacing};
    build.vectors.meshes = options.isExact;
    SVT_TRY(built, pipeline::buildVolume(model, build));
    const volume::SemanticVolume& volume = built->volume;
    SVT_TRY(bricks,
            volume::BrickVolume::fromColumns(volume.columns, {.faces = options.faces, .planes = volume.planes}));

    model = given;
    model::splitPhases(model);
    SVT_TRY(meshes, mesh::buildMeshes(model));
    pipeline::addCapFeatures(model, *meshes);
    const pipeline::StyleSheet* sheet = &pipeline::defaultStyle(false);
    SVT_TRY(labelled, pipeline::makeLabels(model, *meshes, std::span(&sheet, 1)));

    std::vector<char> isHidden(volume.labels.scalarCount(), 0);
    isHidden[0] = 1;  // background
    for (const volume::Label& label : volume.labels.labels)
        if (model::isSpace(label.className)) std::fill_n(isHidden.begin() + label.first, label.count, char{1});
    std::unique_ptr<render::FaceModel> faces;
    if (options.isExact) {
        SVT_TRY(made, render::FaceModel::make(volume, analyze::labelsByPriority(volume.labels)));
        faces = std::move(*made);
    }
    const Drawn drawn{volume, *bricks, isHidden, faces.get()};
    const MeshTracer tracer(*meshes, *labelled, volume.labels, isHidden);
    const Box3d bounds{meshes->bounds.min + meshes->origin, meshes->bounds.max + meshes->origin};
    SVT_TRY(views, viewsOf(bounds, options));
    std::vector<PictureErrors> all;
    for (const View& view : *views) {
        SVT_TRY(errors, measure(tracer, drawn, view, options));
        all.push_back(std::move(*errors));
    }
    return all;
}

}  // namespace svt::test

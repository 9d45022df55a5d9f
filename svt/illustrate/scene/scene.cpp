#include <svt/core/rounding.hpp>
#include <svt/illustrate/scene.hpp>

#include <svt/drawing/hatches.hpp>
#include <svt/illustrate/annotate/legend.hpp>
#include <svt/illustrate/annotate/name_tags.hpp>
#include <svt/illustrate/inset/inset_frame.hpp>
#include <svt/illustrate/scene/region.hpp>
#include <svt/illustrate/scene/vector_shapes.hpp>
#include <svt/illustrate/scene/visible_points.hpp>
#include <svt/illustrate/sun.hpp>
#include <svt/model/classes.hpp>
#include <svt/render/camera_presets.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace svt::illustrate {
namespace {

using volume::Label;
using volume::LabelTable;

// Light of sun and sky: shadows are visible, and so are objects in them.
constexpr float kSunKey = 0.85f, kSunAmbient = 0.46f;
constexpr float kGhostOpacity = 0.22f;
constexpr float kGhostGray = 0.7f;  // share of a ghost's colour that is lost
// Labels that stop less light per metre are air, such as a room.
constexpr float kSolidOpacity = 0.5f;
// Share of light that a shell of glass stops, seen face on.
constexpr double kShellGhost = 0.10;

// Style of a label in a pass.
struct LabelLook {
    Vec3f color;
    float opacity;
    render::Hatch hatch;
    bool isRecolored = false;
    bool hasOwnOpacity = false;  // given by the scene
    bool isGhost = false;
};

Vec3f mix(Vec3f a, Vec3f b, float share) { return a * (1 - share) + b * share; }

float brightnessOf(Vec3f color) { return 0.3f * color.x + 0.59f * color.y + 0.11f * color.z; }

// A colour as modified by a look.
Vec3f shown(Vec3f color, Look look) {
    const float gray = brightnessOf(color);
    switch (look) {
        case Look::Plain: return color;
        case Look::Paper: return mix(mix(color, {gray, gray, gray}, 0.35f), {1, 1, 1}, 0.28f);
        case Look::Blueprint: return mix({0.09f, 0.25f, 0.50f}, {0.45f, 0.66f, 0.92f}, gray);
        case Look::Dark: break;
    }
    return mix(color, {gray, gray, gray}, 0.1f);
}

void applyLook(const Scene& scene, render::FrameSpec& spec) {
    switch (scene.look) {
        case Look::Plain: spec.borders = {0.5f, 1, 1, {}}; break;
        case Look::Paper:
            spec.borders = {0.8f, 1.2f, 3, {0.05f, 0.05f, 0.06f}};
            spec.light.key = 0.35f;
            spec.light.ambient = 0.78f;
            break;
        case Look::Blueprint:
            spec.background.top = {0.075f, 0.22f, 0.45f};
            spec.background.bottom = {0.055f, 0.17f, 0.37f};
            spec.borders = {0.9f, 1.2f, 3, {0.93f, 0.97f, 1}};
            spec.hatches.color = {0.90f, 0.95f, 1};
            break;
        case Look::Dark:
            spec.background.top = {0.09f, 0.10f, 0.12f};
            spec.background.bottom = {0.05f, 0.055f, 0.065f};
            spec.borders = {0.55f, 1, 2, {0.01f, 0.01f, 0.015f}};
            break;
    }
    if (scene.background) spec.background.top = spec.background.bottom = *scene.background;
    if (scene.isTransparent) spec.background.alpha = 0;
    if (scene.lines.strength) spec.borders.strength = *scene.lines.strength;
    if (scene.lines.width) spec.borders.width = *scene.lines.width;
    if (scene.lines.cutWidth) spec.borders.cutWidth = *scene.lines.cutWidth;
    if (scene.lines.color) spec.borders.color = *scene.lines.color;
    if (scene.ambientOcclusion) spec.light.ambientOcclusion = *scene.ambientOcclusion;
}

// Replaces the light beside the camera with the sun. Below the horizon, only the sky gives light.
Result<void> applySun(const Scene& scene, const volume::SemanticVolume& volume, render::FrameSpec& spec) {
    if (!scene.sun) return {};
    SVT_TRY(sunlight, sunlightOf(*scene.sun, volume));
    render::Light& light = spec.light;
    light.space = render::Light::Space::World;
    light.direction = sunlight->direction;
    light.size = scene.sun->size;
    light.hasShadows = true;
    light.key = sunlight->position.elevation > 0 ? kSunKey : 0;
    light.ambient = kSunAmbient;
    return {};
}

// The part of a grid in a box of samples, for fitting cameras.
volume::Grid gridOf(const analyze::SampleBox& box, const volume::Grid& grid) {
    Vec3i dimension;
    Vec3d first;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int32_t count = box.max[axis] - box.min[axis] + 1;
        dimension[axis] = std::max(2, count);
        first[axis] = box.min[axis] - (dimension[axis] - count) / 2.0;
    }
    const auto part = volume::Grid::fromParts(dimension, grid.spacing(), grid.worldFromIndex(first), grid.axes());
    return part ? *part : grid;
}

// The points to which a named view is fitted: the corners of a grid, or a list.
struct ToShow {
    volume::Grid grid;
    std::vector<Vec3d> points;  ///< empty: the grid
};

Result<ToShow> wholeOrAround(const SceneCamera& wanted, const volume::SemanticVolume& volume,
                             const analyze::LabelRows& rows) {
    if (wanted.around.empty()) return ToShow{volume.grid, {}};
    SVT_TRY(selected, analyze::selectWithParts(rows, wanted.around));
    if (selected->empty()) return ToShow{volume.grid, {}};
    SVT_TRY(box, analyze::boxAround(*selected, volume, fmt::format("the selection of the query '{}'", wanted.around)));
    return ToShow{gridOf(*box, volume.grid), {}};
}

// Moves a camera to the right, so that its picture moves to the left, by a share of the picture's height.
void moveAside(double share, render::Camera& camera) {
    const Vec3d forward = camera.target - camera.eye;
    const double height = camera.projection == render::Camera::Projection::Orthographic
                              ? camera.orthographicHeight
                              : 2 * std::tan(camera.verticalFovDegrees * std::numbers::pi / 360) * length(forward);
    const Vec3d by = normalized(cross(forward, camera.up)) * (share * height);
    camera.eye = camera.eye + by;
    camera.target = camera.target + by;
}

Result<render::Camera> cameraOf(const Scene& scene, const volume::Grid& grid, const ToShow& toShow) {
    const SceneCamera& wanted = scene.camera;
    if (!(wanted.zoom > 0 && std::isfinite(wanted.zoom)))
        return Error(Code::BadCamera,
                     fmt::format("a zoom of {} is out of range; it must be greater than 0", wanted.zoom));
    if (!(wanted.fieldOfView > 0 && wanted.fieldOfView < 180))
        return Error(Code::BadCamera,
                     fmt::format("a field of view of {} degrees is out of range; it must be greater than 0 and less "
                                 "than 180",
                                 wanted.fieldOfView));
    render::PresetOptions options;
    options.aspect = double(scene.width) / scene.height;
    options.projection =
        wanted.isParallel ? render::Camera::Projection::Orthographic : render::Camera::Projection::Perspective;
    options.verticalFovDegrees = wanted.fieldOfView;
    const double names = scene.names.empty() ? 0 : nameMargin(scene.width, scene.height);
    const bool hasScale = !scene.colorBy.empty() || scene.field;
    const double legend = hasScale && scene.hasLegend ? legendMargin(scene.width, scene.height) : 0;
    options.sideMargin = std::max({options.sideMargin, names, legend});
    const InsetMargins insets = insetMargins(scene);
    // The margins of a picture that is moved aside are as wide as the marks at each side.
    const double left = std::max({options.sideMargin, options.margin, insets.left});
    // Names are between the model and the legend.
    const double right = std::max({options.sideMargin, std::min(0.5, names + legend), options.margin, insets.right});
    options.sideMargin = std::min(0.45, (left + right) / 2);
    auto camera = toShow.points.empty() ? render::cameraPreset(wanted.preset, toShow.grid, options)
                                        : render::cameraPreset(wanted.preset, toShow.points, grid.axes(), options);
    if (!camera) return camera;
    if (wanted.eye) camera->eye = grid.origin() + *wanted.eye;
    if (wanted.target) camera->target = grid.origin() + *wanted.target;
    camera->eye = camera->target + (camera->eye - camera->target) / wanted.zoom;
    camera->orthographicHeight /= wanted.zoom;
    if (left != right && !wanted.eye && !wanted.target) moveAside((right - left) / 2 * options.aspect, *camera);
    return camera;
}

// Size of a pixel at the camera's target, metres.
double pixelOf(const render::FrameSpec& spec) {
    const render::Camera& camera = spec.camera;
    if (camera.projection == render::Camera::Projection::Orthographic) return camera.orthographicHeight / spec.height;
    return 2 * std::tan(camera.verticalFovDegrees * std::numbers::pi / 360) * length(camera.target - camera.eye) /
           spec.height;
}

Result<void> select(const analyze::LabelRows& rows, const std::vector<std::string>& queries,
                    std::vector<bool>& isSelected) {
    for (const std::string& query : queries) {
        SVT_TRY(selected, analyze::selectWithParts(rows, query));
        for (const std::uint32_t l : *selected) isSelected[l] = true;
    }
    return {};
}

// Opacity per metre of a ghost. For a shell it depends on the voxel size, as its thickness does.
float ghostOpacity(const ScenePass& pass, const volume::Grid& grid) {
    if (!pass.representation.shell) return kGhostOpacity;
    const double thickness = 2 * std::max({grid.spacing().x, grid.spacing().y, grid.spacing().z});
    return static_cast<float>(std::min(0.9999, 1 - std::pow(1 - kShellGhost, 1 / thickness)));
}

// Rooms and other air are drawn solid if nothing else is shown, because their shape matters and nothing is inside.
void makeSolidIfAlone(const LabelTable& table, std::vector<LabelLook>& looks) {
    for (std::size_t l = 0; l < looks.size(); ++l)
        if (looks[l].opacity >= kSolidOpacity && table.labels[l].count > 0) return;
    for (LabelLook& look : looks)
        if (look.opacity > 0 && !look.hasOwnOpacity) look.opacity = 1;
}

bool isAir(const Label& label) { return model::isSpace(label.className); }

// Hides rooms and other spaces where anything else is drawn, except those that a style or a name asks for: its query
// selects only spaces.
void hideSpaces(const LabelTable& table, const std::vector<bool>& isAskedFor, std::vector<LabelLook>& looks) {
    bool isAlone = true;
    for (std::size_t l = 0; l < looks.size() && isAlone; ++l)
        isAlone = looks[l].opacity <= 0 || table.labels[l].voxels == 0 || isAir(table.labels[l]) ||
                  table.labels[l].className == "ClosureSurface";
    for (std::size_t l = 0; l < looks.size() && !isAlone; ++l)
        if (isAir(table.labels[l]) && !isAskedFor[l]) looks[l].opacity = 0;
}

Result<std::vector<LabelLook>> looksOf(const Scene& scene, const ScenePass& pass, const volume::SemanticVolume& volume,
                                       const analyze::LabelRows& rows) {
    const LabelTable& table = volume.labels;
    const float ghost = ghostOpacity(pass, volume.grid);
    std::vector<LabelLook> looks;
    const bool hasHatches = scene.hatches.show.value_or(scene.look == Look::Paper || scene.look == Look::Blueprint);
    std::vector<render::Hatch> hatches(table.labels.size(), render::Hatch::None);
    if (hasHatches) hatches = drawing::labelHatches(rows);
    for (std::size_t l = 0; l < table.labels.size(); ++l)
        looks.push_back({shown(table.labels[l].color, scene.look), table.labels[l].opacity,
                         table.labels[l].count > 1 ? render::Hatch::None : hatches[l]});
    std::vector<bool> isShown(table.labels.size(), pass.show.empty()), isHidden(table.labels.size(), false);
    SVT_DO(select(rows, pass.show, isShown));
    SVT_DO(select(rows, pass.hide, isHidden));
    std::vector<bool> isAskedFor(table.labels.size(), false);
    const auto askForSpaces = [&](const std::vector<std::uint32_t>& selected) {
        if (std::all_of(selected.begin(), selected.end(), [&](std::uint32_t l) { return isAir(table.labels[l]); }))
            for (const std::uint32_t l : selected) isAskedFor[l] = true;
    };
    for (const std::string& query : scene.names) {
        SVT_TRY(named, analyze::selectLabels(rows, query));
        askForSpaces(*named);
    }
    for (const SceneStyle& style : pass.styles) {
        SVT_TRY(selected, analyze::selectLabels(rows, style.select));
        if (!style.isGhost && (style.color || style.opacity)) askForSpaces(*selected);
        for (const std::uint32_t l : *selected) {
            LabelLook& look = looks[l];
            if (style.isGhost) {
                // Gray, so that only the highlight inside a ghost has colour.
                const float gray = brightnessOf(look.color);
                look.color = mix(look.color, {gray, gray, gray}, kGhostGray);
                look.isGhost = true;
                look.opacity = look.opacity >= kSolidOpacity ? ghost : 0;
                look.hasOwnOpacity = true;
            }
            if (style.color) {
                look.color = *style.color;
                look.isRecolored = true;
            }
            if (style.opacity) {
                look.opacity = *style.opacity;
                look.hasOwnOpacity = true;
            }
            if (style.hatch) look.hatch = *style.hatch;
        }
    }
    for (std::size_t l = 0; l < looks.size(); ++l)
        if (!isShown[l] || isHidden[l]) looks[l].opacity = 0;
    if (pass.show.empty() && !pass.representation.shell) hideSpaces(table, isAskedFor, looks);
    if (!pass.show.empty()) makeSolidIfAlone(table, looks);
    return looks;
}

std::vector<render::Style> stylesOf(const LabelTable& table, const std::vector<LabelLook>& looks, Look look) {
    std::vector<render::Style> styles(table.scalarCount());
    styles[0].opacity = 0;
    for (std::size_t l = 0; l < table.labels.size(); ++l)
        for (volume::Scalar s = 0; s < table.labels[l].count; ++s) {
            const volume::Scalar scalar = table.labels[l].first + s;
            const bool hasPhase =
                !looks[l].isRecolored && table.labels[l].count > 1 && scalar < table.phaseColors.size();
            // A recoloured pattern keeps its further phases, such as joints, as darker shades.
            styles[scalar].color =
                hasPhase ? shown(table.phaseColors[scalar], look) : looks[l].color * (1.0f / (1.0f + 0.35f * float(s)));
            styles[scalar].opacity = looks[l].opacity;
            styles[scalar].hatch = looks[l].hatch;
        }
    return styles;
}

using PassLooks = std::vector<std::vector<LabelLook>>;  // by pass, by label

// Labels that are not shown, although others of their kind are. The kinds are spaces and all other components.
std::vector<std::uint8_t> hiddenOfKind(const std::vector<volume::Label>& labels,
                                       const std::vector<std::uint8_t>& isShown) {
    std::array<bool, 2> hasShown{};
    const auto kindOf = [&](std::size_t l) { return std::size_t(isAir(labels[l])); };
    for (std::size_t l = 0; l < labels.size(); ++l)
        if (isShown[l] != 0) hasShown[kindOf(l)] = true;
    std::vector<std::uint8_t> isHidden(labels.size(), 0);
    for (std::size_t l = 0; l < labels.size(); ++l)
        isHidden[l] = isShown[l] == 0 && labels[l].count > 0 && hasShown[kindOf(l)] ? 1 : 0;
    return isHidden;
}

// The looks of all passes, with the colours of Scene::colorBy.
Result<PassLooks> passLooks(const Scene& scene, const volume::SemanticVolume& volume, const analyze::LabelRows& rows,
                            ColorScale* scale) {
    PassLooks all;
    for (const ScenePass& pass : scene.passes) {
        SVT_TRY(looks, looksOf(scene, pass, volume, rows));
        all.push_back(std::move(*looks));
    }
    if (scene.colorBy.empty()) return all;
    // Transparent labels count only if there are no others.
    const auto& labels = volume.labels.labels;
    std::vector<std::uint8_t> isShown(labels.size(), 0);
    for (const float least : {kSolidOpacity, 0.0f}) {
        for (const auto& looks : all)
            for (std::size_t l = 0; l < labels.size(); ++l)
                if (labels[l].count > 0 && looks[l].opacity > least && !looks[l].isGhost) isShown[l] = 1;
        if (std::count(isShown.begin(), isShown.end(), 1) != 0) break;
    }
    SVT_TRY(areas, areasFor(scene.colorBy, volume));
    SVT_TRY(coloring, colorBy(scene.colorBy, rows.withVolumes(), isShown, *areas, hiddenOfKind(labels, isShown)));
    for (auto& looks : all)
        for (std::size_t l = 0; l < labels.size(); ++l)
            if (!looks[l].isRecolored && !looks[l].isGhost) {
                looks[l].color = coloring->colors[l];
                looks[l].isRecolored = true;
            }
    if (scale != nullptr) *scale = std::move(coloring->scale);
    return all;
}

Result<render::Pass> passOf(const Scene& scene, const ScenePass& wanted, const std::vector<LabelLook>& looks,
                            const RegionContext& context) {
    render::Pass pass;
    pass.styles = stylesOf(context.volume.labels, looks, scene.look);
    pass.join = wanted.join;
    pass.hasCells = wanted.representation.hasCells;
    const auto addClip = [&](const std::string& region, render::ClipRegion::Mode mode) -> Result<void> {
        if (region.empty()) return {};
        SVT_TRY(parts, parseRegion(region, context));
        pass.clips.push_back({std::move(*parts), mode});
        return {};
    };
    SVT_DO(addClip(wanted.keep, render::ClipRegion::Mode::KeepOnly));
    SVT_DO(addClip(wanted.cut, render::ClipRegion::Mode::CutAway));
    SVT_DO(addShapes(wanted, context.volume, context.rows, pass));
    return pass;
}

Result<std::vector<render::Pass>> passesOf(const Scene& scene, const PassLooks& looks, const RegionContext& context) {
    const std::vector<VolumeRepresentation> representations = volumeRepresentations(scene);
    std::vector<render::Pass> passes;
    for (std::size_t n = 0; n < scene.passes.size(); ++n) {
        const ScenePass& wanted = scene.passes[n];
        SVT_TRY(pass, passOf(scene, wanted, looks[n], context));
        pass->volume = static_cast<std::uint32_t>(std::ranges::find(representations, wanted.representation) -
                                                  representations.begin());
        passes.push_back(std::move(*pass));
    }
    return passes;
}

// Fits the named view of a frame, initially of the whole volume, to the parts that its passes draw.
Result<void> fitToVisible(const Scene& scene, const PassLooks& looks, const volume::SemanticVolume& volume,
                          const analyze::LabelRows& rows, render::FrameSpec& spec) {
    // Before anything is clipped: whether there are more parts than a ray has room for.
    SVT_DO(checkFrameSpec(spec));
    SVT_TRY(camera, cameraOf(scene, volume.grid, {volume.grid, visiblePoints(spec.passes, volume)}));
    spec.camera = *camera;
    const bool isOfView = std::ranges::any_of(
        scene.passes, [](const ScenePass& pass) { return dependsOnView(pass.cut) || dependsOnView(pass.keep); });
    if (!isOfView) return {};
    SVT_TRY(passes, passesOf(scene, looks, {volume, rows, *camera, double(scene.width) / scene.height}));
    spec.passes = std::move(*passes);
    return {};
}

// The union of two regions, each of which may be empty.
std::string either(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty()) return a + b;
    return fmt::format("({}) or ({})", a, b);
}
std::string bothOf(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty()) return a + b;
    return fmt::format("({}) and ({})", a, b);
}

// Replaces the scene's passes by the context and `detail`.
void setInContext(Scene& scene, const ScenePass& detail, ScenePass around, Context context) {
    if (context == Context::Shell) around.representation.shell = ShellLevel::Building;
    if (context == Context::Shell || context == Context::Ghost) around.styles.push_back({"all", {}, {}, {}, true});
    scene.passes.clear();
    if (context != Context::None) scene.passes.push_back(std::move(around));
    scene.passes.push_back(detail);
}

std::string anyOf(const std::vector<std::string>& queries) {
    std::string text;
    for (const std::string& query : queries) text += fmt::format("{}({})", text.empty() ? "" : " or ", query);
    return text;
}

}  // namespace

void addLens(Scene& scene, const std::string& region, const std::string& cut, Context context) {
    ScenePass detail = scene.passes.front(), around = detail;
    detail.keep = bothOf(detail.keep, region);
    detail.cut = either(detail.cut, cut);
    detail.join = render::Pass::Join::Replace;
    setInContext(scene, detail, around, context);
}

void addHighlight(Scene& scene, const std::vector<std::string>& queries, Context context) {
    ScenePass target = scene.passes.front(), around = target;
    target.show = queries;
    // Rooms as a target are drawn solid, since their shape is wanted.
    target.styles.insert(target.styles.begin(), {"all", {}, 1.0f, {}, false});
    target.join = render::Pass::Join::Over;
    around.hide.push_back(anyOf(queries));
    setInContext(scene, target, around, context);
}

void addCutaway(Scene& scene, const std::string& query, double margin) {
    ScenePass target = scene.passes.front(), around = target;
    target.show = {query};
    target.join = render::Pass::Join::Depth;
    around.hide.push_back(query);
    around.cut = either(around.cut, fmt::format("cutaway({}; {})", query, margin));
    scene.passes = {around, target};
}

std::vector<VolumeRepresentation> volumeRepresentations(const Scene& scene) {
    std::vector<VolumeRepresentation> representations;
    for (const ScenePass& pass : scene.passes)
        if (std::ranges::find(representations, pass.representation) == representations.end())
            representations.push_back(pass.representation);
    if (representations.empty()) representations.emplace_back();
    return representations;
}

Result<render::FrameSpec> makeFrameSpec(const Scene& scene, const volume::SemanticVolume& volume) {
    if (scene.field)
        return Error(
            Code::BadArgument,
            fmt::format("the field '{}' is drawn only in pictures of pixels by the CPU; leave out the field here, "
                        "or write a .png without --gl",
                        scene.field->name));
    return makeFrameSpec(scene, volume, volume.labels);
}

Result<render::FrameSpec> makeFrameSpec(const Scene& scene, const volume::SemanticVolume& volume,
                                        const analyze::LabelRows& rows, ColorScale* scale) {
    render::FrameSpec spec;
    spec.width = scene.width;
    spec.height = scene.height;
    spec.samplesPerPixel = scene.samples;
    // Checked here because sizes are divided by them below.
    if (scene.width < 1 || scene.height < 1)
        return Error(Code::BadFrame, fmt::format("a picture of {} x {} pixels cannot be drawn; 1 to {} are possible",
                                                 scene.width, scene.height, render::FrameSpec::kMaxSize));
    if (scene.hasScaleBar && !scene.camera.isParallel)
        return Error(Code::BadCamera,
                     "a scale bar needs a parallel view (--ortho); in perspective, near objects are larger");
    applyLook(scene, spec);
    SVT_DO(applySun(scene, volume, spec));
    SVT_TRY(toShow, wholeOrAround(scene.camera, volume, rows));
    SVT_TRY(camera, cameraOf(scene, volume.grid, *toShow));
    spec.camera = *camera;
    SVT_TRY(looks, passLooks(scene, volume, rows, scale));
    SVT_TRY(passes, passesOf(scene, *looks, {volume, rows, *camera, double(scene.width) / scene.height}));
    spec.passes = std::move(*passes);
    // Lines are drawn between objects, not between the phases of one object's pattern.
    spec.objectOfScalar = volume.labels.labelOfScalar();
    for (std::uint32_t& object : spec.objectOfScalar) ++object;
    const SceneCamera& wanted = scene.camera;
    if (wanted.fit == Fit::Visible && wanted.around.empty() && !wanted.eye && !wanted.target)
        if (auto fitted = fitToVisible(scene, *looks, volume, rows, spec); !fitted) return fitted.error();
    spec.hatches.spacing = scene.hatches.spacing ? *scene.hatches.spacing : roundDownTo125(11 * pixelOf(spec));
    SVT_DO(checkFrameSpec(spec));
    return spec;
}

}  // namespace svt::illustrate

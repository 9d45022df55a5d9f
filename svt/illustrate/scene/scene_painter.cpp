#include <svt/illustrate/scene_painter.hpp>

#include <svt/drawing/north.hpp>
#include <svt/illustrate/annotate/field_paint.hpp>
#include <svt/illustrate/annotate/legend.hpp>
#include <svt/illustrate/annotate/marks.hpp>
#include <svt/illustrate/annotate/name_tags.hpp>
#include <svt/illustrate/exploded.hpp>
#include <svt/illustrate/inset/inset_frame.hpp>
#include <svt/illustrate/shell.hpp>
#include <svt/render/camera_rays.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace svt::illustrate {
namespace {

// Colours of texts in a picture: dark on light paper, light on dark.
struct TextColors {
    Vec3f text, halo;
};
TextColors textColors(const render::Background& background) {
    const Vec3f paper = (background.top + background.bottom) * 0.5f;
    const bool isDark = paper.x + paper.y + paper.z < 1.5f && background.alpha > 0;
    const Vec3f dark{0.05f, 0.05f, 0.06f}, light{1, 1, 1};
    return isDark ? TextColors{light, paper} : TextColors{dark, light};
}

bool hasLegend(const Scene& scene) { return (!scene.colorBy.empty() || scene.field) && scene.hasLegend; }

Result<void> addNames(const Scene& scene, const volume::SemanticVolume& volume, const analyze::LabelRows& rows,
                      Painting& painting) {
    if (scene.names.empty()) return {};
    SVT_TRY(tags, findNameTags(scene.names, volume, rows, painting.frame));
    if (hasLegend(scene)) tags->taken = legendMargin(scene.width, scene.height) * scene.width;
    const TextColors colors = textColors(painting.spec.background);
    const std::size_t drawn = drawNameTags(*tags, colors.text, colors.halo, painting.frame.color);
    painting.names = {drawn, tags->hiddenCount, tags->tags.size() - drawn};
    return {};
}

ScenePainter::Draw byCasting(const render::CastOptions& options) {
    return [options](std::span<const render::DrawnVolume> volumes, const render::FrameSpec& spec) {
        return render::castRays(volumes, spec, options);
    };
}

// The visible share of the gaps between objects on the ground. Below a view angle of about 30 degrees, the objects hide
// more and more of the gaps.
float seenGaps(const render::FrameSpec& spec, const volume::Grid& grid) {
    return static_cast<float>(std::clamp(-2 * render::CameraRays(spec, grid).forward().z, 0.0, 1.0));
}

void mix(const std::vector<ScenePainter::StyleMixture>& mixtures, const render::Background& background, float gaps,
         render::Pass& pass) {
    const Vec3f behind = (background.top + background.bottom) * 0.5f;
    const std::vector<render::Style> before = pass.styles;
    for (const ScenePainter::StyleMixture& mixture : mixtures) {
        if (mixture.scalar >= pass.styles.size()) continue;
        render::Style& own = pass.styles[mixture.scalar];
        own.color = {0, 0, 0};
        own.opacity = 0;
        float all = 0;
        for (const auto& [scalar, share] : mixture.parts) {
            if (scalar >= before.size() || before[scalar].opacity <= 0) continue;
            own.color = own.color + before[scalar].color * share;
            own.opacity += before[scalar].opacity * share;
            all += share;
        }
        if (all <= 0) continue;
        own.opacity = std::min(1.0f, own.opacity / all);
        const float empty = background.alpha < 1 ? 0 : mixture.empty * gaps;
        own.color = (own.color + behind * empty) * (1 / (all + empty));
    }
}

}  // namespace

std::string Painting::Surfaces::note() const {
    if (byVoxels == 0) return {};
    return fmt::format(
        "exact surfaces: {} of {} features have no closed mesh, a pattern, or material divided among surfaces; voxels "
        "show them",
        byVoxels, features);
}

struct ScenePainter::Representations {
    std::size_t number = 0;  // 0: the painter's volume; others: its details
    std::optional<ShellLevel> level;
    std::optional<volume::SemanticVolume> shell;
    const volume::SemanticVolume* volume = nullptr;
    std::optional<volume::BrickVolume> bricks, cells;  // `cells` has only voxels
    std::optional<ExactFaces> faces;                   // made on first use
    std::map<int, volume::LodLevel> levels;            // made on first use
};

struct ScenePainter::Apart {
    double distance;
    volume::SemanticVolume volume;
    ScenePainter painter;
    Apart(double by, volume::SemanticVolume lifted, int threads)
        : distance(by), volume(std::move(lifted)), painter(volume, threads) {}
};

ScenePainter::ScenePainter(const volume::SemanticVolume& volume, int threads) : volume_(volume), threads_(threads) {}
ScenePainter::~ScenePainter() = default;
ScenePainter::ScenePainter(ScenePainter&&) noexcept = default;

Result<ScenePainter::Representations*> ScenePainter::findRepresentations(std::size_t number,
                                                                         std::optional<ShellLevel> shell) {
    for (const auto& representations : representations_)
        if (representations->number == number && representations->level == shell) return representations.get();
    auto representations = std::make_unique<Representations>();
    representations->number = number;
    representations->level = shell;
    representations->volume = number == 0 ? &volume_ : details_[number - 1].volume;
    if (shell) {
        ShellOptions options;
        options.threads = threads_;
        auto hulls = extractShell(*representations->volume, *shell, options);
        // A part may have no group of this level, for example if it has only classes.
        const bool isPart = number > 0 && details_[number - 1].isPart;
        if (!hulls && !(isPart && hulls.error().code() == Code::NothingSelected)) return hulls.error();
        if (hulls) representations->volume = &representations->shell.emplace(std::move(*hulls));
    }
    return representations_.emplace_back(std::move(representations)).get();
}

Result<render::DrawnVolume> ScenePainter::representation(const VolumeRepresentation& wanted,
                                                         const render::FrameSpec& spec,
                                                         std::optional<SurfaceSource> surfaces) {
    return representationOf(0, wanted, surfaces, spec);
}

// The faces of the volume or of a detail; null if it has no meshes. Only those of the volume can be required.
Result<const render::RunSource*> ScenePainter::facesOf(Representations& representations, bool areRequired) {
    const volume::SemanticVolume& volume = *representations.volume;
    const bool isRequired = areRequired && representations.number == 0;
    if (isRequired && makeFaces_ == nullptr)
        return Error(Code::BadArgument, "exact surfaces are not available here; leave out --surfaces exact");
    std::optional<ExactFaces>& faces = representations.faces;
    const bool isMissing = !faces || (isRequired && !faces->source);
    if (isMissing && makeFaces_ != nullptr && (isRequired || !volume.vectors.triangles.empty())) {
        SVT_TRY(made, makeFaces_(volume));
        faces = std::move(*made);
    }
    if (!faces) {
        const auto count = static_cast<std::size_t>(
            std::ranges::count_if(volume.labels.labels, [](const volume::Label& label) { return label.voxels > 0; }));
        faces = ExactFaces{nullptr, count, count};
    }
    return faces->source.get();
}

Painting::Surfaces ScenePainter::countSurfaces() const {
    Painting::Surfaces sum;
    for (const auto& representations : representations_) {
        if (!representations->faces) continue;
        sum.features += representations->faces->features;
        sum.byVoxels += representations->faces->byVoxels;
    }
    return sum;
}

Result<render::DrawnVolume> ScenePainter::representationOf(std::size_t number, const VolumeRepresentation& wanted,
                                                           std::optional<SurfaceSource> surfaces,
                                                           const render::FrameSpec& spec) {
    SVT_TRY(found, findRepresentations(number, wanted.shell));
    Representations& representations = **found;
    const volume::SemanticVolume& volume = *representations.volume;
    const render::RunSource* faces = nullptr;
    if (drawsFaces(surfaces, wanted)) {
        SVT_TRY(made, facesOf(representations, surfaces.has_value()));
        faces = *made;
    }
    const bool isFinest = wanted.hasCells || faces != nullptr;
    const int level = wanted.level.value_or(isFinest ? 0 : render::levelForView(spec, volume.grid));
    if (level > 0) {
        if (const int own = std::min(level, volume::lodLevelCount(volume.grid.dimension())); own > 0) {
            auto known = representations.levels.find(own);
            if (known == representations.levels.end()) {
                Progress::tell(progress_, "prepare", 0);
                SVT_TRY(made, volume::buildLodLevel(volume.columns, volume.grid, own, threads_));
                known = representations.levels.emplace(own, std::move(*made)).first;
            }
            return render::DrawnVolume(known->second);
        }
    }
    std::optional<volume::BrickVolume>& bricks = wanted.hasCells ? representations.cells : representations.bricks;
    if (!bricks) {
        volume::BrickVolume::Options options{
            .faces = volume::BrickFaces::Slopes, .planes = volume.planes, .threads = threads_, .progress = progress_};
        const bool hasSlopes = number == 0 || details_[number - 1].hasSlopes;
        if (wanted.hasCells || !hasSlopes) options = {.faces = volume::BrickFaces::Voxels, .threads = threads_};
        SVT_TRY(made, volume::BrickVolume::fromColumns(volume.columns, options));
        bricks = std::move(*made);
    }
    return render::DrawnVolume(*bricks, volume.grid, faces);
}

void ScenePainter::addDetail(const volume::SemanticVolume& detail) {
    details_.push_back({&detail, placeOfDetail(volume_, detail)});
}

void ScenePainter::addPart(const volume::SemanticVolume& part, bool hasSlopes) {
    details_.push_back({&part, {}, true, hasSlopes});
}

// The volumes that a frame draws: representations of the first, then those of the details, whose passes are added.
Result<std::vector<render::DrawnVolume>> ScenePainter::drawnVolumes(const Scene& scene, render::FrameSpec& spec) {
    std::vector<render::DrawnVolume> drawn;
    const std::vector<VolumeRepresentation> representations = illustrate::volumeRepresentations(scene);
    for (VolumeRepresentation wanted : representations) {
        // A volume that is divided into parts has its shells in the parts.
        if (!details_.empty() && details_.front().isPart) wanted.shell.reset();
        SVT_TRY(made, representation(wanted, spec, scene.surfaces));
        drawn.push_back(*made);
    }
    if (details_.empty()) return drawn;
    std::vector<DetailPlace> places;
    for (std::size_t d = 0; d < details_.size(); ++d) {
        places.push_back(details_[d].place);
        for (const VolumeRepresentation& wanted : representations) {
            VolumeRepresentation own = wanted;
            if (!details_[d].isPart) own.shell.reset();
            SVT_TRY(made, representationOf(d + 1, own, scene.surfaces, spec));
            drawn.push_back(*made);
        }
    }
    SVT_DO(addDetailPasses(places, representations, spec, details_.front().isPart));
    return drawn;
}

Result<void> ScenePainter::showField(const fields::Field* field) {
    field_.reset();
    if (field == nullptr) return {};
    SVT_TRY(view, FieldView::make(*field, volume_));
    field_ = std::make_unique<const FieldView>(std::move(*view));
    return {};
}

Result<ColorScale> ScenePainter::scaleOfField(const Scene& scene) const {
    SVT_DO(checkField(scene));
    if (!scene.field) return Error(Code::BadArgument, "the scene has no field");
    Scene plain = scene;
    plain.field.reset();
    const analyze::LabelRows rows(volume_);
    SVT_TRY(spec, makeFrameSpec(plain, volume_, rows));
    SVT_TRY(paint, field_->paintFrame(scene, rows, *spec));
    return std::move(paint->scale);
}

Result<std::vector<float>> ScenePainter::fieldAt(volume::Scalar label, Vec3d world, Vec3d normal) const {
    if (field_ == nullptr) return Error(Code::BadArgument, "no field is shown");
    std::vector<float> values;
    for (const double seconds : field_->head().times)
        values.push_back(field_->valueAt({label, world, normal}, seconds));
    return values;
}

// Refuses a field that this picture cannot show.
Result<void> ScenePainter::checkField(const Scene& scene) const {
    if (!scene.field) return {};
    const std::string& name = scene.field->name;
    if (!scene.colorBy.empty())
        return Error(Code::BadArgument,
                     fmt::format("the field '{}' and the key '{}' both give colours; leave out --field or --color-by",
                                 name, scene.colorBy));
    if (scene.explode != 0 || !details_.empty())
        return Error(
            Code::BadArgument,
            fmt::format("the field '{}' has its values in one volume as it stands; leave out --explode and --with",
                        name));
    if (field_ == nullptr || field_->name() != name)
        return Error(
            Code::BadArgument,
            fmt::format("the picture shows the field '{}', which is not loaded here; leave out the field, or draw "
                        "the volume (.svt) that has it by svt render",
                        name));
    return {};
}

Result<Painting> ScenePainter::paint(const Scene& scene, const render::CastOptions& options) {
    return paintWith(scene, byCasting(options));
}

Result<ScenePainter*> ScenePainter::apart(double distance) {
    if (distance == 0) return this;
    if (!details_.empty())
        return Error(Code::BadArgument,
                     "storeys can be drawn apart only without further volumes; leave out "
                     "--explode or --with");
    if (!apart_ || apart_->distance != distance) {
        SVT_TRY(lifted, explodeStoreys(volume_, distance, threads_));
        apart_ = std::make_unique<Apart>(distance, std::move(*lifted), threads_);
    }
    apart_->painter.nothing_ = nothing_;
    apart_->painter.makeFaces_ = makeFaces_;
    apart_->painter.progress_ = progress_;
    return &apart_->painter;
}

Result<Painting> ScenePainter::paint(const Scene& scene, const Draw& draw) {
    if (scene.field)
        return Error(Code::BadArgument,
                     fmt::format("only the CPU draws the field '{}'; leave out --gl", scene.field->name));
    if (scene.surfaces == SurfaceSource::Exact)
        return Error(Code::BadArgument, "only the CPU draws exact surfaces; leave out --surfaces exact or --gl");
    Scene voxels = scene;
    voxels.surfaces = SurfaceSource::Voxels;
    return paintWith(voxels, draw);
}

Result<Painting> ScenePainter::paintWith(const Scene& scene, const Draw& draw) {
    SVT_DO(checkField(scene));
    SVT_TRY(painter, apart(scene.explode));
    const Paint paintOne = [&](const Scene& one) { return (*painter)->paintPlain(one, draw); };
    auto painting = paintOne(scene);
    if (!painting) return painting;
    SVT_DO((*painter)->addInsets(scene, paintOne, *painting));
    return painting;
}

// Draws the insets, and marks the parts that they show in the picture: the target of their camera, otherwise everything
// visible in them. An inset that shows most of the picture is an overview; its mark shows the area of the picture.
Result<void> ScenePainter::addInsets(const Scene& scene, const Paint& paint, Painting& painting) const {
    const Vec3f color{0.80f, 0.16f, 0.12f}, halo = textColors(painting.spec.background).halo;
    if (scene.insets.empty()) return {};
    const render::Frame whole = painting.frame;  // the picture without insets
    for (const Inset& inset : scene.insets) {
        SVT_TRY(own, insetScene(scene, inset));
        SVT_TRY(small, paint(*own));
        InsetMarks marks;
        const auto target = targetOf(*own);
        if (inset.hasMark && target)
            marks.inPicture = boxOfSamples(*target, volume_.grid, painting.spec);
        else if (inset.hasMark)
            marks = findMarks(small->frame, small->spec, whole, painting.spec, volume_.grid);
        if (marks.inInset) drawMark(*marks.inInset, color, halo, small->frame.color);
        drawInset(small->frame, insetPlace(scene, inset), marks.inPicture, color, halo, painting.frame);
    }
    return {};
}

// The target box of a named view; empty without a query, or if it selects nothing.
std::optional<analyze::SampleBox> ScenePainter::targetOf(const Scene& scene) const {
    if (scene.camera.around.empty()) return {};
    const auto selected = analyze::selectWithParts(volume_, scene.camera.around);
    if (!selected) return {};
    const auto box = analyze::boxAround(*selected, volume_, "an inset");
    return box ? std::optional(*box) : std::nullopt;
}

Result<Painting> ScenePainter::paintPlain(const Scene& scene, const Draw& draw) {
    SVT_DO(checkSurfaces(scene));
    const analyze::LabelRows rows(volume_, nothing_);
    ColorScale scale;
    SVT_TRY(spec, makeFrameSpec(scene, volume_, rows, &scale));
    const float gaps = mixtures_.empty() ? 0 : seenGaps(*spec, volume_.grid);
    for (render::Pass& pass : spec->passes) mix(mixtures_, spec->background, gaps, pass);
    SVT_TRY(drawn, drawnVolumes(scene, *spec));
    SVT_TRY(painting, finish(scene, rows, std::move(scale), std::move(*spec), *drawn, draw));
    if (scene.surfaces == SurfaceSource::Exact) painting->surfaces = countSurfaces();
    return std::move(*painting);
}

Result<Painting> ScenePainter::paintDraft(const Scene& scene, const render::CastOptions& options) {
    SVT_DO(checkField(scene));
    SVT_TRY(painter, apart(scene.explode));
    const Paint paintOne = [&](const Scene& one) { return (*painter)->draftPlain(one, options); };
    auto painting = paintOne(scene);
    if (!painting) return painting;
    SVT_DO((*painter)->addInsets(scene, paintOne, *painting));
    return painting;
}

Result<Painting> ScenePainter::draftPlain(const Scene& scene, const render::CastOptions& options) {
    const analyze::LabelRows rows(volume_, nothing_);
    ColorScale scale;
    SVT_TRY(spec, makeFrameSpec(scene, volume_, rows, &scale));
    std::vector<render::DrawnVolume> drawn;
    std::vector<std::unique_ptr<volume::BrickVolume>> drafts;
    for (const VolumeRepresentation& wanted : illustrate::volumeRepresentations(scene)) {
        SVT_TRY(representations, findRepresentations(0, wanted.shell));
        const volume::SemanticVolume& volume = *(*representations)->volume;
        SVT_TRY(bricks, volume::BrickVolume::fromColumns(volume.columns,
                                                         {.faces = volume::BrickFaces::Voxels, .threads = threads_}));
        drafts.push_back(std::make_unique<volume::BrickVolume>(std::move(*bricks)));
        drawn.emplace_back(*drafts.back(), volume.grid);
    }
    return finish(scene, rows, std::move(scale), std::move(*spec), drawn, byCasting(options));
}

Result<Painting> ScenePainter::finish(const Scene& scene, const analyze::LabelRows& rows, ColorScale scale,
                                      render::FrameSpec spec, std::span<render::DrawnVolume> drawn,
                                      const Draw& draw) const {
    std::unique_ptr<const render::SurfacePaint> surfaces;
    if (scene.field) {
        SVT_TRY(paint, field_->paintFrame(scene, rows, spec));
        surfaces = std::move(paint->colors);
        scale = std::move(paint->scale);
        for (render::DrawnVolume& volume : drawn) volume.paintBy(surfaces.get());
    }
    SVT_TRY(frame, draw(drawn, spec));
    Painting painting{std::move(*frame), std::move(spec)};
    const TextColors colors = textColors(painting.spec.background);
    auto& image = painting.frame.color;
    if (hasLegend(scene)) drawLegend(scale, colors.text, colors.halo, image);
    if (!scene.title.empty()) drawTitle(scene.title, colors.text, colors.halo, image);
    if (scene.hasScaleBar) drawScaleBar(painting.spec.camera, colors.text, colors.halo, image);
    if (scene.hasNorthArrow)
        drawNorthArrow(painting.spec.camera, drawing::northOf(volume_).direction(), colors.text, colors.halo, image);
    SVT_DO(addNames(scene, volume_, rows, painting));
    return painting;
}

}  // namespace svt::illustrate

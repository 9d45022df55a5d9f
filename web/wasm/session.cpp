#include "session.hpp"

#include "whole.hpp"

#include <svt/analyze/selection.hpp>
#include <svt/illustrate/color_by.hpp>
#include <svt/illustrate/details.hpp>
#include <svt/illustrate/view.hpp>
#include <svt/image/png.hpp>
#include <svt/model/classes.hpp>
#include <svt/render/frame_buffers.hpp>
#include <svt/render/view_ray.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/volume/volume_part.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace svt::web {
namespace {

struct Loaded {
    std::vector<volume::SemanticVolume> volumes;
    std::string spacingReason;
};

// The models as one volume.
Result<void> build(std::span<const NamedBytes> files, const OpenOptions& options, const Progress* progress,
                   Diagnostics& findings, Loaded& into) {
    SVT_TRY(built, buildModels(files, options, progress, findings));
    if (!built->spacingReason.empty()) into.spacingReason = std::move(built->spacingReason);
    into.volumes.push_back(std::move(built->volume));
    return {};
}

Result<Loaded> load(std::span<const NamedBytes> files, const OpenOptions& options, const Progress* progress,
                    Diagnostics& findings) {
    Loaded loaded;
    const bool hasVolumes = std::any_of(files.begin(), files.end(),
                                        [](const NamedBytes& file) { return volume::looksLikeSvt(file.bytes); });
    if (!hasVolumes) {
        SVT_DO(build(files, options, progress, findings, loaded));
        return loaded;
    }
    for (std::size_t n = 0; n < files.size(); ++n) {
        if (!volume::looksLikeSvt(files[n].bytes)) {
            SVT_DO(build(files.subspan(n, 1), options, progress, findings, loaded));
            continue;
        }
        SVT_TRY(volume, volume::readSvt(files[n].bytes, files[n].name));
        loaded.volumes.push_back(std::move(*volume));
    }
    auto& volumes = loaded.volumes;
    SVT_DO(illustrate::joinLabels(volumes.front(), std::span(volumes).subspan(1)));
    return loaded;
}

render::CastOptions castOptions() {
    render::CastOptions options;
    options.isAdaptive = true;
    return options;
}

}  // namespace

Session::Session(std::vector<volume::SemanticVolume> volumes, Diagnostics findings)
    : volume_(std::move(volumes.front())),
      details_(std::make_move_iterator(volumes.begin() + 1), std::make_move_iterator(volumes.end())),
      findings_(std::move(findings)),
      painter_(volume_) {
    for (const volume::SemanticVolume& detail : details_) painter_.addDetail(detail);
    painter_.drawFacesBy(faceMaker());
    labelOfScalar_ = volume_.labels.labelOfScalar();
}

Session::Session(city::JoinedTiles tiles) : volume_(std::move(tiles.frame)), isOfParts_(true), painter_(volume_) {
    painter_.tolerateNothing(&nothing_);
    tiles.addTo(painter_);
    details_ = std::move(tiles.parts);  // the painter refers to the parts themselves, which do not move
    labelOfScalar_ = volume_.labels.labelOfScalar();
}

std::unique_ptr<Session> Session::ofTiles(city::JoinedTiles tiles) {
    return std::unique_ptr<Session>(new Session(std::move(tiles)));
}

const volume::SemanticVolume& Session::volumeOf(std::uint32_t label) const {
    const volume::Label& own = volume_.labels.labels[label];
    for (const volume::SemanticVolume& part : details_) {
        const Vec3i n = part.columns.dimension();
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i)
                for (const auto& run : part.columns.column(i, j))
                    if (run.scalar >= own.first && run.scalar < own.first + own.count) return part;
    }
    return volume_;
}

Result<illustrate::SceneCamera> Session::view(const std::string& query, const std::string& preset,
                                              const illustrate::SceneCamera& now) const {
    if (!isOfParts_ || query.empty()) return illustrate::makeView(query, preset, now, aspect(), volume_);
    SVT_TRY(selected, analyze::selectLabels(volume_, query));
    for (const std::uint32_t label : *selected) {
        const volume::SemanticVolume& part = volumeOf(label);
        if (&part != &volume_) return illustrate::makeView(query, preset, now, aspect(), part, &volume_.grid);
    }
    return Error(Code::NothingSelected, "the selected features are not visible here");
}

std::unique_ptr<Session> Session::around(std::uint32_t label) const {
    const volume::SemanticVolume& part = volumeOf(label);
    if (&part == &volume_) return nullptr;
    const volume::Label& own = volume_.labels.labels[label];
    auto cropped =
        volume::croppedVolume(part, volume::samplesAround(part.columns, own.first, own.first + own.count - 1));
    if (!cropped) return nullptr;
    std::vector<volume::SemanticVolume> volumes;
    volumes.push_back(std::move(*cropped));
    return std::unique_ptr<Session>(new Session(std::move(volumes), {}));
}

Result<std::unique_ptr<Session>> Session::open(std::span<const NamedBytes> files, const OpenOptions& options,
                                               const Progress* progress) {
    Diagnostics findings;
    SVT_TRY(loaded, load(files, options, progress, findings));
    std::unique_ptr<Session> session(new Session(std::move(loaded->volumes), std::move(findings)));
    session->spacingReason_ = std::move(loaded->spacingReason);
    return session;
}

Result<Diagnostics> Session::setOwners(std::string_view table, std::string_view file) {
    if (hasOwners_)
        for (volume::Label& label : volume_.labels.labels)
            if (!label.attributes.empty() && label.attributes.back().name == "owner") label.attributes.pop_back();
    hasOwners_ = false;
    Diagnostics unknown;
    SVT_DO(illustrate::addOwnerAttributes(volume_, table, file, unknown));
    hasOwners_ = true;
    return unknown;
}

volume::Scalar Session::scalarAt(Vec3d point) const {
    const volume::Grid& grid = volume_.grid;
    std::array<std::int32_t, 3> at{};
    for (int axis = 0; axis < 3; ++axis) {
        const double index = dot(point, grid.axes()[static_cast<std::size_t>(axis)]) / grid.spacing()[axis];
        if (!(index > -0.5 && index < grid.dimension()[axis] - 0.5)) return 0;
        at[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(std::floor(index + 0.5));
    }
    return volume_.columns.scalarAt(at[0], at[1], at[2]);
}

bool Session::isInRoom(Vec3d point) const {
    const volume::Scalar scalar = scalarAt(point);
    return scalar != 0 && model::isSpace(volume_.labels.labels[labelOfScalar_[scalar]].className);
}

bool Session::isAir(Vec3d point) const {
    const volume::Scalar scalar = scalarAt(point);
    if (scalar == 0) return true;
    const volume::Label& label = volume_.labels.labels[labelOfScalar_[scalar]];
    if (model::isSpace(label.className) || label.className == "Door" || label.className == "DoorSurface") return true;
    if (!lastSpec_) return false;
    const auto isDrawn = [&](const render::Pass& pass) {
        return scalar < pass.styles.size() && pass.styles[scalar].opacity > 0;
    };
    return std::none_of(lastSpec_->passes.begin(), lastSpec_->passes.end(), isDrawn);
}

Result<const render::Frame*> Session::draw(const illustrate::Scene& scene, bool isDraft) {
    // Parts are not drawn in drafts.
    SVT_TRY(painting,
            isDraft && !isOfParts_ ? painter_.paintDraft(scene, castOptions()) : painter_.paint(scene, castOptions()));
    lastSpec_ = std::move(painting->spec);
    lastRepresentations_ = illustrate::volumeRepresentations(scene);
    lastSurfaces_ = scene.surfaces;
    lastApart_ = scene.explode;
    lastFrame_ = std::move(painting->frame);
    return &*lastFrame_;
}

Result<void> Session::drawGl(const illustrate::Scene& scene, Purpose purpose) {
    SVT_TRY(spec, illustrate::makeFrameSpec(scene, volume_));
    const auto representations = illustrate::volumeRepresentations(scene);
    const int level = representations.front().level.value_or(render::levelForView(*spec, volume_.grid));
    const bool hasMore = !details_.empty() || scene.explode != 0 || scene.sun || !scene.insets.empty() ||
                         representations.front().hasCells || scene.surfaces != illustrate::SurfaceSource::Voxels;
    if (representations.size() != 1 || representations.front().shell || level != 0 || !scene.names.empty() || hasMore)
        return Error(Code::BadArgument,
                     "names, shells, levels of detail, cells, insets, storeys apart, the sun and exact surfaces are "
                     "drawn by the CPU");
    if (!gl_) {
        const auto whole = painter_.representation({{}, 0}, *spec);
        if (!whole) return whole.error();
        SVT_TRY(made, render_gl::GlRenderer::make(whole->bricks(), volume_.grid));
        gl_ = std::move(*made);
    }
    SVT_DO(gl_->draw(*spec));
    if (purpose == Purpose::Trial) return {};
    lastSpec_ = std::move(*spec);
    lastRepresentations_ = representations;
    lastSurfaces_ = scene.surfaces;
    lastApart_ = 0;
    lastFrame_.reset();
    return {};
}

void Session::dropGl() {
    if (!lastFrame_) lastSpec_.reset();
    gl_.reset();
}

double Session::aspect() const noexcept { return lastSpec_ ? double(lastSpec_->width) / lastSpec_->height : 16.0 / 9; }

Result<std::vector<std::byte>> Session::picture(const illustrate::Scene& scene) {
    SVT_TRY(painting, painter_.paint(scene, castOptions()));
    return image::encodePng(painting->frame.color);
}

Result<std::vector<std::byte>> Session::labels(const illustrate::Scene& scene) {
    SVT_TRY(painting, painter_.paint(scene, castOptions()));
    SVT_TRY(gray, render::grayFromLabels(painting->frame.label));
    return image::encodePng(*gray);
}

std::optional<Picked> Session::pick(double x, double y) {
    if (!lastSpec_ || !(x >= 0 && x <= 1) || !(y >= 0 && y <= 1)) return {};
    const auto [width, height] = std::pair(lastSpec_->width, lastSpec_->height);
    const auto column = std::min(width - 1, static_cast<std::int32_t>(x * width));
    const auto row = std::min(height - 1, static_cast<std::int32_t>(y * height));
    // Label and depth are those at the centre of the pixel.
    const auto ray = render::viewRay(*lastSpec_, volume_.grid, (column + 0.5) / width, (row + 0.5) / height);
    const auto first = firstAt(column, row);
    if (!isSeenThrough(first.label)) return pickedAt(first, ray);
    auto behind = behindGlass(ray, true);
    // Behind the air of a room is only glass, which is the object that a person sees.
    if (behind && model::isSpace(volume_.labels.labels[behind->label].className))
        if (auto glass = behindGlass(ray, false)) return glass;
    return behind ? behind : pickedAt(first, ray);
}

render_gl::PickedPixel Session::firstAt(std::int32_t column, std::int32_t row) {
    if (lastFrame_) return {lastFrame_->label.at(column, row), lastFrame_->depth.at(column, row)};
    const auto seen = gl_->pick(*lastSpec_, column, row);
    return seen ? *seen : render_gl::PickedPixel{};
}

bool Session::isSeenThrough(volume::Scalar scalar) const {
    const auto isGlass = [&](const render::Pass& pass) {
        return scalar < pass.styles.size() && pass.styles[scalar].opacity > 0 && pass.styles[scalar].opacity < 1;
    };
    return scalar != 0 && std::any_of(lastSpec_->passes.begin(), lastSpec_->passes.end(), isGlass);
}

// Casts only this ray. Its clips are those of the picture: regions of the picture, such as a lens, are cones in space.
std::optional<Picked> Session::behindGlass(const render::ViewRay& ray, bool hasSpaces) {
    render::FrameSpec spec = *lastSpec_;
    for (render::Pass& pass : spec.passes) {
        pass.lines.clear();
        for (std::size_t scalar = 0; !hasSpaces && scalar < pass.styles.size(); ++scalar) {
            const std::uint32_t label = scalar < labelOfScalar_.size() ? labelOfScalar_[scalar] : volume::kNoLabel;
            if (label != volume::kNoLabel && model::isSpace(volume_.labels.labels[label].className))
                pass.styles[scalar].opacity = 0;
        }
    }
    spec.width = spec.height = spec.samplesPerPixel = 1;
    spec.light.ambientOcclusion = 0;
    spec.light.hasShadows = false;
    render::Camera& camera = spec.camera;
    const bool isUpright = length(cross(ray.direction, camera.up)) > 1e-6 * length(ray.direction);
    if (!isUpright) camera.up = {camera.up.y, camera.up.z, camera.up.x};
    camera.eye = ray.origin;
    camera.target = ray.origin + ray.direction;
    camera.verticalFovDegrees = 0.001;
    camera.orthographicHeight = 1e-4;
    const auto painter = painter_.apart(lastApart_);
    if (!painter) return {};
    std::vector<render::DrawnVolume> drawn;
    for (const illustrate::VolumeRepresentation& wanted : lastRepresentations_) {
        const auto made = (*painter)->representation(wanted, *lastSpec_, lastSurfaces_);
        if (!made) return {};
        drawn.push_back(*made);
    }
    render::CastOptions options;
    options.labelAt = 0.5f;
    const auto frame = render::castRays(drawn, spec, options);
    if (!frame) return {};
    return pickedAt({frame->label.at(0, 0), frame->depth.at(0, 0)}, render::viewRay(spec, volume_.grid, 0.5, 0.5));
}

std::optional<Picked> Session::pickedAt(const render_gl::PickedPixel& pixel, const render::ViewRay& ray) const {
    const volume::Scalar scalar = pixel.label;
    if (scalar == 0 || scalar >= labelOfScalar_.size() || labelOfScalar_[scalar] == volume::kNoLabel ||
        !std::isfinite(pixel.depth))
        return {};
    return Picked{scalar, labelOfScalar_[scalar],
                  ray.origin + ray.direction * double(pixel.depth) - volume_.grid.origin()};
}

Result<std::vector<render::LabelInterval>> Session::along(double x, double y) {
    if (!lastSpec_) return std::vector<render::LabelInterval>{};
    SVT_TRY(painter, painter_.apart(lastApart_));
    const auto whole = (*painter)->representation({{}, 0}, *lastSpec_);
    if (!whole) return whole.error();
    const auto ray = render::viewRay(*lastSpec_, whole->grid(), x, y);
    return render::labelsAlong(whole->bricks(), whole->grid(), volume_.labels, ray.origin, ray.direction);
}

const std::vector<analyze::Contact>& Session::contacts() {
    if (!contacts_) contacts_ = analyze::findContacts(volume_.columns, volume_.grid, volume_.labels);
    return *contacts_;
}

const std::vector<analyze::Measure>& Session::measures() {
    if (!measures_) measures_ = analyze::measureLabels(volume_, contacts());
    return *measures_;
}

const std::vector<double>& Session::floorAreas() {
    if (!floorAreas_) {
        auto areas = illustrate::areasFor("area", volume_);
        floorAreas_ = areas ? std::move(*areas) : std::vector<double>();
    }
    return *floorAreas_;
}

}  // namespace svt::web

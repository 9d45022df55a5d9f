#include "session.hpp"

#include <svt/image/png.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/render/frame_buffers.hpp>
#include <svt/render/view_ray.hpp>
#include <svt/volume/svt_file.hpp>

#include <algorithm>
#include <cmath>

namespace svt::web {
namespace {

Result<volume::SemanticVolume> load(std::span<const std::byte> bytes, const std::string& name, const Progress* progress,
                                    Diagnostics& findings) {
    if (volume::looksLikeSvt(bytes)) return volume::readSvt(bytes, name);
    readers::ReadOptions reading;
    reading.progress = progress;
    auto model = readers::readModel(bytes, name, reading, &findings);
    if (!model) return model.error();
    pipeline::BuildOptions building;
    building.vectors = {.edges = true, .meshes = true, .isRequired = false};
    building.progress = progress;
    auto output = pipeline::buildVolume(*model, building, &findings);
    if (!output) return output.error();
    return std::move(output->volume);
}

render::CastOptions castOptions() {
    render::CastOptions options;
    options.isAdaptive = true;
    return options;
}

}  // namespace

Result<std::unique_ptr<Session>> Session::open(std::span<const std::byte> bytes, const std::string& name,
                                               const Progress* progress) {
    Diagnostics findings;
    auto volume = load(bytes, name, progress, findings);
    if (!volume) return volume.error();
    std::unique_ptr<Session> session(new Session(std::move(*volume), std::move(findings)));
    session->labelOfScalar_ = session->volume_.labels.labelOfScalar();
    return session;
}

Result<const render::Frame*> Session::draw(const illustrate::Scene& scene, bool isDraft) {
    auto painting = isDraft ? painter_.paintDraft(scene, castOptions()) : painter_.paint(scene, castOptions());
    if (!painting) return painting.error();
    lastSpec_ = std::move(painting->spec);
    lastForms_ = illustrate::volumeForms(scene);
    lastApart_ = scene.explode;
    lastFrame_ = std::move(painting->frame);
    return &*lastFrame_;
}

Result<void> Session::drawGl(const illustrate::Scene& scene, Purpose purpose) {
    auto spec = illustrate::makeFrameSpec(scene, volume_);
    if (!spec) return spec.error();
    const auto forms = illustrate::volumeForms(scene);
    const int level = forms.front().level.value_or(render::levelForView(*spec, volume_.grid));
    const bool hasMore = scene.explode != 0 || scene.sun || !scene.insets.empty() || forms.front().hasCells;
    if (forms.size() != 1 || forms.front().shell || level != 0 || !scene.names.empty() || hasMore)
        return Error(Code::BadArgument,
                     "names, shells, levels of detail, cells, insets, storeys apart and the sun are drawn by the CPU");
    if (!gl_) {
        const auto whole = painter_.form({{}, 0}, *spec);
        if (!whole) return whole.error();
        auto made = render_gl::GlRenderer::make(whole->bricks(), volume_.grid);
        if (!made) return made.error();
        gl_ = std::move(*made);
    }
    if (auto drawn = gl_->draw(*spec); !drawn) return drawn;
    if (purpose == Purpose::Trial) return {};
    lastSpec_ = std::move(*spec);
    lastForms_ = forms;
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
    const auto painting = painter_.paint(scene, castOptions());
    if (!painting) return painting.error();
    return image::encodePng(painting->frame.color);
}

Result<std::vector<std::byte>> Session::labels(const illustrate::Scene& scene) {
    const auto painting = painter_.paint(scene, castOptions());
    if (!painting) return painting.error();
    const auto gray = render::grayFromLabels(painting->frame.label);
    if (!gray) return gray.error();
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
    if (isSeenThrough(first.label))
        if (auto behind = behindGlass(ray)) return behind;
    return pickedAt(first, ray);
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

// Casts the ray alone. Its clips are those of the picture: regions of the picture, such as a lens, are cones in space.
std::optional<Picked> Session::behindGlass(const render::ViewRay& ray) {
    render::FrameSpec spec = *lastSpec_;
    for (render::Pass& pass : spec.passes) pass.lines.clear();
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
    for (const illustrate::VolumeForm& wanted : lastForms_) {
        const auto made = (*painter)->form(wanted, *lastSpec_);
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
    const auto painter = painter_.apart(lastApart_);
    if (!painter) return painter.error();
    const auto whole = (*painter)->form({{}, 0}, *lastSpec_);
    if (!whole) return whole.error();
    const auto ray = render::viewRay(*lastSpec_, whole->grid(), x, y);
    return render::labelsAlong(whole->bricks(), whole->grid(), volume_.labels, ray.origin, ray.direction);
}

const std::vector<analyze::Contact>& Session::contacts() {
    if (!contacts_) contacts_ = analyze::findContacts(volume_.columns, volume_.grid, volume_.labels);
    return *contacts_;
}

const std::vector<analyze::LabelMeasure>& Session::measures() {
    if (!measures_) measures_ = analyze::measureLabels(volume_, contacts());
    return *measures_;
}

}  // namespace svt::web

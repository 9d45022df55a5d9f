#include "session.hpp"

#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/render/png.hpp>
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
    building.vectors.edges = true;
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
    if (const auto bricks = session->painter_.bricks(); !bricks) return bricks.error();
    return session;
}

Result<const render::Frame*> Session::draw(const illustrate::Scene& scene) {
    auto painting = painter_.paint(scene, castOptions());
    if (!painting) return painting.error();
    last_ = std::move(*painting);
    return &last_->frame;
}

double Session::aspect() const noexcept { return last_ ? double(last_->spec.width) / last_->spec.height : 16.0 / 9; }

Result<std::vector<std::byte>> Session::picture(const illustrate::Scene& scene) {
    const auto painting = painter_.paint(scene, castOptions());
    if (!painting) return painting.error();
    return render::encodePng(painting->frame.color);
}

Result<std::vector<std::byte>> Session::labels(const illustrate::Scene& scene) {
    const auto painting = painter_.paint(scene, castOptions());
    if (!painting) return painting.error();
    const auto gray = render::grayFromLabels(painting->frame.label);
    if (!gray) return gray.error();
    return render::encodePng(*gray);
}

std::optional<Picked> Session::pick(double x, double y) const {
    if (!last_ || !(x >= 0 && x <= 1) || !(y >= 0 && y <= 1)) return {};
    const auto& labels = last_->frame.label;
    const auto column = std::min(labels.width() - 1, static_cast<std::int32_t>(x * labels.width()));
    const auto row = std::min(labels.height() - 1, static_cast<std::int32_t>(y * labels.height()));
    const volume::Scalar scalar = labels.at(column, row);
    const float depth = last_->frame.depth.at(column, row);
    if (scalar == 0 || scalar >= labelOfScalar_.size() || labelOfScalar_[scalar] == volume::kNoLabel ||
        !std::isfinite(depth))
        return {};
    // The depth is that of the pixel's centre.
    const auto ray =
        render::viewRay(last_->spec, volume_.grid, (column + 0.5) / labels.width(), (row + 0.5) / labels.height());
    return Picked{scalar, labelOfScalar_[scalar], ray.origin + ray.direction * double(depth) - volume_.grid.origin()};
}

Result<std::vector<render::RayStretch>> Session::along(double x, double y) {
    if (!last_) return std::vector<render::RayStretch>{};
    const auto bricks = painter_.bricks();
    if (!bricks) return bricks.error();
    const auto ray = render::viewRay(last_->spec, volume_.grid, x, y);
    return render::labelsAlong(**bricks, volume_.grid, volume_.labels, ray.origin, ray.direction);
}

const std::vector<volume::Contact>& Session::contacts() {
    if (!contacts_) contacts_ = volume::contactsOf(volume_.columns, volume_.grid, volume_.labels);
    return *contacts_;
}

const std::vector<volume::LabelMeasure>& Session::measures() {
    if (!measures_) measures_ = volume::measureLabels(volume_, contacts());
    return *measures_;
}

}  // namespace svt::web

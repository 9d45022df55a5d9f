#include "volume_object.hpp"

#include <svt/fields/svt_fields.hpp>

#include <numeric>

namespace svt::python {

Result<const volume::BrickVolume*> VolumeObject::bricks(const Progress* progress) {
    const std::lock_guard lock(making_);
    if (!bricks_) {
        SVT_TRY(made, volume::BrickVolume::fromColumns(
                          volume_.columns,
                          {.faces = volume::BrickFaces::Slopes, .planes = volume_.planes, .progress = progress}));
        bricks_ = std::move(*made);
    }
    return &*bricks_;
}

const VolumeObject::Measures& VolumeObject::measures() {
    const std::lock_guard lock(making_);
    if (!measures_) {
        Measures made;
        made.contacts = analyze::findContacts(volume_.columns, volume_.grid, volume_.labels);
        made.labels = analyze::measureLabels(volume_, made.contacts);
        std::vector<std::uint32_t> all(made.labels.size());
        std::iota(all.begin(), all.end(), 0U);
        const analyze::Extents extents(volume_.labels);
        made.features = analyze::measureFeatures(extents, all, made.labels, made.contacts);
        const analyze::KnownVolumes volumes(volume_.labels, volume_.grid, extents);
        for (const std::uint32_t label : all) made.volumes.push_back(volumes.of(label));
        const auto areas = analyze::meshAreas(volume_);
        for (const std::uint32_t label : all)
            made.faces.push_back(analyze::faceAreas(volume_.labels, extents.of(label), areas));
        measures_ = std::move(made);
    }
    return *measures_;
}

Result<illustrate::Painting> VolumeObject::paint(const illustrate::Scene& scene, const render::CastOptions& options,
                                                 std::vector<std::string>& notes) {
    const std::lock_guard lock(painting_);
    if (!painter_) painter_.emplace(volume_);
    painter_->drawFacesBy(illustrate::makeFaces);
    std::optional<fields::Field> field;
    if (scene.field && !path_.empty()) {
        SVT_TRY(read, fields::readField(path_, scene.field->name));
        field = std::move(*read);
        SVT_DO(painter_->showField(&*field));
    }
    painter_->tolerateNothing(&notes);
    painter_->reportTo(options.progress);
    auto painting = painter_->paint(scene, options);
    painter_->tolerateNothing(nullptr);
    painter_->reportTo(nullptr);
    if (painting)
        if (std::string text = painting->surfaces.note(); !text.empty()) notes.push_back(std::move(text));
    if (field) SVT_DO(painter_->showField(nullptr));
    return painting;
}

}  // namespace svt::python

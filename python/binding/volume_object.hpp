#pragma once
/// \file
/// A volume in Python: the volume itself, which never changes, and data derived from it on first use.

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/extents.hpp>
#include <svt/analyze/face_areas.hpp>
#include <svt/analyze/known_volumes.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/analyze/selection.hpp>
#include <svt/core/diagnostics.hpp>
#include <svt/illustrate/scene_painter.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace svt::python {

/// Shared by all Python objects that refer to the volume. Safe to use from several threads. Calls that derive data
/// must not hold the GIL, because they wait for each other.
class VolumeObject {
public:
    /// \param from  the `.svt` of the volume; empty without one
    explicit VolumeObject(volume::SemanticVolume made, Diagnostics found = {}, std::filesystem::path from = {})
        : volume_(std::move(made)), findings_(std::move(found)), path_(std::move(from)) {}
    VolumeObject(const VolumeObject&) = delete;
    VolumeObject& operator=(const VolumeObject&) = delete;

    [[nodiscard]] const volume::SemanticVolume& volume() const noexcept { return volume_; }
    [[nodiscard]] const Diagnostics& findings() const noexcept { return findings_; }
    /// The `.svt` of the volume, which has its fields; empty without one.
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
    [[nodiscard]] const volume::Label& label(std::uint32_t index) const noexcept {
        return volume_.labels.labels[index];
    }

    /// Bricks with the planes of the model. Cost: BrickVolume::fromColumns() once.
    [[nodiscard]] Result<const volume::BrickVolume*> bricks(const Progress* progress);

    struct Measures {
        std::vector<analyze::Contact> contacts;
        std::vector<analyze::Measure> labels;
        std::vector<analyze::FeatureMeasure> features;  ///< by label: own, and with its parts
        std::vector<analyze::KnownVolume> volumes;      ///< by label, with its parts
        std::vector<std::array<std::optional<double>, 5>>
            faces;  ///< by label, with its parts; see analyze::faceAreas()
    };
    /// Contacts and areas of all labels. Cost: analyze::findContacts() once.
    [[nodiscard]] const Measures& measures();

    /// Draws a picture; one at a time. Reads the field of the scene from path().
    /// \param notes  gets queries that select nothing, and features that voxels show in spite of exact surfaces
    [[nodiscard]] Result<illustrate::Painting> paint(const illustrate::Scene& scene, const render::CastOptions& options,
                                                     std::vector<std::string>& notes);

private:
    const volume::SemanticVolume volume_;
    const Diagnostics findings_;
    const std::filesystem::path path_;
    std::mutex making_, painting_;
    std::optional<volume::BrickVolume> bricks_;
    std::optional<Measures> measures_;
    std::optional<illustrate::ScenePainter> painter_;
};

using SharedVolume = std::shared_ptr<VolumeObject>;

}  // namespace svt::python

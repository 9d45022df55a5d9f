#pragma once
/// \file
/// Measures of labels: voxels, volume, bounding box, surface area.

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/scalar_boxes.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace svt::analyze {

/// Measures of a label's own voxels, or of the voxels of several labels.
struct Measure {
    std::uint64_t voxels = 0;
    std::optional<double> volume;  ///< m3; empty: unknown, because there is no solid, only sheets or nothing
    double countedVolume = 0;      ///< m3: the part of the volume that is counted in voxels; the rest is that of solids
    Box3d box;                     ///< of its mesh, or of its voxels (see labelWorldBoxes()); world axes, metres
    double area = 0;               ///< m2: the sum over contacts
    double outsideArea = 0;        ///< m2: the part of `area` in contact with background

    /// Adds voxels, volume and box of a label that is not contained yet. Areas do not add up: contacts become inner.
    void add(const Measure& other) noexcept {
        if (other.volume) volume = volume.value_or(0) + *other.volume;
        countedVolume += other.countedVolume;
        voxels += other.voxels;
        box.add(other.box);
    }
    friend bool operator==(const Measure&, const Measure&) = default;
};

/// Voxels and volume of each label; entry l is label l. If the label lost no voxels to others (see
/// LabelTable::overlaps), the volume is that of its solid. Otherwise it is the volume of its own voxels and of the
/// sheets that bound it, which lie inside: a room without its furniture, a flat without its rooms. So the volumes of all
/// labels are parts of space that do not overlap.
[[nodiscard]] std::vector<Measure> ownMeasures(const volume::LabelTable& labels, const volume::Grid& grid);

/// ownMeasures() with boxes (see labelWorldBoxes()) and areas.
/// \param contacts  of the whole volume, see findContacts(); empty: areas are 0
/// Cost: that of labelWorldBoxes().
[[nodiscard]] std::vector<Measure> measureLabels(const volume::SemanticVolume& volume,
                                                 const std::vector<Contact>& contacts);

/// The volume of the closed solid that the model has for the feature itself, m3; empty without one.
[[nodiscard]] std::optional<double> solidVolumeOf(const volume::Label& label) noexcept;

/// The volumes of ownMeasures(), m3; 0 where unknown.
[[nodiscard]] std::vector<double> ownVolumes(const volume::LabelTable& labels, const volume::Grid& grid);

/// Volume of a label's solid, m3. A label without a solid has the sum of the solids below it in the tree; 0: there are
/// none. For coarse tiles of cities, in which the volume of a building includes its classes; see Measure otherwise.
[[nodiscard]] double solidVolume(const volume::LabelTable& labels, std::uint32_t label) noexcept;

/// The box of each label itself, along world axes, metres; entry l is label l. It is that of its mesh if the volume keeps
/// one, however thin the part is and whatever voxels it lost; otherwise that of its voxels. The material behind a
/// boundary surface (volume::Filling::Body) has no mesh: its box is that of surface and voxels. Empty without both.
/// Cost: O(triangles), and that of labelBoxes() if a label has no mesh.
[[nodiscard]] std::vector<Box3d> labelWorldBoxes(const volume::SemanticVolume& volume);

/// The box around the voxels of `box`, along world axes, metres; empty if `box` is.
[[nodiscard]] Box3d worldBox(const SampleBox& box, const volume::Grid& grid) noexcept;

}  // namespace svt::analyze

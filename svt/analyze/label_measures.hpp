#pragma once
/// \file
/// Measures of each label: bounding box, surface area, volume.

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/scalar_boxes.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <vector>

namespace svt::analyze {

/// Measures of a label's own voxels, without those of features below it in the tree.
struct LabelMeasure {
    SampleBox box;           ///< empty if it has no voxels
    double area = 0;         ///< m2: the sum over its contacts
    double outsideArea = 0;  ///< m2: the part of `area` in contact with background
    friend bool operator==(const LabelMeasure&, const LabelMeasure&) = default;
};

/// Measures all labels; entry l is label l.
/// \param contacts  of the whole volume, see findContacts()
/// Cost: that of scalarBoxes().
[[nodiscard]] std::vector<LabelMeasure> measureLabels(const volume::SemanticVolume& volume,
                                                      const std::vector<Contact>& contacts);

/// Volume of each label, m3; entry l is label l. If the label lost no voxels to others (see LabelTable::overlaps), it
/// is the exact volume of its solid. Otherwise it is the volume of its own voxels: a room without its furniture, a flat
/// without its rooms. 0 for sheets.
[[nodiscard]] std::vector<double> ownVolumes(const volume::LabelTable& labels, const volume::Grid& grid);

/// Volume of a label's solid, m3. A label without a solid has the sum of the solids below it in the tree; 0: there are
/// none.
[[nodiscard]] double solidVolume(const volume::LabelTable& labels, std::uint32_t label) noexcept;

/// The box around the voxels of `box`, along world axes, metres; empty if `box` is.
[[nodiscard]] Box3d worldBox(const SampleBox& box, const volume::Grid& grid) noexcept;

}  // namespace svt::analyze

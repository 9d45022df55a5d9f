#pragma once
/// \file
/// What a volume says of each label: where it is and how large its surface is.

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/scalar_boxes.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <vector>

namespace svt::analyze {

/// Of a label's own voxels; those of features below it do not count.
struct LabelMeasure {
    SampleBox box;           ///< empty where it has no voxels
    double area = 0;         ///< m2: the sum over its contacts
    double outsideArea = 0;  ///< m2 of it that meet background
    friend bool operator==(const LabelMeasure&, const LabelMeasure&) = default;
};

/// Entry l is label l.
/// \param contacts  those of the whole volume
/// Cost: that of scalarBoxes.
[[nodiscard]] std::vector<LabelMeasure> measureLabels(const volume::SemanticVolume& volume,
                                                      const std::vector<Contact>& contacts);

/// m3 that each label has for itself; entry l is label l. That of its solid, which is exact, where it lost no voxels to
/// others (see LabelTable::overlaps); else by its voxels: a room without its furniture, a flat without its rooms. None
/// for sheets.
[[nodiscard]] std::vector<double> ownVolumes(const volume::LabelTable& labels, const volume::Grid& grid);

/// The world-axis box around the voxels of `box`, metres; empty where it is.
[[nodiscard]] Box3d worldBox(const SampleBox& box, const volume::Grid& grid) noexcept;

}  // namespace svt::analyze

#pragma once
/// \file
/// Measures of the features of one volume, each with its extent: the rows of `svt query` for cities.

#include <svt/analyze/extents.hpp>
#include <svt/drawing/section_plane.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::city {

/// A feature. All but `measure.own` is of its extent: the feature with its parts, see analyze::Extents.
struct FeatureRow {
    std::uint32_t label = 0;
    analyze::FeatureMeasure measure;             ///< without boxes and areas
    double area = 0;                             ///< m2 in plan: of the columns of samples that it fills
    double lowest = 0, highest = 0;              ///< of its voxels, metres above datum; meaningless without voxels
    bool isOpen = false;                         ///< its shell, or one of a part, is not closed in the model
    bool isCut = false;                          ///< by the plane
    std::vector<std::array<double, 2>> outline;  ///< convex, around its voxels in plan; counter-clockwise
};

/// Whether the shell of a solid is open in the model, and was nevertheless closed or filled.
[[nodiscard]] bool isOpenShell(const volume::Label& label) noexcept;

/// \param selected  labels, ascending
/// \param plane     cutting plane, at the accuracy of voxels; null: none
/// Cost: O(columns + runs * selected features that share a label + labels of all extents)
[[nodiscard]] std::vector<FeatureRow> featureRows(const volume::SemanticVolume& volume,
                                                  std::span<const std::uint32_t> selected,
                                                  const drawing::SectionPlane* plane);

}  // namespace svt::city

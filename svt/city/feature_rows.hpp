#pragma once
/// \file
/// Measures of the features of one volume, each with its extent: the rows of `svt query` for cities.

#include <svt/analyze/known_volumes.hpp>
#include <svt/drawing/footprints.hpp>
#include <svt/drawing/section_plane.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::city {

/// A feature. All but `measure.own` is of its extent: the feature with its parts, see analyze::Extents.
struct FeatureRow {
    std::uint32_t label = 0;
    analyze::FeatureMeasure measure;  ///< without boxes and areas
    analyze::KnownVolume volume;
    double area = 0;                 ///< m2 in plan: that of the footprint
    double lowest = 0, highest = 0;  ///< of its box, metres above datum; meaningless without voxels
    bool isOpen = false;             ///< its shell, or one of a part, is not closed in the model
    bool isCut = false;              ///< by the plane
    drawing::Footprint footprint;
    drawing::Footprint roof;  ///< on request
};

struct FeatureRowOptions {
    const drawing::SectionPlane* plane = nullptr;  ///< cutting plane, at the accuracy of voxels; null: none
    bool hasRoofs = false;                         ///< roof outlines as well
    int threads = 0;
};

/// Whether the shell of a solid is open in the model, and was nevertheless closed or filled.
[[nodiscard]] bool isOpenShell(const volume::Label& label) noexcept;

/// \param selected  labels, ascending
/// Cost: O(columns + runs * selected features that share a label + labels of all extents), and that of
/// drawing::Footprints. The result does not depend on the threads.
[[nodiscard]] std::vector<FeatureRow> featureRows(const volume::SemanticVolume& volume,
                                                  std::span<const std::uint32_t> selected,
                                                  const FeatureRowOptions& options = {});

}  // namespace svt::city

#pragma once
/// \file
/// Labels of a volume as rows of a query; what is selected, and where it is.

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/model/query.hpp>
#include <svt/volume/label_table.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <string_view>
#include <vector>

namespace svt::analyze {

/// Row i is label i. Views into `labels`, which must outlive the rows.
[[nodiscard]] std::vector<model::QueryRow> rowsOf(const volume::LabelTable& labels);

/// Labels that `text` selects, or BadQuery, or NothingSelected with the nearest existing value.
[[nodiscard]] Result<std::vector<std::uint32_t>> selectLabels(const volume::LabelTable& labels, std::string_view text);

/// The box around all voxels of `labels`.
/// \param what  names them in the message
/// \return the box, or NothingSelected where they have none
[[nodiscard]] Result<SampleBox> boxAround(const std::vector<std::uint32_t>& labels,
                                          const volume::SemanticVolume& volume, std::string_view what);

}  // namespace svt::analyze

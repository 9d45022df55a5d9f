#pragma once
/// \file
/// Queries on the labels of a volume: the rows that they read, the labels that they select, and the box around these.

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/model/query.hpp>
#include <svt/volume/label_table.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <string_view>
#include <vector>

namespace svt::analyze {

/// The labels as rows for model::Query; row i is label i. The rows refer to `labels`, which must outlive them.
[[nodiscard]] std::vector<model::QueryRow> queryRows(const volume::LabelTable& labels);

/// Labels that the query `text` selects.
/// \return the labels, or BadQuery, or NothingSelected; the latter names the nearest existing value
[[nodiscard]] Result<std::vector<std::uint32_t>> selectLabels(const volume::LabelTable& labels, std::string_view text);

/// The box around all voxels of `labels`.
/// \param what  describes them in the message
/// \return the box, or NothingSelected if they have no voxels
[[nodiscard]] Result<SampleBox> boxAround(const std::vector<std::uint32_t>& labels,
                                          const volume::SemanticVolume& volume, std::string_view what);

}  // namespace svt::analyze

#pragma once
/// \file
/// Features as rows for queries: from a model, or from the label table of a volume.

#include <svt/model/building_model.hpp>
#include <svt/model/query.hpp>
#include <svt/volume/label_table.hpp>

#include <vector>

namespace svt::pipeline {

/// Row i is label i. Views into `labels`, which must outlive the rows.
[[nodiscard]] std::vector<model::QueryRow> rowsOf(const volume::LabelTable& labels);

/// Labels that `text` selects, or BadQuery, or NothingSelected with the nearest existing value.
[[nodiscard]] Result<std::vector<std::uint32_t>> selectLabels(const volume::LabelTable& labels, std::string_view text);

}  // namespace svt::pipeline

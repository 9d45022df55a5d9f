#pragma once
/// \file
/// Labels of a volume as rows of a query.

#include <svt/model/query.hpp>
#include <svt/volume/label_table.hpp>

#include <cstdint>
#include <string_view>
#include <vector>

namespace svt::illustrate {

/// Row i is label i. Views into `labels`, which must outlive the rows.
[[nodiscard]] std::vector<model::QueryRow> rowsOf(const volume::LabelTable& labels);

/// Labels that `text` selects, or BadQuery, or NothingSelected with the nearest existing value.
[[nodiscard]] Result<std::vector<std::uint32_t>> selectLabels(const volume::LabelTable& labels, std::string_view text);

}  // namespace svt::illustrate

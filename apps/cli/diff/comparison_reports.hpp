#pragma once
/// \file
/// A comparison of two volumes as a table and as JSON.

#include <apps/cli/diff/compared.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/table.hpp>

#include <span>

namespace svt::cli {

/// One row per object and per group.
/// \param hasAll          false: only rows that differ
/// \param mostProperties  maximum number of names in the column of other properties; further ones are counted
[[nodiscard]] Table comparisonTable(const Compared& compared, bool hasAll, std::size_t mostProperties = 1000);

/// rows and summary, see docs/user/json.md.
[[nodiscard]] Json comparisonJson(const Compared& compared);

/// Parts of this JSON: the rows, and the sums of the classes. \param hasAll  false: only rows that differ
[[nodiscard]] Json rowsJson(const Compared& compared, bool hasAll);
[[nodiscard]] Json classesJson(std::span<const ClassSums> classes);

}  // namespace svt::cli

#pragma once
/// \file
/// A comparison of two volumes as a table, and its JSON.

#include <apps/cli/diff/compared.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/table.hpp>

#include <svt/frontend/comparison_json.hpp>

namespace svt::cli {

/// One row per object and per group.
/// \param hasAll          false: only rows that differ
/// \param mostProperties  maximum number of names in the column of other properties; further ones are counted
[[nodiscard]] Table comparisonTable(const Compared& compared, bool hasAll, std::size_t mostProperties = 1000);

using frontend::classesJson, frontend::comparisonFile, frontend::comparisonJson, frontend::propertiesJson,
    frontend::rowsJson;

}  // namespace svt::cli

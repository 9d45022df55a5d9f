#pragma once
/// \file
/// A comparison of two volumes as a table, as JSON, and in words.

#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/table.hpp>

#include <svt/compare/comparison.hpp>

namespace svt::cli {

/// Two volumes and their comparison.
struct Compared {
    const volume::SemanticVolume &was, &is;
    const compare::Comparison& comparison;
};

/// One row per object and per group.
/// \param hasAll          false: only rows that differ
/// \param mostProperties  maximum number of names in the column of other properties; further ones are counted
[[nodiscard]] Table comparisonTable(const Compared& compared, bool hasAll, std::size_t mostProperties = 1000);

/// rows and summary, see docs/user/json.md.
[[nodiscard]] Json comparisonJson(const Compared& compared);

/// "3 changed, 1 removed, 41 same; 2 with other properties"
[[nodiscard]] std::string comparisonSummary(const Compared& compared);

}  // namespace svt::cli

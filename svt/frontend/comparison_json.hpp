#pragma once
/// \file
/// A comparison of two volumes as JSON. Stable; described in docs/user/json.md.

#include <svt/compare/compared.hpp>
#include <svt/record/record.hpp>

#include <span>
#include <string>

namespace svt::frontend {

using record::Json;

/// rows and summary, as `svt diff --json` prints them.
[[nodiscard]] Json comparisonJson(const compare::Compared& compared);

/// Parts of this JSON: the rows, and the sums of the classes. \param hasAll  false: only rows that differ
[[nodiscard]] Json rowsJson(const compare::Compared& compared, bool hasAll);
[[nodiscard]] Json classesJson(std::span<const compare::ClassSums> classes);
/// The numbers of rows with another class, name, storey, and with other attributes.
[[nodiscard]] Json propertiesJson(const compare::PropertyCounts& counts);

/// The comparison as a file, byte for byte what `svt diff -o F.json` writes. Invalid UTF-8 is replaced.
[[nodiscard]] std::string comparisonFile(const compare::Compared& compared);

}  // namespace svt::frontend

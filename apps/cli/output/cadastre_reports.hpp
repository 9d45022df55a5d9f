#pragma once
/// \file
/// Reports of `svt cadastre`: legal units, their owners and relations, as text, JSON and CSV.

#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/table.hpp>

#include <svt/analyze/land_administration.hpp>
#include <svt/volume/semantic_volume.hpp>

namespace svt::cli {

/// Pairs of legal units: overlaps, shared faces, gaps.
[[nodiscard]] Table relationTable(const analyze::LandAdministration& all, const volume::SemanticVolume& volume);
[[nodiscard]] Json cadastreJson(const analyze::LandAdministration& all, const volume::SemanticVolume& volume);
/// Prints units with owners, then relations.
void printCadastre(const analyze::LandAdministration& all, const volume::SemanticVolume& volume);

}  // namespace svt::cli

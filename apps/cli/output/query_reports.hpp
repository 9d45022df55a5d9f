#pragma once
/// \file
/// Reports of `svt query` on the selected features, as tables.

#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/table.hpp>

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/owners.hpp>
#include <svt/illustrate/pick_ray.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::cli {

using Labels = std::vector<std::uint32_t>;  ///< ascending

/// Additional columns of `--with`.
struct With {
    bool volume = false, surface = false, faces = false, box = false;
};
[[nodiscard]] Result<With> parseWith(const std::string& text);

/// Columns of m2 by analyze::FaceKind.
void addFaceColumns(std::vector<Column>& columns);
/// The features themselves.
[[nodiscard]] Table featureTable(const volume::SemanticVolume& volume, const Labels& selected, const With& with,
                                 int threads);
[[nodiscard]] Json featureJson(const volume::SemanticVolume& volume, const Labels& selected, const With& with,
                               int threads);

[[nodiscard]] Table neighborTable(const volume::SemanticVolume& volume, const Labels& selected, int threads);
[[nodiscard]] Result<Table> rayTable(const volume::SemanticVolume& volume, const Labels& selected,
                                     const illustrate::PickRay& ray, int threads);
[[nodiscard]] Table overlapTable(const volume::SemanticVolume& volume, const Labels& selected);
[[nodiscard]] Table gapTable(const volume::SemanticVolume& volume, const Labels& selected);
/// Rooms of the selected features, and floor areas per storey and in total; the areas count all rooms.
/// \param findings  receives contradictions of levels and areas
[[nodiscard]] Result<Table> areaTable(const volume::SemanticVolume& volume, const Labels& selected, int threads,
                                      Diagnostics& findings);
[[nodiscard]] Result<Table> parcelTable(const volume::SemanticVolume& volume, const Labels& selected,
                                        const volume::SemanticVolume& parcels, int threads);

/// Ownership: totals of owners; features of the table and components, with one row per owner; common property by
/// storey.
struct OwnerReport {
    Table totals, features, common, components;
    Json json;
};
[[nodiscard]] OwnerReport ownerReport(const volume::SemanticVolume& volume, const Labels& selected,
                                      const analyze::OwnerTable& owners, int threads);

}  // namespace svt::cli

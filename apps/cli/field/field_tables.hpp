#pragma once
/// \file
/// Tables of the commands `svt field`.

#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/table.hpp>

#include <svt/core/vec.hpp>
#include <svt/fields/field_statistics.hpp>
#include <svt/fields/svt_fields.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::cli {

/// A row per field.
[[nodiscard]] Table fieldTable(std::span<const fields::ListedField> listed);
/// Everything that is known of the fields except their values.
[[nodiscard]] Json fieldsJson(std::span<const fields::ListedField> listed);

/// A row per component and time; with several times, a further row over all times, whose cell `time` is empty.
/// \param hasTimes  false: only the row over all times, or the row of the only time
[[nodiscard]] Table statisticsTable(const fields::FieldHead& head, const fields::FieldStatistics& statistics,
                                    std::span<const fields::StatisticsRow> rows, const volume::LabelTable& labels,
                                    bool hasTimes);

/// The values of a field at places over time: a row per place and time.
/// \param places  world space
[[nodiscard]] Result<Table> probeTable(const fields::Field& field, const volume::SemanticVolume& volume,
                                       std::span<const Vec3d> places);

}  // namespace svt::cli

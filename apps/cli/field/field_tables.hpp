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
#include <filesystem>
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

/// Rows of a table of values, at most.
inline constexpr std::uint64_t kMostValueRows = 2'000'000;
/// The known values of a field: a row per node, component or point and time, with its place in world space or its id.
/// \param times  indices into the times of the field
/// \return the table, or InputTooBig for more than kMostValueRows values
[[nodiscard]] Result<Table> valueTable(const fields::Field& field, const volume::SemanticVolume& volume,
                                       std::span<const std::size_t> times);

/// Writes a table as its ending says: .csv, .json or .parquet.
[[nodiscard]] Result<void> writeTable(const Table& table, const std::filesystem::path& output);

/// The values of a field at places over time: a row per place and time.
/// \param places  world space
[[nodiscard]] Result<Table> probeTable(const fields::Field& field, const volume::SemanticVolume& volume,
                                       std::span<const Vec3d> places);

}  // namespace svt::cli

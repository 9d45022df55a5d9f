#pragma once
/// \file
/// `svt field export`: writes a field for other programs.

#include <apps/cli/options/shared_options.hpp>

#include <svt/core/result.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace svt::cli {

struct FieldExportArguments {
    std::filesystem::path input, output;
    std::string name;
    std::optional<double> time;
};

[[nodiscard]] Members<FieldExportArguments> membersOf(const FieldExportArguments*) noexcept;

/// Writes the lattice of one time (.vti, .vtr, .nrrd), or the values of all times or of one as a table (.csv, .json, .parquet).
/// \return the exit code, or the errors of readField() and writeLattice(); BadArgument for a time that the field does not have;
///         InputTooBig for a table of more than kMostValueRows
[[nodiscard]] Result<int> runFieldExport(const FieldExportArguments& arguments);

}  // namespace svt::cli

#pragma once
/// \file
/// Columns, units and language of the tables of `svt quantities`: the settings file of --settings, and the headings.

#include <apps/cli/output/table.hpp>

#include <svt/core/option.hpp>
#include <svt/core/result.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::cli {

/// Units of figures in tables.
struct QuantityUnits {
    std::string length = "m";   ///< m or mm
    std::string area = "m2";    ///< m2
    std::string volume = "m3";  ///< m3 or l
};

/// A settings file, docs/user/quantities.md.
struct QuantitySettings {
    std::vector<std::string> columns;  ///< names as in files, in this order; empty: the usual ones
    QuantityUnits units;
    std::string language = "en";  ///< of headings: en or de
};

/// Reads a settings file.
/// \return the settings; CannotOpen, BadJson; or BadArgument with the place of a member that is unknown or has a wrong
///         value
[[nodiscard]] Result<QuantitySettings> readQuantitySettings(const std::filesystem::path& file);

/// Headings with units, such as "Net volume (m3)", one per column. A name that is not a figure of `svt quantities`, such
/// as an attribute, is its own heading.
[[nodiscard]] std::vector<std::string> quantityHeadings(const Table& table, const QuantitySettings& settings);

/// The table in the units of the settings. If the settings have columns, only these, after the first `kept` columns.
/// A last row with the text "(sum)" keeps this text in its first cell, and is removed if that cell is a figure.
/// \return the table, or BadArgument: a column of the settings was not measured
[[nodiscard]] Result<Table> withQuantitySettings(Table table, const QuantitySettings& settings, std::size_t kept = 0);

/// The same table with headings as titles and names: for text and CSV.
[[nodiscard]] Table withHeadings(Table table, const QuantitySettings& settings);

}  // namespace svt::cli

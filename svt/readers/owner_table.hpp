#pragma once
/// \file
/// A table of owners as CSV text: the file itself, or a table of a GeoPackage.

#include <svt/core/result.hpp>

#include <filesystem>
#include <string>

namespace svt::readers {

/// Reads a table for analyze::parseOwners(). The table of a GeoPackage or SQLite file is the first one with the columns
/// `feature` and `owner`; its columns `share`, `right` and `source` are optional. The text then has a heading.
/// \return the text, or CannotOpen, InputTooBig (over 64 MiB), BadValue: no such table
[[nodiscard]] Result<std::string> readOwnerTable(const std::filesystem::path& path);

}  // namespace svt::readers

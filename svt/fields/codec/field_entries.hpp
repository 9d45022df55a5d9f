#pragma once
/// \file
/// The entries of fields in the container.

#include <svt/core/result.hpp>
#include <svt/fields/field_blocks.hpp>
#include <svt/volume/zip_entries.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace svt::fields {

inline constexpr std::string_view kFieldsJson = "fields.json";
inline constexpr std::string_view kFieldsFolder = "fields/";

/// "fields/NAME/PART"
[[nodiscard]] std::string entryName(std::string_view field, std::string_view part);

/// All fields of a file; none if it has no `fields.json`.
[[nodiscard]] Result<std::vector<StoredField>> storedFields(const volume::ZipRanges& file);
/// One of them.
/// \return or UnknownField with the names of the fields
[[nodiscard]] Result<StoredField> findField(const volume::ZipRanges& file, const std::string& name);
/// \return the entry, or BadField
[[nodiscard]] Result<volume::EntryPlace> findEntry(const volume::ZipRanges& file, const std::string& entry);

/// UnknownField with the names of the fields.
[[nodiscard]] Error unknownField(const std::string& name, const std::vector<StoredField>& fields);

/// The error with the file as its place.
[[nodiscard]] Error inFile(const Error& error, const std::filesystem::path& path);

}  // namespace svt::fields

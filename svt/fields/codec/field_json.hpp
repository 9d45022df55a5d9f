#pragma once
/// \file
/// `fields.json`: the heads and codes of the fields of a file.

#include <svt/core/result.hpp>
#include <svt/fields/field_blocks.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::fields {

inline constexpr std::size_t kMaxFieldsJson = std::size_t{16} << 20;

/// The fields in a text, checked as by checkHead(); names are unique.
/// \return the fields, or BadField that names the field and the member
[[nodiscard]] Result<std::vector<StoredField>> readFieldsJson(std::string_view text);

/// The inverse. Equal fields give equal text.
/// \return the text, or BadField if it is too long
[[nodiscard]] Result<std::string> writeFieldsJson(std::span<const StoredField> fields);

}  // namespace svt::fields

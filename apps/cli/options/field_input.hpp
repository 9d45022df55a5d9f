#pragma once
/// \file
/// Fields of the input of a command.

#include <svt/core/result.hpp>
#include <svt/fields/field.hpp>

#include <filesystem>
#include <string>

namespace svt::cli {

/// \return success, or BadVolume for an input that is not a `.svt`
[[nodiscard]] Result<void> requireSvt(const std::filesystem::path& input);

/// A field of a volume by name, for --field.
/// \return the field, or BadArgument if the input is not a `.svt`, or an error of fields::readField()
[[nodiscard]] Result<fields::Field> readFieldOf(const std::filesystem::path& input, const std::string& name);

/// Prints a note with the fields of a `.svt`, which a volume made from it does not have. Nothing for other inputs.
void noteLostFields(const std::filesystem::path& input);

}  // namespace svt::cli

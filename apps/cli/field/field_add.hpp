#pragma once
/// \file
/// `svt field add`: adds the fields of a file of another program to a volume.

#include <apps/cli/options/shared_options.hpp>

#include <svt/core/result.hpp>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace svt::cli {

struct FieldAddArguments {
    std::filesystem::path volume, file, output, places;
    std::string name, quantity, unit, medium;
    std::optional<double> from, to, every, precision;
    std::vector<double> at;
    bool replace = false, json = false, verbose = false;
};

[[nodiscard]] Members<FieldAddArguments> membersOf(const FieldAddArguments*) noexcept;

/// Reads the fields of the file, places them in the volume, and writes the volume with them: `output`, or the volume itself.
/// Prints a line for each field, the findings, and all that was assumed.
/// \return the exit code, or the errors of readFields() and writeFields(); BadArgument for a name that is taken
[[nodiscard]] Result<int> runFieldAdd(const FieldAddArguments& arguments);

}  // namespace svt::cli

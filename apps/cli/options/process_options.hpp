#pragma once
/// \file
/// Options that act on the process and not on the work of one command: --no-clobber, --max-input, --format, --no-config,
/// and --verbose of commands without an own one. They are declared once, and commands have no member for them.

#include <svt/frontend/option_set.hpp>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace svt::cli {

/// The options of a command, and behind them those of the process that have a meaning for it.
[[nodiscard]] std::vector<frontend::BoundOption> withProcessOptions(std::span<const frontend::BoundOption> own);

/// Whether an option is one of the process.
[[nodiscard]] bool isOfProcess(const frontend::BoundOption& option) noexcept;

/// The options that set members of a command's arguments.
[[nodiscard]] std::vector<frontend::GivenOption> withoutProcessOptions(std::span<const frontend::GivenOption> given);

/// The given option with this name; null if it is not given.
[[nodiscard]] const frontend::GivenOption* findGiven(std::span<const frontend::GivenOption> given,
                                                     std::string_view longName) noexcept;

/// Largest input from stdin or an address, in bytes: of --max-input, or its default.
[[nodiscard]] std::uint64_t maxInputBytes(std::span<const frontend::GivenOption> given);

/// Whether an option names a file or folder that is written.
[[nodiscard]] bool isOutput(const Option& option) noexcept;
/// Whether an option names a file or folder that is read.
[[nodiscard]] bool isInput(const Option& option) noexcept;

}  // namespace svt::cli

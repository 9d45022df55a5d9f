#pragma once
/// \file
/// All commands and their options, declared once. `svt describe` prints the table, from which the manual, the manual
/// pages, the completions and the page's limits are made.

#include <svt/core/option.hpp>

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::cli {

class Command;
/// Runs a command. \return the exit code
using Action = std::function<int()>;

/// A command, declared beside its code: its options in the order in which help lists them, and its work.
struct CommandText {
    std::string_view name;
    std::string_view help;
    std::vector<std::span<const Option>> sets;
    bool hasScene = false;  ///< also the options that set members of a scene (Option::option)
    /// Connects its options with variables of its own, and returns what runs once these are read.
    Action (*connect)(Command&) = nullptr;
};

/// All commands, in the order in which help lists them.
[[nodiscard]] std::span<const CommandText> commandTexts();

/// The options of a command, arguments first. What an option leaves to a scene's member is filled in from there.
[[nodiscard]] std::vector<Option> optionsOf(const CommandText& command);

/// What help says of an option: its help, unit, range, default, and whether it may be repeated.
[[nodiscard]] std::string descriptionOf(const Option& option);

/// What stands for an option's value in help: "QUERY", "NUMBER", "thin|conservative"; empty for flags.
[[nodiscard]] std::string valueText(const Option& option);

}  // namespace svt::cli

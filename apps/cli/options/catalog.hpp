#pragma once
/// \file
/// All commands and their options, each declared once. `svt describe` prints the table, the source of the manual, the
/// manual pages, the completions and the page's limits.

#include <apps/cli/options/process_options.hpp>
#include <apps/cli/output/messages.hpp>

#include <svt/frontend/option_set.hpp>

#include <span>
#include <string_view>

namespace svt::cli {

/// A command, declared beside its code.
struct CommandText {
    std::string_view name;
    std::string_view help;
    /// Its options, arguments first, those of the process last.
    std::span<const frontend::BoundOption> (*options)();
    /// Sets the arguments from the given options, then runs the command. \return the exit code, or an error
    Result<int> (*run)(std::span<const frontend::GivenOption> given);
};

/// A command whose options are the members of its arguments, and those of the process.
template <record::Recorded Arguments, auto Run>
[[nodiscard]] constexpr CommandText commandOf(std::string_view name, std::string_view help) {
    return {name, help,
            []() -> std::span<const frontend::BoundOption> {
                static const auto kAll = withProcessOptions(frontend::optionsOf<Arguments>());
                return kAll;
            },
            [](std::span<const frontend::GivenOption> given) -> Result<int> {
                Arguments arguments{};
                SVT_DO(frontend::setOptions(arguments, withoutProcessOptions(given)));
                return Run(arguments);
            }};
}

/// All commands, in the order in which help lists them.
[[nodiscard]] std::span<const CommandText> commandTexts();

}  // namespace svt::cli

// The only file that uses the parser of command lines (CLI11).
#include <apps/cli/options/command_line.hpp>
#include <apps/cli/options/format_table.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/table.hpp>
#include <apps/cli/output/version.hpp>

#include <svt/core/edit_distance.hpp>
#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <map>
#include <memory>

namespace svt::cli {
namespace {

// The given values, by the option's number in its command.
using Given = std::vector<std::vector<std::string>>;

// Adds an option to CLI11's parser. Checks its values against the declaration and stores them as texts.
CLI::Option* addOption(CLI::App& app, const Option& option, std::vector<std::string>& values) {
    const std::string name(option.name), description = frontend::descriptionOf(option);
    if (option.kind == OptionKind::Flag) return app.add_flag(name, description);
    CLI::Option* added = app.add_option(name, values, description);
    added->type_name(frontend::valueText(option));
    if (option.leastCount == 0) {
        added->expected(0, 1)->default_str("");
    } else if (!option.name.starts_with('-')) {
        if (!option.mayRepeat) added->expected(1)->allow_extra_args(false);
    } else {
        added->expected(1)->multi_option_policy(option.mayRepeat ? CLI::MultiOptionPolicy::TakeAll
                                                                 : CLI::MultiOptionPolicy::Throw);
        // Otherwise CLI11 would take a "--" after its value as the end of its values, not of the options.
        if (!option.mayRepeat) added->allow_extra_args(false);
    }
    return added->check(
        CLI::Validator([option](std::string& text) { return frontend::faultOfValues(option, text); }, ""));
}

void addOptions(CLI::App& app, std::span<const frontend::BoundOption> options, Given& given) {
    given.resize(options.size());
    for (std::size_t n = 0; n < options.size(); ++n) {
        CLI::Option* added = addOption(app, options[n], given[n]);
        if (options[n].isRequired) added->required();
        if (!options[n].group.empty()) added->group(std::string(options[n].group));
    }
    for (const Option& option : options)
        for (const std::string_view other : splitChoices(option.excludes))
            app.get_option(std::string(longName(option)))->excludes(app.get_option(std::string(other)));
}

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
    std::string best;
    std::size_t distance = std::max<std::size_t>(3, word.size() / 2);
    for (const std::string& candidate : known)
        if (const std::size_t d = editDistance(word, candidate, distance); d < distance) {
            distance = d;
            best = candidate;
        }
    return best;
}

// The option or command that the user may have meant.
std::string suggestionFor(const CLI::App& app, const std::string& word) {
    std::vector<std::string> known;
    const auto commands = app.get_subcommands();
    if (word.starts_with('-')) {
        const CLI::App* scope = commands.empty() ? &app : commands.front();
        for (const CLI::Option* option : scope->get_options())
            for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    } else if (commands.empty()) {
        for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
            known.push_back(command->get_name());
    }
    const std::string found = nearest(word.substr(0, word.find('=')), known);
    return found.empty() ? "" : fmt::format("; did you mean {}?", found);
}

// Results that cannot be written to stdout (a full disk behind '>') must not count as success.
int flushed(int exitCode) {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exitCode;
    if (errno == EPIPE) return kNoReader;
    printMessage("svt: error: stdout cannot be written\n");
    return exitCode == kDone ? kOutput : exitCode;
}

// Commands of two words: "svt city plan" is "svt city-plan".
std::vector<std::string> joinedWords(int argc, char** argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    if (words.size() < 2) return words;
    const std::string joined = words[0] + "-" + words[1];
    for (const CommandText& text : commandTexts())
        if (text.name == joined) {
            words.erase(words.begin());
            words[0] = joined;
            break;
        }
    return words;
}

// The commands whose first word is `word`, one per line; may be empty.
std::string commandsBelow(std::string_view word) {
    std::string lines;
    for (const CommandText& text : commandTexts()) {
        if (text.name == word) return {};
        if (text.name.starts_with(word) && text.name.substr(word.size()).starts_with("-"))
            lines += fmt::format("  svt {} {:<10} {}\n", word, text.name.substr(word.size() + 1), text.help);
    }
    return lines;
}

// The parser with all commands.
struct Parser {
    CLI::App app{"Semantic volume textures of building models: build, query and draw them", "svt"};
    std::map<std::string_view, Given> given;
    std::string formats = "text";  // notation of the table of formats

    Parser() {
        app.require_subcommand(0, 1);
        app.set_version_flag("--version", versionText());
        app.add_option("--formats", formats, "Print the formats that are read and written")
            ->expected(0, 1)
            ->type_name("[text|json]")
            ->check(CLI::Validator(CLI::IsMember({"text", "json"}), "", ""));
        app.failure_message(CLI::FailureMessage::simple);
        for (const CommandText& text : commandTexts())
            addOptions(*app.add_subcommand(std::string(text.name), std::string(text.help)), text.options(),
                       given[text.name]);
    }
};

// CLI11 takes the word after "--look=" as its value, and reads "--wireframe ''" as "--wireframe".
// \return the fault of the first such option; empty without a fault
std::string faultOfEmptyValues(std::span<const std::string> words) {
    const auto text = std::ranges::find(commandTexts(), words.empty() ? "" : words.front(), &CommandText::name);
    if (text == commandTexts().end()) return {};
    const auto options = text->options();
    for (std::size_t n = 1; n < words.size() && words[n] != "--"; ++n)
        for (const Option& option : options) {
            const std::string name(longName(option));
            if (option.kind == OptionKind::Flag || !name.starts_with("--")) continue;
            const bool isEmpty = n + 1 < words.size() && words[n + 1].empty();
            if (words[n] == name + "=" || (option.leastCount == 0 && words[n] == name && isEmpty))
                return fmt::format("{}: {}", name, faultOf(option, ""));
        }
    return {};
}

int reportUsage(const CLI::App& app, const CLI::ParseError& error) {
    std::string message = error.what();
    for (const std::string& word : app.remaining(true)) message += suggestionFor(app, word);
    const auto chosen = app.get_subcommands();
    printMessage(fmt::format("svt: {}\nsvt: see 'svt {}--help'\n", message,
                             chosen.empty() ? "" : chosen.front()->get_name() + " "));
    return kUsage;
}

// Applies the options of the whole process.
void setProcess(std::span<const frontend::BoundOption> options, std::span<const frontend::GivenOption> given) {
    if (std::ranges::any_of(options, [](const Option& option) { return option.name == "--memory"; }))
        limitMemoryToMachine();
    for (const auto& [option, values] : given) {
        if (longName(*option) == "--quiet") beQuiet();
        if (option->name == "--memory")
            limitMemory(static_cast<std::uint64_t>(parseNumber(values.front()).value_or(0)) * 1000000, "--memory");
    }
}

// The options of a command that are given, in their order in help.
std::vector<frontend::GivenOption> givenOf(const CLI::App& app, const Given& texts, const CommandText& text) {
    std::vector<frontend::GivenOption> given;
    const auto options = text.options();
    for (std::size_t n = 0; n < options.size(); ++n) {
        if (app.get_option(std::string(longName(options[n])))->count() == 0) continue;
        frontend::GivenOption& each = given.emplace_back(frontend::GivenOption{&options[n], {}});
        for (const std::string& value : texts[n])
            for (std::string& part : frontend::valuesOf(options[n], value)) each.values.push_back(std::move(part));
    }
    return given;
}

Result<int> runCommand(std::span<const frontend::GivenOption> given, const CommandText& text) {
    SVT_DO(frontend::checkExclusions(given));
    setProcess(text.options(), given);
    SVT_DO(checkFiles(given));
    return text.run(given);
}

}  // namespace

int runCommandLine(int argc, char** argv) {
    Parser parser;
    const std::vector<std::string> words = joinedWords(argc, argv);
    if (const std::string below = words.empty() ? "" : commandsBelow(words.front()); !below.empty()) {
        const bool isAsked = words.size() > 1 && (words[1] == "--help" || words[1] == "-h");
        fmt::print(isAsked ? stdout : stderr, "svt {}: one of\n{}", words.front(), below);
        return isAsked ? flushed(kDone) : kUsage;
    }
    if (const std::string fault = faultOfEmptyValues(words); !fault.empty()) {
        printMessage(fmt::format("svt: {}\nsvt: see 'svt {} --help'\n", fault, words.front()));
        return kUsage;
    }
    try {
        parser.app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // as CLI11 takes them: last first
    } catch (const CLI::CallForHelp& help) {
        parser.app.exit(help);
        return flushed(kDone);
    } catch (const CLI::CallForVersion& version) {
        parser.app.exit(version);
        return flushed(kDone);
    } catch (const CLI::ExcludesError&) {  // reported by runCommand()
    } catch (const CLI::ParseError& error) {
        return reportUsage(parser.app, error);
    }
    if (parser.app.get_option("--formats")->count() > 0) {
        print(formatTable(), parser.formats == "json" ? TableFormat::JsonRows : TableFormat::Text);
        return flushed(kDone);
    }
    for (const CommandText& text : commandTexts()) {
        const std::string name(text.name);
        if (!parser.app.got_subcommand(name)) continue;
        const auto done = runCommand(givenOf(*parser.app.get_subcommand(name), parser.given[text.name], text), text);
        return flushed(done ? *done : fail(done.error()));
    }
    fmt::print("{}", parser.app.help());
    return kUsage;
}

std::string helpText(std::string_view command) {
    const Parser parser;
    return command.empty() ? parser.app.help() : parser.app.get_subcommand(std::string(command))->help();
}

}  // namespace svt::cli

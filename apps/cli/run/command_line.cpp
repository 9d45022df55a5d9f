// The only file that uses the parser of command lines (CLI11).
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/format_table.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/table.hpp>
#include <apps/cli/output/version.hpp>
#include <apps/cli/run/command_line.hpp>
#include <apps/cli/run/defaults.hpp>
#include <apps/cli/run/transfer.hpp>

#include <svt/core/edit_distance.hpp>
#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
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
    const std::vector<std::string_view> names(known.begin(), known.end());
    const std::string_view found = nearestName(std::string_view(word).substr(0, word.find('=')), names);
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

// The command that a file without a command stands for.
struct ImpliedCommand {
    std::string name;    // "view" or "info"; empty: a command is given
    std::string reason;  // why it is not "view"
};

// "svt FILE" is "svt view FILE" at a terminal of a desktop, and "svt info FILE" elsewhere.
ImpliedCommand impliedCommand(std::span<const std::string> words) {
    const bool isNamed =
        !words.empty() && std::ranges::find(commandTexts(), words.front(), &CommandText::name) != commandTexts().end();
    if (words.empty() || isNamed || (words.front().starts_with('-') && words.front() != "-")) return {};
    std::error_code ignored;
    if (!isFromElsewhere(words.front()) && !std::filesystem::exists(userPath(words.front()), ignored)) return {};
    if (!hasDesktop().value_or(false)) return {"info", "there is no display"};
    if (!isOutputTerminal()) return {"info", "stdout is not a terminal"};
    return {"view", {}};
}

// The parser with all commands, and with the options of those that the words name: the others would take a quarter of the
// time in which the program starts.
struct Parser {
    CLI::App app{
        "Semantic volume textures of building models: build, query and draw them\n"
        "'svt FILE' opens a file in the browser, or prints 'svt info FILE' without a display",
        "svt"};
    std::map<std::string_view, Given> given;
    std::string formats = "text";  // notation of the table of formats
    bool isJson = false;

    explicit Parser(std::span<const std::string> words) {
        app.require_subcommand(0, 1);
        app.set_version_flag("--version", versionText());
        app.add_option("--formats", formats, "Print the formats that are read and written")
            ->expected(0, 1)
            ->type_name("[text|json]")
            ->check(CLI::Validator(CLI::IsMember({"text", "json"}), "", ""));
        app.add_flag("--json", isJson, "Print the version or the formats as JSON");
        app.failure_message(CLI::FailureMessage::simple);
        for (const CommandText& text : commandTexts()) {
            CLI::App* command = app.add_subcommand(std::string(text.name), std::string(text.help));
            if (std::ranges::find(words, text.name) != words.end())
                addOptions(*command, text.options(), given[text.name]);
        }
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
    const auto chosen = app.get_subcommands();
    const std::vector<std::string> unknown = app.remaining(true);
    if (chosen.empty() && !unknown.empty() && !unknown.front().starts_with('-'))
        message = fmt::format("'{}' is neither a command nor a file", unknown.front());
    // As CLI11 puts it: "--spacing: At Most 1 required but received 2".
    constexpr std::string_view kTwice = "At Most 1 required";
    if (const std::size_t at = message.find(kTwice); at != std::string::npos)
        message.replace(at, std::string::npos, "give this option once");
    for (const std::string& word : unknown) message += suggestionFor(app, word);
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
        if (longName(*option) == "--verbose") beVerbose();
        if (option->name == "--no-clobber") keepExistingFiles();
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

// \param defaults  receives those that are used
Result<int> runCommand(std::vector<frontend::GivenOption> given, const CommandText& text, Defaults& defaults) {
    SVT_DO(frontend::checkExclusions(given));
    SVT_TRY(added, Defaults::add(text, given));
    defaults = std::move(*added);
    setProcess(text.options(), given);
    Transfer transfer;
    SVT_DO(transfer.begin(given));
    SVT_DO(checkFiles(given));
    SVT_DO(transfer.fetch(given));
    if (areAllVolumes(given) || !cityOf(given).empty()) defaults.dropOptionsForModels(given);
    SVT_DO(checkOptionsForModels(given));
    if (isVerbose()) defaults.print();
    SVT_TRY(exitCode, text.run(given));
    SVT_DO(transfer.deliver());
    return *exitCode;
}

// Runs a command, and prints its error. \return the exit code
int runAndReport(const std::vector<frontend::GivenOption>& given, const CommandText& text,
                 const ImpliedCommand& implied) {
    if (!implied.reason.empty() && findGiven(given, "--quiet") == nullptr)
        note(fmt::format("{}: svt {}", implied.reason, implied.name));
    Defaults defaults;
    const auto done = runCommand(given, text, defaults);
    if (done) return *done;
    const int exitCode = fail(done.error());
    if (exitCode == kUsage && !isVerbose()) defaults.print();
    return exitCode;
}

// Prints what options without a command ask for. \return the exit code; nothing if there is no such option
std::optional<int> printFacts(const Parser& parser) {
    if (parser.app.get_option("--formats")->count() > 0) {
        const bool isJson = parser.isJson || parser.formats == "json";
        print(formatTable(), isJson ? TableFormat::JsonRows : TableFormat::Text);
        return kDone;
    }
    if (!parser.isJson) return std::nullopt;
    printMessage("svt: --json needs --version or --formats, or a command that has it\nsvt: see 'svt --help'\n");
    return kUsage;
}

}  // namespace

int runCommandLine(int argc, char** argv) {
    std::vector<std::string> words = joinedWords(argc, argv);
    if (const std::string below = words.empty() ? "" : commandsBelow(words.front()); !below.empty()) {
        const bool isAsked = words.size() > 1 && (words[1] == "--help" || words[1] == "-h");
        fmt::print(isAsked ? stdout : stderr, "svt {}: one of\n{}", words.front(), below);
        return isAsked ? flushed(kDone) : kUsage;
    }
    const ImpliedCommand implied = impliedCommand(words);
    if (!implied.name.empty()) words.insert(words.begin(), implied.name);
    if (const std::string fault = faultOfEmptyValues(words); !fault.empty()) {
        printMessage(fmt::format("svt: {}\nsvt: see 'svt {} --help'\n", fault, words.front()));
        return kUsage;
    }
    Parser parser(words);
    try {
        parser.app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // as CLI11 takes them: last first
    } catch (const CLI::CallForHelp& help) {
        parser.app.exit(help);
        return flushed(kDone);
    } catch (const CLI::CallForVersion&) {
        const bool isJson = std::ranges::find(words, "--json") != words.end();
        fmt::print("{}\n", isJson ? versionJson() : versionText());
        return flushed(kDone);
    } catch (const CLI::ExcludesError&) {  // reported by runCommand()
    } catch (const CLI::ParseError& error) {
        return reportUsage(parser.app, error);
    }
    if (const auto exitCode = printFacts(parser)) return flushed(*exitCode);
    for (const CommandText& text : commandTexts()) {
        const std::string name(text.name);
        if (!parser.app.got_subcommand(name)) continue;
        const auto given = givenOf(*parser.app.get_subcommand(name), parser.given[text.name], text);
        return flushed(runAndReport(given, text, implied));
    }
    fmt::print("{}", parser.app.help());
    return kUsage;
}

}  // namespace svt::cli

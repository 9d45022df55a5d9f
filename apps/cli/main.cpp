#include <apps/cli/cli.hpp>

#include <svt/core/edit_distance.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <new>
#include <system_error>

namespace {

using namespace svt::cli;

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
    std::string best;
    std::size_t distance = std::max<std::size_t>(3, word.size() / 2);
    for (const std::string& candidate : known)
        if (const std::size_t d = svt::editDistance(word, candidate, distance); d < distance) {
            distance = d;
            best = candidate;
        }
    return best;
}

// The nearest option or command, to suggest to the user.
std::string suggestionFor(const CLI::App& app, const std::string& word) {
    std::vector<std::string> known;
    const auto commands = app.get_subcommands();
    if (word.rfind("-", 0) == 0) {
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

// Reports success only if stdout accepted all output (not with a full disk behind '>').
int flushed(int exitCode) {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exitCode;
    fmt::print(stderr, "svt: error: stdout cannot be written\n");
    return exitCode == kDone ? kOutput : exitCode;
}

int run(int argc, char** argv) {
    CLI::App app{"Semantic volume textures of building models: build, query and draw them", "svt"};
    app.require_subcommand(0, 1);
    app.set_version_flag("--version", "svt 0.1.0");
    app.failure_message(CLI::FailureMessage::simple);
    std::vector<std::pair<std::string, Run>> commands;
    commands.emplace_back("sample", addSampleCommand(app));
    commands.emplace_back("build", addBuildCommand(app));
    commands.emplace_back("info", addInfoCommand(app));
    commands.emplace_back("check", addCheckCommand(app));
    commands.emplace_back("render", addRenderCommand(app));
    commands.emplace_back("section", addSectionCommand(app));
    commands.emplace_back("query", addQueryCommand(app));
    commands.emplace_back("shell", addShellCommand(app));
    commands.emplace_back("convert", addConvertCommand(app));
    commands.emplace_back("serve", addServeCommand(app));
    commands.emplace_back("view", addViewCommand(app));
    commands.emplace_back("publish", addPublishCommand(app));
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp& help) {
        app.exit(help);
        return kDone;
    } catch (const CLI::CallForVersion& version) {
        app.exit(version);
        return kDone;
    } catch (const CLI::ParseError& error) {
        std::string message = error.what();
        for (const std::string& word : app.remaining(true)) message += suggestionFor(app, word);
        const auto chosen = app.get_subcommands();
        fmt::print(stderr, "svt: {}\nsvt: see 'svt {}--help'\n", message,
                   chosen.empty() ? "" : chosen.front()->get_name() + " ");
        return kUsage;
    }
    for (const auto& [name, command] : commands)
        if (app.got_subcommand(name)) return flushed(command());
    fmt::print("{}", app.help());
    return kUsage;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "svt: error: out of memory; choose a coarser --spacing or a smaller model\n");
        return kLimit;
    } catch (const std::system_error& error) {
        // fmt throws this when stdout cannot be written.
        fmt::print(stderr, "svt: error: stdout cannot be written: {}\n", error.code().message());
        return kOutput;
    } catch (const std::exception& error) {
        fmt::print(stderr, "svt: internal error: {}\n", error.what());
        return kInternal;
    }
}

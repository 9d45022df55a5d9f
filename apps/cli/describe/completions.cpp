#include <apps/cli/describe/completions.hpp>

#include <apps/cli/options/catalog.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

// The names of an option: "-o", "--output".
std::vector<std::string> namesOf(const Option& option) {
    std::vector<std::string> names;
    const std::size_t comma = option.name.find(',');
    names.emplace_back(option.name.substr(0, comma));
    if (comma != std::string_view::npos) names.emplace_back(option.name.substr(comma + 1));
    return names;
}

bool isArgument(const Option& option) { return !option.name.starts_with('-'); }

std::string replaced(std::string_view text, char what, std::string_view by) {
    std::string result;
    for (const char c : text) c == what ? result += by : result += c;
    return result;
}

std::string bashScript() {
    std::string commands, cases;
    for (const CommandText& command : commandTexts()) {
        commands += fmt::format("{} ", command.name);
        std::string options = "--help ", values;
        for (const Option& option : command.options()) {
            if (isArgument(option)) {
                for (const std::string_view choice : splitChoices(option.choices))
                    options += fmt::format("{} ", choice);
                continue;
            }
            std::string pattern;
            for (const std::string& name : namesOf(option)) {
                options += name + " ";
                pattern += (pattern.empty() ? "" : "|") + name;
            }
            if (!option.choices.empty())
                values += fmt::format("        {}) COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); return ;;\n", pattern,
                                      replaced(option.choices, '|', " "));
        }
        cases += fmt::format("    {})\n", command.name);
        if (!values.empty()) cases += fmt::format("      case $before in\n{}      esac\n", values);
        cases += fmt::format("      words=\"{}\" ;;\n", options);
    }
    return fmt::format(R"(# Completion of svt for bash.
_svt() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words=
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{}--formats --help --json --version" -- "$word") $(compgen -f -- "$word"))
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
  COMPREPLY=($(compgen -W "$words" -- "$word") $(compgen -f -- "$word"))
}}
complete -o filenames -F _svt svt
)",
                       commands, cases);
}

std::string zshScript() {
    std::string commands, cases;
    const auto escaped = [](std::string_view text) {
        std::string result;
        for (const char c : text) {
            if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
            c == '\'' ? result += "'\\''" : result += c;
        }
        return result;
    };
    for (const CommandText& command : commandTexts()) {
        commands += fmt::format("    '{}:{}'\n", command.name, escaped(command.help));
        cases += fmt::format("    {})\n      _arguments \\\n", command.name);
        for (const Option& option : command.options()) {
            const std::string choices =
                option.choices.empty() ? "_files" : fmt::format("({})", replaced(option.choices, '|', " "));
            if (isArgument(option)) {
                cases += fmt::format("        '{}:{}:{}' \\\n", option.mayRepeat ? "*" : "", option.name, choices);
                continue;
            }
            for (const std::string& name : namesOf(option))
                cases += fmt::format(
                    "        '{}{}[{}]{}' \\\n", option.mayRepeat ? "*" : "", name, escaped(option.help),
                    option.kind == OptionKind::Flag
                        ? ""
                        : fmt::format(":{}:{}", escaped(option.choices.empty() ? frontend::valueText(option) : "value"),
                                      choices));
        }
        cases += "        '--help[print help]' ;;\n";
    }
    return fmt::format(R"(#compdef svt
# Completion of svt for zsh.
_svt() {{
  local -a commands
  commands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe command commands
    _files
    return
  fi
  local command=${{words[2]}}
  shift words
  (( CURRENT-- ))
  case $command in
{}  esac
}}
_svt "$@"
)",
                       commands, cases);
}

std::string fishScript() {
    std::string script = "# Completion of svt for fish.\n";
    const auto quoted = [](std::string_view text) {
        std::string result = "'";
        for (const char c : text) {
            if (c == '\'' || c == '\\') result += '\\';
            result += c;
        }
        return result + "'";
    };
    for (const CommandText& command : commandTexts())
        script +=
            fmt::format("complete -c svt -n __fish_use_subcommand -a {} -d {}\n", command.name, quoted(command.help));
    for (const CommandText& command : commandTexts())
        for (const Option& option : command.options()) {
            const std::string where = fmt::format("complete -c svt -n '__fish_seen_subcommand_from {}'", command.name);
            const std::string choices =
                option.choices.empty() ? std::string() : fmt::format(" -f -a '{}'", replaced(option.choices, '|', " "));
            if (isArgument(option)) {
                if (!choices.empty()) script += where + choices + "\n";
                continue;
            }
            script += where;
            for (const std::string& name : namesOf(option))
                script += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (option.kind != OptionKind::Flag) script += " -r" + choices;
            script += fmt::format(" -d {}\n", quoted(option.help));
        }
    return script;
}

}  // namespace

std::string completionScript(std::string_view shell) {
    return shell == "bash" ? bashScript() : shell == "zsh" ? zshScript() : fishScript();
}

}  // namespace svt::cli

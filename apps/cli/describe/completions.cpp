#include <apps/cli/describe/completions.hpp>
#include <svt/core/text.hpp>

#include <apps/cli/options/catalog.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>
#include <svt/core/text.hpp>

#include <algorithm>
#include <svt/core/text.hpp>

#include <svt/core/text.hpp>
namespace svt::cli {
#include <svt/core/text.hpp>
namespace {
#include <svt/core/text.hpp>

#include <svt/core/text.hpp>
// The names of an option: "-o", "--output".
#include <svt/core/text.hpp>
std::vector<std::string> namesOf(const Option& option) {
#include <svt/core/text.hpp>
    std::vector<std::string> names;
#include <svt/core/text.hpp>
    const std::size_t comma = option.name.find(',');
#include <svt/core/text.hpp>
    names.emplace_back(option.name.substr(0, comma));
#include <svt/core/text.hpp>
    if (comma != std::string_view::npos) names.emplace_back(option.name.substr(comma + 1));
#include <svt/core/text.hpp>
    return names;
#include <svt/core/text.hpp>
}
#include <svt/core/text.hpp>

#include <svt/core/text.hpp>
bool isArgument(const Option& option) { return !option.name.starts_with('-'); }
#include <svt/core/text.hpp>

#include <svt/core/text.hpp>
std::string replaced(std::string_view text, char what, std::string_view by) {
#include <svt/core/text.hpp>
    std::string result;
#include <svt/core/text.hpp>
    for (const char c : text) c == what ? result += by : result += c;
#include <svt/core/text.hpp>
    return result;
#include <svt/core/text.hpp>
}
#include <svt/core/text.hpp>

#include <svt/core/text.hpp>
std::string bashScript() {
#include <svt/core/text.hpp>
    std::string commands, cases;
#include <svt/core/text.hpp>
    for (const CommandText& command : commandTexts()) {
#include <svt/core/text.hpp>
        commands += fmt::format("{} ", command.name);
#include <svt/core/text.hpp>
        std::string options = "--help ", values;
#include <svt/core/text.hpp>
        for (const Option& option : optionsOf(command)) {
#include <svt/core/text.hpp>
            if (isArgument(option)) {
#include <svt/core/text.hpp>
                for (const std::string_view choice : splitChoices(option.choices))
#include <svt/core/text.hpp>
                    options += fmt::format("{} ", choice);
#include <svt/core/text.hpp>
                continue;
#include <svt/core/text.hpp>
            }
#include <svt/core/text.hpp>
            std::string pattern;
#include <svt/core/text.hpp>
            for (const std::string& name : namesOf(option)) {
#include <svt/core/text.hpp>
                options += name + " ";
#include <svt/core/text.hpp>
                pattern += (pattern.empty() ? "" : "|") + name;
#include <svt/core/text.hpp>
            }
#include <svt/core/text.hpp>
            if (!option.choices.empty())
#include <svt/core/text.hpp>
                values += fmt::format("        {}) COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); return ;;\n", pattern,
#include <svt/core/text.hpp>
                                      replaced(option.choices, '|', " "));
#include <svt/core/text.hpp>
        }
#include <svt/core/text.hpp>
        cases += fmt::format("    {})\n", command.name);
#include <svt/core/text.hpp>
        if (!values.empty()) cases += fmt::format("      case $before in\n{}      esac\n", values);
#include <svt/core/text.hpp>
        cases += fmt::format("      words=\"{}\" ;;\n", options);
#include <svt/core/text.hpp>
    }
#include <svt/core/text.hpp>
    return fmt::format(R"(# Completion of svt for bash.
#include <svt/core/text.hpp>
_svt() {{
#include <svt/core/text.hpp>
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words=
#include <svt/core/text.hpp>
  if [ "$COMP_CWORD" -eq 1 ]; then
#include <svt/core/text.hpp>
    COMPREPLY=($(compgen -W "{}--help --version" -- "$word"))
#include <svt/core/text.hpp>
    return
#include <svt/core/text.hpp>
  fi
#include <svt/core/text.hpp>
  case ${{COMP_WORDS[1]}} in
#include <svt/core/text.hpp>
{}  esac
#include <svt/core/text.hpp>
  COMPREPLY=($(compgen -W "$words" -- "$word") $(compgen -f -- "$word"))
#include <svt/core/text.hpp>
}}
#include <svt/core/text.hpp>
complete -o filenames -F _svt svt
#include <svt/core/text.hpp>
)",
#include <svt/core/text.hpp>
                       commands, cases);
#include <svt/core/text.hpp>
}
#include <svt/core/text.hpp>

#include <svt/core/text.hpp>
std::string zshScript() {
#include <svt/core/text.hpp>
    std::string commands, cases;
#include <svt/core/text.hpp>
    const auto escaped = [](std::string_view text) {
#include <svt/core/text.hpp>
        std::string result;
#include <svt/core/text.hpp>
        for (const char c : text) {
#include <svt/core/text.hpp>
            if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
#include <svt/core/text.hpp>
            c == '\'' ? result += "'\\''" : result += c;
#include <svt/core/text.hpp>
        }
#include <svt/core/text.hpp>
        return result;
#include <svt/core/text.hpp>
    };
#include <svt/core/text.hpp>
    for (const CommandText& command : commandTexts()) {
#include <svt/core/text.hpp>
        commands += fmt::format("    '{}:{}'\n", command.name, escaped(command.help));
#include <svt/core/text.hpp>
        cases += fmt::format("    {})\n      _arguments \\\n", command.name);
#include <svt/core/text.hpp>
        for (const Option& option : optionsOf(command)) {
#include <svt/core/text.hpp>
            const std::string choices =
#include <svt/core/text.hpp>
                option.choices.empty() ? "_files" : fmt::format("({})", replaced(option.choices, '|', " "));
#include <svt/core/text.hpp>
            if (isArgument(option)) {
#include <svt/core/text.hpp>
                cases += fmt::format("        '{}:{}:{}' \\\n", option.mayRepeat ? "*" : "", option.name, choices);
#include <svt/core/text.hpp>
                continue;
#include <svt/core/text.hpp>
            }
#include <svt/core/text.hpp>
            for (const std::string& name : namesOf(option))
#include <svt/core/text.hpp>
                cases += fmt::format(
#include <svt/core/text.hpp>
                    "        '{}{}[{}]{}' \\\n", option.mayRepeat ? "*" : "", name, escaped(option.help),
#include <svt/core/text.hpp>
                    option.kind == OptionKind::Flag
#include <svt/core/text.hpp>
                        ? ""
#include <svt/core/text.hpp>
                        : fmt::format(":{}:{}", escaped(option.choices.empty() ? valueText(option) : "value"),
#include <svt/core/text.hpp>
                                      choices));
#include <svt/core/text.hpp>
        }
#include <svt/core/text.hpp>
        cases += "        '--help[print help]' ;;\n";
#include <svt/core/text.hpp>
    }
#include <svt/core/text.hpp>
    return fmt::format(R"(#compdef svt
#include <svt/core/text.hpp>
# Completion of svt for zsh.
#include <svt/core/text.hpp>
_svt() {{
#include <svt/core/text.hpp>
  local -a commands
#include <svt/core/text.hpp>
  commands=(
#include <svt/core/text.hpp>
{}  )
#include <svt/core/text.hpp>
  if (( CURRENT == 2 )); then
#include <svt/core/text.hpp>
    _describe command commands
#include <svt/core/text.hpp>
    return
#include <svt/core/text.hpp>
  fi
#include <svt/core/text.hpp>
  local command=${{words[2]}}
#include <svt/core/text.hpp>
  shift words
#include <svt/core/text.hpp>
  (( CURRENT-- ))
#include <svt/core/text.hpp>
  case $command in
#include <svt/core/text.hpp>
{}  esac
#include <svt/core/text.hpp>
}}
#include <svt/core/text.hpp>
_svt "$@"
#include <svt/core/text.hpp>
)",
#include <svt/core/text.hpp>
                       commands, cases);
#include <svt/core/text.hpp>
}
#include <svt/core/text.hpp>

#include <svt/core/text.hpp>
std::string fishScript() {
#include <svt/core/text.hpp>
    std::string script = "# Completion of svt for fish.\n";
#include <svt/core/text.hpp>
    const auto quoted = [](std::string_view text) {
#include <svt/core/text.hpp>
        std::string result = "'";
#include <svt/core/text.hpp>
        for (const char c : text) {
#include <svt/core/text.hpp>
            if (c == '\'' || c == '\\') result += '\\';
#include <svt/core/text.hpp>
            result += c;
#include <svt/core/text.hpp>
        }
#include <svt/core/text.hpp>
        return result + "'";
#include <svt/core/text.hpp>
    };
#include <svt/core/text.hpp>
    for (const CommandText& command : commandTexts())
#include <svt/core/text.hpp>
        script += fmt::format("complete -c svt -n __fish_use_subcommand -f -a {} -d {}\n", command.name,
#include <svt/core/text.hpp>
                              quoted(command.help));
#include <svt/core/text.hpp>
    for (const CommandText& command : commandTexts())
#include <svt/core/text.hpp>
        for (const Option& option : optionsOf(command)) {
#include <svt/core/text.hpp>
            const std::string where = fmt::format("complete -c svt -n '__fish_seen_subcommand_from {}'", command.name);
#include <svt/core/text.hpp>
            const std::string choices =
#include <svt/core/text.hpp>
                option.choices.empty() ? std::string() : fmt::format(" -f -a '{}'", replaced(option.choices, '|', " "));
#include <svt/core/text.hpp>
            if (isArgument(option)) {
#include <svt/core/text.hpp>
                if (!choices.empty()) script += where + choices + "\n";
#include <svt/core/text.hpp>
                continue;
#include <svt/core/text.hpp>
            }
#include <svt/core/text.hpp>
            script += where;
#include <svt/core/text.hpp>
            for (const std::string& name : namesOf(option))
#include <svt/core/text.hpp>
                script += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
#include <svt/core/text.hpp>
            if (option.kind != OptionKind::Flag) script += " -r" + choices;
#include <svt/core/text.hpp>
            script += fmt::format(" -d {}\n", quoted(option.help));
#include <svt/core/text.hpp>
        }
#include <svt/core/text.hpp>
    return script;
#include <svt/core/text.hpp>
}
#include <svt/core/text.hpp>

#include <svt/core/text.hpp>
}  // namespace
#include <svt/core/text.hpp>

#include <svt/core/text.hpp>
std::string completionScript(std::string_view shell) {
#include <svt/core/text.hpp>
    return shell == "bash" ? bashScript() : shell == "zsh" ? zshScript() : fishScript();
#include <svt/core/text.hpp>
}
#include <svt/core/text.hpp>

#include <svt/core/text.hpp>
}  // namespace svt::cli

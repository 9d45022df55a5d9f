#include <apps/cli/describe/man_pages.hpp>

#include <apps/cli/options/catalog.hpp>
#include <apps/cli/output/version.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

constexpr std::string_view kExitCodes[][2] = {
    {"0", "done"},
    {"1", "internal error"},
    {"2", "wrong usage"},
    {"3", "input that cannot be read"},
    {"4", "a defect prevents the use of the model (check), or it has any defect (\\-\\-strict)"},
    {"5", "output that cannot be written"},
    {"6", "no graphics driver (render \\-\\-gl), or no cairo library (sheets as PDF)"},
    {"7", "differences were found (diff); not an error"},
    {"8", "a limit or the memory is exceeded"},
    {"9", "cancelled"},
    {"129, 130, 143", "ended by the signal HUP, INT or TERM"},
};

// Text for roff: dashes that can be copied, and lines that do not begin a request.
std::string roff(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '-')
            result += "\\-";
        else if (c == '\\')
            result += "\\e";
        else if (c == '\'' && result.empty())
            result += "\\(aq";
        else
            result += c;
    }
    return result.starts_with('.') ? "\\&" + result : result;
}

std::string header(std::string_view name, std::string_view help) {
    return fmt::format(".TH {} 1 \"\" \"svt {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n", roff(name), versionNumber(),
                       roff(name), roff(help));
}

std::string exitStatus() {
    std::string text = ".SH EXIT STATUS\n";
    for (const auto& [code, means] : kExitCodes) text += fmt::format(".TP\n.B {}\n{}\n", code, means);
    return text;
}

std::string optionText(const Option& option) {
    std::string names;
    for (std::string_view rest = option.name; !rest.empty();) {
        const std::size_t comma = std::min(rest.find(','), rest.size());
        names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(rest.substr(0, comma)));
        rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
    const std::string value = frontend::valueText(option);
    if (!value.empty() && option.name.starts_with('-')) names += fmt::format(" \\fI{}\\fR", roff(value));
    return fmt::format(".TP\n{}\n{}\n", names, roff(frontend::descriptionOf(option)));
}

std::string commandPage(const CommandText& command) {
    const auto options = command.options();
    std::string page = header(fmt::format("svt-{}", command.name), command.help);
    page += fmt::format(".SH SYNOPSIS\n.B svt {}\n[\\fIOPTIONS\\fR]", command.name);
    for (const Option& option : options)
        if (!option.name.starts_with('-'))
            page += fmt::format(" {}\\fI{}\\fR{}{}", option.isRequired ? "" : "[", option.name,
                                option.mayRepeat ? "..." : "", option.isRequired ? "" : "]");
    page += fmt::format("\n.SH DESCRIPTION\n{}.\n", roff(command.help));
    std::vector<std::string_view> groups;
    for (const Option& option : options) {
        const std::string_view group = !option.name.starts_with('-') ? "Arguments" : option.group;
        if (std::ranges::find(groups, group) == groups.end()) groups.push_back(group);
    }
    page += ".SH OPTIONS\n";
    for (const std::string_view group : groups) {
        page += fmt::format(".SS {}\n", group.empty() ? "General" : group);
        for (const Option& option : options)
            if ((!option.name.starts_with('-') ? "Arguments" : option.group) == group) page += optionText(option);
    }
    return page + exitStatus() + ".SH SEE ALSO\n.BR svt (1)\n";
}

std::string mainPage() {
    std::string page = header("svt", "semantic volume textures of building models");
    page += ".SH SYNOPSIS\n.B svt\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.br\n.B svt\n\\fIFILE\\fR [\\fIOPTIONS\\fR]\n";
    page +=
        ".SH DESCRIPTION\nConverts a semantic building model (CityGML, CityJSON, IFC, IndoorGML) to a volume that "
        "stores the building component at every point. Draws that volume cut open, answers queries about it, and "
        "converts it to other formats.\n.PP\n"
        "\\fBsvt\\fR \\fIFILE\\fR opens a file in the browser (\\fBsvt view\\fR). Without a display, or if stdout "
        "is not a terminal, it prints \\fBsvt info\\fR. The input \\(aq\\-\\(aq is stdin. The output "
        "\\(aq\\-\\(aq is stdout. Inputs may be addresses (https://).\n.SH COMMANDS\n";
    for (const CommandText& command : commandTexts())
        page += fmt::format(".TP\n.BR svt\\-{} (1)\n{}\n", command.name, roff(command.help));
    page +=
        ".SH OPTIONS\n.TP\n\\fB\\-\\-formats\\fR [\\fItext|json\\fR]\nPrint the formats that are read and written.\n";
    page += ".TP\n\\fB\\-\\-version\\fR\nPrint the version.\n";
    page += ".TP\n\\fB\\-\\-json\\fR\nWith \\-\\-version or \\-\\-formats: print JSON.\n";
    page +=
        ".SH FILES\n.TP\n.I svt.json\nDefaults of options, in the folder of the model.\n.TP\n"
        ".I $XDG_CONFIG_HOME/svt/svt.json\nDefaults of the user; ~/.config/svt/svt.json without the variable.\n"
        ".SH ENVIRONMENT\n.TP\n.B SVT_NO_CONFIG\nIf set, both files are ignored, as with \\-\\-no\\-config.\n"
        ".TP\n.B TMPDIR\nFolder for temporary files.\n";
    page += exitStatus();
    page += ".SH SEE ALSO\n";
    for (const CommandText& command : commandTexts())
        page += fmt::format(".BR svt\\-{} (1){}\n", command.name, &command == &commandTexts().back() ? "" : ",");
    return page;
}

}  // namespace

std::optional<std::string> manPage(std::string_view command) {
    if (command.empty()) return mainPage();
    for (const CommandText& text : commandTexts())
        if (text.name == command) return commandPage(text);
    return std::nullopt;
}

}  // namespace svt::cli

#include <apps/cli/describe/completions.hpp>
#include <apps/cli/describe/man_pages.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/version.hpp>

#include <svt/core/text.hpp>
#include <svt/drawing/sheet_set.hpp>
#include <svt/illustrate/scene_members.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace svt::cli {
namespace {

enum class What : std::uint8_t { Json, Man, Bash, Zsh, Fish };
constexpr auto namesOf(What) {
    using enum What;
    return std::to_array<Name<What>>({{Json, "json"}, {Man, "man"}, {Bash, "bash"}, {Zsh, "zsh"}, {Fish, "fish"}});
}

struct DescribeArguments {
    What what = What::Json;
    std::string command;
};

// The use of the file that an option names.
std::string_view fileText(FileUse use) noexcept {
    switch (use) {
        case FileUse::None: return {};
        case FileUse::Model:
        case FileUse::ModelOrVolume:
        case FileUse::Style:
        case FileUse::OtherInput:
        case FileUse::InputOrFolder: return "input";
        case FileUse::InputFolder: return "inputFolder";
        case FileUse::Output: return "output";
        case FileUse::OutputFolder: return "outputFolder";
    }
    return {};
}

Json optionJson(const Option& option) {
    constexpr std::string_view kKinds[] = {"flag", "whole", "number", "text", "object", "list"};
    Json json{{"name", option.name}, {"kind", kKinds[static_cast<std::size_t>(option.kind)]}};
    const auto text = [&](const char* key, std::string_view value) {
        if (!value.empty()) json[key] = value;
    };
    const auto list = [&](const char* key, std::string_view values) {
        if (!values.empty()) json[key] = splitChoices(values);
    };
    text("value", option.value);
    text("unit", option.unit);
    if (std::isfinite(option.least)) json["minimum"] = option.least;
    if (std::isfinite(option.most)) json["maximum"] = option.most;
    list("choices", option.choices);
    text("default", option.byDefault);
    text("otherwise", option.otherwise);
    text("help", option.help);
    text("group", option.group);
    text("option", option.option);
    text("member", option.member);
    list("excludes", option.excludes);
    if (option.count != 1) json["count"] = option.count;
    if (option.leastCount != 1) json["leastCount"] = option.leastCount;
    if (option.isRequired) json["required"] = true;
    if (option.mayRepeat) json["repeats"] = true;
    if (option.isForProjects) json["project"] = true;
    text("file", fileText(option.file));
    return json;
}

Json describedJson() {
    Json json{{"version", versionNumber()}, {"commands", Json::array()}, {"sceneMembers", Json::array()}};
    for (const CommandText& command : commandTexts()) {
        Json described{{"name", command.name}, {"help", command.help}, {"options", Json::array()}};
        for (const Option& option : command.options()) described["options"].push_back(optionJson(option));
        json["commands"].push_back(std::move(described));
    }
    for (const Option& member : illustrate::sceneMembers()) json["sceneMembers"].push_back(optionJson(member));
    for (const Option& member : drawing::sheetMembers()) json["sheetMembers"].push_back(optionJson(member));
    for (const writers::VolumeFormat& format : writers::volumeFormats())
        json["volumeFormats"].push_back({{"name", format.name},
                                         {"endings", splitChoices(format.endings)},
                                         {"holds", format.holds},
                                         {"readers", format.readers}});
    for (const readers::Format& format : readers::formats())
        json["modelFormats"].push_back({{"name", format.holds}, {"endings", splitChoices(format.endings)}});
    for (const auto& [name, english, german] : writers::classTerms())
        json["classes"].push_back({{"name", name}, {"english", english}, {"german", german}});
    return json;
}

Result<int> runDescribe(const DescribeArguments& arguments) {
    if (arguments.what == What::Json) {
        print(describedJson());
        return kDone;
    }
    if (arguments.what != What::Man) {
        fmt::print("{}", completionScript(nameOf(arguments.what)));
        return kDone;
    }
    const auto page = manPage(arguments.command);
    if (!page)
        return Error(Code::BadArgument, fmt::format("unknown command '{}'; see 'svt --help'", arguments.command));
    fmt::print("{}", *page);
    return kDone;
}

Members<DescribeArguments> membersOf(const DescribeArguments*) noexcept {
    using All = DescribeArguments;
    static constexpr Member<All> kMembers[] = {
        member<&All::what>("what",
                           "json: all commands and options; man: a manual page; bash, zsh, fish: completions for that "
                           "shell",
                           {.isRequired = true}),
        member<&All::command>("command", "with man: the command whose page is printed",
                              {.otherwise = "the page of svt itself"}),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kDescribeCommand =
    commandOf<DescribeArguments, runDescribe>("describe", "Print all commands and options, for other programs");

}  // namespace svt::cli

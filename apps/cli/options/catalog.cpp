#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/shared_options.hpp>

#include <svt/core/text.hpp>
#include <svt/illustrate/scene_members.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

// "nrrd|glb|..."; kept for the time of the program, as options refer to it.
std::string_view volumeFormatNames() {
    static const std::string kNames = [] {
        std::string names;
        for (const writers::VolumeFormat& format : writers::volumeFormats())
            names += fmt::format("{}{}", names.empty() ? "" : "|", format.name);
        return names + "|geojson|gpkg";  // features one by one: writers::FeatureLayer
    }();
    return kNames;
}

std::string_view volumeFormatHelp() {
    static const std::string kHelp = [] {
        std::vector<std::string_view> endings;
        for (const writers::VolumeFormat& format : writers::volumeFormats())
            for (const std::string_view ending : splitChoices(format.endings)) endings.push_back(ending);
        endings.insert(endings.end(), {".geojson", ".gpkg"});
        return fmt::format("file to write; the extension selects the format: {}", fmt::join(endings, ", "));
    }();
    return kHelp;
}

std::string_view modelFilesHelp() {
    static const std::string kHelp = fmt::format("model files ({}, each also with .gz), and folders with such files",
                                                 fmt::join(readers::modelEndings(), ", "));
    return kHelp;
}

}  // namespace

// Each is declared beside its code.
extern const CommandText kSampleCommand, kSampleCityCommand, kBuildCommand, kInfoCommand, kCheckCommand, kRenderCommand,
    kSectionCommand, kSheetsCommand, kQueryCommand, kShellCommand, kConvertCommand, kServeCommand, kViewCommand,
    kPublishCommand, kCityPlanCommand, kCityRunCommand, kCityTaskCommand, kCityStatusCommand, kCityMergeCommand,
    kCityInfoCommand, kCityExtractCommand, kDoctorCommand, kDescribeCommand;

std::span<const CommandText> commandTexts() {
    static const CommandText kAll[] = {kSampleCommand,      kSampleCityCommand, kBuildCommand,     kInfoCommand,
                                       kCheckCommand,       kRenderCommand,     kSectionCommand,   kSheetsCommand,
                                       kQueryCommand,       kShellCommand,      kConvertCommand,   kServeCommand,
                                       kViewCommand,        kPublishCommand,    kCityPlanCommand,  kCityRunCommand,
                                       kCityTaskCommand,    kCityStatusCommand, kCityMergeCommand, kCityInfoCommand,
                                       kCityExtractCommand, kDoctorCommand,     kDescribeCommand};
    return kAll;
}

namespace {

// Gives an option all that it does not say itself from a member of a scene.
void fillFrom(Option& option, const Option& member) {
    const auto fill = [](auto& own, const auto& other, bool isOwn) {
        if (!isOwn) own = other;
    };
    fill(option.kind, member.kind, option.kind != Text);
    fill(option.value, member.value, !option.value.empty());
    fill(option.help, member.help, !option.help.empty());
    fill(option.choices, member.choices, !option.choices.empty());
    if (option.kind != Flag) fill(option.byDefault, member.byDefault, !option.byDefault.empty());
    fill(option.otherwise, member.otherwise, !option.otherwise.empty());
    option.unit = member.unit;
    option.least = member.least;
    option.most = member.most;
    option.count = member.count;
    option.leastCount = member.leastCount;
    option.mayRepeat = member.mayRepeat;
}

// The options that set a member of a scene, each before the first option of its group.
void addSceneOptions(std::vector<Option>& options) {
    for (const Option& member : illustrate::sceneMembers()) {
        if (member.option.empty()) continue;
        Option option{.name = member.option, .group = member.group, .member = member.name};
        fillFrom(option, member);
        const auto isOfGroup = [&](const Option& other) { return other.group == option.group && other.member.empty(); };
        options.insert(std::ranges::find_if(options, isOfGroup), option);
    }
}

}  // namespace

std::vector<Option> optionsOf(const CommandText& command) {
    std::vector<Option> options;
    for (const auto set : command.sets)
        for (Option option : set) {
            if (!option.like.empty()) fillFrom(option, illustrate::sceneMember(option.like));
            if (option.formats == kVolumeFormats) {
                option.formats = volumeFormatNames();
                option.help = volumeFormatHelp();
            }
            if (option.help == kModelFiles) option.help = modelFilesHelp();
            options.push_back(option);
        }
    if (command.hasScene) addSceneOptions(options);
    return options;
}

std::string valueText(const Option& option) {
    if (option.kind == Flag) return {};
    if (!option.choices.empty()) return std::string(option.choices);
    if (!option.value.empty()) return std::string(option.value);
    return option.kind == Whole ? "N" : option.kind == Number ? "NUMBER" : "TEXT";
}

std::string descriptionOf(const Option& option) {
    std::string text(option.help);
    if (!option.unit.empty()) text += fmt::format(", {}", option.unit);
    // A range that is there only to keep out what no computer could draw tells people nothing.
    if (const std::string range = rangeText(option); option.choices.empty() && !range.empty() && option.most < 1e9)
        text += fmt::format(", {}", range);
    if (!option.byDefault.empty()) text += fmt::format("; default: {}", option.byDefault);
    if (!option.otherwise.empty()) text += fmt::format("; default: {}", option.otherwise);
    if (option.mayRepeat && option.name.starts_with("-")) text += "; may be repeated";
    return text;
}

}  // namespace svt::cli

#include <svt/frontend/option_set.hpp>

#include <svt/core/text.hpp>
#include <svt/illustrate/scene_members.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace svt::frontend {
namespace {

// Fills the empty fields of an option, and its unit, range and counts, from a member of a scene.
void fillFrom(Option& option, const Option& member) {
    const auto fill = [](auto& own, const auto& other, bool isOwn) {
        if (!isOwn) own = other;
    };
    fill(option.kind, member.kind, option.kind != OptionKind::Text);
    fill(option.value, member.value, !option.value.empty());
    fill(option.help, member.help, !option.help.empty());
    fill(option.choices, member.choices, !option.choices.empty());
    if (option.kind != OptionKind::Flag) fill(option.byDefault, member.byDefault, !option.byDefault.empty());
    fill(option.otherwise, member.otherwise, !option.otherwise.empty());
    option.unit = member.unit;
    option.least = member.least;
    option.most = member.most;
    option.count = member.count;
    option.leastCount = member.leastCount;
    option.mayRepeat = member.mayRepeat;
}

// The name of the option of a member; empty: the member is not an option.
std::string_view optionName(const Option& member) noexcept {
    if (!member.option.empty()) return member.option;
    const std::string_view name = member.name.substr(member.name.rfind('/') + 1);
    const bool isArgument =
        member.name.rfind('/') == 0 && member.kind != OptionKind::Object && member.kind != OptionKind::List;
    return isArgument || name.starts_with('-') ? name : std::string_view();
}

}  // namespace

namespace detail {

void addOptions(std::span<const Option> members, std::string_view of, std::vector<BoundOption>& to) {
    const std::vector<std::string_view> wanted = splitChoices(of);
    for (const Option& member : members) {
        const std::string_view name = optionName(member);
        const std::string_view group = member.member.empty() ? member.group : kSceneMembers;
        const auto isWanted = [&](std::string_view known) { return known == name || known == group; };
        if (name.empty() || (!wanted.empty() && !std::ranges::any_of(wanted, isWanted))) continue;
        Option option = member;
        option.name = name;
        option.option = {};
        if (option.kind == OptionKind::Flag) option.byDefault = {};
        option.isForProjects = option.isForProjects || !option.member.empty();
        if (!option.like.empty()) fillFrom(option, illustrate::sceneMember(option.like));
        to.push_back({{option}, member.name});
    }
}

void placeSceneOptions(std::vector<BoundOption>& options) {
    std::vector<BoundOption> ofScene;
    for (const BoundOption& option : options)
        if (!option.member.empty()) ofScene.push_back(option);
    std::erase_if(options, [](const BoundOption& option) { return !option.member.empty(); });
    for (const BoundOption& option : ofScene) {
        const auto isOfGroup = [&](const Option& other) { return other.group == option.group && other.member.empty(); };
        options.insert(std::ranges::find_if(options, isOfGroup), option);
    }
}

}  // namespace detail

bool excludeEachOther(const Option& a, const Option& b) {
    const auto lists = [](const Option& option, const Option& other) {
        const auto names = splitChoices(option.excludes);
        return std::ranges::find(names, longName(other)) != names.end();
    };
    return lists(a, b) || lists(b, a);
}

Result<void> checkExclusions(std::span<const GivenOption> given) {
    for (const GivenOption& each : given)
        for (const std::string_view other : splitChoices(each.option->excludes))
            if (std::ranges::any_of(given, [&](const GivenOption& any) { return longName(*any.option) == other; }))
                return Error(Code::BadArgument, fmt::format("{} and {} exclude each other; give one of them",
                                                            longName(*each.option), other));
    return {};
}

std::string valueText(const Option& option) {
    if (option.kind == OptionKind::Flag) return {};
    if (!option.choices.empty()) return std::string(option.choices);
    if (!option.value.empty()) return std::string(option.value);
    return option.kind == OptionKind::Whole ? "N" : option.kind == OptionKind::Number ? "NUMBER" : "TEXT";
}

std::string descriptionOf(const Option& option) {
    std::string text(option.help);
    if (!option.unit.empty()) text += fmt::format(", {}", option.unit);
    // A range that only excludes sizes beyond any computer does not help users.
    if (const std::string range = rangeText(option); option.choices.empty() && !range.empty() && option.most < 1e9)
        text += fmt::format(", {}", range);
    if (!option.byDefault.empty()) text += fmt::format("; default: {}", option.byDefault);
    if (!option.otherwise.empty()) text += fmt::format("; default: {}", option.otherwise);
    if (option.mayRepeat && option.name.starts_with("-")) text += "; may be repeated";
    return text;
}

std::vector<std::string> valuesOf(const Option& option, const std::string& text) {
    if (option.count == 1) return {text};
    std::vector<std::string> values(1);
    for (const char c : text) c == ',' ? static_cast<void>(values.emplace_back()) : values.back().push_back(c);
    return values;
}

std::string faultOfValues(const Option& option, const std::string& text) {
    if (text.empty()) return option.leastCount == 0 ? std::string() : faultOf(option, text);
    const std::vector<std::string> values = valuesOf(option, text);
    const auto count = static_cast<int>(values.size());
    if (option.count > 1 && (count < option.leastCount || count > option.count))
        return option.leastCount == option.count
                   ? fmt::format("'{}': expected {} values with commas between them", text, option.count)
                   : fmt::format("'{}': expected {} to {} values with commas between them", text, option.leastCount,
                                 option.count);
    for (const std::string& value : values)
        if (std::string fault = faultOf(option, value); !fault.empty()) return fault;
    return {};
}

}  // namespace svt::frontend

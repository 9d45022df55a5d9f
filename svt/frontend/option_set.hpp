#pragma once
/// \file The options that the members of a struct declare (svt/record). A command line or keywords give their values,
/// and setOptions() sets the members. A member is an option if its declaration has Option::option, if its name begins
/// with a dash, or if it is an argument of the struct itself.
///
///     record::Members<Wash> membersOf(const Wash*) noexcept {
///         static constexpr record::Member<Wash> kMembers[] = {
///             member<&Wash::input>("input", "clothes to wash", {.isRequired = true}),
///             member<&Wash::heat>("--heat", "of the water", {.unit = "degrees", .least = 0, .most = 95}),
///             part<&Wash::drying>("drying", "Drum|--fan")};  // options of another struct, by group or name
///         return kMembers;
///     }

#include <svt/core/option.hpp>
#include <svt/record/record.hpp>

#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::frontend {

/// An option, named "--heat", and the member that it sets.
struct BoundOption : Option {
    std::string_view pointer;  ///< of the member: "/drying/heat"
};

/// An option with its given values; empty for a flag.
struct GivenOption {
    const BoundOption* option = nullptr;
    std::vector<std::string> values;
};

/// The options of a struct, in the order of its members. Options that set a member of a scene come before the other
/// options of their group.
template <record::Recorded T>
[[nodiscard]] std::span<const BoundOption> optionsOf();

/// Sets the members that the options are bound to.
/// \return nothing, or an error that names the option; BadArgument unless its member declares another code
template <record::Recorded T>
[[nodiscard]] Result<void> setOptions(T& to, std::span<const GivenOption> given);

/// Stands for the options that set a member of a scene, whatever their group; see part().
inline constexpr std::string_view kSceneMembers = "members of the scene";

/// The options of a struct that is a member of another.
/// \param of  groups and names of options, "|" between them; empty: all
template <auto... Fields>
[[nodiscard]] constexpr auto part(std::string_view name, std::string_view of = {}) {
    return record::member<Fields...>(name, "", {.group = of});
}

/// Whether two options cannot be combined (Option::excludes of either).
[[nodiscard]] bool excludeEachOther(const Option& a, const Option& b);

/// \return nothing, or BadArgument for two options that exclude each other (Option::excludes)
[[nodiscard]] Result<void> checkExclusions(std::span<const GivenOption> given);

/// Help for an option: its help, unit, range, default, and whether it may be repeated.
[[nodiscard]] std::string descriptionOf(const Option& option);

/// The placeholder of an option's value in help: "QUERY", "NUMBER", "thin|conservative"; empty for flags.
[[nodiscard]] std::string valueText(const Option& option);

/// The values of "a,b,c" for an option with several values; for others the whole text is one value.
[[nodiscard]] std::vector<std::string> valuesOf(const Option& option, const std::string& text);

/// The first fault among the values of a text for an option; empty: none.
[[nodiscard]] std::string faultOfValues(const Option& option, const std::string& text);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

/// Appends the options among the members of a part. \param of  see part()
void addOptions(std::span<const Option> members, std::string_view of, std::vector<BoundOption>& to);
/// Puts the options that set a member of a scene before the first option of their group.
void placeSceneOptions(std::vector<BoundOption>& options);

template <record::Recorded T>
struct OptionSet {
    std::deque<std::string> texts;
    std::vector<BoundOption> options;

    OptionSet() {
        for (const record::Member<T>& member : record::membersOf<T>()) {
            std::vector<Option> members;
            record::listMember(member, "", texts, members);
            addOptions(members, member.option.kind == OptionKind::Object ? member.option.group : "", options);
        }
        placeSceneOptions(options);
    }
};

}  // namespace detail

template <record::Recorded T>
std::span<const BoundOption> optionsOf() {
    static const detail::OptionSet<T> kSet;
    return kSet.options;
}

template <record::Recorded T>
Result<void> setOptions(T& to, std::span<const GivenOption> given) {
    for (const GivenOption& each : given) {
        record::Faults faults;
        record::setTexts(faults, std::string(each.option->pointer), *each.option, each.values, to);
        if (faults.isFine()) continue;
        const std::string name(longName(*each.option));
        return faults.error(Code::BadArgument, faults.text().starts_with(name) ? "" : name + ": ");
    }
    return {};
}

}  // namespace svt::frontend

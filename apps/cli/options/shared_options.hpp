#pragma once
/// \file
/// Options that several commands have.

#include <svt/frontend/option_set.hpp>

namespace svt::cli {

using frontend::part;
using record::Member, record::member, record::memberAs, record::Members;

/// An option of the whole process. runCommandLine() applies it; the arguments have no field for it.
template <class Arguments>
struct OfProcess : record::Ignored<Arguments> {
    static constexpr void describe(Option& option) { option.kind = OptionKind::Flag; }
};

template <class Arguments>
[[nodiscard]] constexpr Member<Arguments> quietOption() {
    return record::memberOf<Arguments, OfProcess<Arguments>>(
        "-q,--quiet", "print errors and results only: no progress, findings, notes or summary", {.group = "Output"});
}
template <auto Field>
[[nodiscard]] constexpr auto verboseOption(std::string_view group = "Output") {
    return member<Field>("-v,--verbose", "show all findings, and the files with defaults that are used",
                         {.group = group, .excludes = "--quiet"});
}
template <auto Field>
[[nodiscard]] constexpr auto jsonOption(std::string_view help = "print everything as JSON on stdout") {
    return member<Field>("--json", help, {.group = "Output"});
}
template <auto... Fields>
[[nodiscard]] constexpr auto threadsOption() {
    return member<Fields...>("--threads", "number of threads; the result does not depend on it",
                             {.least = 0, .most = 1024, .otherwise = "all cores", .isForProjects = true});
}
template <auto Field>
[[nodiscard]] constexpr auto modelInput(
    std::string_view help = "a .svt, a model file, or a city: its folder or address") {
    return member<Field>("input", help, {.value = "FILE", .isRequired = true, .file = FileUse::ModelOrVolume});
}
template <auto... Fields>
[[nodiscard]] constexpr auto siteInputs() {
    return member<Fields...>("input", "inputs of the page: .svt, model files, or cities: their folders or addresses",
                             {.value = "FILE", .isRequired = true, .file = FileUse::ModelOrVolume});
}
template <auto Field>
[[nodiscard]] constexpr auto cityFolder() {
    return member<Field>("folder", "the folder of the city",
                         {.value = "DIR", .isRequired = true, .file = FileUse::InputFolder});
}
/// A box of world coordinates, bound to a vector of six numbers.
template <auto... Fields>
[[nodiscard]] constexpr auto worldBox(std::string_view help, std::string_view group,
                                      std::string_view value = "X0,Y0,Z0,X1,Y1,Z1") {
    return memberAs<record::Numbers<6>, Fields...>("--box", help, {.value = value, .unit = "metres", .group = group});
}

}  // namespace svt::cli

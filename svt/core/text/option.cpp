#include <svt/core/option.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt {

std::string_view longName(const Option& option) noexcept {
    const std::size_t comma = option.name.find(',');
    return comma == std::string_view::npos ? option.name : option.name.substr(comma + 1);
}

std::string rangeText(const Option& option) {
    const bool hasLeast = std::isfinite(option.least), hasMost = std::isfinite(option.most);
    if (hasLeast && hasMost) return fmt::format("{} to {}", option.least, option.most);
    if (hasLeast) return fmt::format("at least {}", option.least);
    return hasMost ? fmt::format("at most {}", option.most) : std::string();
}

namespace {

// The fault of an empty value, with the value to give instead.
std::string emptyFault(const Option& option) {
    const std::string wanted = !option.choices.empty()
                                   ? fmt::format("one of {}", fmt::join(splitChoices(option.choices), ", "))
                               : !option.value.empty()           ? std::string(option.value)
                               : option.kind == OptionKind::Text ? "a text"
                                                                 : "a number";
    return fmt::format("the value is empty; give {}{}", wanted, option.isRequired ? "" : ", or leave the option out");
}

}  // namespace

std::string faultOf(const Option& option, std::string_view text) {
    if (text.empty()) return emptyFault(option);
    if (!option.choices.empty()) {
        const auto choices = splitChoices(option.choices);
        if (std::ranges::find(choices, text) == choices.end())
            return fmt::format("'{}' is not possible; possible are {}", text, fmt::join(choices, ", "));
        return {};
    }
    if (option.kind != OptionKind::Whole && option.kind != OptionKind::Number) return {};
    const auto parsed = parseNumber(text);
    if (!parsed) return fmt::format("'{}' is not a number", text);
    const double number = *parsed;
    if (option.kind == OptionKind::Whole && number != std::floor(number))
        return fmt::format("'{}' is not a whole number", text);
    // Beyond 2^53, neighbouring whole numbers are the same double.
    if (option.kind == OptionKind::Whole && std::abs(number) > 9007199254740992.0)
        return fmt::format("{} is out of range; it has too many digits", text);
    if (number < option.least || number > option.most)
        return fmt::format("{} is out of range; possible is {}", text, rangeText(option));
    return {};
}

}  // namespace svt

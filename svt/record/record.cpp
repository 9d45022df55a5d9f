#include <svt/record/record.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::record {

std::string shortened(const Json& value) {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 40);
}

double shortest(float value) { return parseNumber(fmt::format("{}", value)).value_or(value); }

std::pair<std::string_view, std::string_view> firstStep(std::string_view pointer) noexcept {
    if (pointer.starts_with('/')) pointer.remove_prefix(1);
    const std::size_t end = std::min(pointer.find('/'), pointer.size());
    return {pointer.substr(0, end), pointer.substr(end)};
}

std::string plainText(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return fmt::format("{}", value.get<double>());
    if (!value.is_array()) return value.dump();
    std::string text;
    for (const Json& element : value) text.append(text.empty() ? "" : ",").append(plainText(element));
    return text;
}

Json valueOfTexts(const Option& option, std::span<const std::string> texts) {
    if (option.kind == OptionKind::Flag) return texts.empty() || texts.front() == "true";
    const bool isNumber = option.kind == OptionKind::Whole || option.kind == OptionKind::Number;
    if (texts.empty() && !isNumber && option.count == 1) return std::string();
    Json values = Json::array();
    for (const std::string& text : texts) values.push_back(isNumber ? Json(parseNumber(text).value_or(0)) : Json(text));
    return option.count > 1 || values.empty() ? values : values.front();
}

bool isInRange(Faults& faults, const Json& value, const std::string& path, const Option& option, bool isWhole) {
    if (!value.is_number() || !(value.get<double>() >= option.least && value.get<double>() <= option.most)) {
        const bool hasRange = std::isfinite(option.least) || std::isfinite(option.most);
        const std::string range = hasRange ? fmt::format(" from {} to {}", option.least, option.most) : std::string();
        faults.add(path, fmt::format("expected a number{}, found {}", range, shortened(value)));
        return false;
    }
    if (isWhole && value.get<double>() != std::floor(value.get<double>())) {
        faults.add(path, fmt::format("expected a whole number, found {}", shortened(value)));
        return false;
    }
    return true;
}

bool isArray(Faults& faults, const Json& value, const std::string& path, const Option& option) {
    const auto count = static_cast<double>(value.size());
    if (value.is_array() && count >= option.least && count <= option.most) return true;
    const std::string range = option.kind == OptionKind::List ? rangeText(option) : std::string();
    faults.add(path, fmt::format("expected an array{}, found {}", range.empty() ? "" : " of " + range + " elements",
                                 shortened(value)));
    return false;
}

void Choice::read(Faults& faults, const Json& json, const std::string& path, const Option& option, std::string& to) {
    Codec<std::string>::read(faults, json, path, option, to);
    if (!faults.isFine()) return;
    const auto choices = splitChoices(option.choices);
    if (std::ranges::find(choices, to) == choices.end())
        faults.add(path, fmt::format("'{}' is not possible; possible are {}", to, fmt::join(choices, ", ")));
}

void NumberChoice::read(Faults& faults, const Json& json, const std::string& path, const Option& option, int& to) {
    std::string name;
    Choice::read(faults, json, path, option, name);
    if (faults.isFine()) to = parseInteger<int>(std::string_view(name).substr(0, name.find('.'))).value_or(to);
}

Json NumberChoice::write(const Option& option, int from) {
    for (const std::string_view choice : splitChoices(option.choices))
        if (parseInteger<int>(choice.substr(0, choice.find('.'))) == from) return std::string(choice);
    return Json();
}

}  // namespace svt::record

#include <svt/fields/units.hpp>

#include <svt/core/text.hpp>

#include <algorithm>
#include <array>

namespace svt::fields {
namespace {

// UCUM, the Unified Code for Units of Measure (ucum.org), case sensitive. Among the spellings are those of FDS.
constexpr auto kUnits = std::to_array<Unit>({
    {"1", "", "none|-|{none}|mol/mol|kg/kg|m3/m3"},
    {"%", "%", "percent"},
    {"[ppm]", "ppm", "ppm|ppmv"},
    {"[ppb]", "ppb", "ppb"},
    {"Cel", "°C", "C|°C|degC|deg_C|celsius|degree_celsius|degrees_celsius"},
    {"K", "K", "kelvin|degK"},
    {"[degF]", "°F", "F|°F|degF|deg_F|fahrenheit|degree_fahrenheit|degrees_fahrenheit"},
    {"m", "m", "metre|meter|metres|meters"},
    {"cm", "cm", ""},
    {"mm", "mm", ""},
    {"m2", "m²", "m^2|m²"},
    {"m3", "m³", "m^3|m³"},
    {"1/m", "1/m", "m-1|m^-1"},
    {"s", "s", "sec|second|seconds"},
    {"min", "min", "minute|minutes"},
    {"h", "h", "hour|hours"},
    {"1/h", "1/h", "1/hour|h-1|ach"},
    {"1/s", "1/s", "s-1"},
    {"m/s", "m/s", "m s-1|m*s-1|m/sec"},
    {"m3/s", "m³/s", "m^3/s|m³/s"},
    {"m3/h", "m³/h", "m^3/h|m³/h"},
    {"kg", "kg", ""},
    {"kg/s", "kg/s", ""},
    {"kg/m2", "kg/m²", "kg/m^2|kg/m²"},
    {"kg/m3", "kg/m³", "kg/m^3|kg m-3|kg/m³"},
    {"g/m3", "g/m³", "g/m^3|g/m³"},
    {"mg/m3", "mg/m³", "mg/m^3|mg/m³"},
    {"ug/m3", "µg/m³", "µg/m3|µg/m³|ug/m^3|μg/m³"},
    {"Pa", "Pa", "pascal"},
    {"hPa", "hPa", "mbar"},
    {"kPa", "kPa", ""},
    {"J", "J", "joule"},
    {"kJ", "kJ", ""},
    {"kW.h", "kWh", "kWh"},
    {"W", "W", "watt"},
    {"kW", "kW", ""},
    {"W/m2", "W/m²", "W/m^2|W/m²"},
    {"kW/m2", "kW/m²", "kW/m^2|kW/m²"},
    {"W/m3", "W/m³", "W/m^3|W/m³"},
    {"kW/m3", "kW/m³", "kW/m^3|kW/m³"},
    {"W/(m2.K)", "W/(m²K)", "W/m2K|W/(m2K)|W/m^2/K"},
    {"W/(m.K)", "W/(mK)", "W/mK|W/m/K"},
    {"lx", "lx", "lux"},
    {"dB", "dB", "decibel"},
    {"dB[SPL]", "dB", "dB(A)|dBA"},
    {"Bq/m3", "Bq/m³", "Bq/m^3|Bq/m³"},
    {"Hz", "Hz", ""},
    {"V", "V", "volt"},
    {"A", "A", "ampere"},
});

// Codes that files write in several ways keep their letter case first: "K" is not "k".
const Unit* unitOfSpelling(std::string_view text) noexcept {
    for (const Unit& unit : kUnits)
        for (const std::string_view spelling : splitChoices(unit.spellings))
            if (spelling == text) return &unit;
    for (const Unit& unit : kUnits)
        for (const std::string_view spelling : splitChoices(unit.spellings))
            if (spelling.size() > 2 && equalsIgnoringCase(spelling, text)) return &unit;
    return nullptr;
}

bool isUcumCharacter(char c) noexcept {
    return isLetter(c) || isDigit(c) || std::string_view("./*()[]{}%'_+-^").find(c) != std::string_view::npos;
}

}  // namespace

std::span<const Unit> units() noexcept { return kUnits; }

const Unit* findUnit(std::string_view code) noexcept {
    const auto* found = std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& unit) { return unit.code == code; });
    return found == kUnits.end() ? nullptr : &*found;
}

std::optional<std::string> unitCode(std::string_view text) {
    text = withoutBlanks(text);
    if (text.empty()) return std::nullopt;
    if (const Unit* unit = findUnit(text)) return std::string(unit->code);
    if (const Unit* unit = unitOfSpelling(text)) return std::string(unit->code);
    if (text.size() > 40 || std::find_if_not(text.begin(), text.end(), isUcumCharacter) != text.end())
        return std::nullopt;
    return std::string(text);
}

std::string unitText(std::string_view code) {
    const Unit* unit = findUnit(code);
    return std::string(unit == nullptr ? code : unit->text);
}

std::optional<UnitConversion> unitConversion(std::string_view from, std::string_view to) noexcept {
    constexpr double kZeroCelsius = 273.15;  // kelvins
    if (from == to) return UnitConversion{};
    if (from == "K" && to == "Cel") return UnitConversion{1, -kZeroCelsius};
    if (from == "Cel" && to == "K") return UnitConversion{1, kZeroCelsius};
    if (from == "[degF]" && to == "Cel") return UnitConversion{5.0 / 9, -32 * 5.0 / 9};
    if (from == "[degF]" && to == "K") return UnitConversion{5.0 / 9, kZeroCelsius - 32 * 5.0 / 9};
    return std::nullopt;
}

}  // namespace svt::fields

#pragma once
/// \file
/// Units of fields: UCUM codes, their texts for legends, and the spellings of other programs. Values are never converted,
/// except between degrees Celsius and kelvins.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace svt::fields {

struct Unit {
    std::string_view code;       ///< UCUM, such as "Cel" or "kg/m3"
    std::string_view text;       ///< for legends, UTF-8: "°C", "kg/m³"; empty for a number without unit
    std::string_view spellings;  ///< of other programs, "|" between them: "C|degC|celsius"
};

/// The known units.
[[nodiscard]] std::span<const Unit> units() noexcept;

/// The known unit with a UCUM code; null if the table lacks it.
[[nodiscard]] const Unit* findUnit(std::string_view code) noexcept;

/// The UCUM code of a unit as a file or a person writes it: a known code, a known spelling, or else a text of the
/// characters that UCUM allows. Blanks around it do not count.
/// \return the code, or nothing for a text that cannot be one, such as "" or "deg C"
[[nodiscard]] std::optional<std::string> unitCode(std::string_view text);

/// Text for legends: that of the table, or else the code itself.
[[nodiscard]] std::string unitText(std::string_view code);

/// value' = value * scale + offset.
struct UnitConversion {
    double scale = 1, offset = 0;
    friend bool operator==(const UnitConversion&, const UnitConversion&) = default;
};

/// \param from, to  UCUM codes
/// \return the conversion: between Cel and K, or none where both are the same; nothing for any other pair
[[nodiscard]] std::optional<UnitConversion> unitConversion(std::string_view from, std::string_view to) noexcept;

}  // namespace svt::fields

#pragma once
/// \file
/// Thermal conductivities and heat capacities of materials by words of their names, and of components by their class.

#include <span>
#include <string_view>

namespace svt::simulate {

/// A row of the built-in table. Design values rounded from ISO 10456 and, for masonry, from DIN 4108-4.
struct ThermalWord {
    /// Beginnings of words in lower case, separated by '|'. Entries of up to three letters are whole words. A '*' before an
    /// entry: also within a word, as in German compounds.
    std::string_view words;
    double conductivity;  ///< W/(m K)
    double density;       ///< kg/m3
    double specificHeat;  ///< J/(kg K)
    /// J/(m3 K)
    [[nodiscard]] constexpr double heatCapacity() const noexcept { return density * specificHeat; }
};

/// The rows, in the order in which they are tried.
[[nodiscard]] std::span<const ThermalWord> thermalWords() noexcept;

/// The first row with an entry in `name`, in any case; null if there is none.
/// \param word  receives the entry
[[nodiscard]] const ThermalWord* findThermalWord(std::string_view name, std::string_view& word);

/// W/(m K) assumed for a component of unknown material.
inline constexpr double kUnknownConductivity = 1.0;
inline constexpr double kGroundConductivity = 2.0;   ///< ISO 13370, sand and gravel
inline constexpr double kUnknownCapacity = 1.5e6;    ///< J/(m3 K) assumed for a component of unknown material
inline constexpr double kGroundCapacity = 2.0e6;     ///< J/(m3 K), ISO 13370, sand and gravel
inline constexpr double kAirCapacity = 1.2e3;        ///< J/(m3 K), of cavities
inline constexpr double kWindowTransmittance = 1.3;  ///< W/(m2 K), assumed
inline constexpr double kDoorTransmittance = 1.8;    ///< W/(m2 K), assumed

}  // namespace svt::simulate

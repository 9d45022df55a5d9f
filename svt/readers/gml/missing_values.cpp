#include <svt/readers/gml/missing_values.hpp>

#include <algorithm>
#include <cmath>

namespace svt::readers::gml {

bool isMissingValue(std::string_view name, double value) noexcept {
    const double size = std::abs(value);
    if (size != 9999 && size != 99999 && size != 999999) return false;
    constexpr std::string_view kNames[] = {"measuredHeight",
                                           "height",
                                           "averageHeight",
                                           "trunkDiameter",
                                           "crownDiameter",
                                           "storeysAboveGround",
                                           "storeysBelowGround",
                                           "storeyHeightsAboveGround",
                                           "storeyHeightsBelowGround",
                                           "yearOfConstruction",
                                           "yearOfDemolition",
                                           "dateOfConstruction",
                                           "dateOfDemolition",
                                           "numberOfOccupants"};
    while (!name.empty()) {
        const std::string_view part = name.substr(0, name.find('/'));
        if (std::find(std::begin(kNames), std::end(kNames), part) != std::end(kNames)) return true;
        name.remove_prefix(std::min(part.size() + 1, name.size()));
    }
    return false;
}

}  // namespace svt::readers::gml

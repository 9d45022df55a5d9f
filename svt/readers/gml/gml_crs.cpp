#include <svt/readers/gml/gml_crs.hpp>

#include <svt/core/text.hpp>
#include <svt/crs/crs_facts.hpp>
#include <svt/crs/crs_name.hpp>

#include <algorithm>
#include <cmath>

namespace svt::readers::gml {
namespace {

using std::string_view;

char lower(char c) noexcept { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::size_t findIgnoringCase(string_view text, string_view word) noexcept {
    const auto found = std::search(text.begin(), text.end(), word.begin(), word.end(),
                                   [](char a, char b) { return lower(a) == lower(b); });
    return found == text.end() ? string_view::npos : static_cast<std::size_t>(found - text.begin());
}

bool promisesAuthorityOrder(string_view name) noexcept {
    if (findIgnoringCase(name, "urn:adv:") != string_view::npos) return false;
    // Compounds with a version of EPSG of 2007 are those of CityGML 1.0 and 2.0, whose own examples have east first.
    if (findIgnoringCase(name, "crs,crs:EPSG:6.") != string_view::npos) return false;
    return findIgnoringCase(name, "urn:") == 0 || findIgnoringCase(name, "/def/crs") != string_view::npos;
}

// CRSs in which northings and eastings differ by magnitude.
struct CodeRange {
    int first, last;
};
struct Magnitudes {
    CodeRange codes;
    double eastMin, eastMax, northMin, northMax;
};
constexpr Magnitudes kMagnitudes[] = {
    {{31466, 31466}, 2.2e6, 2.8e6, 5.1e6, 6.3e6},  // Germany, 3-degree Gauss-Krueger zones 2 to 5
    {{31467, 31467}, 3.2e6, 3.8e6, 5.1e6, 6.3e6}, {{31468, 31468}, 4.2e6, 4.8e6, 5.1e6, 6.3e6},
    {{31469, 31469}, 5.2e6, 5.8e6, 5.1e6, 6.3e6}, {{3006, 3006}, 2.0e5, 1.0e6, 6.0e6, 7.8e6},  // Sweden
    {{3038, 3051}, 0.5e5, 9.5e5, 3.0e6, 9.4e6},  // Europe, UTM with north first
    {{2193, 2193}, 9.0e5, 2.3e6, 4.5e6, 6.4e6},  // New Zealand
    {{3300, 3301}, 3.0e5, 8.0e5, 6.2e6, 6.8e6},  // Estonia
    {{3346, 3346}, 2.0e5, 8.0e5, 5.8e6, 6.4e6},  // Lithuania
};

bool isWithin(double value, double min, double max) noexcept { return value >= min && value <= max; }

// Degrees without a known CRS name: tiny horizontal extent, yet metres high, and away from the origin.
bool looksLikeDegrees(const Box3d& box) noexcept {
    const Vec3d size = box.size();
    const Vec3d center = box.center();
    return std::max(size.x, size.y) < 0.02 && std::max(size.x, size.y) > 0 && size.z > 1 &&
           std::abs(center.x) + std::abs(center.y) > 5 && std::abs(center.x) <= 180 && std::abs(center.y) <= 180;
}

// The order of the axes that the coordinates show: +1 as given, -1 swapped, 0 both or none. The range of degrees, the
// usual magnitudes of a projection and the area of use of the CRS decide.
int shownOrder(const Box3d& box, int code, bool isDegrees) {
    const auto swapped = [](Vec3d p) { return Vec3d{p.y, p.x, p.z}; };
    if (isDegrees) {
        const auto isOnEarth = [](Vec3d p) { return std::abs(p.y) <= 91; };
        const bool asGiven = isOnEarth(box.min) && isOnEarth(box.max);
        const bool isSwapped = isOnEarth(swapped(box.min)) && isOnEarth(swapped(box.max));
        if (asGiven != isSwapped) return asGiven ? 1 : -1;
    }
    const Vec3d center = box.center();
    for (const Magnitudes& known : kMagnitudes) {
        if (code < known.codes.first || code > known.codes.last) continue;
        const auto fits = [&](Vec3d p) {
            return isWithin(p.x, known.eastMin, known.eastMax) && isWithin(p.y, known.northMin, known.northMax);
        };
        if (fits(center) != fits(swapped(center))) return fits(center) ? 1 : -1;
    }
    const auto asGiven = crs::isInAreaOfUse(code, center);
    const auto isSwapped = asGiven ? crs::isInAreaOfUse(code, swapped(center)) : asGiven;
    return !isSwapped || *asGiven == *isSwapped ? 0 : *asGiven ? 1 : -1;
}

// Follows the name, unless the coordinates are possible only in the other order.
void settleOrder(AxisDecision& decision, bool isPromised, int shown) {
    decision.isNorthFirst = shown == 0 ? isPromised : shown < 0;
    decision.isDoubtful = decision.isNorthFirst != isPromised;
    if (!decision.isDoubtful) return;
    decision.remark =
        decision.isNorthFirst
            ? "the coordinates are in north, east order, although this form of the name means east, north; in that "
              "order they would lie outside of the area in which the CRS is used"
            : "the coordinates are in east, north order, although this form of the name means north, east; in that "
              "order they would lie outside of the area in which the CRS is used";
}

AxisDecision decideDegrees(string_view name, const Box3d& box, int code) {
    AxisDecision decision;
    decision.hasNorthFirst = true;
    decision.isGeographic = box.isEmpty() || (std::max(std::abs(box.min.x), std::abs(box.max.x)) <= 360 &&
                                              std::max(std::abs(box.min.y), std::abs(box.max.y)) <= 360);
    if (!decision.isGeographic) {
        decision.remark = "the srsName means degrees, but the coordinates are too large for that; taken as metres";
        return decision;
    }
    if (box.isEmpty()) return decision;
    settleOrder(decision, promisesAuthorityOrder(name) && !isCrs84(name),
                shownOrder(box, isCrs84(name) ? 4326 : code, true));
    return decision;
}

}  // namespace

int epsgCode(string_view name) noexcept { return crs::codesOf(name).code; }

int verticalCode(string_view name) noexcept { return crs::codesOf(name).vertical; }

bool isCrs84(string_view name) noexcept { return findIgnoringCase(name, "CRS84") != string_view::npos; }

bool isSameCrs(string_view a, string_view b) noexcept {
    const int codeA = crs::codesOf(a).horizontal;
    const int codeB = crs::codesOf(b).horizontal;
    return codeA != 0 && codeB != 0 ? codeA == codeB : a == b;
}

AxisDecision decideAxes(string_view name, const Box3d& box) {
    const int code = epsgCode(name);
    const crs::CrsFacts facts = crs::factsOf(code);
    if (facts.isDegrees || isCrs84(name)) return decideDegrees(name, box, code);
    AxisDecision decision;
    if (box.isEmpty()) return decision;
    if (code == 0 && looksLikeDegrees(box)) {
        decision.isGeographic = true;
        return decision;
    }
    if (facts.order == crs::AxisOrder::SouthWest)
        decision.remark = "the axes of this CRS point south or west; the coordinates are taken as east and north";
    decision.hasNorthFirst = facts.order == crs::AxisOrder::NorthEast;
    if (decision.remark.empty())
        settleOrder(decision, decision.hasNorthFirst && promisesAuthorityOrder(name), shownOrder(box, code, false));
    return decision;
}

}  // namespace svt::readers::gml

#include <svt/readers/gml/gml_crs.hpp>

#include <svt/core/text.hpp>
#include <svt/crs/crs_facts.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::readers::gml {
namespace {

using std::string_view;

char lower(char c) noexcept { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::size_t findIgnoringCase(string_view text, string_view word) noexcept {
    const auto found = std::search(text.begin(), text.end(), word.begin(), word.end(),
                                   [](char a, char b) { return lower(a) == lower(b); });
    return found == text.end() ? string_view::npos : static_cast<std::size_t>(found - text.begin());
}

// The last run of digits in `text` as a number; 0 if there is none or it is not a code.
int lastNumber(string_view text) noexcept {
    while (!text.empty() && !isDigit(text.back())) text.remove_suffix(1);
    std::size_t begin = text.size();
    while (begin > 0 && isDigit(text[begin - 1])) --begin;
    if (text.size() - begin > 7) return 0;
    int value = 0;
    for (const char c : text.substr(begin)) value = value * 10 + (c - '0');
    return value;
}

// GeoInfoDok names used in German cadastre data; their axis order is east, north.
constexpr std::pair<string_view, int> kAdvNames[] = {
    {"ETRS89_UTM31", 25831}, {"ETRS89_UTM32", 25832}, {"ETRS89_UTM33", 25833}, {"DE_DHDN_3GK2", 31466},
    {"DE_DHDN_3GK3", 31467}, {"DE_DHDN_3GK4", 31468}, {"DE_DHDN_3GK5", 31469},
};

bool promisesAuthorityOrder(string_view name) noexcept {
    if (findIgnoringCase(name, "urn:adv:") != string_view::npos) return false;
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
    {{31466, 31466}, 2.2e6, 2.8e6, 5.1e6, 6.3e6},  // Germany, 3-degree Gauss-Krueger zones 2 to 4
    {{31467, 31467}, 3.2e6, 3.8e6, 5.1e6, 6.3e6}, {{31468, 31468}, 4.2e6, 4.8e6, 5.1e6, 6.3e6},
    {{3006, 3006}, 2.0e5, 1.0e6, 6.0e6, 7.8e6},  // Sweden
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

// Degrees of one of two orders: which of them lies on earth, else which lies in the area of use; 0: both or none.
int orderOfDegrees(const Box3d& box, int code) noexcept {
    const auto has = [](const Box3d& area, double x, double y) {
        return x >= area.min.x - 1 && x <= area.max.x + 1 && y >= area.min.y - 1 && y <= area.max.y + 1;
    };
    const auto lies = [&](const Box3d& area, bool isSwapped) {
        return isSwapped ? has(area, box.min.y, box.min.x) && has(area, box.max.y, box.max.x)
                         : has(area, box.min.x, box.min.y) && has(area, box.max.x, box.max.y);
    };
    const Box3d earth{{-360, -90, 0}, {360, 90, 0}};
    for (const Box3d& area : {earth, crs::areaOf(code).value_or(earth)}) {
        const bool asGiven = lies(area, false), swapped = lies(area, true);
        if (asGiven != swapped) return asGiven ? 1 : -1;
    }
    return 0;
}

void remarkOnOrder(AxisDecision& decision, bool isPromised) {
    if (decision.isNorthFirst == isPromised) return;
    decision.remark =
        decision.isNorthFirst
            ? "the coordinates are in north, east order, although this form of the name means east, north"
            : "the coordinates are in east, north order, although this form of the name means north, east";
}

AxisDecision decideDegrees(string_view name, const Box3d& box, int code, int handedness) {
    AxisDecision decision;
    decision.isGeographic = box.isEmpty() || (std::max(std::abs(box.min.x), std::abs(box.max.x)) <= 360 &&
                                              std::max(std::abs(box.min.y), std::abs(box.max.y)) <= 360);
    if (!decision.isGeographic) {
        decision.remark = "the srsName means degrees, but the coordinates are too large for that; taken as metres";
        return decision;
    }
    if (box.isEmpty()) return decision;
    const bool isPromised = promisesAuthorityOrder(name) && !isCrs84(name);
    const int shown = orderOfDegrees(box, isCrs84(name) ? 4326 : code);
    decision.isNorthFirst = shown != 0 ? shown < 0 : handedness != 0 ? handedness < 0 : isPromised;
    remarkOnOrder(decision, isPromised);
    return decision;
}

}  // namespace

int epsgCode(string_view name) noexcept {
    const std::size_t at = findIgnoringCase(name, "epsg");
    if (at != string_view::npos) {
        const string_view rest = name.substr(at + 4);
        return lastNumber(rest.substr(0, rest.find_first_of(",&;+ ")));
    }
    for (const auto& [adv, code] : kAdvNames)
        if (name.find(adv) != string_view::npos) return code;
    const bool isNumber = !name.empty() && std::all_of(name.begin(), name.end(), isDigit);
    return isNumber ? lastNumber(name) : 0;
}

int verticalCode(string_view name) noexcept {
    const std::size_t first = findIgnoringCase(name, "epsg");
    if (first == string_view::npos) return 0;
    string_view rest = name.substr(first + 4);
    if (const std::size_t second = findIgnoringCase(rest, "epsg"); second != string_view::npos)
        return epsgCode(rest.substr(second));
    const std::size_t plus = rest.find('+');
    return plus == string_view::npos ? 0 : lastNumber(rest.substr(plus + 1));
}

bool isCrs84(string_view name) noexcept { return findIgnoringCase(name, "CRS84") != string_view::npos; }

bool isSameCrs(string_view a, string_view b) noexcept {
    const int codeA = epsgCode(a);
    const int codeB = epsgCode(b);
    return codeA != 0 && codeB != 0 ? codeA == codeB : a == b;
}

AxisDecision decideAxes(string_view name, const Box3d& box, int handedness) {
    const int code = epsgCode(name);
    const crs::CrsFacts facts = crs::factsOf(code);
    if (facts.isDegrees || isCrs84(name)) return decideDegrees(name, box, code, handedness);
    AxisDecision decision;
    if (box.isEmpty()) return decision;
    if (code == 0 && looksLikeDegrees(box)) {
        decision.isGeographic = true;
        return decision;
    }
    if (facts.order == crs::AxisOrder::SouthWest)
        decision.remark = "the axes of this CRS point south or west; the coordinates are taken as east and north";
    if (facts.order != crs::AxisOrder::NorthEast) return decision;

    const bool promised = promisesAuthorityOrder(name);
    decision.isNorthFirst = handedness == 0 ? promised : handedness < 0;
    const Vec3d center = box.center();
    for (const Magnitudes& known : kMagnitudes) {
        if (code < known.codes.first || code > known.codes.last) continue;
        const bool isEastFirst =
            isWithin(center.x, known.eastMin, known.eastMax) && isWithin(center.y, known.northMin, known.northMax);
        const bool isNorthFirst =
            isWithin(center.y, known.eastMin, known.eastMax) && isWithin(center.x, known.northMin, known.northMax);
        if (isEastFirst != isNorthFirst) decision.isNorthFirst = isNorthFirst;
    }
    remarkOnOrder(decision, promised);
    return decision;
}

}  // namespace svt::readers::gml

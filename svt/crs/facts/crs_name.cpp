#include <svt/crs/crs_name.hpp>

#include <svt/core/text.hpp>
#include <svt/crs/crs_facts.hpp>

#include <algorithm>

namespace svt::crs {
namespace {

using std::string_view;

constexpr std::size_t kMissing = string_view::npos;

std::size_t findIgnoringCase(string_view text, string_view word) noexcept {
    const auto found = std::search(text.begin(), text.end(), word.begin(), word.end(),
                                   [](char a, char b) { return lowerAscii(a) == lowerAscii(b); });
    return found == text.end() ? kMissing : static_cast<std::size_t>(found - text.begin());
}

// The last run of digits in `text` as a number; 0 if there is none or it is too long for a code.
int lastNumber(string_view text) noexcept {
    while (!text.empty() && !isDigit(text.back())) text.remove_suffix(1);
    std::size_t begin = text.size();
    while (begin > 0 && isDigit(text[begin - 1])) --begin;
    if (text.size() - begin > 7) return 0;
    int value = 0;
    for (const char c : text.substr(begin)) value = value * 10 + (c - '0');
    return value;
}

// The code behind the first "EPSG" of a name, and the text behind that code. A version may precede the code.
int codeBehindEpsg(string_view& name) noexcept {
    const std::size_t at = findIgnoringCase(name, "epsg");
    if (at == kMissing) return 0;
    name.remove_prefix(at + 4);
    while (!name.empty() && (name.front() == ' ' || name.front() == ':')) name.remove_prefix(1);
    const std::size_t end = std::min(name.find_first_of(",&;+ ()"), name.size());
    const int code = lastNumber(name.substr(0, end));
    name.remove_prefix(end);
    return code;
}

struct Alias {
    string_view part;  ///< of a name
    int code;
};
// The first that a name contains counts.
constexpr Alias kPlans[] = {
    {"DE_DHDN_3GK2", 31466}, {"DE_DHDN_3GK3", 31467}, {"DE_DHDN_3GK4", 31468}, {"DE_DHDN_3GK5", 31469},
    {"CH1903+", 2056},       {"LV95", 2056},          {"CH1903", 21781},       {"LV03", 21781},
    {"RD New", 28992},       {"RDNew", 28992},        {"Lambert-93", 2154},    {"Lambert93", 2154},
};
constexpr Alias kHeights[] = {
    {"DHHN2016", 7837}, {"DHHN92", 5783}, {"DHHN12", 5699}, {"NAP", 5709}, {"LN02", 5728}, {"LHN95", 5729},
};
// The code of a system with UTM zones is that of its zone 0 and the zone: ETRS89_UTM32, "ETRS89 / UTM zone 32N".
struct UtmSystem {
    string_view name;
    int north, south;  ///< 0: it has no zones there
};
constexpr UtmSystem kUtmSystems[] = {{"ETRS89", 25800, 0}, {"WGS 84", 32600, 32700}, {"WGS84", 32600, 32700}};

template <std::size_t N>
int aliasIn(string_view name, const Alias (&aliases)[N]) noexcept {
    for (const Alias& alias : aliases)
        if (name.find(alias.part) != kMissing) return alias.code;
    return 0;
}

int utmIn(string_view name) noexcept {
    const std::size_t at = findIgnoringCase(name, "UTM");
    if (at == kMissing) return 0;
    string_view zone = name.substr(at + 3);
    const std::size_t begin = zone.find_first_of("0123456789");
    if (begin == kMissing || begin > 8) return 0;
    zone.remove_prefix(begin);
    std::size_t digits = 0;
    int number = 0;
    for (; digits < zone.size() && digits < 3 && isDigit(zone[digits]); ++digits)
        number = 10 * number + (zone[digits] - '0');
    if (number < 1 || number > 60) return 0;
    const bool isSouth = digits < zone.size() && lowerAscii(zone[digits]) == 's';
    for (const UtmSystem& system : kUtmSystems)
        if (findIgnoringCase(name, system.name) != kMissing) {
            const int base = isSouth ? system.south : system.north;
            // ETRS89 has the zones of Europe.
            return base == 0 || (base == 25800 && (number < 28 || number > 38)) ? 0 : base + number;
        }
    return 0;
}

// The vertical code in the text behind the first one: "+5783", "EPSG::5783", or that of the system that SVT converted.
int verticalIn(string_view rest) noexcept {
    if (const std::size_t from = rest.find("(from "); from != kMissing) return codesOf(rest.substr(from)).vertical;
    string_view next = rest;
    if (const int code = codeBehindEpsg(next); code != 0) return code;
    const std::size_t plus = rest.find('+');
    if (plus != kMissing)
        if (const int code = lastNumber(rest.substr(plus + 1)); code != 0) return code;
    return aliasIn(rest, kHeights);
}

}  // namespace

CrsCodes codesOf(string_view name) noexcept {
    CrsCodes codes;
    string_view rest = name;
    const bool isNumber = !name.empty() && std::all_of(name.begin(), name.end(), isDigit);
    codes.code = isNumber ? lastNumber(name) : codeBehindEpsg(rest);
    if (isNumber) rest = {};
    if (codes.code == 0 && findIgnoringCase(name, "epsg") == kMissing) {
        rest = name;
        codes.code = aliasIn(name, kPlans);
        if (codes.code == 0) codes.code = utmIn(name);
        if (codes.code != 0) codes.vertical = aliasIn(name, kHeights);
    }
    if (codes.code == 0) return codes;
    const CrsFacts facts = factsOf(codes.code);
    codes.horizontal = facts.horizontal;
    if (codes.vertical == 0) codes.vertical = facts.vertical != 0 ? facts.vertical : verticalIn(rest);
    return codes;
}

std::uint32_t epsgCodeOf(string_view name) noexcept { return static_cast<std::uint32_t>(codesOf(name).horizontal); }

}  // namespace svt::crs

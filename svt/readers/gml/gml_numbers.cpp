#include <svt/readers/gml/gml_numbers.hpp>

#include <svt/core/text.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace svt::readers::gml {
namespace {

using std::string_view;

// Powers of ten that a double holds exactly.
constexpr double kExactPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                   1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Plain decimals such as -458876.123: if the digits fit 53 bits and the power of ten is exact, one division
// is correctly rounded (Clinger, How to read floating point numbers accurately, 1990). For anything else returns
// false and does not move `at`; the caller then uses from_chars.
bool parsePlain(const char*& at, const char* end, double& value) noexcept {
    const char* p = at;
    const bool isNegative = p != end && *p == '-';
    if (isNegative) ++p;
    std::uint64_t digits = 0;
    const char* const first = p;
    while (p != end && isDigit(*p)) digits = digits * 10 + static_cast<std::uint64_t>(*p++ - '0');
    std::ptrdiff_t count = p - first;
    std::ptrdiff_t decimals = 0;
    if (p != end && *p == '.') {
        const char* const point = ++p;
        while (p != end && isDigit(*p)) digits = digits * 10 + static_cast<std::uint64_t>(*p++ - '0');
        decimals = p - point;
        count += decimals;
    }
    // 18 digits cannot overflow 64 bits.
    if (count == 0 || count > 18 || digits > (std::uint64_t{1} << 53) || (p != end && !isBlank(*p))) return false;
    const double magnitude = static_cast<double>(digits) / kExactPowers[decimals];
    value = isNegative ? -magnitude : magnitude;
    at = p;
    return true;
}

// One token in any notation; false if it is not a number.
bool parseToken(string_view token, double& value) noexcept {
    if (token.size() > 1 && token[0] == '+' && token[1] != '-' && token[1] != '+') token.remove_prefix(1);
    const char* const end = token.data() + token.size();
    const std::from_chars_result result = std::from_chars(token.data(), end, value);
    if (result.ptr != end) return false;
    if (result.ec == std::errc::result_out_of_range) {
        // Underflow becomes zero, overflow infinity.
        const std::size_t exponent = token.find_first_of("eE");
        const bool isTiny = exponent != string_view::npos ? token.find('-', exponent) != string_view::npos
                                                          : token.starts_with("0") || token.starts_with("-0");
        value = isTiny ? 0.0 : std::numeric_limits<double>::infinity();
        return true;
    }
    return result.ec == std::errc{};
}

}  // namespace

string_view parseNumbers(string_view text, std::vector<double>& numbers) {
    const char* p = text.data();
    const char* const end = p + text.size();
    while (true) {
        while (p != end && isBlank(*p)) ++p;
        if (p == end) return {};
        double value = 0;
        if (!parsePlain(p, end, value)) {
            const char* const tokenEnd = std::find_if(p, end, isBlank);
            const string_view token(p, static_cast<std::size_t>(tokenEnd - p));
            if (!parseToken(token, value)) return token;
            p = tokenEnd;
        }
        numbers.push_back(value);
    }
}

std::optional<double> parseNumber(string_view text) {
    while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
    double value = 0;
    if (text.empty() || !parseToken(text, value)) return std::nullopt;
    return value;
}

std::optional<Tuples> parseTuples(string_view text, char decimal, char memberSeparator, char tupleSeparator) {
    Tuples tuples;
    std::string token;
    bool isUniform = true;
    std::size_t members = 0;
    bool failed = false;
    const auto endMember = [&] {
        if (token.empty()) return;
        const std::optional<double> value = parseNumber(token);
        if (value)
            tuples.numbers.push_back(*value);
        else
            failed = true;
        ++members;
        token.clear();
    };
    const auto endTuple = [&] {
        endMember();
        if (members == 0) return;
        if (tuples.dimension == 0) tuples.dimension = members;
        isUniform = isUniform && members == tuples.dimension;
        members = 0;
    };
    for (const char c : text) {
        const bool separatesTuples = c == tupleSeparator || (isBlank(tupleSeparator) && isBlank(c));
        if (c == memberSeparator && c != tupleSeparator)
            endMember();
        else if (separatesTuples)
            endTuple();
        else if (c == decimal)
            token += '.';
        else if (!isBlank(c))
            token += c;
        else
            endMember();
    }
    endTuple();
    if (failed || !isUniform) return std::nullopt;
    return tuples;
}

}  // namespace svt::readers::gml

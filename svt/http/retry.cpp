#include <svt/http/retry.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <thread>

namespace svt::http {
namespace {

constexpr double kFirstRetrySeconds = 0.25;

// "Sun, 06 Nov 1994 08:49:37 GMT", the only format of a date that servers may send.
std::optional<std::int64_t> secondsOfDate(std::string_view text) {
    constexpr std::array<std::string_view, 12> kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                       "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    constexpr std::string_view kForm = "XXX, 00 XXX 0000 00:00:00 GMT";
    if (text.size() != kForm.size()) return std::nullopt;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool isDigit = text[i] >= '0' && text[i] <= '9';
        if (kForm[i] == '0' ? !isDigit : kForm[i] != 'X' && text[i] != kForm[i]) return std::nullopt;
    }
    const auto number = [&](std::size_t at, std::size_t size) {
        int value = 0;
        std::from_chars(text.data() + at, text.data() + at + size, value);
        return value;
    };
    const int day = number(5, 2), year = number(12, 4), hour = number(17, 2), minute = number(20, 2),
              second = number(23, 2);
    const auto* const found = std::ranges::find(kMonths, text.substr(8, 3));
    if (found == kMonths.end()) return std::nullopt;
    const std::chrono::year_month_day date(std::chrono::year(year),
                                           std::chrono::month(static_cast<unsigned>(found - kMonths.begin()) + 1),
                                           std::chrono::day(static_cast<unsigned>(day)));
    if (!date.ok()) return std::nullopt;
    const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
    return ((days * 24 + hour) * 60 + minute) * 60 + second;
}

// The time that a server asks for; 0: no readable time.
double askedSeconds(std::string_view retryAfter, std::int64_t now) {
    std::uint32_t seconds = 0;
    const char* const end = retryAfter.data() + retryAfter.size();
    const auto [at, failed] = std::from_chars(retryAfter.data(), end, seconds);
    if (failed == std::errc() && at == end) return seconds;
    if (const auto date = secondsOfDate(retryAfter)) return static_cast<double>(std::max<std::int64_t>(0, *date - now));
    return 0;
}

}  // namespace

RetryClock machineClock() {
    return {[](double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); },
            [] {
                using namespace std::chrono;
                return std::int64_t{duration_cast<seconds>(system_clock::now().time_since_epoch()).count()};
            }};
}

double retrySeconds(int attempt, std::string_view retryAfter, std::int64_t now) {
    return std::max(std::ldexp(kFirstRetrySeconds, attempt - 1), askedSeconds(retryAfter, now));
}

}  // namespace svt::http

#include <svt/record/times.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace svt::record {
namespace {

constexpr std::int64_t kDaySeconds = 86400;

// Days since 1970-01-01 of the proleptic Gregorian calendar: H. Hinnant, "chrono-Compatible Low-Level Date Algorithms".
std::int64_t daysOfDate(std::int64_t year, int month, int day) noexcept {
    year -= month <= 2 ? 1 : 0;
    const std::int64_t era = (year >= 0 ? year : year - 399) / 400, yearOfEra = year - era * 400;
    const std::int64_t dayOfYear = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
    return era * 146097 + yearOfEra * 365 + yearOfEra / 4 - yearOfEra / 100 + dayOfYear - 719468;
}

int daysOfMonth(int year, int month) noexcept {
    constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool isLeap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    return month == 2 && isLeap ? 29 : kDays[month - 1];
}

// Removes `count` digits from the front of a text.
bool takeDigits(std::string_view& text, std::size_t count, int& to) noexcept {
    if (text.size() < count) return false;
    to = 0;
    for (std::size_t n = 0; n < count; ++n) {
        if (!isDigit(text[n])) return false;
        to = to * 10 + (text[n] - '0');
    }
    text.remove_prefix(count);
    return true;
}

bool takeMark(std::string_view& text, char mark) noexcept {
    if (!text.starts_with(mark)) return false;
    text.remove_prefix(1);
    return true;
}

// Removes the fraction of a second.
bool takeFraction(std::string_view& text, double& to) noexcept {
    if (!text.starts_with('.') && !text.starts_with(',')) return true;
    std::size_t n = 1;
    double scale = 0.1;
    for (; n < text.size() && isDigit(text[n]); ++n, scale /= 10) to += (text[n] - '0') * scale;
    if (n == 1) return false;
    text.remove_prefix(n);
    return true;
}

// The zone at the end of a text, in seconds; nothing where there is none or it is not valid.
bool takeZone(std::string_view text, IsoTime& time) noexcept {
    if (text.empty()) return true;
    time.hasZone = true;
    if (text == "Z" || text == "z") return true;
    const int sign = text[0] == '-' ? -1 : 1;
    int hours = 0, minutes = 0;
    if (!takeMark(text, '+') && !takeMark(text, '-')) return false;
    if (!takeDigits(text, 2, hours)) return false;
    (void)takeMark(text, ':');
    if (!text.empty() && !takeDigits(text, 2, minutes)) return false;
    if (!text.empty() || hours > 18 || minutes > 59) return false;
    time.seconds -= sign * (hours * 3600 + minutes * 60);
    return true;
}

}  // namespace

std::optional<IsoTime> parseIsoTime(std::string_view text) noexcept {
    text = withoutBlanks(text);
    int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
    if (!takeDigits(text, 4, year) || !takeMark(text, '-') || !takeDigits(text, 2, month) || !takeMark(text, '-') ||
        !takeDigits(text, 2, day))
        return std::nullopt;
    if (month < 1 || month > 12 || day < 1 || day > daysOfMonth(year, month)) return std::nullopt;
    IsoTime time;
    time.seconds = static_cast<double>(daysOfDate(year, month, day) * kDaySeconds);
    if (text.empty()) return time;
    if (!takeMark(text, 'T') && !takeMark(text, 't') && !takeMark(text, ' ')) return std::nullopt;
    double fraction = 0;
    if (!takeDigits(text, 2, hour) || !takeMark(text, ':') || !takeDigits(text, 2, minute)) return std::nullopt;
    if (takeMark(text, ':') && (!takeDigits(text, 2, second) || !takeFraction(text, fraction))) return std::nullopt;
    if (hour > 24 || (hour == 24 && minute + second > 0) || minute > 59 || second > 60) return std::nullopt;
    time.seconds += hour * 3600 + minute * 60 + (second == 60 ? 59 : second) + fraction;
    if (!takeZone(text, time)) return std::nullopt;
    return time;
}

std::string isoText(double seconds) {
    const double whole = std::floor(seconds);
    const auto total = static_cast<std::int64_t>(whole);
    std::int64_t days = total / kDaySeconds, rest = total % kDaySeconds;
    if (rest < 0) {
        rest += kDaySeconds;
        --days;
    }
    const std::int64_t shifted = days + 719468, era = (shifted >= 0 ? shifted : shifted - 146096) / 146097;
    const std::int64_t dayOfEra = shifted - era * 146097;
    const std::int64_t yearOfEra = (dayOfEra - dayOfEra / 1460 + dayOfEra / 36524 - dayOfEra / 146096) / 365;
    const std::int64_t dayOfYear = dayOfEra - (365 * yearOfEra + yearOfEra / 4 - yearOfEra / 100);
    const std::int64_t monthPart = (5 * dayOfYear + 2) / 153, day = dayOfYear - (153 * monthPart + 2) / 5 + 1;
    const std::int64_t month = monthPart + (monthPart < 10 ? 3 : -9);
    const std::int64_t year = yearOfEra + era * 400 + (month <= 2 ? 1 : 0);
    const auto milliseconds = static_cast<int>((seconds - whole) * 1000);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}{}Z", year, month, day, rest / 3600, rest / 60 % 60,
                       rest % 60, milliseconds > 0 ? fmt::format(".{:03}", milliseconds) : "");
}

bool TimeReader::read(std::string_view text, std::optional<double> number, double& to, std::string& fault) {
    const auto date = number ? std::nullopt : parseIsoTime(text);
    if (!number && !date) {
        fault = fmt::format("'{}' is not a time; seconds or an ISO 8601 time such as 2026-01-05T08:15:00Z are expected",
                            text);
        return false;
    }
    const bool hasNoZone = date && !date->hasZone;
    if (!isFirst_ && date.has_value() != isDated_) {
        fault = fmt::format("'{}' is {}, but the first time is not", text, date ? "a date" : "a number of seconds");
        return false;
    }
    if (!isFirst_ && hasNoZone != hasNoZone_) {
        fault = fmt::format("'{}' {} a time zone, unlike the first time", text, hasNoZone ? "lacks" : "has");
        return false;
    }
    isFirst_ = false;
    isDated_ = date.has_value();
    hasNoZone_ = hasNoZone;
    to = number ? *number : date->seconds;
    return true;
}

}  // namespace svt::record

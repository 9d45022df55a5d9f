#include <svt/illustrate/sun.hpp>

#include <svt/crs/crs_name.hpp>
#include <svt/crs/globe.hpp>
#include <svt/drawing/north.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <string>
#include <variant>

namespace svt::illustrate {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

double turnOf(double degrees) { return degrees - 360 * std::floor(degrees / 360); }

struct Equatorial {
    double rightAscension, declination;  // degrees, apparent
    double siderealTime;                 // degrees, apparent, of Greenwich
};

// Meeus, chapter 25, low accuracy; sidereal time by equation 12.4.
Equatorial sunAt(double julianDay) {
    const double t = (julianDay - 2451545.0) / 36525;
    const double meanLongitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
    const double anomaly = (357.52911 + t * (35999.05029 - t * 0.0001537)) * kDegree;
    const double center = std::sin(anomaly) * (1.914602 - t * (0.004817 + 0.000014 * t)) +
                          std::sin(2 * anomaly) * (0.019993 - 0.000101 * t) + std::sin(3 * anomaly) * 0.000289;
    const double node = (125.04 - 1934.136 * t) * kDegree;
    const double longitude = (meanLongitude + center - 0.00569 - 0.00478 * std::sin(node)) * kDegree;
    const double meanTilt = 23 + (26 + (21.448 - t * (46.8150 + t * (0.00059 - t * 0.001813))) / 60) / 60;
    const double tilt = (meanTilt + 0.00256 * std::cos(node)) * kDegree;
    const double sidereal = 280.46061837 + 360.98564736629 * (julianDay - 2451545.0) + 0.000387933 * t * t;
    return {turnOf(std::atan2(std::cos(tilt) * std::sin(longitude), std::cos(longitude)) / kDegree),
            std::asin(std::sin(tilt) * std::sin(longitude)) / kDegree,
            turnOf(sidereal - 0.00478 * std::sin(node) * std::cos(tilt))};
}

// Reads whole numbers and single characters, one after the other.
class TextReader {
public:
    explicit TextReader(std::string_view text) : text_(text) {}
    [[nodiscard]] bool isAtEnd() const { return at_ == text_.size(); }
    bool take(std::string_view any) {
        if (isAtEnd() || any.find(text_[at_]) == std::string_view::npos) return false;
        ++at_;
        return true;
    }
    // A number of `digits` digits up to `most`.
    std::optional<int> number(std::size_t digits, int least, int most) {
        int value = 0;
        for (std::size_t n = 0; n < digits; ++n, ++at_) {
            if (isAtEnd() || text_[at_] < '0' || text_[at_] > '9') return std::nullopt;
            value = 10 * value + (text_[at_] - '0');
        }
        if (value < least || value > most) return std::nullopt;
        return value;
    }

private:
    std::string_view text_;
    std::size_t at_ = 0;
};

// Meeus, equation 7.1, for the Gregorian calendar.
double julianDayOf(int year, int month, double day) {
    if (month <= 2) {
        --year;
        month += 12;
    }
    const int century = year / 100;
    const int skippedLeapDays = 2 - century + century / 4;
    return std::floor(365.25 * (year + 4716)) + std::floor(30.6001 * (month + 1)) + day + skippedLeapDays - 1524.5;
}

int daysIn(int year, int month) {
    constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool isLeap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    return month == 2 && isLeap ? 29 : kDays[month - 1];
}

// Hours east of Greenwich at the end of a time; empty if the text is invalid.
std::optional<double> zoneAt(TextReader& read, double longitude) {
    read.take(" ");
    if (read.isAtEnd()) return std::round(longitude / 15);
    if (read.take("Zz")) return 0.0;
    const bool isEast = read.take("+");
    if (!isEast && !read.take("-")) return std::nullopt;
    const auto hours = read.number(2, 0, 14);
    if (!hours) return std::nullopt;
    std::optional<int> minutes = 0;
    if (read.take(":")) minutes = read.number(2, 0, 59);
    if (!minutes) return std::nullopt;
    return (isEast ? 1 : -1) * (*hours + *minutes / 60.0);
}

double numberOf(const AttributeValue& value) {
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
    return std::nan("");
}

std::optional<double> attributeOf(const volume::SemanticVolume& volume, std::string_view name) {
    for (const volume::Label& label : volume.labels.labels)
        for (const Attribute& attribute : label.attributes)
            if (attribute.name == name)
                if (const double value = numberOf(attribute.value); std::isfinite(value)) return value;
    return std::nullopt;
}

// Where a building stands.
struct Site {
    double latitude, longitude;
};

std::optional<Site> siteOfCrs(const volume::SemanticVolume& volume) {
    const auto epsg = static_cast<int>(crs::epsgCodeOf(volume.crsName));
    if (epsg == 0) return std::nullopt;
    const Vec3d at = volume.grid.origin();
    const auto place = crs::placeOnEarth(epsg, at);
    if (!place) return std::nullopt;
    return Site{place->y, place->x};
}

std::optional<Site> siteOfAttributes(const volume::SemanticVolume& volume) {
    const auto latitude = attributeOf(volume, "latitude"), longitude = attributeOf(volume, "longitude");
    if (!latitude || !longitude || std::abs(*latitude) > 90 || std::abs(*longitude) > 180) return std::nullopt;
    return Site{*latitude, *longitude};
}

}  // namespace

SunPosition sunPosition(double julianDay, double latitude, double longitude) noexcept {
    const Equatorial sun = sunAt(julianDay);
    const double hour = (sun.siderealTime + longitude - sun.rightAscension) * kDegree;
    const double phi = latitude * kDegree, declination = sun.declination * kDegree;
    // Meeus, equations 13.5 and 13.6; his azimuth is from the south.
    const double south =
        std::atan2(std::sin(hour), std::cos(hour) * std::sin(phi) - std::tan(declination) * std::cos(phi));
    const double height = std::asin(std::clamp(
        std::sin(phi) * std::sin(declination) + std::cos(phi) * std::cos(declination) * std::cos(hour), -1.0, 1.0));
    return {turnOf(south / kDegree + 180), height / kDegree};
}

Result<double> parseSunTime(std::string_view text, double longitude) {
    const auto bad = [&] {
        return Error(Code::BadScene,
                     fmt::format("time of the sun '{}': expected a date from 1900 to 2100 and an hour, such as "
                                 "'2026-06-21 15:00', with Z or +02:00 where that is its zone",
                                 text));
    };
    TextReader read(text);
    const auto year = read.number(4, 1900, 2100);
    if (!year || !read.take("-")) return bad();
    const auto month = read.number(2, 1, 12);
    if (!month || !read.take("-")) return bad();
    const auto day = read.number(2, 1, daysIn(*year, *month));
    if (!day || !read.take(" T")) return bad();
    const auto hour = read.number(2, 0, 24);
    if (!hour || !read.take(":")) return bad();
    const auto minute = read.number(2, 0, 59);
    std::optional<int> second = 0;
    if (minute && read.take(":")) second = read.number(2, 0, 59);
    if (!minute || !second) return bad();
    const auto zone = zoneAt(read, longitude);
    if (!zone || !read.isAtEnd()) return bad();
    return julianDayOf(*year, *month, *day + (*hour + *minute / 60.0 + *second / 3600.0 - *zone) / 24);
}

Result<Sunlight> sunlightOf(const Sun& sun, const volume::SemanticVolume& volume) {
    std::optional<Site> site;
    if (sun.place) site = Site{(*sun.place)[0], (*sun.place)[1]};
    if (site && std::abs(site->latitude) > 90)
        return Error(Code::BadScene,
                     fmt::format("a latitude of {} degrees; -90 to 90 are possible, and it comes before the "
                                 "longitude",
                                 site->latitude));
    if (!site) site = siteOfCrs(volume);
    if (!site) site = siteOfAttributes(volume);
    if (!site)
        return Error(Code::BadScene,
                     "the model does not state its place on earth, so the position of the sun is unknown; give the "
                     "place (--place LAT,LON)");
    SVT_TRY(day, parseSunTime(sun.time, site->longitude));
    Sunlight light{sunPosition(*day, site->latitude, site->longitude), {}, site->latitude, site->longitude};
    const double azimuth = (light.position.azimuth + drawing::northOf(volume).degrees) * kDegree,
                 height = light.position.elevation * kDegree;
    light.direction = {std::sin(azimuth) * std::cos(height), std::cos(azimuth) * std::cos(height), std::sin(height)};
    return light;
}

}  // namespace svt::illustrate

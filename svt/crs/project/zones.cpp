#include <svt/crs/project/zones.hpp>

#include <svt/crs/facts/table_search.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::crs::project {
namespace {

// Origins of zones I to XIX, latitude and longitude (Geospatial Information Authority of Japan, notice 9 of 2002).
constexpr std::pair<double, double> kJapaneseOrigins[] = {{33, 129.5},
                                                          {33, 131},
                                                          {36, 132 + 1.0 / 6},
                                                          {33, 133.5},
                                                          {36, 134 + 1.0 / 3},
                                                          {36, 136},
                                                          {36, 137 + 1.0 / 6},
                                                          {36, 138.5},
                                                          {36, 139 + 5.0 / 6},
                                                          {40, 140 + 5.0 / 6},
                                                          {44, 140.25},
                                                          {44, 142.25},
                                                          {44, 144.25},
                                                          {26, 142},
                                                          {26, 127.5},
                                                          {26, 124},
                                                          {26, 131},
                                                          {20, 136},
                                                          {26, 154}};

// First codes of the plane rectangular systems.
struct JapaneseSystem {
    int datum, firstCode;
};
constexpr JapaneseSystem kJapaneseSystems[] = {{4612, 2443}, {6668, 6669}};

// Boxes that together cover the zones; the first box that contains the place counts.
struct ZoneBox {
    double south, west, north, east;
    int zone;
};
constexpr ZoneBox kJapaneseBoxes[] = {
    {15, 150, 30, 160, 19},           {15, 138.5, 28, 150, 14},       {15, 133, 24, 138.5, 18},
    {15, 129.5, 27, 133, 17},         {15, 125.9, 27.1, 129.5, 15},   {15, 120, 27, 125.9, 16},
    {41.35, 138, 50, 141.25, 11},     {41.6, 141.25, 50, 143.3, 12},  {42.6, 143.3, 50, 150, 13},
    {41.35, 141.25, 42.6, 150, 12},   {27, 120, 34.8, 130.25, 1},     {27, 130.25, 33.93, 132.05, 2},
    {33.93, 130.25, 37, 132.1, 3},    {34.0, 132.1, 37, 133.45, 3},   {27, 132.05, 34.0, 134.8, 4},
    {34.0, 133.45, 34.45, 134.45, 4}, {34.45, 133.45, 37, 135.35, 5}, {34.0, 134.45, 34.45, 134.75, 4},
    {33, 134.75, 34.7, 135.02, 5},    {33, 134.75, 36.35, 136.65, 6}, {34, 136.65, 35.1, 136.75, 6},
    {36.35, 135, 38, 137.65, 7},      {34, 136.65, 36.35, 137.5, 7},  {34, 137.5, 35.9, 139.1, 8},
    {35.9, 137.5, 36.7, 138.65, 8},   {36.7, 137.65, 38.6, 139.2, 8}, {28, 138.4, 37.85, 142, 9},
    {37.85, 139.2, 41.6, 143, 10},    {38, 135, 41.6, 139.2, 8}};

}  // namespace

int utmZone(Vec3d place) noexcept {
    const double lon = place.x, lat = place.y;
    if (lat >= 56 && lat < 64 && lon >= 3 && lon < 12) return 32;
    if (lat >= 72 && lat < 84 && lon >= 0 && lon < 42) return lon < 9 ? 31 : lon < 21 ? 33 : lon < 33 ? 35 : 37;
    const int zone = static_cast<int>(std::floor((lon + 180) / 6)) + 1;
    return zone > 60 ? zone - 60 : std::max(zone, 1);
}

int japaneseZone(Vec3d place) noexcept {
    for (const ZoneBox& box : kJapaneseBoxes)
        if (place.y >= box.south && place.y < box.north && place.x >= box.west && place.x < box.east) return box.zone;
    // In the sea between the boxes: the nearest origin.
    int nearest = 1;
    double least = kInfinity;
    for (std::size_t i = 0; i < std::size(kJapaneseOrigins); ++i) {
        const double north = place.y - kJapaneseOrigins[i].first, east = (place.x - kJapaneseOrigins[i].second) * 0.8;
        if (north * north + east * east >= least) continue;
        least = north * north + east * east;
        nearest = static_cast<int>(i) + 1;
    }
    return nearest;
}

std::optional<DatumZone> findZone(int epsg) {
    const auto make = [&](int code, std::string name, const Zone& zone) {
        const facts::Datum& datum = *facts::findDatum(code);
        return DatumZone{epsg, code, fmt::format("{} / {}", datum.name, name), datum.isWgs84 ? kWgs84 : kGrs80, zone};
    };
    constexpr int kJapaneseZones = static_cast<int>(std::size(kJapaneseOrigins));
    constexpr const char* kRoman[] = {"I",  "II",  "III",  "IV",  "V",  "VI",  "VII",  "VIII",  "IX", "X",
                                      "XI", "XII", "XIII", "XIV", "XV", "XVI", "XVII", "XVIII", "XIX"};
    for (const JapaneseSystem& system : kJapaneseSystems) {
        const int zone = epsg - system.firstCode;
        if (zone < 0 || zone >= kJapaneseZones) continue;
        return make(system.datum, fmt::format("Japan Plane Rectangular CS {}", kRoman[zone]),
                    {kJapaneseOrigins[zone].first, kJapaneseOrigins[zone].second, 0.9999, 0, 0});
    }
    for (const facts::UtmZones& row : facts::kUtmZones) {
        if (epsg < row.code || epsg > row.code + row.last - row.first) continue;
        const int zone = row.first + epsg - row.code;
        const bool isAustralian = row.datum == 4283 || row.datum == 7844;
        return make(row.datum,
                    isAustralian ? fmt::format("MGA zone {}", zone)
                                 : fmt::format("UTM zone {}{}", zone, row.isSouth ? 'S' : 'N'),
                    {0, zone * 6.0 - 183, 0.9996, 500000, row.isSouth ? 10000000.0 : 0.0});
    }
    return std::nullopt;
}

std::optional<DatumZone> usualZone(int degrees, Vec3d place) {
    const facts::Datum* const datum = facts::findDatum(degrees);
    if (datum == nullptr) return std::nullopt;
    for (const JapaneseSystem& system : kJapaneseSystems)
        if (system.datum == datum->epsg) return findZone(system.firstCode + japaneseZone(place) - 1);
    const int zone = utmZone(place);
    const bool isSouth = place.y < 0;
    // A datum may have zones only on one side of the equator; these zones are then also used on the other side.
    for (const bool side : {isSouth, !isSouth})
        for (const facts::UtmZones& row : facts::kUtmZones)
            if (row.datum == datum->epsg && row.isSouth == side && row.first <= zone && zone <= row.last)
                return findZone(row.code + zone - row.first);
    return std::nullopt;
}

}  // namespace svt::crs::project

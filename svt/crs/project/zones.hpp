#pragma once
/// \file
/// Zones of UTM and of the Japanese plane rectangular system, by place and by code.

#include <svt/crs/project/transverse_mercator.hpp>

#include <optional>
#include <string>

namespace svt::crs::project {

/// A transverse Mercator zone of a datum.
struct DatumZone {
    int epsg = 0;
    int datum = 0;  ///< code of the degrees
    std::string name;
    Ellipsoid ellipsoid{};
    Zone zone{};
};

/// The zone of a code, if it is a zone of a datum in the tables.
[[nodiscard]] std::optional<DatumZone> findZone(int epsg);

/// The usual zone of a datum at a place: of the Japanese plane rectangular system for JGD2000 and JGD2011, else of UTM.
/// \param degrees  code of degrees
/// \param place    x: longitude, y: latitude in degrees
/// \return nothing if the datum is not in the tables or has no zone there
[[nodiscard]] std::optional<DatumZone> usualZone(int degrees, Vec3d place);

/// UTM zone 1 to 60 of a place, with the exceptions of Norway and Svalbard.
[[nodiscard]] int utmZone(Vec3d place) noexcept;

/// Zone 1 to 19 of the Japanese plane rectangular system. Zones are assigned by prefecture; here they are boxes, so
/// along a border of prefectures the result may be the zone of the neighbour.
[[nodiscard]] int japaneseZone(Vec3d place) noexcept;

}  // namespace svt::crs::project

#pragma once
/// \file
/// Which zone of UTM or of the Japanese plane rectangular system a place lies in, and which zone a code means.

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

/// The zone that a code means, where it is one of a datum of the tables.
[[nodiscard]] std::optional<DatumZone> findZone(int epsg);

/// The usual zone of a datum at a place: of the Japanese plane rectangular system for JGD2000 and JGD2011, else of UTM.
/// \param degrees  code of degrees
/// \param place    x: longitude, y: latitude in degrees
/// \return nothing where the datum is not in the tables or has no zone there
[[nodiscard]] std::optional<DatumZone> usualZone(int degrees, Vec3d place);

/// UTM zone 1 to 60 of a place, with the exceptions of Norway and Svalbard.
[[nodiscard]] int utmZone(Vec3d place) noexcept;

/// Zone 1 to 19 of the Japanese plane rectangular system. Zones are assigned by prefecture; here they are boxes, so
/// along a border of prefectures it may be the neighbour's.
[[nodiscard]] int japaneseZone(Vec3d place) noexcept;

}  // namespace svt::crs::project

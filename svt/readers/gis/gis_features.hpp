#pragma once
/// \file
/// Features of GIS files: attributes and polygons in plan, as the file contains them.

#include <svt/core/attribute.hpp>
#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::readers::gis {

using GisRing = std::vector<Vec3d>;  ///< x, y; the first point is not repeated
struct GisPolygon {
    std::vector<GisRing> rings;  ///< outer ring, then holes, in any direction
};

struct GisFeature {
    std::vector<Attribute> attributes;
    std::vector<GisPolygon> polygons;
};

struct GisFile {
    std::vector<GisFeature> features;
    int epsg = 0;               ///< code of the CRS, 0: not named
    bool isUnknownCrs = false;  ///< a CRS is named, but its code is not known
    std::string crsText{};      ///< its name, for messages
    std::size_t skipped = 0;    ///< geometries that are not polygons
};

/// \return the features, or BadJson with the reason
[[nodiscard]] Result<GisFile> readGeoJson(std::string_view text, const std::string& name);
/// Polygons of all feature tables. \return the features, or BadValue, CannotOpen
[[nodiscard]] Result<GisFile> readGeoPackage(const std::filesystem::path& path);
/// \param table       bytes of the .dbf, or empty
/// \param projection  text of the .prj, or empty
/// \return the features, or BadValue: not a shapefile of polygons, or cut off
[[nodiscard]] Result<GisFile> readShapefile(std::span<const std::byte> bytes, std::span<const std::byte> table,
                                            std::string_view projection, const std::string& name);

/// Removes a repeated first point. \return whether the ring has three points and finite coordinates
[[nodiscard]] bool tidyRing(GisRing& ring);
/// Twice the signed area: positive if counter-clockwise.
[[nodiscard]] double twiceAreaOf(const GisRing& ring) noexcept;
/// The EPSG code of a CRS as well-known text, or 0.
[[nodiscard]] int epsgOfText(std::string_view text) noexcept;

}  // namespace svt::readers::gis

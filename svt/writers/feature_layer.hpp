#pragma once
/// \file
/// Features with values and an outline in plan, written one by one: CSV, GeoJSON, GeoPackage or GeoParquet, for tables
/// and GIS.

#include <svt/core/result.hpp>
#include <svt/writers/table.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace svt::writers {

/// A file to which features are added. It appears on disk only with finish().
class FeatureLayer {
public:
    /// \param path     ends in .csv (without outlines), .geojson, .gpkg (table `features`) or .parquet (column
    ///                 `geometry`)
    /// \param crsName  CRS of the coordinates, which are written unchanged; GeoJSON names it in the style of 2008,
    ///                 GeoParquet stores it as PROJJSON, which needs PROJ (omitted without PROJ)
    /// \return the layer, or BadArgument for another ending; CannotWrite, DiskFull
    [[nodiscard]] static Result<std::unique_ptr<FeatureLayer>> create(const std::filesystem::path& path,
                                                                      std::vector<Column> columns,
                                                                      const std::string& crsName);
    virtual ~FeatureLayer() = default;

    /// \param cells    one per column, of its type or empty
    /// \param outline  a simple ring (east, north) without repeating the first point; empty: none
    [[nodiscard]] virtual Result<void> add(std::span<const Cell> cells,
                                           std::span<const std::array<double, 2>> outline) = 0;
    /// \return bytes written, or CannotWrite, DiskFull. Equal features give equal bytes.
    [[nodiscard]] virtual Result<std::uint64_t> finish() = 0;
};

}  // namespace svt::writers

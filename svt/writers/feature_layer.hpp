#pragma once
/// \file
/// Features with an outline in plan and values, one after the other: CSV, GeoJSON, GeoPackage or GeoParquet, for tables
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

/// A file that features are added to. Nothing is there before finish().
class FeatureLayer {
public:
    /// \param path     ends in .csv (without outlines), .geojson, .gpkg (table `features`) or .parquet (column `geometry`)
    /// \param crsName  of the coordinates, which are written as they are; GeoJSON names it as its version of 2008 did,
    ///                 GeoParquet has it as PROJJSON, which needs PROJ (none without it)
    /// \return the layer, or BadArgument for another ending; CannotWrite, DiskFull
    [[nodiscard]] static Result<std::unique_ptr<FeatureLayer>> create(const std::filesystem::path& path,
                                                                      std::vector<Column> columns,
                                                                      const std::string& crsName);
    virtual ~FeatureLayer() = default;

    /// \param cells    one for each column, of its type or empty
    /// \param outline  a simple ring (east, north), the first point not repeated; empty: none
    [[nodiscard]] virtual Result<void> add(std::span<const Cell> cells,
                                           std::span<const std::array<double, 2>> outline) = 0;
    /// \return bytes written, or CannotWrite, DiskFull. Equal features give equal bytes.
    [[nodiscard]] virtual Result<std::uint64_t> finish() = 0;
};

}  // namespace svt::writers

#pragma once
/// \file
/// Features with values and polygons in plan, written one by one: CSV, GeoJSON, GeoPackage or GeoParquet, for tables and
/// GIS.
///
/// Attributes with several values are arrays: in GeoJSON as JSON, in all other formats as JSON text. GeoPackage and
/// GeoParquet list the values as well, one per row, in the table `attribute_values` (NAME.attributes.parquet):
/// `feature_fid` (GeoPackage), `feature` (id), `name`, `record` and `position` from 1, `value` as text, `unit`.
///
/// Roof outlines are a second layer: the table `roofs` of a GeoPackage, or NAME.roofs.geojson and NAME.roofs.parquet.

#include <svt/core/attribute.hpp>
#include <svt/core/result.hpp>
#include <svt/drawing/footprints.hpp>
#include <svt/writers/table.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace svt::writers {

/// A file to which features are added. It appears on disk only with finish(), as do the files beside it.
class FeatureLayer {
public:
    struct Options {
        bool hasLists = false;  ///< attributes may have several values
        bool hasRoofs = false;  ///< features have roof outlines
    };
    /// \param path     ends in .csv (without polygons), .geojson, .gpkg (table `features`) or .parquet (column
    ///                 `geometry`)
    /// \param columns  the first is the id
    /// \param crsName  CRS of the coordinates, which are written unchanged; GeoJSON names it in the style of 2008,
    ///                 GeoParquet stores it as PROJJSON, which needs PROJ (omitted without PROJ)
    /// \return the layer, or BadArgument for another ending; CannotWrite, DiskFull
    [[nodiscard]] static Result<std::unique_ptr<FeatureLayer>> create(const std::filesystem::path& path,
                                                                      std::vector<Column> columns,
                                                                      const std::string& crsName, Options options);
    virtual ~FeatureLayer() = default;

    using Polygons = std::span<const drawing::PlanPolygon>;
    struct Feature {
        std::span<const Cell> cells;           ///< one per column, of its type or empty
        Polygons footprint, roof;              ///< empty: none
        std::span<const AttributeList> lists;  ///< attributes with several values
    };
    [[nodiscard]] virtual Result<void> add(const Feature& feature) = 0;
    /// \return bytes written, or CannotWrite, DiskFull. Equal features give equal bytes.
    [[nodiscard]] virtual Result<std::uint64_t> finish() = 0;
};

}  // namespace svt::writers

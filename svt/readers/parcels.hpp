#pragma once
/// \file
/// Parcels and other areas of a GIS as solids: polygons of GeoJSON, GeoPackage or shapefiles, extruded upright.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

namespace svt::readers {

struct ParcelOptions {
    double low = 0, high = 0;                         ///< heights of the solids, metres, low < high
    std::string crsName;                              ///< of the model, or empty
    std::uint64_t maxBytes = std::uint64_t{1} << 30;  ///< limit on the size of the file
};

/// Whether the file is one of these formats: GeoJSON by its content, GeoPackage and shapefile by their first bytes.
/// False for a file that cannot be read.
[[nodiscard]] bool looksLikeParcels(const std::filesystem::path& path);

/// Reads the polygons of all layers as features of class `Parcel`, each with a solid. Lines and points are left out.
///
/// The id is the attribute `id`, `gml_id`, `nationalCadastralReference`, `localId`, `flstkennz`, `parcel_id`, `parcel`
/// or `fid`, else the number of the feature. The name is `name` or `label`. A shapefile's attributes are in the .dbf
/// beside it.
///
/// If the file names another CRS than the model has, the coordinates are converted. A file without a CRS has that of the
/// model. GeoJSON without one has degrees if all coordinates are valid degrees.
/// \return the model, or CannotOpen, InputTooBig, BadJson, BadValue (not a readable GeoPackage or shapefile),
///         EmptyModel (no polygons), CannotProject. Findings: features without polygons, and polygons left out.
/// Cost: O(bytes).
[[nodiscard]] Result<model::BuildingModel> readParcels(const std::filesystem::path& path, const ParcelOptions& options,
                                                       Diagnostics* diagnostics = nullptr);

}  // namespace svt::readers

#pragma once
/// \file
/// Reads IFC2x3, IFC4 and IFC4.3 from STEP files.
///
/// | in IFC                                      | in the model                                                        |
/// |---------------------------------------------|---------------------------------------------------------------------|
/// | site, building, storey, space, element      | a feature; its class by ifc_schema/product_classes.cpp; `ifcType`   |
/// | GlobalId, Name                              | id, name                                                            |
/// | property sets, quantities, also of the type | attributes `Pset_WallCommon.IsExternal`, `BaseQuantities.NetVolume` |
/// | materials, classifications                  | attributes `material`, `materialLayers`, `classification`           |
/// | body of a product                           | polygons; solids where the file has solids, else surfaces           |
/// | openings                                    | cut out of the body of their product; no features                   |
/// | boolean results, half-spaces                | evaluated: closed polygons (ifc_shape/solid_boolean.hpp)            |
/// | layer set usages, with splitLayers          | features below the product, one for each layer (ifc/layers.hpp)     |
/// | mapped items                                | a copy of their polygons in each place                              |
/// | surface styles, colour maps of face sets    | materials                                                           |
/// | zones, systems, groups                      | CityObjectGroup with members                                        |
/// | map conversion, projected CRS               | coordinates in the map, `crs`                                       |
/// | annotations, grids, ports, analysis models  | nothing                                                             |
///
/// Lengths become metres. Unreadable products, and those that are read only in part, are findings that name the missing
/// parts.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>

#include <cstddef>
#include <span>
#include <string_view>

namespace svt::readers {

/// True if the text begins with ISO-10303-21, after a byte order mark and blanks.
[[nodiscard]] bool looksLikeIfc(std::span<const std::byte> head) noexcept;

/// \return the model, or BadStep, Truncated (without options.allowTruncated; with it, a finding), UnknownVersion (a
///         schema that is not IFC), EmptyModel (no product), InputTooBig, Cancelled, or an error of georeference().
///         Findings: BadRecord, DuplicateId, MissingId, BadValue, UnknownElement, DanglingReference, ReferenceCycle,
///         ReadInPart, ShapeNotRead, LayersNotSplit, and ProductsRead and LayersSplit as the last.
/// Cost: one pass over the text, then O(size of the shapes of products); memory below five times the file for most
/// files.
[[nodiscard]] Result<model::BuildingModel> readIfc(std::span<const std::byte> bytes, std::string_view name,
                                                   const ReadOptions& options, Diagnostics* diagnostics);

}  // namespace svt::readers

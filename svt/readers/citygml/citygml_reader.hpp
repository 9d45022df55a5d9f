#pragma once
/// \file
/// Reads CityGML 1.0, 2.0 and 3.0 into the semantic tree.
///
/// Mapping:
///  - An object with geometry or parts is a feature, regardless of its module or ADE. The enclosing object is its
///    parent.
///  - A reference to a feature (rooms of a storey, members of a group) is a membership. Its role is the role of the
///    group member if the file has one, else the name of the property ("buildingRoom").
///  - Properties and generic attributes are attributes. Parts of a value are named "name/part" ("height" and
///    "height/status"), members of a generic set "set/name".
///  - lodN properties are geometries of level N. Shared polygons are one polygon with several uses. An
///    ImplicitGeometry is instantiated at its location. Curves, points and textures are skipped.
///  - A feature without gml:id is named after its path: "Building[1]/BuildingRoom[2]".
///  - Polygon::material follows the first theme of the file that has X3DMaterials.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>

#include <cstddef>
#include <span>
#include <string_view>

namespace svt::readers {

/// True if `head`, the first bytes of a file, is XML with a root named CityModel, in UTF-8 or UTF-16.
[[nodiscard]] bool looksLikeCityGml(std::span<const std::byte> head) noexcept;

/// Reads a whole CityGML document.
///
/// Nothing is repaired: an unusable ring, reference or value is reported with its line and id, and left out.
/// References to other files are reported, never fetched. Coordinates stay in the file's CRS, in (east, north, up)
/// order.
/// \param bytes        UTF-8, UTF-16 with byte order mark, or declared as ISO-8859-1 or Windows-1252
/// \param name         path or name for messages
/// \param diagnostics  receives findings, those of the parse in document order first; may be null
/// \return the model, or BadXml with line and column (truncated files included), DtdRefused, BadEncoding,
///         UnknownFormat, UnknownVersion, InputTooBig (bytes, depth, multiplying references), GeographicCrs or
///         Cancelled
/// Cost: linear in bytes. Memory: the model, and for UTF-8 the parsed tree of some megabytes of the file at a time
/// (or of the largest part of one feature, if that is more). Threads: pieces of the file are parsed in parallel and
/// joined in document order; the result does not depend on their number.
[[nodiscard]] Result<model::BuildingModel> readCityGml(std::span<const std::byte> bytes, std::string_view name,
                                                       const ReadOptions& options = {},
                                                       Diagnostics* diagnostics = nullptr);

}  // namespace svt::readers

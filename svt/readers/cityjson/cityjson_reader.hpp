#pragma once
/// \file
/// Reads CityJSON 1.0, 1.1 and 2.0 and CityJSONSeq into the semantic tree.
///
/// Mapping:
///  - A city object is a feature. The first of its `parents` that is not a CityObjectGroup is its parent. All
///    further parents and all groups are memberships (`children_roles` gives the role).
///  - A geometry is one solid or surface of its object, at its own lod. A GeometryInstance is instantiated.
///    MultiPoint and MultiLineString do not bound a volume and are skipped.
///  - A semantic surface with polygons becomes a child feature that uses the same polygons, like a CityGML
///    boundary surface. Its id is its member "id", else "<object>/<type>[n]", n counted from 1 per type.
///  - Nested attributes are named "outer/inner", arrays are compact JSON text, {"value", "uom"} is a measure,
///    the members of an address are named "address/...".
///  - Polygon::material follows the theme `default-theme-material`. A geometry without that theme follows its
///    first theme in alphabetical order. Polygons without material follow `default-theme-texture` in the same way:
///    they get a colour from their texture, see textures/texture_colors.hpp.
///  - x is east and y north, as is usual in files. They are swapped only if the CRS and the magnitude of the
///    coordinates prove the opposite.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>

#include <cstddef>
#include <span>
#include <string_view>

namespace svt::readers {

/// True if the text starts like CityJSON or CityJSONSeq: after a byte order mark and white space, an object
/// that contains "CityJSON" or a member specific to CityJSON within the first 4096 bytes of `head`.
[[nodiscard]] bool looksLikeCityJson(std::span<const std::byte> head) noexcept;

/// Reads a whole CityJSON document or a CityJSONSeq (one JSON text per line, the first with the transform).
/// Vertices are v * scale + translate in double, so equal integers give identical bits. Nothing is repaired: an
/// unusable surface, ring, reference or (in a sequence) line is reported with object id and line, and left out.
/// \param bytes  UTF-8, a byte order mark allowed; one JSON text may have up to 4 GiB less one byte
/// \param name   path or name for messages
/// \param diagnostics  receives findings in file order; may be null
/// \return the model (without features if CityObjects is empty), or BadJson with line and column, BadEncoding,
///         Truncated, UnknownVersion, BadValue (transform), GeographicCrs, InputTooBig (bytes, depth, instanced
///         templates, polygons) or Cancelled. Truncated means that the last line of a sequence is cut off; with
///         options.allowTruncated it is a finding.
/// Cost: linear in bytes; peak memory up to about 15 times the largest JSON text, in addition to
/// the model. Threads: objects and lines are read in parallel and joined in file order.
[[nodiscard]] Result<model::BuildingModel> readCityJson(std::span<const std::byte> bytes, std::string_view name,
                                                        const ReadOptions& options = {},
                                                        Diagnostics* diagnostics = nullptr);

}  // namespace svt::readers

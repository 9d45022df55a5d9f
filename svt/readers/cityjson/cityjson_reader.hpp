#pragma once
/// \file
/// CityJSON 1.0, 1.1 and 2.0 and CityJSONSeq into the semantic tree.
///
/// What becomes what:
///  - a city object is a feature; the first of its `parents` that is no CityObjectGroup is its parent, any
///    further one and every group is a membership (`children_roles` give the role);
///  - a geometry stays one solid or surface of its object, in its own lod; a GeometryInstance is written out;
///    MultiPoint and MultiLineString bound nothing and are left out;
///  - a semantic surface that owns polygons becomes a child feature that uses the same polygons, as a CityGML
///    boundary surface does. Its id is its member "id", else "<object>/<type>[n]", n counted from 1 per type;
///  - attributes of attributes are "outer/inner", arrays are compact JSON text, {"value", "uom"} is a measure,
///    the members of an address are "address/...";
///  - Polygon::material follows the theme `default-theme-material`; a geometry that lacks it follows its
///    first theme in alphabetical order. Textures are left out;
///  - x is east and y north, as files have it; they are exchanged only where the CRS and the size of the
///    coordinates prove the opposite.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>

#include <cstddef>
#include <span>
#include <string_view>

namespace svt::readers {

/// True where the text begins like CityJSON or CityJSONSeq: after a byte order mark and white space an object
/// that names CityJSON, or a member only CityJSON has, within the first 4096 bytes of `head`.
[[nodiscard]] bool looksLikeCityJson(std::span<const std::byte> head) noexcept;

/// Reads a whole CityJSON document or a CityJSONSeq (one JSON text per line, the first with the transform).
/// Vertices are v * scale + translate in double, so equal integers give equal bits. Nothing is repaired: a surface,
/// ring, reference or (in a sequence) line that cannot be used is reported with object id and line, and left out.
/// \param bytes  UTF-8, a byte order mark allowed; one JSON text may have up to 4 GiB less one byte
/// \param name   path or name for messages
/// \param diagnostics  receives findings in file order; may be null
/// \return the model (without features where CityObjects is empty), or BadJson with line and column, BadEncoding,
///         UnknownVersion, BadValue (transform), GeographicCrs, InputTooBig (bytes, depth, instanced templates,
///         polygons) or Cancelled
/// Cost: linear in bytes; memory up to about 15 times the largest JSON text for the time of the call, besides
/// the model. Threads: objects and lines are read in parallel and joined in file order.
[[nodiscard]] Result<model::BuildingModel> readCityJson(std::span<const std::byte> bytes, std::string_view name,
                                                        const ReadOptions& options = {},
                                                        Diagnostics* diagnostics = nullptr);

}  // namespace svt::readers

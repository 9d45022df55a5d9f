#pragma once
/// \file
/// The geometries of one city object with their semantics and materials.

#include <svt/readers/cityjson/cityjson_objects.hpp>

namespace svt::readers::cityjson {

/// Reads the array `geometry` of a city object into its feature, polygons and semantic surfaces.
void readGeometries(json::array geometries, const TextContext& context, ParsedObject& object);

/// Bytes of template text that the instances of `cityObject` expand to; checked before any is instantiated.
[[nodiscard]] std::uint64_t instancedBytes(json::element cityObject, const TemplateSet& templates);

}  // namespace svt::readers::cityjson

#pragma once
/// \file
/// Assigns X3DMaterials to polygons.

#include <svt/readers/citygml/citygml_resolver.hpp>

#include <vector>

namespace svt::readers::citygml {

/// Sets Polygon::material for the targets of the materials of one theme: the first theme of the file that has
/// materials. A material of a polygon takes precedence over one of its surface, that over one of its feature; among
/// equals the later takes precedence.
/// \param materials  receives the materials of the theme, without duplicates
void applyMaterials(Part& part, const References& references, GeometryResolver& resolver,
                    const GeometriesByFeature& geometries, std::vector<model::Material>& materials);

}  // namespace svt::readers::citygml

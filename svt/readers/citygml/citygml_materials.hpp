#pragma once
/// \file
/// X3DMaterials onto polygons. Internal to the readers.

#include <svt/readers/citygml/citygml_resolver.hpp>

#include <vector>

namespace svt::readers::citygml {

/// Sets Polygon::material of what the materials of one theme point at: the first theme of the file that has
/// materials. A material of a polygon wins over one of its surface, that over one of its feature; among equals the
/// later wins. \param materials  receives the materials of that theme, equal ones once
void applyMaterials(Part& part, const References& references, GeometryResolver& resolver,
                    const GeometriesByFeature& geometries, std::vector<model::Material>& materials);

}  // namespace svt::readers::citygml

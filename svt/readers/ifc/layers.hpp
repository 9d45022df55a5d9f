#pragma once
/// \file
/// Walls, slabs and roofs split into the layers of their material.
///
///     outside          inside        IfcMaterialLayerSetUsage: along which axis of the product the layers follow each
///       |##|/////////|xxx|          other (AXIS2: y, for walls; AXIS3: z, for slabs), in which sense, and where the first
///       a  b         c   d          begins; the thickness of each gives the planes a, b, c, d
///
/// The body, with openings cut out of it, is intersected with the space between two planes: closed polygons with caps.

#include <svt/readers/ifc/properties.hpp>
#include <svt/readers/ifc_shape/shape_reader.hpp>

#include <optional>
#include <string>
#include <vector>

namespace svt::readers::ifc {

/// One layer of a usage.
struct LayerPart {
    RecordIndex material = kNoRecord;
    std::string name;          ///< of the material, else of the layer
    std::string function;      ///< IfcMaterialLayer.Category, else that of the material: LoadBearing, Insulation, ...
    double thickness = 0;      ///< metres; 0 for a foil, which has no body
    std::vector<Body> bodies;  ///< in the axes of the product
};

struct LayeredShape {
    std::vector<LayerPart> layers;  ///< in the order of the set
    std::vector<Body> rest;         ///< parts of the shape outside of all layers
    std::string why;                ///< not empty: the reason why there are no layers
    double moved = 0;               ///< metres by which the layers were moved onto a body that is as thick as they are
};

/// Splits a shape by the IfcMaterialLayerSetUsage of its product.
///
/// Layers of a wall are parallel to its representation Axis if that is a straight line. Layers of a slab follow the
/// direction of its extrusion if the slab is not as thick as the layers along z. The outermost layers take up to a
/// millimetre more than their thickness. Layers that the usage places next to a body of the same thickness are moved
/// onto it.
/// \param definition  IfcProductDefinitionShape of the product, for its axis
/// \return nothing if the product does not consist of two or more layers
[[nodiscard]] std::optional<LayeredShape> splitIntoLayers(const IfcFile& file, const Properties& properties,
                                                          RecordIndex product, RecordIndex definition,
                                                          const Shape& shape);

}  // namespace svt::readers::ifc

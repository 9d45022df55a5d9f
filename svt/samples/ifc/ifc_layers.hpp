#pragma once
/// \file
/// The layers that walls, slabs and roofs of the samples are built of, and the axes along which they lie.

#include <svt/samples/ifc/ifc_records.hpp>
#include <svt/samples/parts/plan.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace svt::samples {

/// One layer of a component.
struct LayerSpec {
    std::string_view material;
    std::string_view function;  ///< IfcMaterialLayer.Category
    double thickness = 0;       ///< millimetres
    std::array<double, 3> color;
};

/// How a component is built up: what IfcMaterialLayerSetUsage says.
struct LayeredBody {
    Frame frame;                    ///< axes of the product: layers lie along y of a wall, along z of a slab
    bool isWall = false;            ///< AXIS2; else AXIS3
    bool isPositive = true;         ///< the sense in which layers follow each other along the axis
    double offset = 0;              ///< of the first layer's face on the axis, millimetres
    double length = 0;              ///< of a wall along its x axis
    std::vector<LayerSpec> layers;  ///< none: not built of layers
};

/// The build-up of an element; walls from outside to inside where one side is outside.
[[nodiscard]] LayeredBody layersOf(const Plan& plan, const Component& component);

}  // namespace svt::samples

#pragma once
/// \file
/// The layers of walls, slabs and roofs of the samples, and the axes along which they lie.

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

/// The layers of a component: the content of IfcMaterialLayerSetUsage.
struct LayeredBody {
    Frame frame;                    ///< axes of the product: layers lie along y of a wall, along z of a slab
    bool isWall = false;            ///< true: AXIS2; false: AXIS3
    bool isPositive = true;         ///< direction of the sequence of layers along the axis
    double offset = 0;              ///< position of the first layer's face on the axis, millimetres
    double length = 0;              ///< length of a wall along its x axis
    std::vector<LayerSpec> layers;  ///< empty: has no layers
};

/// The layers of an element; walls with an outer side are listed from outside to inside.
[[nodiscard]] LayeredBody layersOf(const Plan& plan, const Component& component);

}  // namespace svt::samples

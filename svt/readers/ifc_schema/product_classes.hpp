#pragma once
/// \file
/// Model classes of IFC products: one table.

#include <svt/readers/ifc_schema/entities.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace svt::readers::ifc {

enum class ProductKind : std::uint8_t {
    Spatial,  ///< part of the spatial structure: site, building, storey, space
    Element,  ///< a thing with a body
    Opening,  ///< is cut out of, or added to, another product; no feature of its own
    Ignored   ///< annotations, grids, ports, structural models: no feature
};

struct ProductClass {
    std::string_view ifcType;    ///< without "Ifc": "Wall"; empty where the class is unknown
    std::string_view className;  ///< of the model: see model/classes.hpp
    ProductKind kind = ProductKind::Element;
};

/// The class of a type name of a STEP file, whatever its case. Unknown ones have an empty `ifcType`.
[[nodiscard]] ProductClass productClassOf(std::string_view typeName) noexcept;

/// Position of the attribute PredefinedType of a class. At this position, IFC2x3 has the same values under other names:
/// ShapeType (roofs, ramps, stairs), OperationType (transport) and CompositionType (proxies).
/// \param ifcType  "IfcDoor"
[[nodiscard]] AttributePosition predefinedTypeOf(std::string_view ifcType) noexcept;

}  // namespace svt::readers::ifc

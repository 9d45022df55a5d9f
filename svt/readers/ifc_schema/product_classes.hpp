#pragma once
/// \file
/// What the classes of IFC products are in the model: one table.

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

}  // namespace svt::readers::ifc

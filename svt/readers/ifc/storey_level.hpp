#pragma once
/// \file
/// Heights and directions that a file states beside its shapes: the levels of storeys, and the product with true north.

#include <svt/readers/ifc/structure.hpp>
#include <svt/readers/ifc/units.hpp>

#include <cstddef>
#include <optional>

namespace svt::readers::ifc {

/// The height of a storey's level in the coordinates of the model, metres. It is the height of the storey's placement.
/// If a storey is placed at the origin of its building, and its `Elevation` differs from that height, the writer gave
/// the storey no placement of its own. Then the level is `Elevation` above the building.
/// \return the height; nothing if the storey has neither placement nor elevation, or a placement is unreadable
[[nodiscard]] std::optional<double> storeyLevel(const IfcFile& file, const Structure& structure, const Product& storey,
                                                const MapPlace& map);

/// The product that gets the attribute `trueNorth`: the first site, otherwise the first building, otherwise the first
/// product. The structure must have products.
[[nodiscard]] std::size_t northBearer(const Structure& structure);

}  // namespace svt::readers::ifc

#pragma once
/// \file
/// The polygons that a geometry uses.

#include <svt/model/building_model.hpp>

namespace svt::model {

/// Calls `visit(use)` for each surface of a geometry, then for the exterior and the interiors of each of its solids.
/// \param geometry  a Geometry, const or not, or another struct with `surfaces` and `solids`
template <class AnyGeometry, class Visit>
void forEachUse(AnyGeometry& geometry, Visit&& visit) {
    for (auto& use : geometry.surfaces) visit(use);
    for (auto& solid : geometry.solids) {
        for (auto& use : solid.exterior) visit(use);
        for (auto& interior : solid.interiors)
            for (auto& use : interior) visit(use);
    }
}

}  // namespace svt::model

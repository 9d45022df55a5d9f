#pragma once
/// \file
/// The promises of svt/model/building_model.hpp, for the fuzz targets of all readers.

#include <svt/model/building_model.hpp>

#include <cstdint>
#include <cstdlib>
#include <vector>

namespace svt::fuzz {

inline void require(bool condition) {
    if (!condition) std::abort();
}

inline void checkUses(const model::BuildingModel& model, const std::vector<model::SurfaceUse>& uses) {
    for (const model::SurfaceUse& use : uses) require(use.polygon < model.polygons.size());
}

/// Ends the program unless all indices are in range, parents precede their children and know them, and polygons have rings.
inline void checkModel(const model::BuildingModel& model) {
    for (std::size_t i = 0; i < model.features.size(); ++i) {
        const model::Feature& feature = model.features[i];
        require(feature.parent == model::kNoFeature || feature.parent < i);
        for (const model::FeatureIndex child : feature.children)
            require(child < model.features.size() && model.features[child].parent == i);
        for (const model::Geometry& geometry : feature.geometries) {
            checkUses(model, geometry.surfaces);
            for (const model::Solid& solid : geometry.solids) {
                checkUses(model, solid.exterior);
                for (const auto& interior : solid.interiors) checkUses(model, interior);
            }
        }
    }
    for (const model::Polygon& polygon : model.polygons) {
        require(!polygon.ringEnds.empty() && polygon.ringEnds.back() == polygon.points.size());
        require(polygon.material < static_cast<std::int64_t>(model.materials.size()));
    }
    for (const model::Polyline& line : model.lines)
        require(line.feature < model.features.size() && !line.points.empty());
    for (const model::Membership& membership : model.memberships)
        require(membership.group < model.features.size() && membership.member < model.features.size());
    require(model.treeOrder().size() == model.features.size());
}

/// Ends the program if a feature has no id. Not for CityJSON, which allows "" as an id.
inline void checkIds(const model::BuildingModel& model) {
    for (const model::Feature& feature : model.features) require(!feature.id.empty());
}

}  // namespace svt::fuzz

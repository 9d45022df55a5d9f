#include <svt/model/building_model.hpp>

#include <svt/model/surface_uses.hpp>

#include <cmath>

namespace svt::model {

bool isReadInPart(std::span<const Attribute> attributes) noexcept {
    for (const Attribute& attribute : attributes)
        if (attribute.name == kReadInPartAttribute) return true;
    return false;
}

FeatureIndex BuildingModel::addFeature(Feature feature, FeatureIndex parent) {
    const auto index = static_cast<FeatureIndex>(features.size());
    feature.parent = parent;
    features.push_back(std::move(feature));
    if (parent == kNoFeature)
        roots.push_back(index);
    else
        features[parent].children.push_back(index);
    return index;
}

PolygonIndex BuildingModel::addPolygon(Polygon polygon) {
    polygons.push_back(std::move(polygon));
    return static_cast<PolygonIndex>(polygons.size() - 1);
}

Place BuildingModel::placeOf(FeatureIndex feature) const {
    // A feature that was added after reading has an ancestor that was read.
    FeatureIndex root = feature;
    while (features[root].parent != kNoFeature) root = features[root].parent;
    const std::string* file = &source;
    for (const JoinedFile& joined : joinedFiles)
        if (root >= joined.firstFeature) file = &joined.source;
    return {*file, features[feature].line, 0, features[feature].id};
}

Place BuildingModel::placeOfPolygon(PolygonIndex polygon) const {
    const std::string* file = &source;
    for (const JoinedFile& joined : joinedFiles)
        if (polygon >= joined.firstPolygon) file = &joined.source;
    return {*file, 0, 0, polygons[polygon].id};
}

std::vector<FeatureIndex> BuildingModel::treeOrder() const {
    std::vector<FeatureIndex> order;
    order.reserve(features.size());
    std::vector<FeatureIndex> stack(roots.rbegin(), roots.rend());
    while (!stack.empty()) {
        const FeatureIndex index = stack.back();
        stack.pop_back();
        order.push_back(index);
        const auto& children = features[index].children;
        stack.insert(stack.end(), children.rbegin(), children.rend());
    }
    return order;
}

Box3d BuildingModel::bounds(const Geometry& geometry) const {
    Box3d box;
    forEachUse(geometry, [&](const SurfaceUse& use) {
        for (const Vec3d& point : polygons[use.polygon].points) box.add(point);
    });
    return box;
}

int LodChoice::choose(const Feature& feature) const {
    int best = -1;
    for (int i = 0; i < static_cast<int>(feature.geometries.size()); ++i) {
        const Geometry& candidate = feature.geometries[i];
        if (candidate.solids.empty() && candidate.surfaces.empty()) continue;
        // A whole level includes its refinements (2 includes 2.2); a refined level matches only itself.
        const bool isWhole = lod == std::floor(lod);
        if (lod >= 0 && (isWhole ? std::floor(candidate.lod) : candidate.lod) > lod) continue;
        if (best < 0) {
            best = i;
            continue;
        }
        const Geometry& current = feature.geometries[best];
        const bool isFiner = candidate.lod > current.lod;
        const bool isSolidOfSameLod = candidate.lod == current.lod && candidate.kind == GeometryKind::Solid &&
                                      current.kind != GeometryKind::Solid;
        if (isFiner || isSolidOfSameLod) best = i;
    }
    return best;
}

}  // namespace svt::model

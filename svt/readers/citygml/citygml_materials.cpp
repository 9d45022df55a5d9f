#include <svt/readers/citygml/citygml_materials.hpp>

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>

namespace svt::readers::citygml {
namespace {

using std::string_view;

// Kind of a target, coarse to fine.
enum class Level { Feature, Surface, Polygon };

struct Application {
    Level level;
    std::uint32_t index;  // feature or node
    std::int32_t material;
};

std::int32_t indexOf(const model::Material& material, std::vector<model::Material>& materials,
                     std::map<std::tuple<std::string, float, float, float, float>, std::int32_t>& known) {
    const auto key = std::make_tuple(material.name, material.diffuse.x, material.diffuse.y, material.diffuse.z,
                                     material.transparency);
    const auto [entry, isNew] = known.emplace(key, static_cast<std::int32_t>(materials.size()));
    if (isNew) materials.push_back(material);
    return entry->second;
}

}  // namespace

void applyMaterials(Part& part, const References& references, GeometryResolver& resolver,
                    const GeometriesByFeature& geometries, std::vector<model::Material>& materials) {
    std::unordered_map<string_view, const MaterialRecord*> byId;
    for (const MaterialRecord& record : part.materials)
        if (!record.isReference && !record.id.empty()) byId.emplace(record.id, &record);
    const auto definition = [&](const MaterialRecord& record) -> const MaterialRecord* {
        if (!record.isReference) return &record;
        const auto found = byId.find(idOfHref(record.id));
        return found == byId.end() ? nullptr : found->second;
    };
    const auto first = std::find_if(part.materials.begin(), part.materials.end(),
                                    [&](const MaterialRecord& record) { return definition(record) != nullptr; });
    if (first == part.materials.end()) return;

    std::map<std::tuple<std::string, float, float, float, float>, std::int32_t> known;
    std::vector<Application> applications;
    for (const MaterialRecord& record : part.materials) {
        if (record.theme != first->theme) continue;
        const MaterialRecord* material = definition(record);
        if (material == nullptr) continue;
        const std::int32_t index = indexOf(material->material, materials, known);
        for (const std::string& href : material->targets) {
            const Target target = references.geometry(href);
            if (target.kind == Target::Kind::Feature)
                applications.push_back({Level::Feature, target.index, index});
            else if (target.kind == Target::Kind::Node)
                applications.push_back(
                    {part.nodes[target.index].kind == NodeKind::Polygon ? Level::Polygon : Level::Surface, target.index,
                     index});
        }
    }
    std::stable_sort(applications.begin(), applications.end(),
                     [](const Application& a, const Application& b) { return a.level < b.level; });

    for (const Application& application : applications) {
        const auto paint = [&](model::PolygonIndex polygon) { part.polygons[polygon].material = application.material; };
        if (application.level != Level::Feature) {
            resolver.forEachPolygon(application.index, paint);
            continue;
        }
        std::vector<model::FeatureIndex> open{application.index};
        while (!open.empty() && resolver.chargeBudget(1)) {
            const model::FeatureIndex feature = open.back();
            open.pop_back();
            for (const FeatureGeometry* geometry = geometries.begin(feature); geometry != geometries.end(feature);
                 ++geometry)
                resolver.forEachPolygon(geometry->node, paint);
            const auto& children = part.features[feature].children;
            open.insert(open.end(), children.begin(), children.end());
        }
    }
}

}  // namespace svt::readers::citygml

#include <svt/mesh/closing/sources.hpp>

#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

namespace svt::mesh {
namespace {

using model::BuildingModel;
using model::Feature;
using model::FeatureIndex;

void appendUses(const model::Geometry& geometry, MeshSource& source) {
    auto& uses = source.uses;
    uses.insert(uses.end(), geometry.surfaces.begin(), geometry.surfaces.end());
    for (const model::Solid& solid : geometry.solids) {
        source.solids.push_back(uses.size());
        uses.insert(uses.end(), solid.exterior.begin(), solid.exterior.end());
        for (const auto& interior : solid.interiors) {
            source.voids.emplace_back(uses.size(), uses.size() + interior.size());
            uses.insert(uses.end(), interior.begin(), interior.end());
        }
    }
}

// Appends the faces of the boundary surfaces of a space, with their openings.
void appendBoundary(const BuildingModel& model, FeatureIndex space, const model::LodChoice& lod,
                    const std::vector<std::uint8_t>& isCoarser, MeshSource& source) {
    for (const FeatureIndex child : model.features[space].children) {
        const Feature& feature = model.features[child];
        if (!model::isBoundarySurface(feature.className) && !(model::isFilling(feature.className) && child != space))
            continue;
        if (model::isFilling(feature.className) && !model::isBoundarySurface(model.features[space].className)) continue;
        if (isCoarser[child]) continue;
        if (const int chosen = lod.choose(feature); chosen >= 0) {
            const model::Geometry& geometry = feature.geometries[std::size_t(chosen)];
            source.lod = std::max(source.lod, geometry.lod);
            appendUses(geometry, source);
        }
        appendBoundary(model, child, lod, isCoarser, source);
    }
}

double chosenLod(const Feature& feature, const model::LodChoice& lod) {
    const int chosen = lod.choose(feature);
    return chosen < 0 ? -1 : feature.geometries[std::size_t(chosen)].lod;
}

// Marks boundary surfaces and openings of a coarser level of detail than others of their class in the same space: files
// with several levels of detail have separate surfaces for each.
std::vector<std::uint8_t> findCoarserSurfaces(const BuildingModel& model, const std::vector<FeatureIndex>& order,
                                              const model::LodChoice& lod) {
    const auto isSurface = [&](FeatureIndex f) {
        const std::string& name = model.features[f].className;
        return model::isBoundarySurface(name) || model::isFilling(name);
    };
    std::vector<FeatureIndex> spaceOf(model.features.size(), model::kNoFeature);
    std::map<std::pair<FeatureIndex, std::string_view>, double> finest;
    for (const FeatureIndex f : order) {
        const FeatureIndex parent = model.features[f].parent;
        if (!isSurface(f) || parent == model::kNoFeature) continue;
        spaceOf[f] = spaceOf[parent] != model::kNoFeature ? spaceOf[parent] : parent;
        double& lodOfClass = finest.try_emplace({spaceOf[f], model.features[f].className}, -1.0).first->second;
        lodOfClass = std::max(lodOfClass, chosenLod(model.features[f], lod));
    }
    std::vector<std::uint8_t> isCoarser(model.features.size(), 0);
    for (const FeatureIndex f : order)
        isCoarser[f] = spaceOf[f] != model::kNoFeature && !model.features[f].geometries.empty() &&
                       chosenLod(model.features[f], lod) < finest[{spaceOf[f], model.features[f].className}];
    return isCoarser;
}

// Marks buildings whose geometry is an outline at level of detail 0, if a part of them has more: the outline stands for
// the parts. Some files have it at a height of 0.
std::vector<std::uint8_t> findOutlinesOfParts(const BuildingModel& model, const model::LodChoice& lod) {
    std::vector<std::uint8_t> isOutline(model.features.size(), 0);
    for (const Feature& fine : model.features) {
        if (chosenLod(fine, lod) < 1) continue;
        bool isInPart = fine.className == "BuildingPart";
        for (FeatureIndex f = fine.parent; f != model::kNoFeature; f = model.features[f].parent) {
            const Feature& above = model.features[f];
            const double lodAbove = chosenLod(above, lod);
            const bool isBuilding = model::classRank(above.className) == model::ClassRank::Building;
            if (isInPart && isBuilding && lodAbove >= 0 && lodAbove < 1) isOutline[f] = 1;
            isInPart = isInPart || above.className == "BuildingPart";
        }
    }
    return isOutline;
}

void note(Diagnostics* log, const BuildingModel& model, std::string_view text,
          const std::vector<std::uint8_t>& isLeftOut) {
    const auto count = std::count(isLeftOut.begin(), isLeftOut.end(), 1);
    if (count == 0 || log == nullptr) return;
    log->add(Severity::Note, Code::NoGeometry, fmt::format("{} {}", count, text), {model.source, 0, 0, {}});
}

}  // namespace

std::vector<MeshSource> collectSources(const BuildingModel& model, const model::LodChoice& lod, Diagnostics* log) {
    std::vector<MeshSource> sources;
    const std::vector<FeatureIndex> order = model.treeOrder();
    const std::vector<std::uint8_t> isCoarser = findCoarserSurfaces(model, order, lod);
    const std::vector<std::uint8_t> isOutline = findOutlinesOfParts(model, lod);
    note(log, model,
         "boundary surfaces and openings are of a coarser level of detail than others of their class and are left out",
         isCoarser);
    note(log, model, "outlines of buildings at level of detail 0 are left out, because their parts have more",
         isOutline);
    for (const FeatureIndex index : order) {
        if (isCoarser[index]) continue;
        const Feature& feature = model.features[index];
        const model::Inside inside = model::insideOf(feature.className);
        MeshSource own{index, -1, false, false, {}, {}, {}};
        if (const int chosen = lod.choose(feature); chosen >= 0 && isOutline[index] == 0) {
            const model::Geometry& geometry = feature.geometries[std::size_t(chosen)];
            own.lod = geometry.lod;
            // Doors and windows can be bodies (CityGML 3.0) or sheets (openings of CityGML 2.0), and so can trees,
            // bridges and generic objects: the kind of geometry decides.
            own.hasSolidMeaning = inside == model::Inside::Always ||
                                  (inside == model::Inside::Declared && geometry.kind == model::GeometryKind::Solid);
            appendUses(geometry, own);
        }
        if (inside != model::Inside::Never) {
            MeshSource assembled{index, -1, true, inside == model::Inside::Always, {}, {}, {}};
            appendBoundary(model, index, lod, isCoarser, assembled);
            if (!assembled.uses.empty() && (own.uses.empty() || assembled.lod > own.lod)) own = std::move(assembled);
        }
        if (!own.uses.empty()) sources.push_back(std::move(own));
    }
    return sources;
}

std::vector<MeshSource> splitIntoSolids(const MeshSource& source) {
    std::vector<std::size_t> begins = source.solids;
    if (begins.size() < 2) return {};
    if (begins.front() != 0) begins.insert(begins.begin(), 0);
    begins.push_back(source.uses.size());
    std::vector<MeshSource> parts;
    for (std::size_t s = 0; s + 1 < begins.size(); ++s) {
        const std::size_t begin = begins[s], end = begins[s + 1];
        if (begin == end) continue;
        MeshSource part{source.feature, source.lod, source.isAssembled, source.hasSolidMeaning, {}, {}, {0}};
        part.uses.assign(source.uses.begin() + std::ptrdiff_t(begin), source.uses.begin() + std::ptrdiff_t(end));
        for (const auto& [from, to] : source.voids)
            if (from >= begin && to <= end) part.voids.emplace_back(from - begin, to - begin);
        parts.push_back(std::move(part));
    }
    return parts;
}

std::vector<FeatureIndex> findSurfacesOfPolygons(const BuildingModel& model) {
    std::vector<FeatureIndex> surfaceOf(model.polygons.size(), model::kNoFeature);
    for (FeatureIndex f = 0; f < model.features.size(); ++f) {
        if (!model::isBoundarySurface(model.features[f].className)) continue;
        for (const model::Geometry& geometry : model.features[f].geometries)
            for (const model::SurfaceUse& use : geometry.surfaces)
                if (surfaceOf[use.polygon] == model::kNoFeature) surfaceOf[use.polygon] = f;
    }
    return surfaceOf;
}

}  // namespace svt::mesh

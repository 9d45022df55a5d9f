#include <svt/pipeline/labels.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/analyze/solid_overlaps.hpp>
#include <svt/model/classes.hpp>
#include <svt/model/phases.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>

namespace svt::pipeline {
namespace {

using model::FeatureIndex;

volume::Filling fillingOf(mesh::ClosingMethod closingMethod) noexcept {
    switch (closingMethod) {
        case mesh::ClosingMethod::Closed: return volume::Filling::Solid;
        case mesh::ClosingMethod::TJunctions: return volume::Filling::TJunctions;
        case mesh::ClosingMethod::Complemented: return volume::Filling::Complemented;
        case mesh::ClosingMethod::Capped: return volume::Filling::Capped;
        case mesh::ClosingMethod::Open: return volume::Filling::Winding;
        case mesh::ClosingMethod::Surface: return volume::Filling::Surface;
    }
    return volume::Filling::None;
}

// The object of the closest body above a boundary surface in the tree, or kNoBody.
std::uint32_t bodyOf(const volume::LabelTable& table, const std::vector<std::uint32_t>& objectOf,
                     const mesh::MeshSet& meshes, std::uint32_t label) {
    if (!model::isBoundarySurface(table.labels[label].className)) return voxelize::kNoBody;
    for (std::uint32_t l = table.labels[label].parent; l != volume::kNoLabel; l = table.labels[l].parent)
        if (objectOf[l] != volume::kNoLabel &&
            meshes.objects[objectOf[l]].closingMethod != mesh::ClosingMethod::Surface)
            return objectOf[l];
    return voxelize::kNoBody;
}

// Boundary surfaces of levels of detail that are not used: a file may have surfaces of its own for each level. They have no
// mesh, and neither do the surfaces below them.
std::vector<char> surfacesOfOtherLods(const model::BuildingModel& model, const mesh::MeshSet& meshes) {
    constexpr double kNoMesh = -2;
    std::vector<double> lodOf(model.features.size(), kNoMesh);
    for (const mesh::ObjectMesh& object : meshes.objects) lodOf[object.feature] = object.lod;
    std::vector<char> isLeftOut(model.features.size(), 0);
    const std::vector<FeatureIndex> order = model.treeOrder();
    for (std::size_t n = order.size(); n-- > 0;) {
        const model::Feature& feature = model.features[order[n]];
        if (!model::isBoundarySurface(feature.className) || lodOf[order[n]] != kNoMesh || feature.geometries.empty() ||
            feature.parent == model::kNoFeature || lodOf[feature.parent] == kNoMesh)
            continue;
        const bool hasUsed = std::any_of(feature.geometries.begin(), feature.geometries.end(),
                                         [&](const auto& geometry) { return geometry.lod == lodOf[feature.parent]; });
        const bool hasChild = std::any_of(feature.children.begin(), feature.children.end(),
                                          [&](FeatureIndex child) { return isLeftOut[child] == 0; });
        if (!hasUsed && !hasChild) isLeftOut[order[n]] = 1;
    }
    return isLeftOut;
}

// Labels in tree order, without scalars, and the label of each feature.
std::vector<std::uint32_t> numberFeatures(const model::BuildingModel& model, const mesh::MeshSet& meshes,
                                          volume::LabelTable& table) {
    std::vector<std::uint32_t> labelOf(model.features.size(), volume::kNoLabel);
    const std::vector<char> isLeftOut = surfacesOfOtherLods(model, meshes);
    for (const FeatureIndex index : model.treeOrder()) {
        if (isLeftOut[index] != 0) continue;
        const model::Feature& feature = model.features[index];
        labelOf[index] = static_cast<std::uint32_t>(table.labels.size());
        volume::Label label;
        label.id = feature.id;
        label.className = feature.className;
        label.name = feature.name;
        label.attributes = feature.attributes;
        if (feature.parent != model::kNoFeature) label.parent = labelOf[feature.parent];
        label.subtreeEnd = labelOf[index] + 1;
        table.labels.push_back(std::move(label));
    }
    for (std::size_t i = table.labels.size(); i-- > 0;) {
        const volume::Label& label = table.labels[i];
        if (label.parent != volume::kNoLabel) {
            std::uint32_t& end = table.labels[label.parent].subtreeEnd;
            end = std::max(end, label.subtreeEnd);
        }
    }
    for (const model::Membership& membership : model.memberships) {
        if (labelOf[membership.member] == volume::kNoLabel || labelOf[membership.group] == volume::kNoLabel) continue;
        table.labels[labelOf[membership.member]].groups.push_back(labelOf[membership.group]);
    }
    for (volume::Label& label : table.labels) {
        std::sort(label.groups.begin(), label.groups.end());
        label.groups.erase(std::unique(label.groups.begin(), label.groups.end()), label.groups.end());
    }
    return labelOf;
}

// The most frequent colour of the feature's polygons.
std::optional<Vec3f> materialColor(const model::BuildingModel& model, const model::Feature& feature) {
    std::map<std::int32_t, std::size_t> uses;
    const auto count = [&](const std::vector<model::SurfaceUse>& surfaces) {
        for (const model::SurfaceUse& use : surfaces)
            if (const std::int32_t material = model.polygons[use.polygon].material; material >= 0) ++uses[material];
    };
    for (const model::Geometry& geometry : feature.geometries) {
        count(geometry.surfaces);
        for (const model::Solid& solid : geometry.solids) count(solid.exterior);
    }
    if (uses.empty()) return std::nullopt;
    const auto best =
        std::max_element(uses.begin(), uses.end(), [](const auto& p, const auto& q) { return p.second < q.second; });
    const model::Material& material = model.materials[std::size_t(best->first)];
    return material.hasColor ? std::optional(material.diffuse) : std::nullopt;
}

// Share of light that a pane stops at least, so that clear glass is visible.
constexpr double kLeastOpacity = 0.2;
constexpr float kMostOpaque = 1 - 0x1p-24f;  // the largest opacity per metre that is not opaque

// The opacity per metre of an object of a transparent material, whose mean thickness stops as much light as the file
// states; nothing for opaque objects.
std::optional<float> materialOpacity(const volume::Label& label, const mesh::ObjectMesh& mesh, double thinnest) {
    if (model::isSpace(label.className)) return std::nullopt;
    for (const Attribute& attribute : label.attributes) {
        const double* transparency = std::get_if<double>(&attribute.value);
        if (attribute.name != model::kTransparencyAttribute || transparency == nullptr) continue;
        if (!(*transparency > 0 && *transparency <= 1)) continue;
        const double thickness = mesh.isSolid() && mesh.area > 0 ? 2 * mesh.volume / mesh.area : 0;
        // Sheets stand in pairs, inside and outside of a pane.
        const double passes = std::pow(std::min(*transparency, 1 - kLeastOpacity), mesh.isSolid() ? 1 : 0.5);
        const auto opacity = static_cast<float>(1 - std::pow(passes, 1 / std::max(thickness, thinnest)));
        return std::min(opacity, kMostOpaque);
    }
    return std::nullopt;
}

// The surfaces of windows that bound rooms lie before and behind panes: they are clear where the model has panes.
void clearWindowSurfaces(const volume::LabelTable& table, const std::vector<std::optional<Vec3f>>& colors,
                         double thinnest, std::vector<std::optional<float>>& opacities) {
    constexpr double kPasses = 0.9;
    if (std::none_of(table.labels.begin(), table.labels.end(), analyze::isPane)) return;
    const auto clear = static_cast<float>(1 - std::pow(kPasses, 1 / thinnest));
    for (std::size_t l = 0; l < table.labels.size(); ++l)
        if (table.labels[l].className == "WindowSurface" && table.labels[l].filling == volume::Filling::Surface &&
            !colors[l] && !opacities[l])
            opacities[l] = std::min(clear, kMostOpaque);
}

// The claims of the objects, the colours of phases where the table has room for them, and the patterns.
void addClaims(const mesh::MeshSet& meshes, const std::vector<std::uint32_t>& objectOf,
               const std::vector<ResolvedStyle>& styles, LabelledObjects& result) {
    volume::LabelTable& table = result.table;
    result.claims.resize(meshes.objects.size());
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o) {
        const std::uint32_t l = result.labelOfObject[o];
        const volume::Label& label = table.labels[l];
        result.claims[o] = {label.first, static_cast<std::uint8_t>(analyze::rankOf(label)), label.id,
                            bodyOf(table, objectOf, meshes, l)};
        if (!table.phaseColors.empty())
            for (volume::Scalar s = 0; s < label.count; ++s)
                table.phaseColors[label.first + s] =
                    s < styles[l].phaseColors.size() ? styles[l].phaseColors[s] : label.color;
        if (label.count > 1)
            result.patterns.push_back({label.first, styles[l].pattern, voxelize::dominantAxes(meshes.objects[o])});
    }
}

}  // namespace

void addCapFeatures(model::BuildingModel& model, const mesh::MeshSet& meshes) {
    for (const mesh::ObjectMesh& object : meshes.objects) {
        for (std::size_t c = 0; c < object.caps.size(); ++c) {
            model::Feature cap;
            cap.id = fmt::format("{}_cap_{}", model.features[object.feature].id, c + 1);
            // A model that is built again already has its caps.
            const auto& children = model.features[object.feature].children;
            if (std::any_of(children.begin(), children.end(),
                            [&](FeatureIndex child) { return model.features[child].id == cap.id; }))
                continue;
            cap.className = "ClosureSurface";
            cap.attributes.push_back({"generated", true, ""});
            cap.attributes.push_back({"area", object.caps[c].area, "m2"});
            model.addFeature(std::move(cap), object.feature);
        }
    }
}

Result<LabelledObjects> makeLabels(const model::BuildingModel& model, const mesh::MeshSet& meshes,
                                   std::span<const StyleSheet* const> sheets, double thinnest) {
    LabelledObjects result;
    volume::LabelTable& table = result.table;
    const std::vector<std::uint32_t> labelOf = numberFeatures(model, meshes, table);
    std::vector<std::optional<Vec3f>> colors(table.labels.size());
    for (FeatureIndex f = 0; f < model.features.size(); ++f)
        if (labelOf[f] != volume::kNoLabel) colors[labelOf[f]] = materialColor(model, model.features[f]);

    std::vector<std::optional<float>> opacities(table.labels.size());
    std::vector<std::uint32_t> objectOf(table.labels.size(), volume::kNoLabel);
    result.labelOfObject.resize(meshes.objects.size());
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o) {
        const std::uint32_t l = labelOf[meshes.objects[o].feature];
        objectOf[l] = o;
        result.labelOfObject[o] = l;
        table.labels[l].filling = fillingOf(meshes.objects[o].closingMethod);
        table.labels[l].volume = meshes.objects[o].isSolid() ? meshes.objects[o].volume : 0;
        opacities[l] = materialOpacity(table.labels[l], meshes.objects[o], thinnest);
    }
    clearWindowSurfaces(table, colors, thinnest, opacities);
    std::vector<bool> hasLines(table.labels.size(), false);
    for (const model::Polyline& line : model.lines) {
        result.labelOfLine.push_back(labelOf[line.feature]);
        if (line.points.size() > 1) hasLines[labelOf[line.feature]] = true;
    }
    const std::vector<ResolvedStyle> styles = resolveStyles(analyze::queryRows(table), sheets, colors, opacities);

    std::uint64_t next = 1;
    bool hasPattern = false;
    for (std::size_t l = 0; l < table.labels.size(); ++l) {
        volume::Label& label = table.labels[l];
        label.color = styles[l].color;
        label.opacity = styles[l].opacity;
        // A style that sets the opacity replaces the transparency of the model.
        if (opacities[l] && label.opacity != *opacities[l])
            std::erase_if(label.attributes,
                          [](const Attribute& attribute) { return attribute.name == model::kTransparencyAttribute; });
        if (objectOf[l] == volume::kNoLabel && !hasLines[l]) continue;
        label.first = static_cast<volume::Scalar>(next);
        label.count = objectOf[l] == volume::kNoLabel ? 1 : styles[l].pattern.phaseCount();
        next += label.count;
        hasPattern = hasPattern || label.count > 1;
    }
    if (next > volume::kMaxScalarCount)
        return Error(Code::TooManyLabels, fmt::format("{} scalars are needed, {} are possible; use fewer patterns, or "
                                                      "patterns with fewer phases",
                                                      next, volume::kMaxScalarCount));
    if (hasPattern) table.phaseColors.resize(next);
    addClaims(meshes, objectOf, styles, result);
    return result;
}

}  // namespace svt::pipeline

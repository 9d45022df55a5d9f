#include <svt/analyze/plan_faces.hpp>

#include <svt/model/classes.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace svt::analyze {
namespace {

using volume::Filling;

bool isBuilding(const volume::Label& label) { return model::classRank(label.className) == model::ClassRank::Building; }

bool isSolid(Filling filling) noexcept { return volume::hasClosedMesh(filling) || filling == Filling::Winding; }

}  // namespace

PlanFaces::PlanFaces(const volume::LabelTable& labels, const volume::VectorParts& vectors)
    : labels_(labels), vectors_(vectors), firstFace_(labels.labels.size() + 1, 0) {
    for (const volume::VectorParts::Triangle& triangle : vectors.triangles) ++firstFace_[triangle.label + 1];
    for (std::size_t l = 0; l < labels.labels.size(); ++l) firstFace_[l + 1] += firstFace_[l];
}

// The nearest building around a label in the extent, or kNoLabel.
std::uint32_t PlanFaces::groupOf(std::uint32_t label, std::span<const std::uint32_t> extent) const {
    while (std::binary_search(extent.begin(), extent.end(), label)) {
        if (isBuilding(labels_.labels[label])) return label;
        const std::uint32_t above = labels_.labels[label].parent;
        if (above >= label) break;
        label = above;
    }
    return volume::kNoLabel;
}

// Faces that point up are left out of closed solids: those that point down have the same outline.
void PlanFaces::addFaces(std::uint32_t label, PlanParts& parts) const {
    const bool isHalf = volume::hasClosedMesh(labels_.labels[label].filling);
    for (std::uint32_t f = firstFace_[label]; f < firstFace_[label + 1]; ++f) {
        const auto& corners = vectors_.triangles[f].corners;
        const Vec3i a = vectors_.points[corners[0]], b = vectors_.points[corners[1]], c = vectors_.points[corners[2]];
        const double area = (double(b.x) - a.x) * (double(c.y) - a.y) - (double(b.y) - a.y) * (double(c.x) - a.x);
        if (area == 0 || (isHalf && area > 0)) continue;
        parts.faces.push_back(f);
    }
}

void PlanFaces::addGroup(std::span<const std::uint32_t> group, PlanOutline outline, PlanParts& parts) const {
    const char* const wanted = outline == PlanOutline::Footprint ? "GroundSurface" : "RoofSurface";
    const auto addWhere = [&](const auto& isWanted) -> bool {
        const std::size_t before = parts.faces.size();
        for (const std::uint32_t label : group)
            if (hasFaces(label) && isWanted(labels_.labels[label])) addFaces(label, parts);
        return parts.faces.size() > before;
    };
    if (addWhere([&](const volume::Label& label) { return label.className == wanted; })) {
        parts.hasSurfaces = true;
        return;
    }
    const volume::Label& first = labels_.labels[group.front()];
    const bool hasBodies = addWhere([&](const volume::Label& label) {
        return isSolid(label.filling) &&
               (&label == &first || model::classRank(label.className) >= model::ClassRank::Element);
    });
    const bool hasFaces = hasBodies || addWhere([](const volume::Label&) { return true; });
    parts.hasSolids = parts.hasSolids || hasFaces;
    const bool isHollow = !isSolid(first.filling);
    for (const std::uint32_t label : group) {
        const volume::Label& own = labels_.labels[label];
        const bool isCounted = !hasFaces || (isHollow && own.filling == Filling::Body);
        if (isCounted && own.voxels > 0) parts.labels.push_back(label);
    }
}

PlanParts PlanFaces::of(std::span<const std::uint32_t> extent, PlanOutline outline) const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> grouped;
    grouped.reserve(extent.size());
    for (const std::uint32_t label : extent) grouped.emplace_back(groupOf(label, extent), label);
    std::sort(grouped.begin(), grouped.end());
    PlanParts parts;
    std::vector<std::uint32_t> group;
    for (std::size_t begin = 0, end = 0; begin < grouped.size(); begin = end) {
        group.clear();
        for (; end < grouped.size() && grouped[end].first == grouped[begin].first; ++end)
            group.push_back(grouped[end].second);
        addGroup(group, outline, parts);
    }
    std::sort(parts.faces.begin(), parts.faces.end());
    std::sort(parts.labels.begin(), parts.labels.end());
    return parts;
}

}  // namespace svt::analyze

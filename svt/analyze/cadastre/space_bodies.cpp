#include <svt/analyze/cadastre/space_bodies.hpp>

#include <svt/analyze/legal_units.hpp>
#include <svt/analyze/merged_boxes.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>

namespace svt::analyze {
namespace {

using volume::kNoLabel;

// The volume that a closed mesh encloses.
double enclosedVolume(const std::vector<SpaceTriangle>& triangles) {
    double sum = 0;
    for (const SpaceTriangle& t : triangles) sum += dot(t[0], cross(t[1], t[2]));
    return sum / 6;
}

// The twelve triangles of a box along the axes of a grid, relative to its origin.
std::vector<SpaceTriangle> trianglesOfBox(const volume::IndexBox& box, const volume::Grid& grid) {
    std::array<Vec3d, 8> corners;
    for (int n = 0; n < 8; ++n) {
        Vec3d index;
        for (int axis = 0; axis < 3; ++axis)
            index[axis] = double((n >> axis & 1) != 0 ? box.end[axis] : box.begin[axis]) - 0.5;
        corners[std::size_t(n)] = grid.worldFromIndexDirection(index);
    }
    constexpr std::array<std::array<std::size_t, 4>, 6> kFaces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    std::vector<SpaceTriangle> triangles;
    for (const auto& face : kFaces) {
        triangles.push_back({corners[face[0]], corners[face[1]], corners[face[2]]});
        triangles.push_back({corners[face[0]], corners[face[2]], corners[face[3]]});
    }
    return triangles;
}

}  // namespace

BodyMaker::BodyMaker(const volume::SemanticVolume& volume, const Extents& extents, std::size_t maxBoxes)
    : volume_(volume),
      extents_(extents),
      maxBoxes_(maxBoxes),
      firstTriangle_(volume.labels.labels.size() + 1, 0),
      known_(volume.labels, volume.grid, extents) {
    for (const auto& triangle : volume.vectors.triangles) ++firstTriangle_[triangle.label + 1];
    for (std::size_t l = 0; l + 1 < firstTriangle_.size(); ++l) firstTriangle_[l + 1] += firstTriangle_[l];
}

bool BodyMaker::hasSolid(std::uint32_t label) const noexcept {
    return volume::hasClosedMesh(volume_.labels.labels[label].filling) &&
           firstTriangle_[label] < firstTriangle_[label + 1];
}

std::vector<SpaceTriangle> BodyMaker::trianglesOf(std::uint32_t label) const {
    std::vector<SpaceTriangle> triangles;
    const volume::VectorParts& parts = volume_.vectors;
    for (std::size_t n = firstTriangle_[label]; n < firstTriangle_[label + 1]; ++n) {
        const auto& corners = parts.triangles[n].corners;
        triangles.push_back(
            {parts.position(corners[0], {}), parts.position(corners[1], {}), parts.position(corners[2], {})});
    }
    return triangles;
}

// The outermost spaces with a solid: a flat, not its rooms again.
void BodyMaker::addParts(const std::vector<std::uint32_t>& extent, LegalSpace& space) const {
    std::vector<char> isCovered(volume_.labels.labels.size(), 0);
    for (const bool isForUnits : {true, false})
        for (const std::uint32_t part : extent) {
            const std::string& className = volume_.labels.labels[part].className;
            const bool isUnit = model::classRank(className) == model::ClassRank::Unit;
            if (isUnit != isForUnits || isCovered[part] != 0 || !model::isSpace(className) || !hasSolid(part)) continue;
            space.solids.push_back(trianglesOf(part));
            for (const std::uint32_t inner : extents_.of(part)) isCovered[inner] = 1;
        }
}

void BodyMaker::addBoxes(const std::vector<std::uint32_t>& extent, LegalSpace& space, bool& hasBoxes) const {
    std::vector<std::uint32_t> groupOfScalar(volume_.labels.scalarCount(), kNoLabel);
    bool isEmpty = true;
    for (const std::uint32_t part : extent) {
        const volume::Label& label = volume_.labels.labels[part];
        isEmpty = isEmpty && label.voxels == 0;
        for (volume::Scalar s = label.first; s < label.first + label.count; ++s) groupOfScalar[s] = 0;
    }
    if (isEmpty) return;
    const auto boxes = mergeBoxes(volume_.columns, groupOfScalar, maxBoxes_);
    space.body = SpaceBody::Voxels;
    hasBoxes = bool(boxes);
    if (!boxes) return;
    for (const GroupBox& box : *boxes) space.solids.push_back(trianglesOfBox(box.box, volume_.grid));
}

LegalSpace BodyMaker::make(std::uint32_t label, bool& hasBoxes) const {
    LegalSpace space;
    space.label = label;
    space.isCommon = isCommonUnit(volume_.labels.labels[label]);
    space.totalVolume = known_.of(label).volume;
    hasBoxes = true;
    const std::vector<std::uint32_t> extent = extents_.of(label);
    if (hasSolid(label)) {
        space.body = SpaceBody::Solid;
        space.solids.push_back(trianglesOf(label));
    } else {
        addParts(extent, space);
        if (!space.solids.empty())
            space.body = SpaceBody::Parts;
        else
            addBoxes(extent, space, hasBoxes);
    }
    if (!space.solids.empty()) space.bodyVolume = 0;
    for (const auto& solid : space.solids) {
        *space.bodyVolume += enclosedVolume(solid);
        for (const SpaceTriangle& triangle : solid)
            for (const Vec3d& corner : triangle) space.box.add(corner);
    }
    return space;
}

}  // namespace svt::analyze

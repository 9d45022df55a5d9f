#pragma once
/// \file
/// The faces of a model that give the outline of a feature in plan.
///
/// The labels of a feature are grouped by building: each building part, with all that is below it, is a group. All
/// labels outside of building parts are one group as well. Each group has the first of these that exists:
///
///     footprint   its ground surfaces; the faces of its solids; all its faces; its voxels
///     roof        its roof surfaces;   the faces of its solids; all its faces; its voxels
///
/// Furniture, doors, windows and installations, such as chimneys, are not among these solids.
///
/// Material behind boundary surfaces (volume::Filling::Body) has no mesh. Its voxels are added to a group without
/// ground surfaces whose building has no solid of its own, such as a storey.

#include <svt/volume/label_table.hpp>
#include <svt/volume/vector_parts.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::analyze {

enum class PlanOutline : std::uint8_t { Footprint, Roof };

/// The parts that together are an outline.
struct PlanParts {
    std::vector<std::uint32_t> faces;   ///< indices into VectorParts::triangles, ascending
    std::vector<std::uint32_t> labels;  ///< labels whose voxels count, ascending
    bool hasSurfaces = false;           ///< the faces of a group are its ground or roof surfaces
    bool hasSolids = false;             ///< those of another group are its solids, or all its faces
};

class PlanFaces {
public:
    /// \param labels   must outlive the object, unchanged, like `vectors`
    /// Cost: O(labels + triangles).
    PlanFaces(const volume::LabelTable& labels, const volume::VectorParts& vectors);

    /// \param extent  of a feature, ascending, see Extents
    /// Cost: O(n log n) for n labels of the extent, plus their triangles.
    [[nodiscard]] PlanParts of(std::span<const std::uint32_t> extent, PlanOutline outline) const;

private:
    [[nodiscard]] std::uint32_t groupOf(std::uint32_t label, std::span<const std::uint32_t> extent) const;
    void addGroup(std::span<const std::uint32_t> group, PlanOutline outline, PlanParts& parts) const;
    void addFaces(std::uint32_t label, PlanParts& parts) const;
    [[nodiscard]] bool hasFaces(std::uint32_t label) const noexcept {
        return firstFace_[label] < firstFace_[label + 1];
    }

    const volume::LabelTable& labels_;
    const volume::VectorParts& vectors_;
    std::vector<std::uint32_t> firstFace_;  // of l: triangles [firstFace_[l], firstFace_[l + 1])
};

}  // namespace svt::analyze

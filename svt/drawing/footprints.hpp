#pragma once
/// \file
/// The true outlines of features in plan, as polygons with holes: from the ground surfaces or roof surfaces of the model,
/// from the faces of its solids, or from voxels. See analyze::PlanFaces for the choice.
///
/// The triangles of all faces are arranged (plane/arrangement.hpp): points within some micrometres meet. Their union has
/// the outline. Voxels contribute the squares of their columns.

#include <svt/analyze/extents.hpp>
#include <svt/analyze/plan_faces.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace svt::drawing {

/// A polygon with holes in world space, metres east and north. No ring repeats its first point.
struct PlanPolygon {
    /// The outer ring, counter-clockwise, then the holes, clockwise. At least one.
    std::vector<std::vector<std::array<double, 2>>> rings;

    friend bool operator==(const PlanPolygon&, const PlanPolygon&) = default;
};

/// m2 of a polygon, without its holes.
[[nodiscard]] double areaOf(const PlanPolygon& polygon) noexcept;

struct Footprint {
    std::vector<PlanPolygon>
        polygons;     ///< they touch at single points at most; none: the feature has no extent in plan
    double area = 0;  ///< m2, of the polygons
    /// "ground surfaces" ("roof surfaces"), "meshes", "voxels", or several of these, joined by " and "; empty without
    /// polygons.
    std::string source;
};

class OutlineUnion;

/// Outlines of features with their parts.
class Footprints {
public:
    /// \param volume  must outlive the object, unchanged, like `extents`. Its meshes give exact outlines, or else
    ///                SemanticVolume::footprints.
    /// Cost: O(labels + triangles), and O(columns + runs) with the first feature that needs voxels.
    Footprints(const volume::SemanticVolume& volume, const analyze::Extents& extents);

    /// Cost: O(n log n) for n faces and runs of columns of the feature. Not thread-safe, like Extents.
    [[nodiscard]] Footprint of(std::uint32_t label,
                               analyze::PlanOutline outline = analyze::PlanOutline::Footprint) const;
    /// The footprint of several labels as one. Thread-safe.
    /// \param extent  ascending
    [[nodiscard]] Footprint of(std::span<const std::uint32_t> extent, analyze::PlanOutline outline) const;

private:
    /// Samples [begin, end) along x in a row of columns.
    struct Span {
        std::int32_t row = 0, begin = 0, end = 0;
    };
    [[nodiscard]] const volume::VectorParts& vectors() const noexcept;
    [[nodiscard]] Footprint unionOf(const analyze::PlanParts& parts, analyze::PlanOutline outline) const;
    void addColumns(std::span<const std::uint32_t> labels, OutlineUnion& borders) const;
    void addSpans() const;

    const volume::SemanticVolume& volume_;
    const analyze::Extents& extents_;
    analyze::PlanFaces faces_;
    mutable std::vector<std::vector<Span>> spansOf_;  // by label, in order
    mutable std::once_flag areSpansKnown_;
};

}  // namespace svt::drawing

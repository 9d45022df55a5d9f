#pragma once
/// \file
/// The part of a view that the cut and the nearest faces cover: behind it, nothing is seen.

#include <svt/drawing/beyond/plane_index.hpp>
#include <svt/drawing/beyond/view_shapes.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace svt::drawing {

/// The common outline of cut components and faces.
class CoveredRegion {
public:
    /// The cut, without spaces.
    CoveredRegion(const SectionDrawing& drawing, const std::vector<LabelFacts>& facts);

    /// Adds the faces with all corners in the depths (from, to]; steep ones do not cover.
    void add(const std::vector<ViewFace>& faces, double from, double to);

    /// Whether a convex polygon lies within the outline: no border comes nearer than 0.03 mm to its inside. Borders stay
    /// 0.2 mm away from polygons that are thinner than twice that.
    /// \param ring  counter-clockwise; two points: a line
    [[nodiscard]] bool contains(const Ring& ring);

private:
    void addRing(const Ring& ring);
    void arrange();
    [[nodiscard]] bool isCovered(PlanePoint p);

    std::vector<std::pair<PlanePoint, PlanePoint>> segments_;  // the region is to the left
    std::vector<PlanePoint> borders_;                          // two each
    double leftmost_ = 0;
    std::optional<PlaneIndex> index_;
    PlaneIndex::Seen seen_;
};

}  // namespace svt::drawing

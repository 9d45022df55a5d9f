#pragma once
/// \file
/// Cut components hide everything behind them: finds the parts of lines that lie within the polygons of a drawing.

#include <svt/drawing/beyond/line_parts.hpp>
#include <svt/drawing/beyond/plane_index.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <vector>

namespace svt::drawing {

class CutRegion {
public:
    struct Scratch {
        PlaneIndex::Seen seen;
        std::vector<double> crossings;
    };

    /// The polygons of all components except spaces.
    CutRegion(const SectionDrawing& drawing, const volume::LabelTable& table);

    /// Adds the parts of the line within the region. The result on its border is unspecified.
    void addCovered(PlanePoint from, PlanePoint to, Scratch& scratch, std::vector<LinePart>& covered) const;

private:
    [[nodiscard]] bool contains(PlanePoint p, PlaneIndex::Seen& seen) const;

    std::vector<PlanePoint> corners_;  // of segments, two each
    double leftmost_ = 0;
    PlaneIndex index_;
};

}  // namespace svt::drawing

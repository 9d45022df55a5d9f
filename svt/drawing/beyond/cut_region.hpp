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
    static constexpr std::size_t kMostRows = 1024;
    struct Border {
        PlanePoint low, high;
        double left = 0;  // the lower u
    };
    void sortIntoRows();
    [[nodiscard]] std::size_t rowOf(double v) const noexcept;
    [[nodiscard]] bool contains(PlanePoint p) const;

    std::vector<PlanePoint> corners_;  // of segments, two each
    PlaneIndex index_;
    double bottom_ = kInfinity, rowHeight_ = 1;
    std::vector<std::vector<Border>> rows_;  // by height; a border is in all rows that it meets
};

}  // namespace svt::drawing

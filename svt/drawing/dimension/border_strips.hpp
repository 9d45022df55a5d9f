#pragma once
/// \file
/// The edges of a drawing's borders by height: a search for those near a room does not visit the whole drawing.

#include <svt/drawing/section_drawing.hpp>

#include <cstdint>
#include <vector>

namespace svt::drawing {

/// Level strips of at least 1 m that list the edges which they meet. The strips refer to the drawing, whose borders stay
/// as they are.
class BorderStrips {
public:
    struct Edge {
        const SectionBorder* border = nullptr;
        PlanePoint a, b;
    };

    /// Cost: O(edges * strips that each meets).
    explicit BorderStrips(const SectionDrawing& drawing);

    /// The edges between two heights, in the order of the drawing. Edges nearby may be among them.
    [[nodiscard]] std::vector<Edge> between(double low, double high) const;

private:
    [[nodiscard]] std::size_t stripOf(double v) const noexcept;

    std::vector<Edge> edges_;
    std::vector<std::vector<std::uint32_t>> strips_;  // numbers of edges
    double low_ = 0, height_ = 1;                     // of a strip, metres
};

}  // namespace svt::drawing

#pragma once
/// \file
/// The lines and texts of a drawing on paper, to find places for further texts that are clear of them.

#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/canvas/mark_shapes.hpp>

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace svt::writers {

/// The weight of an obstacle.
enum class Obstacle : std::uint8_t {
    Border,  ///< outlines of cut parts, doors, dimensions: a text never covers them
    Line,    ///< visible lines: a text covers them only if it has no other place
    Light    ///< dashed lines above and behind
};

class FreeSpace {
public:
    struct Hits {
        int borders = 0, lines = 0, light = 0;
        bool isTaken = false;  ///< by another text
        [[nodiscard]] bool isClear() const noexcept { return borders + lines == 0 && !isTaken; }
    };

    void add(drawing::PlanePoint from, drawing::PlanePoint to, Obstacle kind);
    void add(const MarkPath& path, Obstacle kind);
    /// Occupies a place for a text.
    void take(const MarkBox& box) { taken_.push_back(box); }

    /// The obstacles within a rectangle. Cost: O(obstacles near it + taken places).
    [[nodiscard]] Hits hitsOf(const MarkBox& box) const;
    /// Whether a line crosses a taken place.
    [[nodiscard]] bool crossesTaken(drawing::PlanePoint from, drawing::PlanePoint to) const noexcept;

private:
    struct Segment {
        drawing::PlanePoint from, to;
        Obstacle kind;
    };
    std::vector<Segment> segments_;
    std::vector<MarkBox> taken_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
    mutable std::vector<std::uint32_t> seenIn_;  // by segment: the number of the last search that met it
    mutable std::uint32_t search_ = 0;
};

/// Whether a line has a point within a rectangle.
[[nodiscard]] bool meets(drawing::PlanePoint from, drawing::PlanePoint to, const MarkBox& box) noexcept;

/// All lines of a drawing, with its dimensions and doors.
/// \param millimetres  on paper per metre
[[nodiscard]] FreeSpace freeSpaceOf(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                    double millimetres);

/// A line of text between two baselines, and the size of several lines.
inline constexpr double kLinePitch = 1.3;  ///< font sizes
[[nodiscard]] std::pair<double, double> sizeOfLines(const std::vector<std::string>& lines, double size);

}  // namespace svt::writers

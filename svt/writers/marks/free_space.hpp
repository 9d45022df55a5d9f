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
    /// \param mostLines  the search ends at a taken place, a border, or more lines than this; the counts are then those
    ///                   found so far
    [[nodiscard]] Hits hitsOf(const MarkBox& box, int mostLines = kAll) const;
    /// Whether a rectangle has no border, no line and no taken place.
    [[nodiscard]] bool isClear(const MarkBox& box) const { return hitsOf(box, 0).isClear(); }
    /// Whether a line crosses a taken place.
    [[nodiscard]] bool crossesTaken(drawing::PlanePoint from, drawing::PlanePoint to) const noexcept;

    static constexpr int kAll = -1;

private:
    struct Segment {
        drawing::PlanePoint from, to;
        Obstacle kind;
        MarkBox around;  // with a margin for rounding
    };
    /// A square of 5 mm: the segments in it, and the squares of 1 mm that they touch, as bits. A rectangle that contains
    /// a touched square has an obstacle.
    struct Cell {
        std::vector<std::uint32_t> segments;
        std::uint32_t borders = 0, lines = 0;
    };
    static std::uint32_t touchedBits(const Segment& segment, std::int64_t x, std::int64_t y) noexcept;
    static std::uint32_t bitsWithin(const MarkBox& box, std::int64_t x, std::int64_t y) noexcept;

    std::vector<Segment> segments_;
    std::vector<MarkBox> taken_;
    std::unordered_map<std::uint64_t, Cell> cells_;
    mutable std::vector<const Cell*> near_;      // of the current search
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

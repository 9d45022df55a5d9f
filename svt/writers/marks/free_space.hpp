#pragma once
/// \file
/// The lines and texts of a drawing on paper, to find places for further texts that are clear of them.

#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/canvas/mark_shapes.hpp>

#include <array>
#include <cstdint>
#include <string>
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

/// Squares of 1 mm as rows of bits.
struct MarkRaster {
    std::int64_t left = 0, low = 0;   ///< the first square, millimetres
    std::size_t words = 0;            ///< of a row, 64 squares each
    std::vector<std::uint64_t> rows;  ///< from below
};

/// Obstacles are found by tiles of 64 mm: bits mark the squares of 1 mm that they meet, and cells of 8 mm list them. So
/// a search looks at the obstacles near its rectangle, whatever the size of the drawing.
class FreeSpace {
public:
    struct Hits {
        int borders = 0, lines = 0, light = 0;
        bool isTaken = false;  ///< by another text
        [[nodiscard]] bool isClear() const noexcept { return borders + lines == 0 && !isTaken; }
    };
    /// The work so far: a measure of cost that does not depend on the machine.
    struct Effort {
        std::uint64_t searches = 0;  ///< rectangles and leaders, also those that `BlockedPlaces` refused
        std::uint64_t compared = 0;  ///< obstacles and taken places that they were compared with
    };

    /// The obstacle that a search found. A search near by asks it first.
    struct Found {
        static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
        std::uint32_t segment = kNone, taken = kNone;
    };

    void add(drawing::PlanePoint from, drawing::PlanePoint to, Obstacle kind);
    void add(const MarkPath& path, Obstacle kind);
    /// Occupies a place for a text.
    void take(const MarkBox& box);

    /// The obstacles within a rectangle. Cost: O(area in mm2 / 64 + obstacles and taken places near it).
    /// \param mostLines  the search ends at a taken place, a border, or more lines than this; the counts are then those
    ///                   found so far
    [[nodiscard]] Hits hitsOf(const MarkBox& box, int mostLines = kAll) const;
    /// Whether a rectangle has no border, no line and no taken place.
    [[nodiscard]] bool isClear(const MarkBox& box) const {
        Found last;
        return isClear(box, last);
    }
    [[nodiscard]] bool isClear(const MarkBox& box, Found& last) const;
    /// Whether a line crosses a taken place. Cost: O(length + taken places near it).
    [[nodiscard]] bool crossesTaken(drawing::PlanePoint from, drawing::PlanePoint to) const {
        Found last;
        return crossesTaken(from, to, last);
    }
    [[nodiscard]] bool crossesTaken(drawing::PlanePoint from, drawing::PlanePoint to, Found& last) const;

    /// The squares that borders, taken places and, if `withLines`, visible lines meet: a rectangle around one of them has
    /// an obstacle. The raster covers the box and at most 63 columns beyond its sides. Cost: O(area in mm2 / 64).
    [[nodiscard]] MarkRaster marksIn(const MarkBox& box, bool withLines) const;
    /// Counts a rectangle that was refused without a search.
    void countRefused() const noexcept { ++effort_.searches; }

    [[nodiscard]] const Effort& effort() const noexcept { return effort_; }

    static constexpr int kAll = -1;

private:
    static constexpr std::int64_t kTile = 64, kCell = 8, kCells = kTile / kCell;  // millimetres; cells along a tile
    using Squares = std::array<std::uint64_t, kTile>;                             // one bit per square, by row

    struct Segment {
        drawing::PlanePoint from, to;
        Obstacle kind;
        MarkBox around;  // with a margin for rounding
    };
    struct Cell {
        std::vector<std::uint32_t> segments, light, taken;  // borders and lines; dashed lines; places of texts
    };
    struct Tile {
        Squares borders{}, lines{};  // squares that a segment meets: a rectangle around one has an obstacle
        Squares taken{};             // squares within a taken place
        std::array<Cell, kCells * kCells> cells;
    };
    /// Squares or cells from first to last.
    struct Range {
        std::int64_t first = 0, last = -1;
    };

    Cell& cellAt(std::int64_t x, std::int64_t y);
    [[nodiscard]] const Tile* tileAt(std::int64_t x, std::int64_t y) const;
    void mark(std::int64_t row, Range columns, Squares Tile::*squares);
    void markSegment(const Segment& segment, Squares Tile::*squares);
    template <class Visit>
    void visitCells(const MarkBox& box, const Visit& visit) const;
    template <class Marks>
    [[nodiscard]] bool hasSquare(const MarkBox& box, const Marks& marksOf) const;
    [[nodiscard]] bool isTaken(const MarkBox& box) const;

    std::vector<Segment> segments_;
    std::vector<MarkBox> taken_;
    std::unordered_map<std::uint64_t, Tile> tiles_;
    mutable std::vector<std::uint32_t> seenIn_;  // by segment: the number of the last search that met it
    mutable std::uint32_t search_ = 0;
    mutable Effort effort_;
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

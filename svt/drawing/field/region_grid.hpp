#pragma once
/// \file
/// The values of a field at the nodes of a grid over one region of a section.
///
///     . node outside of the region, continued linearly      o node with a sampled value      | wall
///     x node inside of the region, but in a voxel of its walls: continued as well, and only from its side of the wall
///
///     .   .   .   .   .   .
///       +-------------+
///     . | o   o   x   | . .
///     . | o   o   x   | . .
///       +-------------+

#include <svt/drawing/field/field_regions.hpp>
#include <svt/fields/field_sampler.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace svt::drawing {

/// The source of the values of nodes.
struct FieldSource {
    const fields::Field& field;
    const volume::SemanticVolume& volume;
    const fields::FieldSampler& sampler;
    const std::vector<char>& isMedium;  ///< by scalar
    const std::vector<char>& isAir;     ///< by scalar
    PlaneAxes axes;                     ///< of the section, a hair into the kept side
    double seconds = 0;
    double least = -kInfinity;  ///< values are not continued below it
    int threads = 0;
};

/// A convex part of a cell, counter-clockwise.
using Piece = std::vector<PlanePoint>;

class RegionGrid {
public:
    RegionGrid(const FieldRegion& region, const FieldSource& source);

    enum class Place : std::uint8_t {
        Outside,
        Inside,
        Border,   ///< the outline of the region passes
        Missing,  ///< partly inside, and without values
    };
    [[nodiscard]] std::size_t columns() const noexcept { return us_.size() - 1; }  ///< cells along u
    [[nodiscard]] std::size_t rows() const noexcept { return vs_.size() - 1; }     ///< cells along v
    [[nodiscard]] Place placeOf(std::size_t column, std::size_t row) const noexcept {
        return places_[column + row * columns()];
    }
    /// A corner of the cell: 0 to 3 counter-clockwise from the lower left one.
    [[nodiscard]] PlanePoint corner(std::size_t column, std::size_t row, int number) const noexcept {
        return {us_[column + (number == 1 || number == 2 ? 1 : 0)], vs_[row + (number >= 2 ? 1 : 0)]};
    }
    [[nodiscard]] double value(std::size_t column, std::size_t row, int number) const noexcept {
        return values_[node(column + (number == 1 || number == 2 ? 1 : 0), row + (number >= 2 ? 1 : 0))];
    }

    /// The parts of a segment in a border cell that lie inside the region.
    [[nodiscard]] std::vector<std::pair<PlanePoint, PlanePoint>> clip(std::size_t column, std::size_t row,
                                                                      PlanePoint from, PlanePoint to) const;
    /// The rings of the region within a border cell, with the region to their left; parts along its sides may overlap.
    [[nodiscard]] std::vector<Ring> ringsIn(std::size_t column, std::size_t row) const;

    /// Whether a segment lies within the region, where it has values.
    [[nodiscard]] bool holds(PlanePoint from, PlanePoint to) const noexcept;
    [[nodiscard]] PlanePoint low() const noexcept { return {us_.front(), vs_.front()}; }
    [[nodiscard]] PlanePoint high() const noexcept { return {us_.back(), vs_.back()}; }

    /// Whether a cell without values lies in a component, not in empty space.
    [[nodiscard]] bool isInComponent(std::size_t column, std::size_t row) const noexcept;

private:
    enum class Node : std::uint8_t { Beyond, Known, Missing };
    [[nodiscard]] std::size_t node(std::size_t i, std::size_t j) const noexcept { return i + j * us_.size(); }
    std::size_t fill(double refine);
    [[nodiscard]] bool meetsEmptySpace() const noexcept;
    void findNodes();
    void sampleRow(std::size_t j);
    void findWalls();
    [[nodiscard]] bool hasThinWall() const noexcept;
    [[nodiscard]] bool isWallAhead(std::ptrdiff_t i, std::ptrdiff_t j, int du, int dv) const noexcept;
    [[nodiscard]] double continuedValue(std::ptrdiff_t i, std::ptrdiff_t j, bool isInside) const noexcept;
    void extend();
    void extendNodes(bool areInside, int steps);
    void findPlaces();
    [[nodiscard]] std::span<const std::uint32_t> edgesOf(std::size_t row) const noexcept {
        return {rowEdges_.data() + rowStarts_[row], rowStarts_[row + 1] - rowStarts_[row]};
    }
    [[nodiscard]] bool isInside(std::size_t row, PlanePoint p) const noexcept;
    [[nodiscard]] volume::Scalar scalarAt(PlanePoint p) const noexcept;

    const FieldRegion& region_;
    const FieldSource& source_;
    std::vector<std::pair<PlanePoint, PlanePoint>> edges_;
    std::vector<double> us_, vs_;       // of the nodes, ascending
    std::vector<std::uint8_t> inside_;  // by node
    std::vector<std::uint8_t> walls_;   // by node: whether the outline passes before the next node along u (1), v (2)
    std::vector<Node> nodes_;           // by node
    std::vector<double> values_;        // by node; NaN: none
    std::vector<Place> places_;         // by cell
    bool hasEmptySpace_ = false;        // whether the region has nodes in empty space
    std::vector<std::uint32_t> rowEdges_;  // edges that meet the row of cells, row by row
    std::vector<std::size_t> rowStarts_;
    mutable std::size_t clippedRow_ = ~std::size_t{0};
    mutable std::vector<Ring> rowRings_;
};

/// The part of a ring on one side of a line, as by Sutherland and Hodgman (1974).
/// \param a, b  the part to the left of the line from a to b is kept
[[nodiscard]] Ring clipRing(const Ring& ring, PlanePoint a, PlanePoint b);

/// Coordinates of nodes along u and v over a box, with `more` nodes around it.
struct NodeLines {
    std::vector<double> us, vs;
};
/// \param refine  1: the nodes of the lattice; 2: twice as many
[[nodiscard]] NodeLines nodeLines(const FieldSource& source, PlanePoint low, PlanePoint high, double refine);

}  // namespace svt::drawing

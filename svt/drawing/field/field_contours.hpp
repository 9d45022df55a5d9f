#pragma once
/// \file
/// Lines of equal value and bands of one region.

#include <svt/drawing/field/region_grid.hpp>
#include <svt/drawing/field_drawing.hpp>

#include <cstdint>
#include <map>
#include <vector>

namespace svt::drawing {

/// Collects the area of one band, or of places without a value.
struct BandOutline {
    OutlineUnion outline;
    double area = 0;  ///< m2 of all parts
    /// \param ring  counter-clockwise, or with parts that cancel
    void add(const Ring& ring);
};

/// Bands by number: band k has values from k to k + 1 steps.
using BandOutlines = std::map<std::int64_t, BandOutline>;

/// Appends the lines of a region, joined to polylines, by value.
void addIsolines(const RegionGrid& grid, double step, std::vector<FieldIsoline>& lines);
/// \param shift  of the limits of bands, in steps
void addBands(const RegionGrid& grid, double step, double shift, BandOutlines& bands);
/// Appends the cells of components without values.
void addMissing(const RegionGrid& grid, BandOutline& missing);

}  // namespace svt::drawing

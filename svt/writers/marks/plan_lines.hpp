#pragma once
/// \file
/// Lines that plans have beside the building's own: the line of travel of stairs, axes of grids.

#include <svt/drawing/stair_flights.hpp>
#include <svt/writers/marks/free_space.hpp>

#include <span>
#include <string_view>

namespace svt::writers {

/// The level that a plan shows, metres above the grid's lower corner.
struct PlanHeights {
    double floor = 0, cut = 0, floorAbove = 0;  ///< floorAbove: of the next level, or that of the plan for the top one
};

/// The line of travel of each stair that the plan shows: from a ring at the first tread upwards to an arrow, with the
/// number of risers and their size. A stair that the plan cuts ends at a break line.
/// \param risers  the word for risers, before their size: "16 R 17.5/28", centimetres
[[nodiscard]] MarkShapes drawTravel(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                    std::span<const drawing::StairFlight> flights, const PlanHeights& heights,
                                    double millimetres, std::string_view risers, bool hasCommas, FreeSpace& space);

/// Space around the dimensions of a plan for the names of axes, millimetres.
inline constexpr double kGridMargin = 8;
[[nodiscard]] bool hasGrids(const volume::LabelTable& labels) noexcept;

/// The axes of grids, straight or curved, with their names in circles at both ends. An axis that ends beside the drawing
/// goes on across the dimensions, so that its name stands outside of them; one that is longer ends there. Each of its
/// parts within these limits has its name, and a whole circle has its name once. Circles that would overlap stand one
/// behind the other.
/// \param dimensions  the drawing with its dimensions: circles outside of the drawing stand outside of this box too
[[nodiscard]] MarkShapes drawGrids(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                   double millimetres, const MarkBox& dimensions, FreeSpace& space);

}  // namespace svt::writers

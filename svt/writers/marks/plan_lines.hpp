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

/// The axes of grids, straight or curved, with their names in circles at both ends. An axis that is longer than the
/// drawing ends beside it; each of its parts within the drawing has its name. A whole circle has its name once.
/// \param allowed  limits of the circles
[[nodiscard]] MarkShapes drawGrids(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                   double millimetres, const MarkBox& allowed, FreeSpace& space);

}  // namespace svt::writers

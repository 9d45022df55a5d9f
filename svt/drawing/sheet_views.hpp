#pragma once
/// \file
/// The usual architectural views of a building: a plan of each level, two sections, four elevations.

#include <svt/core/result.hpp>
#include <svt/drawing/building_levels.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <string>
#include <vector>

namespace svt::drawing {

enum class ViewKind : std::uint8_t { Plan, Section, Elevation };

/// The description of a view.
struct SheetView {
    ViewKind kind = ViewKind::Plan;
    std::string
        name;  ///< plan: name of its storey, or empty; section: "A" or "B"; elevation: "north", "north-east" ...
    SectionPlane plane;
    double floor = 0;  ///< plan: floor of its level, metres above the grid's lower corner
    BeyondOptions beyond;
};

struct SheetViews {
    std::vector<BuildingLevel> levels;  ///< from the lowest
    std::vector<SheetView> views;       ///< plans from below, sections, elevations from the north clockwise
};

/// Chooses the views. Plans are cut 1.1 m above the level; they show the parts below, and the parts above as dashed
/// lines. Sections are vertical, along both axes of the grid, in the main building: the largest group of walls, slabs,
/// roofs and rooms that touch in plan. They pass through its largest stair. Without one, A-A cuts the ridge of its roof.
/// Among these places, they cut most of the rooms and least of the walls along their length.
/// \param threads  0: all cores; the result does not depend on it
/// \param tables   of the volume, or null: they are made
/// \return the views, or an error of drawSection()
/// Cost: that of 18 sections without lines beyond the cut.
[[nodiscard]] Result<SheetViews> chooseSheetViews(const volume::SemanticVolume& volume, int threads = 0,
                                                  const DrawingTables* tables = nullptr);

}  // namespace svt::drawing

#pragma once
/// \file
/// Which views of a building an architect would draw: a plan of each level, two sections, four elevations.

#include <svt/core/result.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <string>
#include <vector>

namespace svt::drawing {

enum class ViewKind : std::uint8_t { Plan, Section, Elevation };

/// A floor of the building.
struct BuildingLevel {
    std::string name;  ///< of the storey; empty where the model has none
    double floor = 0;  ///< metres above the grid's lower corner
    double bound = 0;  ///< metres by which it may be off: 0 from meshes and declared elevations, see storey_floors.hpp
};

/// A view, not drawn yet.
struct SheetView {
    ViewKind kind = ViewKind::Plan;
    std::string name;  ///< of a plan that of its storey, or empty; of a section "A" or "B"; "north" and so on
    SectionPlane plane;
    double floor = 0;  ///< of a plan: of its level, metres above the grid's lower corner
    BeyondOptions beyond;
};

struct SheetViews {
    std::vector<BuildingLevel> levels;  ///< the lowest first
    std::vector<SheetView> views;       ///< plans from below, sections, elevations from the north clockwise
};

/// Levels: the storeys of the model, as findStoreys() gives them; without any, floors of rooms that are at least 1.5 m high,
/// those within 1.2 m of the lowest of them being one level; without rooms, the tops of slabs and floors of 4 m2 or more
/// that are no roof.
[[nodiscard]] std::vector<BuildingLevel> findLevels(const volume::SemanticVolume& volume);

/// Chooses the views. Plans are cut 1.1 m above the floor, and show what is below, and dashed what is above. Sections are
/// upright, along both axes of the grid, where they cut most of the rooms; where the model has stairs, through one.
/// \param threads  0: all cores; the result does not depend on it
/// \return the views, or an error of drawSection()
/// Cost: that of 18 sections without what is beyond.
[[nodiscard]] Result<SheetViews> chooseSheetViews(const volume::SemanticVolume& volume, int threads = 0);

}  // namespace svt::drawing

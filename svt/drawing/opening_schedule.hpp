#pragma once
/// \file
/// The schedule of doors and windows: one mark for all openings of one type and size, which plans and tables share.

#include <svt/drawing/building_levels.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace svt::drawing {

/// The place of an opening, from its mesh.
struct OpeningPlace {
    Vec3d center{};         ///< world space
    Vec3d normal{0, 1, 0};  ///< unit vector, across the opening
    double width = 0;       ///< metres, horizontally across the normal
    double height = 0;      ///< metres, across width and normal: along the slope in roofs
    double low = 0;         ///< lowest point, metres above the grid's lower corner
};

/// All openings of one mark on one level.
struct OpeningRow {
    bool isDoor = true;
    std::string mark;                                     ///< D1, D2 ... for doors, W1, W2 ... for windows
    std::string type;                                     ///< name of the type in the file; empty: not stated
    std::size_t level = 0;                                ///< index into the given levels
    std::optional<double> statedWidth, statedHeight;      ///< metres, as the file states them: OverallWidth of IFC
    std::optional<double> measuredWidth, measuredHeight;  ///< metres, of the mesh with its frame
    /// Metres, of doors: a property such as `ClearWidth`, in metres; otherwise, if all panels swing, the stated width without
    /// the linings at both sides (LiningThickness of IFC). The thickness of an open panel is not deducted.
    std::optional<double> clearWidth;
    /// Metres from the floor of the rooms to the lowest point, the least of the row. Thresholds of doors below 5 cm are 0.
    std::optional<double> sill;
    std::vector<std::uint32_t> labels;
};

struct OpeningSchedule {
    std::vector<OpeningRow> rows;                     ///< by mark, doors first, then by level
    std::vector<std::string> marks;                   ///< by label; empty for labels that are not openings
    std::vector<std::optional<OpeningPlace>> places;  ///< by label, likewise
    std::vector<std::uint32_t> openings;              ///< by label: the opening that it is part of, or kNoLabel
    std::size_t unknown = 0;                          ///< openings without a mesh and a stated size, which have no row
};

/// Lists the doors and windows that have a mesh or a stated size, also elements whose `ifcType` is one of a door or a
/// window. A feature within another opening, such as its surface,
/// belongs to that one. Surfaces of doors and windows count only if the model has no doors or windows as bodies; the two
/// sides of a wall count once. Marks are numbered by level, type and size.
/// \param levels  of findLevels(); may be empty
/// Cost: O(triangles + labels log labels).
[[nodiscard]] OpeningSchedule scheduleOpenings(const volume::SemanticVolume& volume,
                                               std::span<const BuildingLevel> levels);

}  // namespace svt::drawing

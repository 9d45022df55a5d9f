#pragma once
/// \file
/// The words on sheets, in English and German.

#include <svt/drawing/hatches.hpp>
#include <svt/writers/sheet_writer.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace svt::writers {

enum class SheetWord : std::uint8_t {
    Drawing,
    Model,
    Scale,
    Sheet,
    Paper,
    SheetOf,  ///< "1 of 3"
    Plan,     ///< "Plan", before the name of a storey
    Level,    ///< "level", before its height
    Plans,
    Section,
    Sections,
    Elevations,
    North,
    East,
    South,
    West,
    NorthEast,
    SouthEast,
    SouthWest,
    NorthWest,
    GroundFloor,
    HeightsAbove,  ///< "Heights above", before the name of the ground floor
    InModelHeights,
    NorthLetter,
    NorthAssumed,  ///< the file does not state true north
    GridNorth,
    GridNorthLetters,
    EastLetter,
    WestLetter,
    Rooms,
    FloorAreas,
    Components,
    Number,
    Room,
    Storey,
    Use,
    Zone,  ///< a room that consists of other rooms
    Area,
    Height,
    Volume,
    Component,
    Type,
    Count,
    Total,
    NoScale,
    Tables,
    Project,
    BuildingAddress,
    DocumentType,
    DrawingNumber,
    Owner,
    Creator,
    Approver,
    Revision,
    Date,
    FloorPlan,
    ElevationType,
    ScheduleType,
    WithoutStamp,  ///< before a list of rooms
    SeeTable,      ///< the end of the line if the list is a table
    Stamp,
    Risers,
    Legend,
    GroundAssumed,  ///< below an elevation
    Doors,
    Windows,
    Mark,
    Width,
    WidthMeasured,
    WidthClear,
    HeightMeasured,
    Sill,
    Revisions,
    RevisionChange,
    RevisionObject,
    RevisionAdded,    ///< m3
    RevisionRemoved,  ///< m3
    FurtherRevisions,
    Moved,
    Changed,
    Split,
    Merged,
    Added,
    Removed
};

[[nodiscard]] std::string_view sheetWord(SheetWord word, SheetLanguage language) noexcept;

/// The material of a hatch.
[[nodiscard]] std::string_view hatchWord(render::Hatch hatch, SheetLanguage language) noexcept;

/// "Elevation from the north", "Ansicht von Norden".
[[nodiscard]] std::string elevationText(std::string_view side, SheetLanguage language);

/// A number with the given number of decimals, with a comma in German.
[[nodiscard]] std::string numberText(double value, int decimals, SheetLanguage language);

}  // namespace svt::writers

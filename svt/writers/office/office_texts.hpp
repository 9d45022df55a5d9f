#pragma once
/// \file
/// The words of title blocks, stamps, schedules and legends, in English and German.

#include <svt/drawing/hatches.hpp>
#include <svt/writers/sheet_writer.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace svt::writers {

enum class OfficeWord : std::uint8_t {
    Project,
    Building,
    DocumentType,
    DrawingNumber,
    Owner,
    Creator,
    Approver,
    Revision,
    Date,
    FloorPlan,
    SectionType,
    ElevationType,
    ScheduleType,
    WithoutStamp,  ///< before a list of rooms
    SeeTable,      ///< "{} more in the table of rooms"
    Risers,
    Legend,
    Doors,
    Windows,
    Mark,
    Width,
    Height,
    WidthMeasured,
    HeightMeasured,
    Sill
};
[[nodiscard]] std::string_view officeWord(OfficeWord word, SheetLanguage language) noexcept;

/// The material of a hatch.
[[nodiscard]] std::string_view hatchWord(render::Hatch hatch, SheetLanguage language) noexcept;

}  // namespace svt::writers

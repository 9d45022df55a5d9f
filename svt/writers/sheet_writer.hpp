#pragma once
/// \file
/// Drawings of a building on sheets of paper, to scale, with frame and title block: as one PDF, or as SVG documents.
///
///     +--+---------------------------------+
///     |  |   view         view             |    views of one kind stand on one sheet, as many as fit
///     |  |   Plan EG      Plan OG          |
///     |  |                  +--------------+
///     |  |  scale bar       | title block  |    180 mm wide, after ISO 7200; frame after ISO 5457
///     +--+------------------+--------------+

#include <svt/core/names.hpp>
#include <svt/core/result.hpp>
#include <svt/drawing/floor_areas.hpp>
#include <svt/drawing/sheet_views.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace svt::writers {

/// A view and what it shows.
struct DrawnView {
    drawing::SheetView view;
    drawing::SectionDrawing drawing;
    int group = -1;  ///< of SheetContent::groups: these share sheets; -1: with others of its kind
};

/// Views that share sheets.
struct SheetGroup {
    std::string title;  ///< empty: of its views
    double scale = 0;   ///< 0: that of all
};

enum class SheetLanguage : std::uint8_t { English, German };
constexpr auto namesOf(SheetLanguage) {
    return std::to_array<Name<SheetLanguage>>({{SheetLanguage::English, "en"}, {SheetLanguage::German, "de"}});
}

/// A table on sheets of its own.
struct SheetTable {
    struct Column {
        std::string heading;
        bool isNumber = false;  ///< stands at the right
    };
    std::string title;
    std::vector<Column> columns;
    std::vector<std::vector<std::string>> rows;  ///< a text for each column
    std::size_t sums = 0;                        ///< so many rows at the end are sums
};

struct SheetContent {
    std::vector<drawing::BuildingLevel> levels;  ///< marks of heights are above the lowest
    std::vector<DrawnView> views;
    std::vector<SheetGroup> groups;
    std::vector<SheetTable> tables;  ///< after the views; those that fit share sheets
};

struct SheetOptions {
    double scale = 0;          ///< 100 draws 1 m as 10 mm; 0: 1:100, or the next standard scale at which all views fit
    std::string paper = "A3";  ///< A4 to A0, landscape
    SheetLanguage language = SheetLanguage::English;
    std::string title{};  ///< of the building; empty: the name of the model
};

/// The tables of rooms, floor areas and components; without rooms that of components alone.
[[nodiscard]] std::vector<SheetTable> makeAreaTables(const drawing::FloorAreas& areas,
                                                     const std::vector<drawing::BuildingLevel>& levels,
                                                     SheetLanguage language);

/// The sheets as SVG documents, in order. `volume` is the volume the drawings were made from. Equal drawings give equal
/// bytes.
/// \return the documents, or BadArgument: an unknown paper, a scale out of 1:0.01 to 1:10000000, or a view that is
///         larger than the paper (names the paper or scale that would do)
[[nodiscard]] Result<std::vector<std::string>> makeSvgSheets(const SheetContent& content,
                                                             const volume::SemanticVolume& volume,
                                                             const SheetOptions& options = {});

/// Why no PDF has layers (optional content) here; empty: they have. Loads libqpdf with the first call.
[[nodiscard]] const std::string& missingPdfLayers();

/// The sheets as one PDF, a page each, with the layers of the SVG unless missingPdfLayers().
/// \return the bytes, or the errors of makeSvgSheets(), NoCairo or CannotWrite
[[nodiscard]] Result<std::string> makePdfSheets(const SheetContent& content, const volume::SemanticVolume& volume,
                                                const SheetOptions& options = {});

}  // namespace svt::writers

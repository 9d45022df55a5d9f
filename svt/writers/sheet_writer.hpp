#pragma once
/// \file
/// Drawings of a building on sheets of paper, to scale, with frame and title block: as one PDF, or as SVG documents.
///
///     +--+---------------------------------+
///     |  |   view         view             |    views of one kind are on one sheet, as many as fit
///     |  |   Plan EG      Plan OG          |
///     |  |                  +--------------+
///     |  |  scale bar       | title block  |    180 mm wide, as in ISO 7200; frame as in ISO 5457
///     +--+------------------+--------------+

#include <svt/core/names.hpp>
#include <svt/core/result.hpp>
#include <svt/drawing/floor_areas.hpp>
#include <svt/drawing/opening_schedule.hpp>
#include <svt/drawing/sheet_set.hpp>
#include <svt/drawing/sheet_views.hpp>
#include <svt/drawing/stair_flights.hpp>
#include <svt/writers/pdf_file.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::writers {

#ifdef __EMSCRIPTEN__
/// Whether drawings show revisions: clouds, numbers and lists. The module of the page leaves out this code to stay small.
inline constexpr bool kDrawsRevisions = false;
#else
inline constexpr bool kDrawsRevisions = true;
#endif
[[nodiscard]] inline bool hasRevisions(const drawing::SectionDrawing& drawing) noexcept {
    return kDrawsRevisions && !drawing.revisions.empty();
}

/// A view and its drawing.
struct DrawnView {
    drawing::SheetView view;
    drawing::SectionDrawing drawing;
    int group = -1;  ///< index into SheetContent::groups, which share sheets; -1: with others of its kind
};

/// Views that share sheets.
struct SheetGroup {
    std::string title;  ///< empty: derived from its views
    double scale = 0;   ///< 0: common scale
};

enum class SheetLanguage : std::uint8_t { English, German };
constexpr auto namesOf(SheetLanguage) {
    return std::to_array<Name<SheetLanguage>>({{SheetLanguage::English, "en"}, {SheetLanguage::German, "de"}});
}

/// The word for a class of CityGML or a type of IFC.
struct ClassTerm {
    std::string_view name;     ///< of the class or type, without the prefix Ifc
    std::string_view english;  ///< empty: the words of the name itself
    std::string_view german;
};
/// All words that sheets have for classes and types.
[[nodiscard]] std::span<const ClassTerm> classTerms() noexcept;

/// A table on sheets of its own.
struct SheetTable {
    struct Column {
        std::string heading;
        bool isNumber = false;  ///< aligned to the right
    };
    std::string title;
    std::vector<Column> columns;
    std::vector<std::vector<std::string>> rows;  ///< one text per column
    std::size_t sums = 0;                        ///< number of total rows at the end
};

struct SheetContent {
    std::vector<drawing::BuildingLevel> levels;  ///< heights are stated above the ground floor
    std::vector<DrawnView> views;
    std::vector<SheetGroup> groups;
    std::vector<SheetTable> tables;                      ///< after the views; tables that fit share sheets
    Diagnostics findings{};                              ///< of the tables, see drawing::reportAreas()
    std::optional<drawing::FloorAreas> areas{};          ///< the source of the tables
    std::optional<drawing::OpeningSchedule> openings{};  ///< plans have its marks
    /// Plans have their lines of travel; without a value, they are found for each plan.
    std::optional<std::vector<drawing::StairFlight>> stairs{};
    /// Drawings of the old state by the planes of the views, without dimensions. Empty without an old state.
    std::vector<drawing::SectionDrawing> before{};
    std::vector<drawing::Revision> revisions{};  ///< of all views, see compare::markRevisions(); a list on each sheet
    bool hasGrids = false;  ///< plans have the names of the axes of grids outside of their dimensions
};

struct SheetOptions {
    double scale = 0;          ///< 100 draws 1 m as 10 mm; 0: 1:100, or the next standard scale at which all views fit
    std::string paper = "A3";  ///< A4 to A0, landscape
    SheetLanguage language = SheetLanguage::English;
    std::string title{};  ///< name of the building; empty: name of the model
    drawing::TitleBlock block{};
};

/// The tables of rooms, floor areas and components; without rooms, only the table of components.
/// \param labels  of the volume: rooms without a name are called a room there, not by their id; may be null
[[nodiscard]] std::vector<SheetTable> makeAreaTables(const drawing::FloorAreas& areas,
                                                     const std::vector<drawing::BuildingLevel>& levels,
                                                     SheetLanguage language,
                                                     const volume::LabelTable* labels = nullptr);

/// The tables of doors and of windows; none for a kind without openings.
[[nodiscard]] std::vector<SheetTable> makeOpeningTables(const drawing::OpeningSchedule& openings,
                                                        const std::vector<drawing::BuildingLevel>& levels,
                                                        SheetLanguage language);

/// The table of all revisions; without rows if there are none. Those without a number are on no view.
[[nodiscard]] SheetTable makeRevisionTable(const std::vector<drawing::Revision>& revisions, SheetLanguage language);

/// The sheets as SVG documents, in order. Each has stamps and marks, a title block after ISO 7200 and a legend. `volume` is the volume from which the drawings were made. Equal drawings give
/// equal bytes.
/// \return the documents, or BadArgument: an unknown paper, a scale outside of 1:0.01 to 1:10000000, or a view that is
///         larger than the paper (the message suggests a paper or scale that works)
[[nodiscard]] Result<std::vector<std::string>> makeSvgSheets(const SheetContent& content,
                                                             const volume::SemanticVolume& volume,
                                                             const SheetOptions& options = {});

/// The reason why PDFs have no layers (optional content) on this machine; empty: they have layers. Loads libqpdf on the
/// first call.
[[nodiscard]] const std::string& missingPdfLayers();

/// The sheets as one PDF, one page per sheet, with the layers of the SVG unless missingPdfLayers().
/// \return the file, or the errors of makeSvgSheets(), NoCairo or CannotWrite
[[nodiscard]] Result<PdfFile> makePdfSheets(const SheetContent& content, const volume::SemanticVolume& volume,
                                            const SheetOptions& options = {});

/// Sheets in two formats.
struct SheetFiles {
    std::vector<std::string> svg;  ///< one document per sheet
    PdfFile pdf;                   ///< without bytes unless it was requested
};

/// makeSvgSheets() and makePdfSheets() together, with the same bytes. Each sheet is painted once for both, so that the
/// places of its texts are found once. Sheets are painted side by side.
/// Memory: beside the files, up to eight painted sheets per thread.
/// \param hasPdf   whether to make the PDF
/// \param threads  0: all cores; the result does not depend on it
/// \return the files, or an error of makePdfSheets()
[[nodiscard]] Result<SheetFiles> makeSheetFiles(const SheetContent& content, const volume::SemanticVolume& volume,
                                                const SheetOptions& options, bool hasPdf, int threads = 0);

}  // namespace svt::writers

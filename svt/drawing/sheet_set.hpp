#pragma once
/// \file
/// A set of sheets: the drawings on each sheet, and their scale. Plain data that can be stored as JSON
/// (`*.sheets.json`, docs/formats/sheets.schema.json), so that the sheets of a model can be edited by hand and drawn
/// again.

#include <svt/core/option.hpp>
#include <svt/core/result.hpp>
#include <svt/drawing/sheet_views.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::drawing {

/// A view of a set: exactly one of plan, section and elevation is given.
struct SetView {
    std::string plan, section;  ///< planes, see parseSectionPlane()
    std::string elevation;      ///< one of compassNames(), see elevationPlane()
    std::string name;           ///< name of the storey of a plan, or letter of a section
    bool hidden = false;        ///< also draw hidden edges, dashed
    friend bool operator==(const SetView&, const SetView&) = default;
};

struct SetSheet {
    std::string title;  ///< empty: derived from its views
    double scale = 0;   ///< 50 draws 1 m as 20 mm; 0: scale of the set
    std::vector<SetView> views;
    friend bool operator==(const SetSheet&, const SetSheet&) = default;
};

/// Fields of the title block (ISO 7200); empty ones are not known.
struct TitleBlock {
    std::string number;  ///< identifies the drawings; each sheet adds its own number
    std::string creator, approver, owner;
    std::string date;  ///< of issue, in any notation
    std::string revision;
    std::string documentType;  ///< empty: by the views of a sheet
    friend bool operator==(const TitleBlock&, const TitleBlock&) = default;
};

struct SheetSet {
    std::string title;  ///< name of the building; empty: name of the model
    std::string paper;  ///< A4 to A0; empty: A3, or with a scale the smallest on which all views fit
    std::string language = "en";
    TitleBlock titleBlock{};
    double scale = 0;  ///< 0: selected so that all views fit
    bool dimensions = true, above = true, tables = true;
    DimensionUnit dimensionUnit = DimensionUnit::MetresCentimetres;
    std::vector<std::string> hide;  ///< queries
    std::vector<SetSheet> sheets;
    friend bool operator==(const SheetSet&, const SheetSet&) = default;
};

/// All members of the JSON representation, like sceneMembers() for scenes.
[[nodiscard]] std::span<const Option> sheetMembers() noexcept;

/// Reads the JSON representation.
/// \param name  name of the file, for messages
/// \return the set, or BadJson, or BadSheets with the member (as a JSON pointer), the found and the expected value
[[nodiscard]] Result<SheetSet> parseSheetSet(std::string_view json, const std::string& name = "sheets");
/// Writes the JSON representation. Equal sets give equal bytes; members with default values are omitted.
[[nodiscard]] std::string writeSheetSet(const SheetSet& set);

/// A set with the views of chooseSheetViews(): a sheet for plans, one for sections, one for elevations.
[[nodiscard]] SheetSet sheetSetOf(const SheetViews& views, const volume::SemanticVolume& volume);

/// The views of a set, in order of sheets.
/// \return the views, or BadSection or NothingSelected of a plane
[[nodiscard]] Result<SheetViews> viewsOfSet(const SheetSet& set, const volume::SemanticVolume& volume);

}  // namespace svt::drawing

#pragma once
/// \file
/// A set of sheets: which drawings stand on which sheets, at which scale. Plain data with a JSON form (`*.sheets.json`,
/// docs/formats/sheets.schema.json), so that the sheets of a model can be chosen by hand and drawn again.

#include <svt/core/option.hpp>
#include <svt/core/result.hpp>
#include <svt/drawing/sheet_views.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::drawing {

/// A view of a set: one of plan, section and elevation is given.
struct SetView {
    std::string plan, section;  ///< planes, see parseSectionPlane()
    std::string elevation;      ///< north, east, south or west
    std::string name;           ///< of a plan that of its storey; of a section its letter
    bool hidden = false;        ///< also hidden edges, dashed
    friend bool operator==(const SetView&, const SetView&) = default;
};

struct SetSheet {
    std::string title;  ///< empty: of its views
    double scale = 0;   ///< 50 draws 1 m as 20 mm; 0: that of the set
    std::vector<SetView> views;
    friend bool operator==(const SetSheet&, const SetSheet&) = default;
};

struct SheetSet {
    std::string title;  ///< of the building; empty: the name of the model
    std::string paper = "A3", language = "en";
    double scale = 0;  ///< 0: chosen, so that all views fit
    bool dimensions = true, above = true, tables = true;
    std::vector<std::string> hide;  ///< queries
    std::vector<SetSheet> sheets;
    friend bool operator==(const SheetSet&, const SheetSet&) = default;
};

/// All members of the JSON form, as sceneMembers() has those of scenes.
[[nodiscard]] std::span<const Option> sheetMembers() noexcept;

/// Reads the JSON form.
/// \param name  of the file, for messages
/// \return the set, or BadJson, or BadSheets; the latter names the member (as a JSON pointer), what was found and expected
[[nodiscard]] Result<SheetSet> parseSheetSet(std::string_view json, const std::string& name = "sheets");
/// Writes the JSON form. Equal sets give equal bytes; members with default values are left out.
[[nodiscard]] std::string writeSheetSet(const SheetSet& set);

/// The set of the views that chooseSheetViews() chose: a sheet for plans, one for sections, one for elevations.
[[nodiscard]] SheetSet sheetSetOf(const SheetViews& views, const volume::SemanticVolume& volume);

/// The views of a set, sheet after sheet.
/// \return the views, or BadSection or NothingSelected of a plane
[[nodiscard]] Result<SheetViews> viewsOfSet(const SheetSet& set, const volume::SemanticVolume& volume);

}  // namespace svt::drawing

#include <svt/writers/draw_sheets.hpp>

#include <svt/drawing/drawing_tables.hpp>
#include <svt/drawing/opening_schedule.hpp>

#include <algorithm>
#include <utility>

namespace svt::writers {
namespace {

// Fills in the sheets that the program chooses.
Result<drawing::SheetViews> chooseViews(drawing::SheetSet& set, const volume::SemanticVolume& volume,
                                        const drawing::DrawingTables& tables, int threads) {
    if (!set.sheets.empty()) return drawing::viewsOfSet(set, volume);
    SVT_TRY(chosen, drawing::chooseSheetViews(volume, threads, &tables));
    set.sheets = drawing::sheetSetOf(*chosen, volume).sheets;
    for (drawing::SheetView& view : chosen->views) view.beyond.above = view.beyond.above && set.above;
    return chosen;
}

// Plans end at the floor of the level below; parts on that floor itself are not drawn. The lowest level has no end.
double depthOfPlan(const drawing::SheetView& plan, const std::vector<drawing::BuildingLevel>& levels,
                   const volume::Grid& grid) {
    constexpr double kOnFloor = 0.05;  // metres
    const double cut = dot(plan.plane.point - grid.origin(), grid.axes()[2]);
    double below = -kInfinity;
    for (const drawing::BuildingLevel& level : levels)
        if (level.floor < plan.floor - kOnFloor) below = std::max(below, level.floor);
    return below == -kInfinity ? 0 : std::max(0.0, cut - below - kOnFloor);
}

}  // namespace

SheetOptions sheetOptionsOf(const drawing::SheetSet& set) {
    return {set.scale, set.paper.empty() ? SheetOptions().paper : set.paper,
            fromName<SheetLanguage>(set.language).value_or(SheetLanguage::English), set.title, set.titleBlock};
}

Result<SheetContent> drawSheets(drawing::SheetSet& set, const volume::SemanticVolume& volume, int threads,
                                std::vector<std::string>* nothing) {
    const drawing::DrawingTables tables(volume);
    SVT_TRY(chosen, chooseViews(set, volume, tables, threads));
    SheetContent content;
    content.levels = std::move(chosen->levels);
    std::vector<int> groups;  // by view
    for (const drawing::SetSheet& sheet : set.sheets) {
        groups.insert(groups.end(), sheet.views.size(), static_cast<int>(content.groups.size()));
        content.groups.push_back({sheet.title, sheet.scale});
    }
    for (drawing::SheetView& view : chosen->views) {
        if (view.kind == drawing::ViewKind::Plan) view.beyond.depth = depthOfPlan(view, content.levels, volume.grid);
        drawing::SectionOptions options;
        options.hide = set.hide;
        options.smallestArea = 1e-4;
        options.threads = threads;
        options.beyond = view.beyond;
        options.dimensions = view.kind != drawing::ViewKind::Elevation && set.dimensions;
        options.dimensionUnit = set.dimensionUnit;
        options.levels = &content.levels;
        options.tables = &tables;
        if (content.views.empty()) options.nothing = nothing;
        SVT_TRY(drawing, drawing::drawSection(volume, view.plane, options));
        drawing->dimensionUnit = set.dimensionUnit;
        content.views.push_back({std::move(view), std::move(*drawing), groups[content.views.size()]});
    }
    content.openings = drawing::scheduleOpenings(volume, content.levels);
    content.stairs = drawing::findStairFlights(volume);
    if (!set.tables) return content;
    SVT_TRY(areas, drawing::measureFloorAreas(volume, content.levels, threads, &tables));
    drawing::reportAreas(*areas, content.levels, volume, content.findings);
    const SheetLanguage language = sheetOptionsOf(set).language;
    content.tables = makeAreaTables(*areas, content.levels, language);
    for (SheetTable& table : makeOpeningTables(*content.openings, content.levels, language))
        content.tables.push_back(std::move(table));
    content.areas = std::move(*areas);
    return content;
}

}  // namespace svt::writers

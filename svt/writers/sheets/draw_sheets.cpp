#include <svt/writers/draw_sheets.hpp>

#include <svt/drawing/drawing_tables.hpp>
#include <svt/drawing/opening_schedule.hpp>
#include <svt/drawing/side_by_side.hpp>
#include <svt/writers/marks/plan_lines.hpp>

#include <algorithm>
#include <functional>
#include <optional>
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

using DrawnResult = std::optional<Result<drawing::SectionDrawing>>;

// Plans are drawn side by side. Sections and elevations show the whole model: they follow one by one, so that the memory
// of one of them is enough, and share the threads.
std::vector<DrawnResult> drawAll(const std::vector<drawing::SheetView>& views, int threads,
                                 const std::function<Result<drawing::SectionDrawing>(std::size_t, int)>& draw) {
    std::vector<DrawnResult> drawn(views.size());
    std::vector<std::size_t> plans;
    for (std::size_t n = 0; n < views.size(); ++n)
        if (views[n].kind == drawing::ViewKind::Plan) plans.push_back(n);
    drawing::drawSideBySide(plans.size(), threads,
                            [&](std::size_t p, int own) { drawn[plans[p]] = draw(plans[p], own); });
    for (std::size_t n = 0; n < views.size(); ++n)
        if (!drawn[n]) drawn[n] = draw(n, threads);
    return drawn;
}

// The views of another state: only lines, which are compared with those of the new one.
Result<std::vector<drawing::SectionDrawing>> drawBefore(const drawing::SheetSet& set, const SheetContent& content,
                                                        const volume::SemanticVolume& before, int threads) {
    const drawing::DrawingTables tables(before);
    std::vector<drawing::SheetView> views;
    for (const DrawnView& view : content.views) views.push_back(view.view);
    const auto draw = [&](std::size_t n, int ownThreads) -> Result<drawing::SectionDrawing> {
        std::vector<std::string> ignored;  // results of queries that only the new state has
        drawing::SectionOptions options;
        options.hide = set.hide;
        options.smallestArea = drawing::kSliverArea;
        options.threads = ownThreads;
        options.beyond = views[n].beyond;
        options.tables = &tables;
        options.doorSwings = false;
        options.nothing = &ignored;
        return drawing::drawSection(before, views[n].plane, options);
    };
    std::vector<drawing::SectionDrawing> drawings;
    for (DrawnResult& drawn : drawAll(views, threads, draw)) {
        SVT_TRY(drawing, std::move(*drawn));
        drawings.push_back(std::move(*drawing));
    }
    return drawings;
}

}  // namespace

SheetOptions sheetOptionsOf(const drawing::SheetSet& set) {
    return {set.scale, set.paper.empty() ? SheetOptions().paper : set.paper,
            fromName<SheetLanguage>(set.language).value_or(SheetLanguage::English), set.title, set.titleBlock};
}

Result<SheetContent> drawSheets(drawing::SheetSet& set, const volume::SemanticVolume& volume, int threads,
                                std::vector<std::string>* nothing, const volume::SemanticVolume* before) {
    const drawing::DrawingTables tables(volume);
    SVT_TRY(chosen, chooseViews(set, volume, tables, threads));
    SheetContent content;
    content.levels = std::move(chosen->levels);
    content.hasGrids = hasGrids(volume.labels);
    std::vector<int> groups;  // by view
    for (const drawing::SetSheet& sheet : set.sheets) {
        groups.insert(groups.end(), sheet.views.size(), static_cast<int>(content.groups.size()));
        content.groups.push_back({sheet.title, sheet.scale});
    }
    for (drawing::SheetView& view : chosen->views)
        if (view.kind == drawing::ViewKind::Plan) view.beyond.depth = depthOfPlan(view, content.levels, volume.grid);
    const auto draw = [&](std::size_t n, int ownThreads) -> Result<drawing::SectionDrawing> {
        const drawing::SheetView& view = chosen->views[n];
        drawing::SectionOptions options;
        options.hide = set.hide;
        options.smallestArea = drawing::kSliverArea;
        options.threads = ownThreads;
        options.beyond = view.beyond;
        options.dimensions = view.kind != drawing::ViewKind::Elevation && set.dimensions;
        options.dimensionUnit = set.dimensionUnit;
        options.levels = &content.levels;
        options.tables = &tables;
        if (n == 0) options.nothing = nothing;
        return drawing::drawSection(volume, view.plane, options);
    };
    std::vector<DrawnResult> drawings = drawAll(chosen->views, threads, draw);
    for (std::size_t n = 0; n < drawings.size(); ++n) {
        SVT_TRY(drawing, std::move(*drawings[n]));
        drawing->dimensionUnit = set.dimensionUnit;
        content.views.push_back({std::move(chosen->views[n]), std::move(*drawing), groups[n]});
    }
    if (before != nullptr) {
        SVT_TRY(drawn, drawBefore(set, content, *before, threads));
        content.before = std::move(*drawn);
    }
    content.openings = drawing::scheduleOpenings(volume, content.levels);
    content.stairs = drawing::findStairFlights(volume);
    if (!set.tables) return content;
    SVT_TRY(areas, drawing::measureFloorAreas(volume, content.levels, threads, &tables));
    drawing::reportAreas(*areas, content.levels, volume, content.findings);
    const SheetLanguage language = sheetOptionsOf(set).language;
    content.tables = makeAreaTables(*areas, content.levels, language, &volume.labels);
    for (SheetTable& table : makeOpeningTables(*content.openings, content.levels, language))
        content.tables.push_back(std::move(table));
    content.areas = std::move(*areas);
    return content;
}

}  // namespace svt::writers

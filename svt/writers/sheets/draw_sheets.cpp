#include <svt/writers/draw_sheets.hpp>

#include <svt/drawing/opening_schedule.hpp>
#include <svt/volume/brick_volume.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace svt::writers {
namespace {

// Fills in the sheets that the program chooses.
Result<drawing::SheetViews> chooseViews(drawing::SheetSet& set, const volume::SemanticVolume& volume, int threads) {
    if (!set.sheets.empty()) return drawing::viewsOfSet(set, volume);
    SVT_TRY(chosen, drawing::chooseSheetViews(volume, threads));
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
    SVT_TRY(chosen, chooseViews(set, volume, threads));
    SheetContent content;
    content.levels = std::move(chosen->levels);
    std::vector<int> groups;  // by view
    std::optional<volume::BrickVolume> bricks;
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
        if (content.views.empty()) options.nothing = nothing;
        SVT_TRY(drawing, bricks ? drawing::drawSection(volume, *bricks, view.plane, options)
                                : drawing::drawSection(volume, view.plane, options));
        drawing->dimensionUnit = set.dimensionUnit;
        // If one view needs bricks, the others do too. So they are made here and kept.
        if (!bricks && std::ranges::any_of(drawing->components, [](const auto& c) { return !c.isExact; })) {
            SVT_TRY(made,
                    volume::BrickVolume::fromColumns(volume.columns, {.planes = volume.planes, .threads = threads}));
            bricks = std::move(*made);
        }
        content.views.push_back({std::move(view), std::move(*drawing), groups[content.views.size()]});
    }
    content.openings = drawing::scheduleOpenings(volume, content.levels);
    if (!set.tables) return content;
    SVT_TRY(areas, drawing::measureFloorAreas(volume, content.levels, threads, bricks ? &*bricks : nullptr));
    drawing::reportAreas(*areas, content.levels, volume, content.findings);
    const SheetLanguage language = sheetOptionsOf(set).language;
    content.tables = makeAreaTables(*areas, content.levels, language);
    for (SheetTable& table : makeOpeningTables(*content.openings, content.levels, language))
        content.tables.push_back(std::move(table));
    content.areas = std::move(*areas);
    return content;
}

}  // namespace svt::writers

#include <svt/drawing/stair_flights.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/marks/ground_line.hpp>
#include <svt/writers/marks/opening_marks.hpp>
#include <svt/writers/marks/plan_lines.hpp>
#include <svt/writers/sheets/sheet_details.hpp>
#include <svt/writers/sheets/sheet_texts.hpp>
#include <svt/writers/sheets/stamp_texts.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::writers {
namespace {

using drawing::PlanePoint;
using drawing::ViewKind;

// The outer edges of a view on its sheet: drawing, dimensions, marks of sections and heights.
struct PaperBox {
    double left, top, right, bottom;
};
PaperBox outerOf(const PlacedView& placed) {
    constexpr double kBeside = 13, kAbove = 11, kBelow = 9;  // millimetres, within the margins of the layout
    const PaperPoint corner = placed.place.corner;
    const ViewMargins& margins = placed.margins;
    return {corner.x - margins.left - kBeside, corner.y - placed.height - margins.above - kAbove,
            corner.x + placed.width + margins.right + kBeside, corner.y + margins.below + kBelow};
}

// A rectangle on the sheet, in the millimetres of marks.
MarkBox marksBox(const PaperBox& box, const DrawingPlace& place) {
    const auto at = [&](double x, double y) {
        return PlanePoint{place.low.u * place.millimetres + x - place.corner.x,
                          place.low.v * place.millimetres + place.corner.y - y};
    };
    return {at(box.left, box.bottom), at(box.right, box.top)};
}

constexpr double kCaption = 12;  // millimetres below the outer edge: title and scale of a view

// The free room around a view: up to the frame, the title block and the other views with their titles.
MarkBox allowedAround(const ViewContext& context) {
    constexpr double kFromFrame = 3;
    const SheetPaper& paper = context.layout.paper;
    const PaperBox own = outerOf(context.placed);
    PaperBox free{paper.left + kFromFrame, paper.top + kFromFrame, paper.right - kFromFrame,
                  paper.bottom - SheetPaper::kTitleHeight - paper.legend - paper.revisions - kFromFrame};
    for (const PlacedView& placed : context.sheet.views) {
        if (placed.view == context.placed.view) continue;
        PaperBox other = outerOf(placed);
        other.bottom += kCaption;
        // The space between two views is divided.
        if (other.left >= own.right)
            free.right = std::min(free.right, 0.5 * (own.right + other.left));
        else if (other.right <= own.left)
            free.left = std::max(free.left, 0.5 * (own.left + other.right));
        else if (other.top >= own.bottom)
            free.bottom = std::min(free.bottom, std::max(own.bottom, other.top - kCaption));
        else
            free.top = std::max(free.top, std::min(own.top, other.bottom));
    }
    return marksBox(free, context.placed.place);
}

// The place of the title below a view.
void takeCaption(const ViewContext& context, FreeSpace& space) {
    constexpr double kWide = 130;
    const PaperBox own = outerOf(context.placed);
    space.take(marksBox({own.left, own.bottom, own.left + kWide, own.bottom + kCaption}, context.placed.place));
}

// The places of the marks of sections around a plan.
void takeSectionMarks(const ViewContext& context, const MarkBox& allowed, FreeSpace& space) {
    constexpr double kHalf = 6, kLong = 12;  // millimetres
    const drawing::PlaneAxes& axes = context.view.drawing.axes;
    const double mm = context.placed.place.millimetres;
    for (const DrawnView& view : context.content.views) {
        if (view.view.kind != ViewKind::Section) continue;
        const PlanePoint at = axes.planeFromWorld(view.view.plane.point);
        if (std::abs(dot(view.view.plane.normal, axes.u)) > 0.5) {
            space.take({{at.u * mm - kHalf, allowed.low.v - kLong}, {at.u * mm + kHalf, allowed.low.v + kLong}});
            space.take({{at.u * mm - kHalf, allowed.high.v - kLong}, {at.u * mm + kHalf, allowed.high.v + kLong}});
        } else {
            space.take({{allowed.low.u - kLong, at.v * mm - kHalf}, {allowed.low.u + kLong, at.v * mm + kHalf}});
            space.take({{allowed.high.u - kLong, at.v * mm - kHalf}, {allowed.high.u + kLong, at.v * mm + kHalf}});
        }
    }
}

PlanHeights heightsOf(const ViewContext& context) {
    const volume::Grid& grid = context.volume.grid;
    PlanHeights heights{context.view.view.floor, dot(context.view.view.plane.point - grid.origin(), grid.axes()[2]),
                        context.view.view.floor};
    for (const drawing::BuildingLevel& level : context.content.levels)
        if (level.floor > heights.cut) {
            heights.floorAbove = level.floor;
            break;
        }
    return heights;
}

// The lines of the stamps that are not whole on the plan, in their order.
std::vector<std::vector<std::string>> withoutStampOf(const std::vector<RoomStamp>& stamps, const PlacedStamps& placed) {
    std::vector<std::size_t> missing = placed.withoutPlace;
    missing.insert(missing.end(), placed.shortened.begin(), placed.shortened.end());
    std::sort(missing.begin(), missing.end());
    std::vector<std::vector<std::string>> lines;
    for (const std::size_t n : missing) lines.push_back(stamps[n].lines);
    return lines;
}

// The drawing of a plan with its dimensions, without the space for the names of axes.
MarkBox dimensionsBox(const PlacedView& placed) {
    const ViewMargins& margins = placed.margins;
    const PaperPoint corner = placed.place.corner;
    return marksBox({corner.x - margins.left + kGridMargin, corner.y - placed.height - margins.above + kGridMargin,
                     corner.x + placed.width + margins.right - kGridMargin, corner.y + margins.below - kGridMargin},
                    placed.place);
}

void addPlanMarks(const ViewContext& context, FreeSpace& space, ViewMarks& marks) {
    const drawing::SectionDrawing& drawing = context.view.drawing;
    const double mm = context.placed.place.millimetres;
    const auto add = [&](MarkShapes shapes) {
        const bool isEmpty = shapes.thin.empty() && shapes.texts.empty() && shapes.masks.empty();
        if (!isEmpty) marks.layers.push_back(std::move(shapes));
    };
    if (context.content.hasGrids) add(drawGrids(drawing, context.volume, mm, dimensionsBox(context.placed), space));
    if (context.content.openings) add(drawPanes(drawing, context.volume, *context.content.openings, mm));
    std::vector<drawing::StairFlight> own;
    if (!context.content.stairs) own = drawing::findStairFlights(context.volume);
    add(drawTravel(drawing, context.volume, context.content.stairs ? *context.content.stairs : own, heightsOf(context),
                   mm, sheetWord(SheetWord::Risers, context.options.language),
                   context.options.language == SheetLanguage::German, space));
    if (context.content.openings) add(placeOpeningMarks(drawing, *context.content.openings, mm, space));
}

}  // namespace

ViewMarks marksOf(const ViewContext& context) {
    ViewMarks marks;
    const drawing::SectionDrawing& drawing = context.view.drawing;
    const double mm = context.placed.place.millimetres;
    FreeSpace space = freeSpaceOf(drawing, context.volume, mm);
    const MarkBox allowed = allowedAround(context);
    takeCaption(context, space);
    if (context.view.view.kind == ViewKind::Plan) {
        const MarkBox own = marksBox(outerOf(context.placed), context.placed.place);
        takeSectionMarks(context, own, space);
        addPlanMarks(context, space, marks);
    }
    if (context.view.view.kind == ViewKind::Section)
        if (MarkShapes ground = drawGround(drawing, context.volume, mm); !ground.bold.empty())
            marks.layers.push_back(std::move(ground));
    if (context.view.view.kind == ViewKind::Elevation) {
        GroundBefore ground = drawGroundBefore(drawing, context.volume, context.content.levels, mm);
        if (!ground.shapes.bold.empty()) marks.layers.push_back(std::move(ground.shapes));
        if (ground.isAssumed) marks.below.emplace_back(sheetWord(SheetWord::GroundAssumed, context.options.language));
    }
    const std::vector<RoomStamp> stamps = roomStamps(context);
    PlacedStamps placed = placeStamps(drawing, stamps, mm, allowed, space);
    marks.layers.push_back(std::move(placed.shapes));
    marks.withoutStamp = withoutStampOf(stamps, placed);
    return marks;
}

StampList stampList(const ViewMarks& marks, double width, SheetLanguage language) {
    constexpr std::size_t kMostLines = 3;
    constexpr double kText = 1.8, kWide = 110;  // millimetres
    if (marks.withoutStamp.empty()) return {};
    const std::string heading(sheetWord(SheetWord::WithoutStamp, language));
    StampList list{{heading}, false};
    for (std::size_t n = 0; n < marks.withoutStamp.size() && !list.needsTable; ++n) {
        const bool isLast = n + 1 == marks.withoutStamp.size();
        const std::string entry = fmt::format("{}{}", fmt::join(marks.withoutStamp[n], ", "), isLast ? "" : "; ");
        const double most = std::min(width, kWide);
        if (n > 0 && widthOnPaper(list.lines.back() + entry, kText) > most) list.lines.emplace_back();
        list.lines.back() += entry;
        list.needsTable = list.lines.size() > kMostLines || widthOnPaper(list.lines.back(), kText) > most;
    }
    if (list.needsTable) list.lines = {heading + std::string(sheetWord(SheetWord::SeeTable, language))};
    return list;
}

SheetTable stampTable(const ViewMarks& marks, const std::string& caption, SheetLanguage language) {
    const auto word = [&](SheetWord w) { return std::string(sheetWord(w, language)); };
    SheetTable table{
        word(SheetWord::WithoutStamp) + caption, {{word(SheetWord::Room)}, {word(SheetWord::Stamp)}}, {}, 0};
    for (const std::vector<std::string>& lines : marks.withoutStamp)
        table.rows.push_back({lines.front(), fmt::format("{}", fmt::join(lines.begin() + 1, lines.end(), ", "))});
    return table;
}

LineWidths widthsOf(double scale) noexcept {
    if (scale <= 25) return {1.0, 0.5, 0.35, 0.25};
    if (scale <= 50) return {0.7, 0.35, 0.25, 0.18};
    if (scale <= 100) return {0.5, 0.25, 0.18, 0.13};
    if (scale <= 200) return {0.35, 0.18, 0.13, 0.13};
    return {0.25, 0.13, 0.13, 0.13};
}

}  // namespace svt::writers

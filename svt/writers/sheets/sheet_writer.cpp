#include <svt/writers/sheet_writer.hpp>

#include <svt/core/parallel.hpp>
#include <svt/core/rounding.hpp>
#include <svt/drawing/building_crop.hpp>
#include <svt/drawing/hull_top.hpp>
#include <svt/drawing/north.hpp>
#include <svt/drawing/storey_floors.hpp>
#include <svt/model/classes.hpp>
#include <svt/writers/canvas/svg_canvas.hpp>
#include <svt/writers/drawing/dimension_marks.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/marks/ground_line.hpp>
#include <svt/writers/marks/terrain_lines.hpp>
#include <svt/writers/sheets/sheet_details.hpp>
#include <svt/writers/sheets/sheet_layout.hpp>
#include <svt/writers/sheets/sheet_painter.hpp>
#include <svt/writers/sheets/sheet_texts.hpp>
#include <svt/writers/sheets/title_block.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace svt::writers {

// Facts of the volume that all sheets share.
struct VolumeFacts {
    std::vector<drawing::LabelExtent> extents;  // by label; empty without levels
    drawing::HullTop top;
    ModelFacts model;
};

// The marks of a view, found before its sheet is painted.
struct PreparedView {
    RoomNotes floors;
    ViewMarks marks;
    std::pair<double, double> freeBelow;  // left and right end of the place for its caption, millimetres
};

namespace {

using drawing::PlanePoint;
using drawing::ViewKind;

constexpr LineStyle kFrame{0.7}, kBox{0.35}, kFine{0.18};
constexpr double kCaptionText = 3.5, kBesideCaption = 6, kCaptionHeight = 20;  // millimetres

// Heights as architects write them: "+2.70", "±0.00".
std::string heightText(double height, SheetLanguage language, drawing::DimensionUnit unit) {
    const double rounded = std::round(height * 100) / 100;
    return (rounded > 0   ? "+"
            : rounded < 0 ? "\u2212"
                          : "\u00B1") +
           (unit == drawing::DimensionUnit::FeetInches ? dimensionText(std::abs(height), unit)
                                                       : numberText(std::abs(rounded), 2, language));
}

class SheetPainter {
public:
    SheetPainter(const SheetContent& content, const volume::SemanticVolume& volume, const SheetLayout& layout,
                 const SheetOptions& options, const VolumeFacts& facts, SheetCanvas& canvas)
        : content_(content), volume_(volume), layout_(layout), options_(options), facts_(facts), canvas_(canvas) {}

    // The marks of the views of a sheet, with lists of rooms without a stamp; lists that do not fit become tables.
    [[nodiscard]] std::vector<PreparedView> prepare(std::size_t n, std::vector<SheetTable>& tables) const {
        const Sheet& sheet = layout_.sheets[n];
        std::vector<PreparedView> views;
        for (const PlacedView& placed : sheet.views) {
            const DrawnView& view = content_.views[placed.view];
            PreparedView prepared;
            if (view.view.kind == ViewKind::Plan) prepared.floors = finishedFloors(view);
            prepared.marks = marksOf({content_, volume_, options_, view, placed, layout_, sheet, prepared.floors});
            const std::string caption = captionOf(view);
            prepared.freeBelow = std::pair(placed.place.corner.x - placed.margins.left, rightBelow(sheet, placed));
            const double left = prepared.freeBelow.first + widthOnPaper(caption, kCaptionText) + kBesideCaption;
            StampList list = stampList(prepared.marks, prepared.freeBelow.second - left, options_.language);
            if (list.needsTable) tables.push_back(stampTable(prepared.marks, caption, options_.language));
            for (std::string& text : list.lines) prepared.marks.below.push_back(std::move(text));
            views.push_back(std::move(prepared));
        }
        return views;
    }

    void paint(std::size_t n, const std::vector<PreparedView>& prepared) {
        const Sheet& sheet = layout_.sheets[n];
        canvas_.beginSheet(layout_.paper.width, layout_.paper.height,
                           fmt::format("{}: {}", modelName(), titleOf(sheet)));
        for (std::size_t v = 0; v < sheet.views.size(); ++v) {
            const PlacedView& placed = sheet.views[v];
            const DrawnView& view = content_.views[placed.view];
            const ViewMarks& marks = prepared[v].marks;
            PaintOptions paint{prepared[v].floors, nullptr, {}};
            paint.marks = &marks.layers;
            paint.widths = widthsOf(sheet.scale);
            if (options_.language == SheetLanguage::German) paint.openings = {"BRH", "STH"};
            paintDrawing(view.drawing, volume_, placed.place, canvas_, paint);
            canvas_.beginLayer("Marks");
            addCaption(placed, view, sheet.scale);
            addBelow(placed, captionOf(view), prepared[v]);
            if (view.view.kind == ViewKind::Plan)
                addSectionMarks(placed, view);
            else
                addHeights(placed, view);
            if (view.view.kind == ViewKind::Section) addLevelNames(placed, view);
            canvas_.endLayer();
        }
        if (!sheet.tables.empty()) {
            canvas_.beginLayer("Tables");
            for (const PlacedTable& placed : sheet.tables) addTable(placed);
            canvas_.endLayer();
        }
        canvas_.beginLayer("Frame");
        addFrame(sheet, n);
        canvas_.endLayer();
        canvas_.endSheet();
    }

private:
    [[nodiscard]] std::string_view word(SheetWord w) const noexcept { return sheetWord(w, options_.language); }
    [[nodiscard]] const std::string& modelName() const noexcept {
        return options_.title.empty() ? shownName(volume_) : options_.title;
    }
    [[nodiscard]] std::string heightMark(double height) const {
        return heightText(height, options_.language,
                          content_.views.empty() ? drawing::DimensionUnit::MetresCentimetres
                                                 : content_.views.front().drawing.dimensionUnit);
    }
    [[nodiscard]] double datum() const noexcept { return drawing::zeroLevel(content_.levels); }

    [[nodiscard]] std::string captionOf(const DrawnView& view) const {
        switch (view.view.kind) {
            case ViewKind::Section: return fmt::format("{0} {1}\u2013{1}", word(SheetWord::Section), view.view.name);
            case ViewKind::Elevation: return elevationText(view.view.name, options_.language);
            case ViewKind::Plan: break;
        }
        const std::string height = heightMark(view.view.floor - datum());
        if (content_.levels.empty()) return planeText(view.drawing, volume_);
        return fmt::format("{}{}{}, {} {}", word(SheetWord::Plan), view.view.name.empty() ? "" : " ", view.view.name,
                           word(SheetWord::Level), height);
    }
    [[nodiscard]] std::string titleOf(const Sheet& sheet) const {
        if (sheet.group >= 0 && !content_.groups[static_cast<std::size_t>(sheet.group)].title.empty())
            return content_.groups[static_cast<std::size_t>(sheet.group)].title;
        if (!sheet.tables.empty()) return tableTitle(sheet);
        const std::size_t count = sheet.views.size();
        if (count == 1) return captionOf(content_.views[sheet.views.front().view]);
        return std::string(word(sheet.kind == ViewKind::Plan      ? SheetWord::Plans
                                : sheet.kind == ViewKind::Section ? SheetWord::Sections
                                                                  : SheetWord::Elevations));
    }
    [[nodiscard]] std::string tableTitle(const Sheet& sheet) const {
        for (const PlacedTable& placed : sheet.tables)
            if (placed.table != sheet.tables.front().table) return std::string(word(SheetWord::Tables));
        return content_.tables[sheet.tables.front().table].title;
    }

    void line(PaperPoint a, PaperPoint b, LineStyle style) { canvas_.stroke({{a, b}}, style); }
    void box(double left, double top, double right, double bottom, LineStyle style) {
        canvas_.stroke({{{left, top}, {right, top}, {right, bottom}, {left, bottom}, {left, top}}}, style);
    }

    void addCaption(const PlacedView& placed, const DrawnView& view, double scale) {
        const double x = placed.place.corner.x - placed.margins.left, y = placed.place.corner.y + placed.margins.below;
        canvas_.text({{x, y + 14}, kCaptionText, captionOf(view)});
        canvas_.text({{x, y + 18.5}, 2.5, fmt::format("1:{}", shortNumber(scale, 2))});
    }

    // The right end of the free place below a view: the frame, or the view beside it.
    [[nodiscard]] double rightBelow(const Sheet& sheet, const PlacedView& placed) const {
        constexpr double kFromFrame = 3, kFromView = 4;  // millimetres
        double right = layout_.paper.right - kFromFrame;
        const double y = placed.place.corner.y + placed.margins.below;
        for (const PlacedView& other : sheet.views) {
            const double left = other.place.corner.x - other.margins.left;
            const bool isBeside = other.place.corner.y + other.margins.below + kCaptionHeight > y &&
                                  other.place.corner.y - other.height - other.margins.above < y + kCaptionHeight;
            if (isBeside && left > placed.place.corner.x) right = std::min(right, left - kFromView);
        }
        return right;
    }

    // Small lines beside the caption; beside the scale below it, where they would not fit.
    void addBelow(const PlacedView& placed, const std::string& caption, const PreparedView& prepared) {
        constexpr double kText = 1.8, kPitch = 2.6, kBesideScale = 16, kScaleLine = 18.5;
        const auto& [left, right] = prepared.freeBelow;
        double width = 0;
        for (const std::string& text : prepared.marks.below) width = std::max(width, widthOnPaper(text, kText));
        double x = left + widthOnPaper(caption, kCaptionText) + kBesideCaption;
        double y = placed.place.corner.y + placed.margins.below + 12.5;
        if (x + width > right) {
            x = std::max(left + kBesideScale, std::min(x, right - width));
            y = placed.place.corner.y + placed.margins.below + kScaleLine;
        }
        for (const std::string& text : prepared.marks.below) {
            canvas_.text({{x, y}, kText, text});
            y += kPitch;
        }
    }

    // A table with its headings; sums stand below a line.
    void addTable(const PlacedTable& placed) {
        const SheetTable& table = content_.tables[placed.table];
        constexpr double kText = PlacedTable::kText, kRow = PlacedTable::kRow;
        constexpr double kTitleBeyond = 5;  // millimetres, of the space between tables
        const double right = placed.left + placed.width();
        canvas_.text({{placed.left, placed.top + 4.5},
                      PlacedTable::kTitleText,
                      shortened(table.title, PlacedTable::kTitleText, placed.width() + kTitleBeyond)});
        double y = placed.top + PlacedTable::kTitle;
        const auto addRow = [&](const auto& textOf) {
            double x = placed.left;
            for (std::size_t c = 0; c < table.columns.size(); ++c) {
                const double width = placed.columns[c];
                const std::string text = shortened(textOf(c), kText, width - 2);
                const bool isNumber = table.columns[c].isNumber;
                canvas_.text({{isNumber ? x + width - 1 : x + 1, y + 3.5},
                              kText,
                              text,
                              isNumber ? TextAnchor::End : TextAnchor::Start});
                x += width;
            }
            y += kRow;
        };
        line({placed.left, y}, {right, y}, kBox);
        addRow([&](std::size_t c) { return table.columns[c].heading; });
        line({placed.left, y}, {right, y}, kBox);
        for (std::size_t row = placed.firstRow; row < placed.endRow; ++row) {
            if (row == table.rows.size() - table.sums && row != placed.firstRow)
                line({placed.left, y}, {right, y}, kBox);
            else if (row != placed.firstRow)
                line({placed.left, y}, {right, y}, {0.09});
            addRow([&](std::size_t c) { return table.rows[row][c]; });
        }
        line({placed.left, y}, {right, y}, kBox);
    }

    // The heights of finished floors in a plan: once, in the largest room, for the rooms that share a height, and in each
    // room with another height. Rooms that begin in a storey below, such as shafts, get no mark.
    [[nodiscard]] RoomNotes finishedFloors(const DrawnView& plan) const {
        constexpr double kStoreyBelow = 1.5, kHeight = 0.01;  // metres
        if (content_.levels.empty()) return {};
        struct Floor {
            double area = 0;
            std::vector<const drawing::SectionComponent*> rooms;
        };
        std::map<long, Floor> floors;  // by height in centimetres
        for (const drawing::SectionComponent& component : plan.drawing.components) {
            const drawing::LabelExtent& extent = facts_.extents[component.label];
            const std::string& name = volume_.labels.labels[component.label].className;
            if (!model::isSpace(name) || model::classRank(name) != model::ClassRank::Room) continue;
            if (extent.bound > 0 || extent.floor < plan.view.floor - kStoreyBelow) continue;
            Floor& floor = floors[std::lround((extent.floor - datum()) / kHeight)];
            floor.area += component.area;
            floor.rooms.push_back(&component);
        }
        const auto main = std::max_element(floors.begin(), floors.end(),
                                           [](const auto& a, const auto& b) { return a.second.area < b.second.area; });
        RoomNotes notes;
        for (auto at = floors.begin(); at != floors.end(); ++at) {
            auto& rooms = at->second.rooms;
            std::stable_sort(rooms.begin(), rooms.end(),
                             [](const auto* a, const auto* b) { return a->area > b->area; });
            if (at == main) rooms.resize(1);
            for (const auto* room : rooms)
                notes[room->label] = "\u25BD " + heightMark(static_cast<double>(at->first) * kHeight);
        }
        return notes;
    }

    // The names of storeys beside a section, at their floors.
    void addLevelNames(const PlacedView& placed, const DrawnView& section) {
        constexpr double kApart = 2.6;  // millimetres between names
        const Vec3d up = volume_.grid.axes()[2];
        const drawing::PlaneAxes& axes = section.drawing.axes;
        if (std::abs(dot(axes.v, up)) < 0.999) return;
        const double right = placed.place.corner.x - 1 - dimensionReach(section.drawing, drawing::DimensionSide::Left),
                     width = levelNameWidth(content_.levels), left = right - width;
        double last = kInfinity;  // y of the name below
        for (const drawing::BuildingLevel& level : content_.levels) {
            if (level.name.empty()) continue;
            const double v = axes.planeFromWorld(volume_.grid.origin() + up * level.floor).v;
            const double y = placed.place.onPaper({0, v}).y;
            if (y > placed.place.corner.y || y < placed.place.corner.y - placed.height) continue;
            line({left, y}, {right, y}, kFine);
            if (last - y < kApart) continue;
            canvas_.text({{left, y - 0.8}, LevelNames::kText, shortened(level.name, LevelNames::kText, width)});
            last = y;
        }
    }

    // Where the sections cut a plan: bold ends of a line, arrows to where one looks, and the letter.
    void addSectionMarks(const PlacedView& placed, const DrawnView& plan) {
        constexpr double kOff = 3, kLength = 6;
        const ViewMargins& margins = placed.margins;
        const PaperPoint corner = placed.place.corner, low{corner.x - margins.left, corner.y + margins.below},
                         high{corner.x + placed.width + margins.right, corner.y - placed.height - margins.above};
        for (const DrawnView& view : content_.views) {
            if (view.view.kind != ViewKind::Section) continue;
            const drawing::PlaneAxes& axes = plan.drawing.axes;
            const PaperPoint at = placed.place.onPaper(axes.planeFromWorld(view.view.plane.point));
            const double u = -dot(view.view.plane.normal, axes.u), v = dot(view.view.plane.normal, axes.v);  // on paper
            if (std::abs(u) < 0.999 && std::abs(v) < 0.999) continue;
            const bool isUpright = std::abs(u) > 0.5;
            for (const bool isFirst : {true, false}) {
                PaperPoint from = isUpright ? PaperPoint{at.x, isFirst ? low.y + kOff : high.y - kOff}
                                            : PaperPoint{isFirst ? low.x - kOff : high.x + kOff, at.y};
                const double out = isFirst == isUpright ? 1 : -1;
                const PaperPoint to =
                    isUpright ? PaperPoint{at.x, from.y + out * kLength} : PaperPoint{from.x + out * kLength, at.y};
                line(from, to, {0.7});
                const PaperPoint tip{to.x + 4 * u, to.y + 4 * v};
                line(to, tip, kFine);
                canvas_.fill({{tip,
                               {tip.x - 2 * u - 0.7 * v, tip.y - 2 * v + 0.7 * u},
                               {tip.x - 2 * u + 0.7 * v, tip.y - 2 * v - 0.7 * u},
                               tip}},
                             "#000000");
                canvas_.text({{to.x - 2.6 * u, to.y - 2.6 * v + 1.25}, 3.5, view.view.name, TextAnchor::Middle});
            }
        }
    }

    // Heights of the floors, and of the highest point, at the right. Floors below the drawing are left out.
    void addHeights(const PlacedView& placed, const DrawnView& view) {
        if (content_.levels.empty()) return;
        const Vec3d up = volume_.grid.axes()[2], origin = volume_.grid.origin();
        const double x = placed.place.corner.x + placed.width + placed.margins.right;
        const double perHeight = dot(view.drawing.axes.v, up);
        const std::optional<double> top = facts_.top.of(view.drawing);
        std::string lastText;
        double last = 1e9;            // y of the mark below
        constexpr double kApart = 4;  // millimetres
        const auto mark = [&](double height, double y) {
            if (last - y < kApart || y > placed.place.corner.y + kApart) return;
            last = y;
            line({x + 1, y}, {x + 13, y}, kFine);
            canvas_.stroke({{{x + 3, y}, {x + 2, y - 1.6}, {x + 4, y - 1.6}, {x + 3, y}}}, kFine);
            lastText = heightMark(height);
            canvas_.text({{x + 4.8, y - 0.8}, 2.2, lastText});
        };
        for (const drawing::BuildingLevel& level : content_.levels) {
            const PlanePoint p = view.drawing.axes.planeFromWorld(origin + up * level.floor);
            mark(level.floor - datum(), placed.place.onPaper({0, p.v}).y);
        }
        const double zero = view.drawing.axes.planeFromWorld(origin + up * datum()).v;
        if (!top) return;
        // Near the highest floor, the line bends to where its number has a place.
        const double topHeight = (*top - zero) / perHeight, y = placed.place.onPaper({0, *top}).y;
        const double free = std::min(y, last - kApart);
        if (y > last || heightMark(topHeight) == lastText) return;
        if (free < y) line({x - 1, y}, {x + 1, free}, kFine);
        mark(topHeight, free);
    }

    void addFrame(const Sheet& sheet, std::size_t number) {
        const SheetPaper& paper = layout_.paper;
        box(paper.left, paper.top, paper.right, paper.bottom, kFrame);
        const std::string title = titleOf(sheet), source = sourceText();
        const BlockContext block{content_, volume_, options_, layout_, sheet, number, title, source, facts_.model};
        paintTitleBlock(block, canvas_);
        paintLegend(block, canvas_);
        paintRevisionList(block, canvas_);
        if (sheet.views.empty()) return;
        addScaleBar(paper.left + 8, paper.bottom - 10, sheet.scale);
        if (!content_.levels.empty()) addDatum({paper.left + 8, paper.bottom - 22});
        if (content_.views[sheet.views.front().view].view.kind == ViewKind::Plan)
            addNorth(sheet, {paper.right - SheetPaper::kTitleWidth - 18, paper.bottom - 18});
    }

    [[nodiscard]] std::string sourceText() const {
        std::string text = volume_.source;
        if (const std::uint32_t epsg = epsgCodeOf(volume_.crsName); epsg != 0) text += fmt::format(", EPSG:{}", epsg);
        return text;
    }
    [[nodiscard]] std::string datumText() const {
        const auto ground = std::find_if(content_.levels.begin(), content_.levels.end(),
                                         [](const drawing::BuildingLevel& level) { return level.isGround; });
        const std::string& name = (ground == content_.levels.end() ? content_.levels.begin() : ground)->name;
        const double height = dot(volume_.grid.origin(), volume_.grid.axes()[2]) + datum();
        return fmt::format("{} {}: {} = {} m{}", word(SheetWord::HeightsAbove),
                           name.empty() ? word(SheetWord::GroundFloor) : std::string_view(name), heightMark(0),
                           numberText(height, 2, options_.language),
                           volume_.crsName.empty() ? std::string_view() : word(SheetWord::InModelHeights));
    }

    // Smaller, then shortened, where it would reach the legend.
    void addDatum(PaperPoint at) {
        constexpr double kWidest = 85, kLeast = 1.8, kMost = 2.2;  // millimetres
        const std::string text = datumText();
        const double size = std::clamp(kMost * kWidest / widthOnPaper(text, kMost), kLeast, kMost);
        canvas_.text({at, size, shortened(text, size, kWidest)});
    }

    // Four fields of a rounded length, 7 to 17 mm each.
    void addScaleBar(double x, double y, double scale) {
        const double field = roundDownTo125(17.5 * scale / 1000), size = field * 1000 / scale;
        for (int n = 0; n < 4; ++n) {
            const double from = x + n * size, to = from + size;
            if (n % 2 == 0) canvas_.fill({{{from, y}, {to, y}, {to, y + 1.4}, {from, y + 1.4}, {from, y}}}, "#000000");
            box(from, y, to, y + 1.4, {0.13});
        }
        for (const int n : {0, 1, 2, 4})
            canvas_.text({{x + n * size, y - 1},
                          2.2,
                          shortNumber(n * field, 3) + (n == 4 ? " m" : ""),
                          n == 0 ? TextAnchor::Start : TextAnchor::Middle});
    }

    // Direction of a horizontal vector in the plans of a sheet, on paper; nothing if the plans do not show it.
    [[nodiscard]] std::optional<PaperPoint> onPlans(const Sheet& sheet, Vec3d direction) const {
        const drawing::PlaneAxes& axes = content_.views[sheet.views.front().view].drawing.axes;
        const double u = dot(direction, axes.u), v = -dot(direction, axes.v), length = std::hypot(u, v);
        return length > 0.5 ? std::optional(PaperPoint{u / length, v / length}) : std::nullopt;
    }

    // An arrow to true north. Grid north, if the map has another one, is a thin line with its angle as text.
    void addNorth(const Sheet& sheet, PaperPoint at) {
        constexpr double kRadius = 7, kSameNorth = 0.05, kApart = 20;  // millimetres, degrees
        const drawing::North north = drawing::northOf(volume_);
        const auto along = onPlans(sheet, north.direction());
        if (!along) return;
        addArrow(at, *along, kRadius);
        const auto below = [&](const std::string& text) {
            canvas_.text({{at.x, at.y + kRadius + 4.5}, 1.8, text, TextAnchor::Middle});
        };
        if (north.source == drawing::NorthSource::Assumed) below(std::string(word(SheetWord::NorthAssumed)));
        if (north.source != drawing::NorthSource::Projection || std::abs(north.degrees) < kSameNorth) return;
        // The y axis lies west of true north if true north is clockwise from it.
        below(fmt::format("{} {}\u00B0 {}", word(SheetWord::GridNorth),
                          numberText(std::abs(north.degrees), std::abs(north.degrees) < 1 ? 2 : 1, options_.language),
                          word(north.degrees > 0 ? SheetWord::WestLetter : SheetWord::EastLetter)));
        const auto grid = onPlans(sheet, {0, 1, 0});
        if (!grid || std::abs(north.degrees) < kApart) return;
        line(at, {at.x + kRadius * grid->x, at.y + kRadius * grid->y}, kFine);
        canvas_.text({{at.x + (kRadius + 3) * grid->x, at.y + (kRadius + 3) * grid->y + 0.8},
                      2,
                      std::string(word(SheetWord::GridNorthLetters)),
                      TextAnchor::Middle});
    }

    void addArrow(PaperPoint at, PaperPoint along, double radius) {
        PaperPath circle;
        for (int n = 0; n <= 64; ++n) {
            const double angle = 2 * 3.14159265358979323846 * (n % 64) / 64;
            circle.push_back({at.x + radius * std::cos(angle), at.y + radius * std::sin(angle)});
        }
        canvas_.stroke({circle}, kFine);
        const PaperPoint tip{at.x + radius * along.x, at.y + radius * along.y};
        const auto foot = [&](double side) {
            return PaperPoint{at.x - 0.8 * radius * along.x - side * along.y,
                              at.y - 0.8 * radius * along.y + side * along.x};
        };
        canvas_.fill({{tip, foot(3), {at.x - 0.45 * radius * along.x, at.y - 0.45 * radius * along.y}, tip}},
                     "#000000");
        canvas_.stroke({{tip, foot(-3), {at.x - 0.45 * radius * along.x, at.y - 0.45 * radius * along.y}, tip}}, kFine);
        canvas_.text({{tip.x + 3 * along.x, tip.y + 3 * along.y + 1.1},
                      3,
                      std::string(word(SheetWord::NorthLetter)),
                      TextAnchor::Middle});
    }

    const SheetContent& content_;
    const volume::SemanticVolume& volume_;
    const SheetLayout& layout_;
    const SheetOptions& options_;
    const VolumeFacts& facts_;
    SheetCanvas& canvas_;
};

// Terrain and vegetation around a building do not decide the scale of its sheets.
SheetContent croppedContent(const SheetContent& content, const volume::SemanticVolume& volume) {
    SheetContent cropped = content;
    const std::vector<std::uint8_t> isAround = drawing::labelsAroundBuilding(volume);
    for (DrawnView& view : cropped.views) {
        view.drawing = drawing::croppedToBuilding(view.drawing, isAround);
        if (view.view.kind == ViewKind::Elevation) hideBelowGround(view.drawing, volume, cropped.levels, isAround);
        if (view.view.kind == ViewKind::Plan) removeTerrainJoints(view.drawing, volume, isAround);
    }
    return cropped;
}

}  // namespace

struct PreparedSheets::Parts {
    SheetContent content;
    const volume::SemanticVolume& volume;
    SheetOptions options;
    SheetLayout layout;
    VolumeFacts facts;
    std::vector<std::vector<PreparedView>> views;  // by sheet
};

PreparedSheets::PreparedSheets(std::unique_ptr<const Parts> parts) noexcept : parts_(std::move(parts)) {}
PreparedSheets::PreparedSheets(PreparedSheets&&) noexcept = default;
PreparedSheets::~PreparedSheets() = default;

Result<PreparedSheets> PreparedSheets::make(const SheetContent& content, const volume::SemanticVolume& volume,
                                            const SheetOptions& options, int threads) {
    SheetContent cropped = croppedContent(content, volume);
    SVT_TRY(layout, layOutSheets(cropped, options));
    VolumeFacts facts{{}, drawing::HullTop(volume.labels), modelFacts(volume)};
    if (!content.levels.empty()) facts.extents = drawing::labelExtents(volume);
    std::vector<std::vector<PreparedView>> views(layout->sheets.size());
    std::vector<std::vector<SheetTable>> tables(views.size());  // by sheet
    parallelFor(views.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        SvgCanvas unused;
        const SheetPainter painter(cropped, volume, *layout, options, facts, unused);
        for (std::size_t n = begin; n < end; ++n) views[n] = painter.prepare(n, tables[n]);
    });
    const std::size_t before = cropped.tables.size();
    for (std::vector<SheetTable>& own : tables)
        for (SheetTable& table : own) cropped.tables.push_back(std::move(table));
    if (cropped.tables.size() > before) {
        // Tables come after the views, whose places stay.
        layout = layOutSheets(cropped, options);
        SVT_DO(layout);
        views.resize(layout->sheets.size());
    }
    return PreparedSheets(std::make_unique<const Parts>(
        Parts{std::move(cropped), volume, options, std::move(*layout), std::move(facts), std::move(views)}));
}

std::size_t PreparedSheets::size() const noexcept { return parts_->layout.sheets.size(); }

void PreparedSheets::paint(std::size_t sheet, SheetCanvas& canvas) const {
    SheetPainter(parts_->content, parts_->volume, parts_->layout, parts_->options, parts_->facts, canvas)
        .paint(sheet, parts_->views[sheet]);
}

Result<std::vector<std::string>> makeSvgSheets(const SheetContent& content, const volume::SemanticVolume& volume,
                                               const SheetOptions& options) {
    SVT_TRY(sheets, PreparedSheets::make(content, volume, options));
    SvgCanvas canvas;
    for (std::size_t n = 0; n < sheets->size(); ++n) sheets->paint(n, canvas);
    return canvas.takeDocuments();
}

}  // namespace svt::writers

#include <svt/writers/sheets/sheet_layout.hpp>

#include <svt/core/text.hpp>
#include <svt/writers/drawing/dimension_marks.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/marks/ground_line.hpp>
#include <svt/writers/marks/plan_lines.hpp>
#include <svt/writers/revisions/revision_list.hpp>
#include <svt/writers/sheet_writer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

// Millimetres: room around a drawing for marks of sections and heights, and below it for its title.
constexpr double kBeside = 14, kAbove = 12, kBelow = 22;
constexpr double kScales[] = {100, 200, 500, 1000, 2000, 5000, 10000, 20000, 50000};  // ISO 5455

Result<SheetPaper> paperOf(const SheetOptions& options) {
    constexpr double kLegend = 14;
    const std::string& name = options.paper;
    constexpr std::array<std::pair<double, double>, 5> kSizes = {
        {{1189, 841}, {841, 594}, {594, 420}, {420, 297}, {297, 210}}};
    if (name.size() == 2 && lowerAscii(name[0]) == 'a' && name[1] >= '0' && name[1] <= '4') {
        const auto [width, height] = kSizes[static_cast<std::size_t>(name[1] - '0')];
        const double legend = name[1] == '4' ? kLegend : 0;
        return SheetPaper{"A" + name.substr(1), width, height, 20, 10, width - 10, height - 10, legend};
    }
    return Error(Code::BadArgument, fmt::format("paper '{}': expected A4, A3, A2, A1 or A0", name));
}

struct ViewSize {
    std::size_t view = 0;
    PlanePoint low;
    double width = 0, height = 0;  // metres
    ViewMargins margins;
};

ViewMargins marginsOf(const DrawnView& view, const SheetContent& content) {
    using drawing::DimensionSide;
    const drawing::SectionDrawing& drawing = view.drawing;
    ViewMargins margins{dimensionReach(drawing, DimensionSide::Left), dimensionReach(drawing, DimensionSide::Right),
                        dimensionReach(drawing, DimensionSide::Above), dimensionReach(drawing, DimensionSide::Below)};
    if (view.view.kind == drawing::ViewKind::Section)
        margins.left += levelNameWidth(content.levels) - LevelNames::kBeside;
    // Level marks stand beside the ground line.
    if (view.view.kind == drawing::ViewKind::Elevation) margins.right += kGroundOver;
    if (view.view.kind == drawing::ViewKind::Plan && content.hasGrids)
        for (double* margin : {&margins.left, &margins.right, &margins.above, &margins.below}) *margin += kGridMargin;
    return margins;
}

// A row of a sheet: the views [first, end), and its size with all margins.
struct SheetRow {
    std::size_t first = 0, end = 0;
    double width = 0, height = 0;
};

class LayoutMaker {
public:
    LayoutMaker(const SheetPaper& paper, std::vector<ViewSize> sizes, const SheetContent& content)
        : paper_(paper), sizes_(std::move(sizes)), content_(content) {}

    // The scale of a group whose views do not fit onto the paper; 0: all fit.
    [[nodiscard]] double tooLargeScale() const {
        for (const ViewSize& size : sizes_) {
            const double scale = scaleOf(size, 0);
            if (scale > 0 && (outerWidth(size, scale) > areaWidth() || outerHeight(size, scale) > areaHeight()))
                return scale;
        }
        return 0;
    }

    // Whether each view fits onto a sheet of its own.
    [[nodiscard]] bool fits(double common) const {
        return std::all_of(sizes_.begin(), sizes_.end(), [&](const ViewSize& size) {
            const double scale = scaleOf(size, common);
            return outerWidth(size, scale) <= areaWidth() && outerHeight(size, scale) <= areaHeight();
        });
    }

    [[nodiscard]] SheetLayout make(double common) const {
        SheetLayout layout{paper_, common, {}};
        std::size_t perRow = 0, endOfKind = 0;
        for (std::size_t first = 0; first < sizes_.size();) {
            const auto kind = keyOf(first);
            const double scale = scaleOf(sizes_[first], common);
            if (first >= endOfKind) perRow = evenRow(first, scale, endOfKind);
            std::vector<SheetRow> rows;
            double height = 0;
            std::size_t next = first;
            while (next < sizes_.size() && keyOf(next) == kind) {
                const SheetRow row = rowFrom(next, kind, scale, perRow);
                if (!rows.empty() && height + row.height > areaHeight()) break;
                rows.push_back(row);
                height += row.height;
                next = row.end;
            }
            layout.sheets.push_back(place(rows, height, scale));
            first = next;
        }
        return layout;
    }

private:
    // Views with one key share sheets: those of a group, or of a kind.
    [[nodiscard]] int keyOf(std::size_t n) const {
        const DrawnView& view = content_.views[sizes_[n].view];
        return view.group >= 0 ? view.group : -1 - static_cast<int>(view.view.kind);
    }
    [[nodiscard]] double scaleOf(const ViewSize& size, double common) const {
        const int group = content_.views[size.view].group;
        if (group < 0 || !(content_.groups[static_cast<std::size_t>(group)].scale > 0)) return common;
        return content_.groups[static_cast<std::size_t>(group)].scale;
    }
    [[nodiscard]] double areaWidth() const { return paper_.right - paper_.left; }
    [[nodiscard]] double areaHeight() const {
        return paper_.bottom - SheetPaper::kTitleHeight - paper_.legend - paper_.revisions - paper_.top;
    }
    static double outerWidth(const ViewSize& size, double scale) {
        return size.width * 1000 / scale + 2 * kBeside + size.margins.left + size.margins.right;
    }
    static double outerHeight(const ViewSize& size, double scale) {
        return size.height * 1000 / scale + kAbove + kBelow + size.margins.above + size.margins.below;
    }

    // How many views of a kind a row has at most, so that all rows have about as many: 2 and 2 rather than 3 and 1.
    std::size_t evenRow(std::size_t first, double scale, std::size_t& endOfKind) const {
        const auto kind = keyOf(first);
        std::size_t rows = 0;
        for (endOfKind = first; endOfKind < sizes_.size() && keyOf(endOfKind) == kind; ++rows)
            endOfKind = rowFrom(endOfKind, kind, scale, sizes_.size()).end;
        return (endOfKind - first + rows - 1) / rows;
    }

    [[nodiscard]] SheetRow rowFrom(std::size_t first, int kind, double scale, std::size_t most) const {
        SheetRow row{first, first, 0, 0};
        double above = 0, below = 0;  // a row stands on one line: the highest part above it, the lowest below
        for (; row.end < sizes_.size() && row.end < first + most && keyOf(row.end) == kind; ++row.end) {
            const double width = outerWidth(sizes_[row.end], scale);
            if (row.end > first && row.width + width > areaWidth()) break;
            row.width += width;
            above = std::max(above, outerHeight(sizes_[row.end], scale) - sizes_[row.end].margins.below);
            below = std::max(below, sizes_[row.end].margins.below);
            row.height = above + below;
        }
        return row;
    }

    // Rows and views with equal distances; the drawings of a row stand on one line.
    [[nodiscard]] Sheet place(const std::vector<SheetRow>& rows, double height, double scale) const {
        const DrawnView& view = content_.views[sizes_[rows.front().first].view];
        Sheet sheet{view.view.kind, view.group, scale, {}, {}};
        const double gap = (areaHeight() - height) / static_cast<double>(rows.size() + 1);
        double y = paper_.top + gap;
        for (const SheetRow& row : rows) {
            const double between = (areaWidth() - row.width) / static_cast<double>(row.end - row.first + 1);
            double x = paper_.left + between;
            double below = 0;
            for (std::size_t n = row.first; n < row.end; ++n) below = std::max(below, sizes_[n].margins.below);
            for (std::size_t n = row.first; n < row.end; ++n) {
                const ViewSize& size = sizes_[n];
                const double mm = 1000 / scale;
                sheet.views.push_back(
                    {size.view,
                     {{x + kBeside + size.margins.left, y + row.height - kBelow - below}, size.low, mm},
                     size.width * mm,
                     size.height * mm,
                     size.margins});
                x += outerWidth(size, scale) + between;
            }
            y += row.height + gap;
        }
        return sheet;
    }

    SheetPaper paper_;
    std::vector<ViewSize> sizes_;
    const SheetContent& content_;
};

// The paper with a strip for the revisions, if there are any.
Result<SheetPaper> paperFor(const SheetContent& content, const SheetOptions& options) {
    constexpr double kFromFrame = 8, kBelowList = 1;
    SVT_TRY(paper, paperOf(options));
    if (!kDrawsRevisions) return paper;
    const auto numbered = std::count_if(content.revisions.begin(), content.revisions.end(),
                                        [](const drawing::Revision& revision) { return revision.number != 0; });
    const RevisionListSize size =
        revisionListSize(std::size_t(numbered), paper->right - paper->left - 2 * kFromFrame, SheetPaper::kRevisionRows);
    if (size.rows > 0) paper->revisions = size.height + kBelowList;
    return paper;
}

// Whether the views need a smaller scale beside the list of revisions, or do not fit at theirs.
bool makesSmaller(const SheetPaper& paper, const std::vector<ViewSize>& sizes, const SheetContent& content,
                  double scale) {
    SheetPaper without = paper;
    without.revisions = 0;
    const LayoutMaker with(paper, sizes, content), alone(without, sizes, content);
    if (scale > 0) return !with.fits(scale) && alone.fits(scale);
    return std::any_of(std::begin(kScales), std::end(kScales),
                       [&](double s) { return !with.fits(s) && alone.fits(s); });
}

Result<SheetLayout> layOutViews(const SheetContent& content, const SheetOptions& options) {
    SVT_TRY(paper, paperFor(content, options));
    if (options.scale != 0 && !(options.scale >= 0.01 && options.scale <= 1e7))
        return Error(Code::BadArgument,
                     fmt::format("a scale of 1:{} is out of range; 1:0.01 to 1:10000000 are possible", options.scale));
    std::vector<ViewSize> sizes;
    for (std::size_t n = 0; n < content.views.size(); ++n) {
        const auto [low, high] = drawnBox(content.views[n].drawing);
        if (high.u > low.u || high.v > low.v)
            sizes.push_back({n, low, high.u - low.u, high.v - low.v, marginsOf(content.views[n], content)});
    }
    if (paper->revisions > 0 && makesSmaller(*paper, sizes, content, options.scale)) paper->revisions = 0;
    const LayoutMaker maker(*paper, sizes, content);
    if (const double scale = maker.tooLargeScale(); scale > 0)
        return Error(Code::BadArgument,
                     fmt::format("the views of a sheet do not fit onto {} at its scale of 1:{}; give "
                                 "a larger paper, or this sheet a smaller scale",
                                 paper->name, shortNumber(scale, 2)));
    if (options.scale == 0) {
        const auto* scale =
            std::find_if(std::begin(kScales), std::end(kScales), [&](double s) { return maker.fits(s); });
        if (scale != std::end(kScales)) return maker.make(*scale);
        return Error(Code::BadArgument, fmt::format("the views do not fit onto {} at 1:50000", paper->name));
    }
    if (maker.fits(options.scale)) return maker.make(options.scale);
    for (const char* name : {"A4", "A3", "A2", "A1", "A0"})
        if (SheetOptions other = options;
            other.paper = name, LayoutMaker(*paperFor(content, other), sizes, content).fits(options.scale))
            return Error(Code::BadArgument, fmt::format("the views do not fit onto {} at 1:{}; {} is large enough",
                                                        paper->name, shortNumber(options.scale, 2), name));
    const auto* scale = std::find_if(std::begin(kScales), std::end(kScales),
                                     [&](double s) { return s > options.scale && maker.fits(s); });
    return Error(Code::BadArgument, fmt::format("the views do not fit onto any paper at 1:{}; on {} 1:{} would do",
                                                shortNumber(options.scale, 2), paper->name,
                                                scale != std::end(kScales) ? *scale : kScales[8]));
}

constexpr double kBetweenTables = 10, kLeastColumn = 10, kWidestColumn = 70;  // millimetres

std::vector<double> columnsOf(const SheetTable& table) {
    std::vector<double> widths;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        double width = std::max(kLeastColumn, widthOnPaper(table.columns[c].heading, PlacedTable::kText) + 3);
        for (const auto& row : table.rows) width = std::max(width, widthOnPaper(row[c], PlacedTable::kText) + 3);
        widths.push_back(std::min(width, kWidestColumn));
    }
    double all = 0;
    for (const double width : widths) all += width;
    // The title stands above the columns.
    const double missing = widthOnPaper(table.title, PlacedTable::kTitleText) - all;
    if (missing > 0 && !widths.empty()) widths.back() += std::min(missing, kWidestColumn);
    return widths;
}

// From the upper left downwards, then to the right; a table begins where its title and three rows fit.
void layOutTables(const SheetContent& content, SheetLayout& layout) {
    const SheetPaper& paper = layout.paper;
    const double top = paper.top + 10, bottom = paper.bottom - SheetPaper::kTitleHeight - 6;
    double x = paper.left + 10, y = top, widest = 0;
    bool isOpen = false;  // the last sheet has tables
    const auto toNextColumn = [&](double width) {
        x += widest == 0 ? 0 : widest + kBetweenTables;
        if (isOpen && x + width > paper.right - 5) isOpen = false;
        if (!isOpen) x = paper.left + 10;
        y = top;
        widest = 0;
    };
    for (std::size_t t = 0; t < content.tables.size(); ++t) {
        const SheetTable& table = content.tables[t];
        std::vector<double> columns = columnsOf(table);
        for (std::size_t first = 0; first == 0 || first < table.rows.size();) {
            PlacedTable placed{t, first, first, x, y, columns};
            const double width = placed.width();
            const auto rowsFit = [&] {
                const double room = (bottom - y - PlacedTable::kTitle) / PlacedTable::kRow - 1;
                return room < 1 ? std::size_t{0} : static_cast<std::size_t>(room);
            };
            const std::size_t left = table.rows.size() - first;
            if (!isOpen || x + width > paper.right - 5 || rowsFit() < std::min<std::size_t>(3, left))
                toNextColumn(width);
            if (!isOpen) layout.sheets.push_back({drawing::ViewKind::Plan, -1, 0, {}, {}});
            isOpen = true;
            placed.left = x;
            placed.top = y;
            placed.endRow = first + std::min(left, std::max<std::size_t>(1, rowsFit()));
            first = placed.endRow;
            y += PlacedTable::kTitle + PlacedTable::kRow * static_cast<double>(placed.endRow - placed.firstRow + 1) +
                 kBetweenTables;
            widest = std::max(widest, width);
            layout.sheets.back().tables.push_back(std::move(placed));
            if (table.rows.empty()) break;
        }
    }
}

}  // namespace

double levelNameWidth(const std::vector<drawing::BuildingLevel>& levels) {
    double width = LevelNames::kBeside;
    for (const drawing::BuildingLevel& level : levels)
        width = std::max(width, widthOnPaper(level.name, LevelNames::kText) + 1);
    return std::min(width, LevelNames::kMost);
}

double PlacedTable::width() const noexcept {
    double width = 0;
    for (const double column : columns) width += column;
    return width;
}

Result<SheetLayout> layOutSheets(const SheetContent& content, const SheetOptions& options) {
    auto layout = layOutViews(content, options);
    if (layout) layOutTables(content, *layout);
    return layout;
}

}  // namespace svt::writers

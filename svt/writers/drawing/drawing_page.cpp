#include <svt/writers/drawing/drawing_page.hpp>

#include <svt/core/rounding.hpp>
#include <svt/writers/drawing/dimension_marks.hpp>
#include <svt/writers/drawing/drawing_style.hpp>
#include <svt/writers/revisions/revision_list.hpp>
#include <svt/writers/sheet_writer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace svt::writers {
namespace {

constexpr double kRevisionMargin = 14;  // millimetres around a drawing with revision clouds and their numbers

}  // namespace

Result<DrawingPage> makeDrawingPage(const drawing::SectionDrawing& drawing, double scale) {
    using drawing::DimensionSide;
    constexpr double kMinWidth = 90;
    if (!(scale >= 0.01 && scale <= 1e7))
        return Error(Code::BadArgument,
                     fmt::format("a scale of 1:{} is out of range; 1:0.01 to 1:10000000 are possible", scale));
    DrawingPage page;
    page.scale = scale;
    page.millimetres = 1000 / scale;
    std::tie(page.low, page.high) = drawnBox(drawing);
    const double drawnWidth = (page.high.u - page.low.u) * page.millimetres;
    const double left = dimensionReach(drawing, DimensionSide::Left),
                 right = dimensionReach(drawing, DimensionSide::Right);
    page.width = std::max(drawnWidth + left + right, kMinWidth) + 2 * DrawingPage::kMargin;
    page.left = 0.5 * (page.width - drawnWidth - left - right) + left;
    page.top = DrawingPage::kMargin + dimensionReach(drawing, DimensionSide::Above);
    page.height = page.top + (page.high.v - page.low.v) * page.millimetres +
                  dimensionReach(drawing, DimensionSide::Below) + DrawingPage::kMargin + DrawingPage::kTitleHeight;
    page.field = roundDownTo125(12.5 / page.millimetres);
    if (!hasRevisions(drawing)) return page;
    page.revisionsHeight =
        revisionListSize(drawing.revisions.size(), page.width - 2 * DrawingPage::kMargin, DrawingPage::kMostRevisions)
            .height;
    page.height += page.revisionsHeight + kRevisionMargin;
    page.top += kRevisionMargin;
    page.height += kRevisionMargin;
    page.left += kRevisionMargin;
    page.width += 2 * kRevisionMargin;
    return page;
}

std::vector<drawing::Revision> revisionsOf(const drawing::SectionDrawing& drawing) {
    std::vector<drawing::Revision> revisions;
    for (const drawing::RevisionLines& lines : drawing.revisions) revisions.push_back(lines.revision);
    return revisions;
}

void addField(const drawing::FieldDrawing& field, DrawingPage& page) {
    drawing::PlanePoint low = page.low, high = page.high;
    const auto add = [&](const std::vector<drawing::PlanePoint>& points) {
        for (const drawing::PlanePoint p : points) {
            low = {std::min(low.u, p.u), std::min(low.v, p.v)};
            high = {std::max(high.u, p.u), std::max(high.v, p.v)};
        }
    };
    for (const drawing::FieldBand& band : field.bands)
        for (const drawing::SectionPolygon& polygon : band.polygons) add(polygon.outer);
    for (const drawing::FieldIsoline& line : field.isolines) add(line.points);
    page.width += (high.u - low.u - (page.high.u - page.low.u)) * page.millimetres;
    page.height += (high.v - low.v - (page.high.v - page.low.v)) * page.millimetres + DrawingPage::kLegendHeight;
    page.low = low;
    page.high = high;
}

}  // namespace svt::writers

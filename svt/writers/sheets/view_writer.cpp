#include <svt/writers/canvas/drawing_painter.hpp>
#include <svt/writers/canvas/pdf_canvas.hpp>
#include <svt/writers/canvas/svg_canvas.hpp>
#include <svt/writers/drawing/drawing_page.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/field/field_marks.hpp>
#include <svt/writers/revisions/revision_list.hpp>
#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/view_drawing.hpp>

#include <fmt/format.h>

namespace svt::writers {
namespace {

void paintView(const drawing::LineView& view, const volume::SemanticVolume& volume, double width, SheetCanvas& canvas) {
    const double millimetres = width / view.width, height = view.height * millimetres;
    canvas.beginSheet(width, height, shownName(volume));
    paintDrawing(view.drawing, volume, {{0.5 * width, 0.5 * height}, {0, 0}, millimetres}, canvas);
    canvas.endSheet();
}

// Model, plane and scale, and the scale bar.
void addTitle(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume, const DrawingPage& page,
              SheetCanvas& canvas) {
    constexpr double left = DrawingPage::kMargin;
    const double top = page.titleTop(), y = top + 17, size = page.field * page.millimetres;
    canvas.stroke({{{left, top}, {page.width - left, top}}}, {0.13});
    canvas.text({{left, top + 6}, 3.5, shownName(volume)});
    canvas.text(
        {{left, top + 11}, 2.5, fmt::format("{}, 1:{}", planeText(drawing, volume), shortNumber(page.scale, 2))});
    for (int n = 0; n < 4; ++n) {
        const double from = left + n * size, to = from + size;
        const PaperPath box{{from, y}, {to, y}, {to, y + 1.2}, {from, y + 1.2}, {from, y}};
        if (n % 2 == 0) canvas.fill({box}, "#000000");
        canvas.stroke({box}, {0.13});
    }
    for (const int n : {0, 1, 2, 4})
        canvas.text({{left + n * size, y - 0.8},
                     1.8,
                     shortNumber(n * page.field, 3) + (n == 4 ? " m" : ""),
                     n == 0 ? TextAnchor::Start : TextAnchor::Middle});
}

void addLegend(const FieldLook& look, const DrawingPage& page, SheetCanvas& canvas) {
    constexpr double left = DrawingPage::kMargin;
    canvas.beginLayer("Legend");
    const FieldLegend legend = makeFieldLegend(look, left, page.legendTop(), page.width - 2 * left);
    for (const FieldLegend::Box& box : legend.boxes) {
        const double right = box.x + box.width, below = box.y + box.height;
        const PaperPath path{{box.x, box.y}, {right, box.y}, {right, below}, {box.x, below}, {box.x, box.y}};
        canvas.fill({path}, box.color);
        if (box.hasOutline) canvas.stroke({path}, {0.13});
    }
    for (const FieldLegend::Text& text : legend.texts)
        canvas.text({{text.x, text.y}, text.size, text.text, text.isCentred ? TextAnchor::Middle : TextAnchor::Start});
    canvas.endLayer();
}

void addRevisionList(const drawing::SectionDrawing& drawing, const DrawingPage& page, SheetCanvas& canvas) {
    constexpr double left = DrawingPage::kMargin;
    const std::vector<drawing::Revision> revisions = revisionsOf(drawing);
    const RevisionList list =
        makeRevisionList(revisions, left, page.revisionsTop(), page.width - 2 * left, DrawingPage::kMostRevisions);
    for (const RevisionList::Rule& rule : list.rules)
        canvas.stroke({{{rule.left, rule.y}, {rule.right, rule.y}}}, {0.18});
    for (const RevisionList::Text& text : list.texts)
        canvas.text(
            {{text.x, text.y}, RevisionList::kText, text.text, text.isEnd ? TextAnchor::End : TextAnchor::Start});
}

}  // namespace

Result<PdfFile> makeSectionPdf(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                               double scale, const FieldLook& look) {
    constexpr double kLongest = 5080;  // 14,400 points: ISO 32000-1, annex C
    SVT_TRY(page, makeDrawingPage(drawing, scale));
    if (look.isShown()) addField(*look.field, *page);
    if (page->width > kLongest || page->height > kLongest)
        return Error(Code::BadArgument,
                     fmt::format("at 1:{} the page has {:.1f} x {:.1f} m; PDF allows 5.08 m; give a smaller scale",
                                 shortNumber(scale, 2), page->width / 1000, page->height / 1000));
    SVT_TRY(canvas, makePdfCanvas(shownName(volume), &volume.labels));
    (*canvas)->beginSheet(page->width, page->height, planeText(drawing, volume));
    const double below = page->top + (page->high.v - page->low.v) * page->millimetres;
    PaintOptions options;
    options.field = look;
    paintDrawing(drawing, volume, {{page->left, below}, page->low, page->millimetres}, **canvas, options);
    if (look.isShown()) addLegend(look, *page, **canvas);
    if (hasRevisions(drawing)) {
        (*canvas)->beginLayer("Revision table");
        addRevisionList(drawing, *page, **canvas);
        (*canvas)->endLayer();
    }
    (*canvas)->beginLayer("Title");
    addTitle(drawing, volume, *page, **canvas);
    (*canvas)->endLayer();
    (*canvas)->endSheet();
    return (*canvas)->finish();
}

std::string makeViewSvg(const drawing::LineView& view, const volume::SemanticVolume& volume, double width) {
    SvgCanvas canvas;
    paintView(view, volume, width, canvas);
    return canvas.takeDocuments().front();
}

Result<PdfFile> makeViewPdf(const drawing::LineView& view, const volume::SemanticVolume& volume, double width) {
    SVT_TRY(canvas, makePdfCanvas(shownName(volume), &volume.labels));
    paintView(view, volume, width, **canvas);
    return (*canvas)->finish();
}

}  // namespace svt::writers

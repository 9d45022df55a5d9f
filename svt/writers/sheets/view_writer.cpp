#include <svt/writers/sheets/drawing_painter.hpp>
#include <svt/writers/sheets/pdf_canvas.hpp>
#include <svt/writers/sheets/svg_canvas.hpp>
#include <svt/writers/view_drawing.hpp>

namespace svt::writers {
namespace {

const std::string& titleOfView(const volume::SemanticVolume& volume) noexcept {
    return volume.modelName.empty() ? volume.source : volume.modelName;
}

void paintView(const illustrate::LineView& view, const volume::SemanticVolume& volume, double width,
               SheetCanvas& canvas) {
    const double millimetres = width / view.width, height = view.height * millimetres;
    canvas.beginSheet(width, height, titleOfView(volume));
    paintDrawing(view.drawing, volume, {{0.5 * width, 0.5 * height}, {0, 0}, millimetres}, canvas);
    canvas.endSheet();
}

}  // namespace

std::string makeViewSvg(const illustrate::LineView& view, const volume::SemanticVolume& volume, double width) {
    SvgCanvas canvas;
    paintView(view, volume, width, canvas);
    return canvas.takeDocuments().front();
}

Result<std::string> makeViewPdf(const illustrate::LineView& view, const volume::SemanticVolume& volume, double width) {
    auto canvas = makePdfCanvas(titleOfView(volume));
    if (!canvas) return canvas.error();
    paintView(view, volume, width, **canvas);
    return (*canvas)->finish();
}

}  // namespace svt::writers

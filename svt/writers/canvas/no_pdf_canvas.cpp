#include <svt/writers/canvas/pdf_canvas.hpp>
#include <svt/writers/sheet_writer.hpp>

namespace svt::writers {

Result<std::unique_ptr<PdfCanvas>> makePdfCanvas(const std::string& /*title*/, const volume::LabelTable* /*names*/) {
    return Error(Code::NoCairo, "this build writes no PDF; write the sheets as SVG");
}

const std::string& missingPdfLayers() {
    static const std::string text = "this build writes no PDF";
    return text;
}

}  // namespace svt::writers

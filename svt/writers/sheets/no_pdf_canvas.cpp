#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/sheets/pdf_canvas.hpp>

namespace svt::writers {

Result<std::unique_ptr<PdfCanvas>> makePdfCanvas(const std::string& /*title*/) {
    return Error(Code::NoCairo, "this build writes no PDF; write the sheets as SVG");
}

const std::string& missingPdfLayers() {
    static const std::string text = "this build writes no PDF";
    return text;
}

}  // namespace svt::writers

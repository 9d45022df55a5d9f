#include <apps/cli/output/pdf_notes.hpp>

#include <apps/cli/output/messages.hpp>

#include <svt/writers/sheet_writer.hpp>

#include <fmt/format.h>

namespace svt::cli {

void notePdf(const writers::PdfFile& pdf) {
    if (!writers::missingPdfLayers().empty()) note(writers::missingPdfLayers());
    if (!pdf.missingLetters.empty())
        note(
            fmt::format("no font on this machine has the letters '{}'; the PDF has boxes in their place. Install a "
                        "font that has them (Debian: fonts-noto-cjk for Chinese, Japanese and Korean, "
                        "fonts-noto-core for other scripts), or write SVG where the command can",
                        pdf.missingLetters));
    if (pdf.hasUnorderedText)
        note(
            "the PDF has Arabic or Hebrew text from left to right, without joined letters, because the FriBidi library "
            "is missing; install it (Debian: libfribidi0), or write SVG where the command can");
}

}  // namespace svt::cli

#include <svt/core/parallel.hpp>
#include <svt/writers/canvas/pdf_canvas.hpp>
#include <svt/writers/canvas/recorded_sheet.hpp>
#include <svt/writers/canvas/svg_canvas.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/sheets/sheet_painter.hpp>

#include <algorithm>
#include <utility>

namespace svt::writers {

Result<SheetFiles> makeSheetFiles(const SheetContent& content, const volume::SemanticVolume& volume,
                                  const SheetOptions& options, bool hasPdf, int threads) {
    constexpr std::size_t kPerThread = 4;  // sheets that are painted at a time
    SVT_TRY(sheets, PreparedSheets::make(content, volume, options, threads));
    std::unique_ptr<PdfCanvas> pdf;
    if (hasPdf) {
        SVT_TRY(canvas, makePdfCanvas(shownName(volume), &volume.labels));
        pdf = std::move(*canvas);
    }
    SheetFiles files;
    files.svg.resize(sheets->size());
    const auto batch = kPerThread * static_cast<std::size_t>(threads > 0 ? threads : hardwareThreads());
    std::vector<RecordedSheet> painted;  // of the batch before
    const auto drawPdf = [&] {
        if (pdf)
            for (const RecordedSheet& sheet : painted) sheet.drawOn(*pdf);
    };
    for (std::size_t first = 0; first < sheets->size(); first += batch) {
        std::vector<RecordedSheet> next(std::min(batch, sheets->size() - first));
        // One thread adds the batch before to the PDF, in order, while the others paint.
        parallelFor(next.size() + 1, 1, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t task = begin; task < end; ++task) {
                if (task == 0) {
                    drawPdf();
                    continue;
                }
                sheets->paint(first + task - 1, next[task - 1]);
                SvgCanvas svg;
                next[task - 1].drawOn(svg);
                files.svg[first + task - 1] = std::move(svg.takeDocuments().front());
            }
        });
        painted = std::move(next);
    }
    drawPdf();
    if (pdf) {
        SVT_TRY(file, pdf->finish());
        files.pdf = std::move(*file);
    }
    return files;
}

Result<PdfFile> makePdfSheets(const SheetContent& content, const volume::SemanticVolume& volume,
                              const SheetOptions& options) {
    SVT_TRY(sheets, PreparedSheets::make(content, volume, options));
    SVT_TRY(canvas, makePdfCanvas(shownName(volume), &volume.labels));
    for (std::size_t n = 0; n < sheets->size(); ++n) sheets->paint(n, **canvas);
    return (*canvas)->finish();
}

}  // namespace svt::writers

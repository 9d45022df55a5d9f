#include <svt/writers/drawing_formats.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/writers/geojson_drawing.hpp>
#include <svt/writers/section_table.hpp>
#include <svt/writers/svg_drawing.hpp>
#include <svt/writers/view_drawing.hpp>

#include <fmt/format.h>

namespace svt::writers {

Result<std::string> makeDrawing(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                std::string_view format, const DrawingOptions& options) {
    if (format == "svg") return makeSvg(drawing, volume, {options.scale, options.field});
    if (format == "dxf") {
        DxfOptions dxf = options.dxf;
        dxf.field = options.field;
        return makeDxf(drawing, volume, dxf);
    }
    if (format == "geojson") return makeGeojson(drawing, volume, options.field);
    if (format == "csv") return makeSectionCsv(drawing, volume);
    if (format == "json") return makeSectionJson(drawing, volume);
    return Error(Code::BadArgument,
                 fmt::format("there is no drawing as '{}'; possible are svg, dxf, geojson, csv, json", format));
}

Result<std::uint64_t> writeDrawing(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                   const std::filesystem::path& path, const DrawingOptions& options) {
    const std::string ending = lowerAscii(path.extension().string());
    if (ending == ".pdf") {
        SVT_TRY(pdf, makeSectionPdf(drawing, volume, options.scale, options.field));
        return writeFileAtomically(path, pdf->bytes);
    }
    SVT_TRY(text, makeDrawing(drawing, volume, ending.substr(ending.empty() ? 0 : 1), options));
    return writeFileAtomically(path, *text);
}

}  // namespace svt::writers

// Section drawings: polygons as arrays, and the drawing as text in the formats of the command.
#include "arrays.hpp"
#include "bindings.hpp"
#include "long_call.hpp"
#include "volume_object.hpp"

#include <svt/core/file.hpp>
#include <svt/drawing/hatches.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/writers/drawing_formats.hpp>
#include <svt/writers/section_table.hpp>
#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/view_drawing.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace svt::python {
namespace {

using drawing::PlanePoint;
using drawing::SectionComponent;

struct SectionObject {
    SharedVolume volume;
    drawing::SectionDrawing drawing;
    Diagnostics findings;

    [[nodiscard]] const SectionComponent& component(std::size_t c) const {
        if (c >= drawing.components.size()) throw py::index_error("no component " + std::to_string(c));
        return drawing.components[c];
    }
};
using SharedSection = std::shared_ptr<SectionObject>;

SharedSection drawSection(const SharedVolume& volume, const std::string& plane, const std::vector<std::string>& show,
                          const std::vector<std::string>& hide, bool spaces, double smallestArea, double tolerance,
                          bool useMeshes, const py::object& report) {
    auto section = std::make_shared<SectionObject>();
    section->volume = volume;
    section->drawing = longCall(report, [&](const Progress*) -> Result<drawing::SectionDrawing> {
        const auto& v = volume->volume();
        SVT_TRY(cut, plane.empty() ? drawing::defaultSectionPlane(v) : drawing::parseSectionPlane(plane, v));
        std::vector<std::string> nothing;
        drawing::SectionOptions options{.show = show,
                                        .hide = hide,
                                        .spaces = spaces,
                                        .smallestArea = smallestArea,
                                        .tolerance = tolerance,
                                        .beyond = {},
                                        .useMeshes = useMeshes,
                                        .nothing = &nothing};
        auto drawing = drawing::drawSection(v, *cut, options);
        if (drawing) drawing::reportSection(*drawing, v, section->findings);
        return drawing;
    });
    return section;
}

static_assert(sizeof(PlanePoint) == 2 * sizeof(double));

py::array_t<double> ringOf(const std::vector<PlanePoint>& ring, const py::object& owner) {
    return viewOf<double>({py::ssize_t(ring.size()), 2}, reinterpret_cast<const double*>(ring.data()), owner);
}

/// [(area, outer, [hole, ...]), ...]; rings are views of the drawing.
py::list polygonsOf(const py::object& self, std::size_t c) {
    py::list polygons;
    for (const drawing::SectionPolygon& polygon : self.cast<SharedSection>()->component(c).polygons) {
        py::list holes;
        for (const drawing::Ring& hole : polygon.holes) holes.append(ringOf(hole, self));
        polygons.append(py::make_tuple(polygon.area, ringOf(polygon.outer, self), holes));
    }
    return polygons;
}

py::list linesOf(const py::object& self) {
    py::list lines;
    for (const drawing::SectionLine& line : self.cast<SharedSection>()->drawing.lines)
        lines.append(py::make_tuple(line.label, ringOf(line.points, self)));
    return lines;
}

/// The areas as `svt section --json` prints them, with the hatches of the cut components.
std::string jsonOf(const SectionObject& section) {
    const volume::SemanticVolume& volume = section.volume->volume();
    std::vector<std::uint32_t> cut;
    for (const SectionComponent& component : section.drawing.components)
        if (!component.polygons.empty()) cut.push_back(component.label);
    return writers::makeSectionJson(section.drawing, volume,
                                    drawing::hatchUses(drawing::chooseHatches(volume.labels), cut));
}

/// The drawing in a format, also written atomically to `path` unless it is None. Bytes, because DXF has a code page.
py::bytes writeAs(const SectionObject& section, const std::string& format, double scale,
                  const std::optional<std::filesystem::path>& path) {
    const std::string text = longCall(py::none(), [&](const Progress*) -> Result<std::string> {
        auto made = format == "json" ? Result<std::string>(jsonOf(section))
                                     : writers::makeDrawing(section.drawing, section.volume->volume(), format, {scale});
        if (made && path) SVT_DO(writeFileAtomically(*path, *made));
        return made;
    });
    return py::bytes(text);
}

/// The drawing as a PDF, as writeAs(): (bytes, letters that it cannot show, whether Arabic or Hebrew text is unordered, why
/// it has no layers).
py::tuple pdfOf(const SectionObject& section, double scale, const std::optional<std::filesystem::path>& path) {
    const writers::PdfFile pdf = longCall(py::none(), [&](const Progress*) -> Result<writers::PdfFile> {
        SVT_TRY(made, writers::makeSectionPdf(section.drawing, section.volume->volume(), scale));
        if (path) SVT_DO(writeFileAtomically(*path, made->bytes));
        return std::move(*made);
    });
    return py::make_tuple(py::bytes(pdf.bytes), pdf.missingLetters, pdf.hasUnorderedText, writers::missingPdfLayers());
}

}  // namespace

void bindSections(py::module_& module) {
    py::class_<SectionObject, SharedSection>(module, "Section")
        .def_property_readonly("area", [](const SectionObject& s) { return s.drawing.area; })
        .def_property_readonly("is_exact", [](const SectionObject& s) { return s.drawing.isFromMeshes; })
        .def_property_readonly("findings", [](const SectionObject& s) { return toPython(s.findings); })
        .def_property_readonly("axes",
                               [](const SectionObject& s) {
                                   const auto& axes = s.drawing.axes;
                                   return py::make_tuple(toPython(axes.origin), toPython(axes.u), toPython(axes.v),
                                                         toPython(axes.normal));
                               })
        .def_property_readonly("component_count", [](const SectionObject& s) { return s.drawing.components.size(); })
        .def("component",
             [](const SectionObject& s, std::size_t c) {
                 const SectionComponent& component = s.component(c);
                 return py::make_tuple(component.label, component.area, component.areaBound, component.isExact,
                                       component.lineLength);
             })
        .def("polygons", &polygonsOf)
        .def("lines", &linesOf)
        .def("write", &writeAs, py::arg("format"), py::arg("scale"), py::arg("path"))
        .def("pdf", &pdfOf, py::arg("scale"), py::arg("path"));
    module.def("section", &drawSection, py::arg("volume"), py::arg("plane"), py::arg("show"), py::arg("hide"),
               py::arg("spaces"), py::arg("min_area"), py::arg("tolerance"), py::arg("use_meshes"),
               py::arg("progress"));
}

}  // namespace svt::python

// Draws what a plane cuts of a volume, as SVG at 1:50, and prints the areas.
#include <svt/drawing/section_drawing.hpp>
#include <svt/drawing/section_plane.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/writers/drawing_formats.hpp>

#include <cstdio>

namespace {

int fail(const svt::Error& error) {
    std::fprintf(stderr, "%s\n", error.toString().c_str());
    return 1;
}

int usage(const char* line) {
    std::fprintf(stderr, "usage: %s\n", line);
    return 2;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return usage("draw_section house.svt z=1.2 plan.svg");
    const auto volume = svt::volume::readSvt(argv[1]);
    if (!volume) return fail(volume.error());
    const auto plane = svt::drawing::parseSectionPlane(argv[2], *volume);
    if (!plane) return fail(plane.error());
    const auto drawing = svt::drawing::drawSection(*volume, *plane);
    if (!drawing) return fail(drawing.error());
    const auto written = svt::writers::writeDrawing(*drawing, *volume, argv[3], {.scale = 50});
    if (!written) return fail(written.error());
    for (const auto& total : drawing->classes)
        std::printf("%-30s %4zu %10.3f m2\n", total.className.c_str(), total.components, total.area);
}

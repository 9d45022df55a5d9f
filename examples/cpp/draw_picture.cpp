// Draws a volume cut open, as PNG.
#include <svt/illustrate/scene.hpp>
#include <svt/illustrate/scene_painter.hpp>
#include <svt/image/png.hpp>
#include <svt/volume/svt_file.hpp>

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
    if (argc != 3) return usage("draw_picture house.svt house.png");
    const auto volume = svt::volume::readSvt(argv[1]);
    if (!volume) return fail(volume.error());
    svt::illustrate::Scene scene;
    scene.width = 960;
    scene.height = 540;
    scene.look = svt::illustrate::Look::Paper;
    scene.passes[0].hide = {"class=BuildingRoom"};
    scene.passes[0].cut = "y<4";  // metres from the lower corner
    svt::render::CastOptions options;
    options.isAdaptive = true;  // more rays only where pixels differ
    const auto painting = svt::illustrate::ScenePainter(*volume).paint(scene, options);
    if (!painting) return fail(painting.error());
    const auto written = svt::image::writePng(argv[2], painting->frame.color);
    if (!written) return fail(written.error());
}

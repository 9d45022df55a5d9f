// Builds the volume of a model, writes it, and lists what a query selects.
#include <svt/analyze/selection.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/volume/svt_file.hpp>

#include <cstdio>
#include <filesystem>
#include <span>

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
    if (argc != 4) return usage("build_and_query house.gml house.svt 'class=BuildingRoom and volume>20'");
    const std::filesystem::path model = argv[1];
    svt::pipeline::BuildOptions options;
    options.spacing = svt::Vec3d{0.1, 0.1, 0.1};  // metres
    const auto built = svt::pipeline::buildVolume(std::span(&model, 1), options);
    if (!built) return fail(built.error());
    if (const auto written = svt::volume::writeSvt(built->volume, argv[2]); !written) return fail(written.error());

    const auto& labels = built->volume.labels;
    const auto selected = svt::analyze::selectLabels(labels, argv[3]);
    if (!selected) return fail(selected.error());
    for (const std::uint32_t l : *selected)
        std::printf("%-30s %10.3f m3\n", labels.labels[l].id.c_str(), labels.labels[l].volume);
}

#include <apps/cli/options/load_volume.hpp>

#include <apps/cli/output/messages.hpp>

#include <svt/volume/svt_file.hpp>
#include <svt/volume_readers/read_label_volume.hpp>

#include <span>

namespace svt::cli {

Result<volume::SemanticVolume> loadVolume(const std::filesystem::path& input, const pipeline::BuildOptions& build,
                                          const Progress* progress, Diagnostics& diagnostics,
                                          const volume::Grid* grid) {
    if (volume::isSvtFile(input)) return volume::readSvt(input);
    if (volume_readers::looksLikeLabelVolume(input))
        return volume_readers::readLabelVolume(input, {{}, 0, progress, &diagnostics});
    pipeline::BuildOptions options = build;
    options.progress = progress;
    if (grid != nullptr) options.grid = *grid;
    SVT_TRY(output, pipeline::buildVolume(std::span(&input, 1), options, &diagnostics));
    if (const auto& choice = output->report.spacing; choice && choice->spacing != pipeline::SpacingChoice::kUsual)
        note("spacing: " + choice->reason);
    return std::move(output->volume);
}

Result<volume::SemanticVolume> loadVolume(const std::filesystem::path& input, const pipeline::BuildOptions& build,
                                          const Progress* progress, bool isVerbose, const volume::Grid* grid) {
    Diagnostics diagnostics;
    auto volume = loadVolume(input, build, progress, diagnostics, grid);
    printDiagnostics(diagnostics, isVerbose);
    return volume;
}

}  // namespace svt::cli

#include <apps/cli/options/load_volume.hpp>

#include <apps/cli/output/messages.hpp>

#include <svt/readers/parcels.hpp>
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

Result<volume::SemanticVolume> loadParcels(const std::filesystem::path& input, const pipeline::BuildOptions& build,
                                           const Progress* progress, const volume::SemanticVolume& volume,
                                           std::span<const double> heights) {
    if (!readers::looksLikeParcels(input)) {
        if (!heights.empty())
            return Error(Code::BadArgument,
                         "--parcel-heights is for parcels that are polygons (.geojson, .gpkg, .shp)");
        pipeline::BuildOptions withMeshes = build;
        withMeshes.vectors.meshes = true;
        return loadVolume(input, withMeshes, progress, false, &volume.grid);
    }
    readers::ParcelOptions options;
    options.crsName = volume.crsName;
    if (heights.empty()) {
        // Beyond the grid on both sides.
        Box3d box;
        const Vec3i n = volume.grid.dimension();
        for (int corner = 0; corner < 8; ++corner)
            box.add(volume.grid.worldFromIndex(
                {corner & 1 ? double(n.x) : -1.0, corner & 2 ? double(n.y) : -1.0, corner & 4 ? double(n.z) : -1.0}));
        options.low = box.min.z - 1;
        options.high = box.max.z + 1;
    } else {
        options.low = heights[0];
        options.high = heights[1];
        if (!(options.low < options.high))
            return Error(Code::BadArgument, "--parcel-heights: the first height must be below the second");
    }
    Diagnostics diagnostics;
    auto model = readers::readParcels(input, options, &diagnostics);
    if (!model) return model.error();
    pipeline::BuildOptions onGrid = build;
    onGrid.progress = progress;
    onGrid.grid = volume.grid;
    onGrid.vectors.meshes = true;
    auto output = pipeline::buildVolume(*model, onGrid, &diagnostics);
    printDiagnostics(diagnostics, false);
    if (!output) return output.error();
    return std::move(output->volume);
}

}  // namespace svt::cli

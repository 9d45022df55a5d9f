#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/hulls/label_hulls.hpp>

#include <utility>

namespace svt::writers {

Result<LabelHulls> makeLabelHulls(const volume::SemanticVolume& volume, const VolumeWriteOptions& options) {
    SVT_DO(checkDimension(volume.grid, volume.columns));
    SVT_TRY(surfaces, labelSurfaces(volume.columns, volume.labels.labelOfScalar(),
                                    {std::uint64_t{1} << 27, options.threads, options.progress}));
    if (surfaces->empty()) return Error(Code::NothingSelected, "the volume has no voxels and therefore no surface");
    SVT_TRY(positions, placeVertices(volume, *surfaces, options.faces, nullptr, options.threads, options.progress));
    return LabelHulls{std::move(*surfaces), std::move(*positions), &volume, false};
}

}  // namespace svt::writers

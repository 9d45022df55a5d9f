#include <svt/writers/hulls/label_hulls.hpp>

#include <utility>

namespace svt::writers {

Result<LabelHulls> makeLabelHulls(const volume::SemanticVolume& volume, const VolumeWriteOptions& options) {
    if (volume.grid.dimension() != volume.columns.dimension())
        return Error(Code::BadArgument, "grid and columns differ in their number of samples");
    auto surfaces = labelSurfaces(volume.columns, volume.labels.labelOfScalar(),
                                  {std::uint64_t{1} << 27, options.threads, options.progress});
    if (!surfaces) return surfaces.error();
    if (surfaces->empty()) return Error(Code::NothingSelected, "the volume has no voxels, so there is no surface");
    SVT_TRY(positions, placeVertices(volume, *surfaces, options.faces, nullptr, options.threads, options.progress));
    return LabelHulls{std::move(*surfaces), std::move(*positions), &volume};
}

}  // namespace svt::writers

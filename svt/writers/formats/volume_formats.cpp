#include <svt/writers/volume_formats.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::writers {

// Each is declared beside its writer.
extern const VolumeFormat kNrrd, kGlb, kSegmentationNrrd, kVti, kVtm, kNifti, kNiftiGzip, kTiff, kOmeTiff, kZarr,
    kPrecomputed, kVdb, kVox, kX3d, kAde, kObj, kPly, kStl, kUsd, kTileset, kObjects, kContacts, kObjectParquet,
    kContactParquet, kFds, kFoam, kBoxTable, kBoxJson, kAdjacency, kGraphMl, kIndoorGml;

std::span<const VolumeFormat> volumeFormats() noexcept {
    static const VolumeFormat kAll[] = {kNrrd,      kGlb,           kSegmentationNrrd,
                                        kVti,       kVtm,           kNifti,
                                        kNiftiGzip, kTiff,          kOmeTiff,
                                        kZarr,      kPrecomputed,   kVdb,
                                        kVox,       kX3d,           kAde,
                                        kObj,       kPly,           kStl,
                                        kUsd,       kTileset,       kObjects,
                                        kContacts,  kObjectParquet, kContactParquet,
                                        kFds,       kFoam,          kBoxTable,
                                        kBoxJson,   kAdjacency,     kGraphMl,
                                        kIndoorGml};
    return kAll;
}

const VolumeFormat* volumeFormatOf(const std::filesystem::path& path) {
    const std::string name = lowerAscii(path.filename().string());
    const VolumeFormat* found = nullptr;
    std::size_t longest = 0;
    for (const VolumeFormat& format : volumeFormats())
        for (std::string_view rest = format.endings; !rest.empty();) {
            const std::string_view ending = rest.substr(0, rest.find('|'));
            rest.remove_prefix(std::min(rest.size(), ending.size() + 1));
            if (ending.size() <= longest || name.size() <= ending.size() || !name.ends_with(ending)) continue;
            longest = ending.size();
            found = &format;
        }
    return found;
}

Result<std::uint64_t> writeVolume(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                  const VolumeWriteOptions& options) {
    const VolumeFormat* format = volumeFormatOf(path);
    if (format == nullptr)
        return Error(Code::BadArgument, fmt::format("'{}' ends as none of the formats that a volume can be written in",
                                                    path.filename().string()));
    // A faulty query is an error whatever the format, even one that does not use it.
    for (const std::string* query : {&options.boxes.holes, &options.boxes.vents, &options.foam.air})
        if (!query->empty()) SVT_DO(analyze::selectLabels(volume, *query));
    return format->write(volume, path, options);
}

}  // namespace svt::writers

#include <svt/record/record.hpp>
#include <svt/writers/volume_formats.hpp>

#include <array>

namespace svt::writers {
namespace {

using record::Faults, record::Json, record::member, record::memberAs;

enum class Encoding : std::uint8_t { Gzip, Raw };
constexpr auto namesOf(Encoding) {
    return std::to_array<Name<Encoding>>({{Encoding::Gzip, "gzip"}, {Encoding::Raw, "raw"}});
}

struct IsGzip : record::PlainCodec<IsGzip, bool> {
    using Names = record::Codec<Encoding>;
    static constexpr void describe(Option& option) { Names::describe(option); }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, bool& to) {
        auto encoding = Encoding::Gzip;
        Names::read(faults, json, path, option, encoding);
        to = encoding == Encoding::Gzip;
    }
    static Json write(const Option&, bool from) { return nameOf(from ? Encoding::Gzip : Encoding::Raw); }
};

}  // namespace

record::Members<VolumeWriteOptions> membersOf(const VolumeWriteOptions*) noexcept {
    using All = VolumeWriteOptions;
    static constexpr record::Member<All> kMembers[] = {
        memberAs<IsGzip, &All::isCompressed>("encoding", "samples of NRRD, VTI and TIFF: compressed or raw",
                                             {.group = "Output", .option = "--encoding", .isForProjects = true}),
        member<&All::texture>(
            "texture",
            "samples of X3D and CityGML: pixel (numbers in the document), image (an NRRD file beside it) or composed "
            "(PNG slices beside it); only X3D: atlas (one PNG of colours beside it, for X3DOM)",
            {.group = "Output", .option = "--texture"}),
        member<&All::cityGml>("cityGml", "CityGML with the volume"),
        member<&All::zarr>("zarr", "Zarr"),
        member<&All::precomputed>("precomputed", "folders of neuroglancer"),
        member<&All::tileset>("tileset", "3D Tiles"),
        member<&All::vdb>("vdb", "OpenVDB"),
        member<&All::maxVoxels>("maxVoxels",
                                "maximum number of samples as numbers in a document, of voxels in a .vox, or of "
                                "cells in a .foam",
                                {.least = 1, .most = 1e12, .group = "Output", .option = "--max-voxels"}),
        member<&All::boxes>("boxes", "FDS and lists of boxes"),
        member<&All::foam>("foam", "OpenFOAM"),
        member<&All::faces>("faces",
                            "slopes of a .glb: planes (flat, where the volume stores planes) or voxels (stairs)",
                            {.group = "Output", .option = "--faces", .isForProjects = true}),
        member<&All::from>("from",
                           "surfaces of a .glb and a .3dtiles: meshes (faces of the model that the volume keeps) or "
                           "voxels; auto: meshes where they are closed or sheets, in a .3dtiles also open shells",
                           {.group = "Output", .option = "--from", .isForProjects = true}),
    };
    return kMembers;
}

}  // namespace svt::writers

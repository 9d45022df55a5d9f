#include <svt/record/record.hpp>
#include <svt/writers/volume_formats.hpp>

#include <array>

namespace svt::writers {
namespace {

using record::Faults, record::Json, record::member, record::memberAs, record::NumberChoice;

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
                                             {.group = "Output", .option = "--encoding"}),
        member<&All::texture>(
            "texture",
            "samples of X3D and of CityGML: pixel (numbers in the document), image (an NRRD beside it) or composed "
            "(PNG slices beside it); of X3D also atlas (one PNG of colours beside it, as X3DOM shows volumes)",
            {.group = "Output", .option = "--texture"}),
        member<&All::model>("model",
                            "of an .ade.gml: the CityGML that the volume was built from, which is kept as it is",
                            {.value = "FILE",
                             .otherwise = "the input, where that is CityGML",
                             .group = "Output",
                             .option = "--model",
                             .file = FileUse::OtherInput}),
        memberAs<NumberChoice, &All::cityGmlVersion>("citygml", "of an .ade.gml: the version of CityGML",
                                                     {.choices = "2.0|3.0",
                                                      .otherwise = "that of the model; 3.0 without one",
                                                      .group = "Output",
                                                      .option = "--citygml"}),
        memberAs<NumberChoice, &All::zarrVersion>("zarr", "of a .zarr: 2 (OME-NGFF 0.4) or 3 (OME-NGFF 0.5, sharded)",
                                                  {.choices = "2|3", .group = "Output", .option = "--zarr"}),
        member<&All::hasMeshes>("meshes", "of a .precomputed: also the surface of each label, for the 3D view",
                                {.group = "Output", .option = "--meshes"}),
        member<&All::isSharded>(
            "sharded",
            "of a .precomputed: up to 64 chunks in a file, packed; the web server has to answer requests for ranges",
            {.group = "Output", .option = "--sharded"}),
        member<&All::place>("place", "of a .3dtiles: where on the globe the lower corner is",
                            {.value = "LAT,LON,HEIGHT",
                             .unit = "degrees and metres",
                             .otherwise = "that of the CRS",
                             .group = "Output",
                             .option = "--place"}),
        member<&All::lift>(
            "lift",
            "of a .3dtiles: metres added to heights, such as the height of the geoid where they are over the sea",
            {.value = "M", .group = "Output", .option = "--lift"}),
        member<&All::hasVoxels>("voxels",
                                "of a .3dtiles: voxels by draft extensions, as Cesium has them for trial, not surfaces",
                                {.group = "Output", .option = "--voxels"}),
        member<&All::hasLevelSets>(
            "levelSets",
            "of a .vdb: each class as signed distances to its surface, three voxels to both sides, not as a mask",
            {.group = "Output", .option = "--level-sets"}),
        member<&All::maxVoxels>("maxVoxels",
                                "most samples that a document is to hold as numbers, most voxels of a .vox",
                                {.least = 1, .most = 1e12, .group = "Output", .option = "--max-voxels"}),
        member<&All::mergeBy>("merge", "of an .fds and of lists of boxes: what becomes boxes together",
                              {.group = "Output", .option = "--merge"}),
        member<&All::maxBoxes>("maxBoxes", "of an .fds and of lists of boxes: more are refused",
                               {.least = 1, .most = 1e8, .group = "Output", .option = "--max-boxes"}),
        member<&All::holes>("holes", "of an .fds: components that are open, such as doors",
                            {.value = "QUERY", .group = "Output", .option = "--holes"}),
        member<&All::vents>("vents", "of an .fds: components with a vent on both sides, such as windows",
                            {.value = "QUERY", .group = "Output", .option = "--vents"}),
        member<&All::faces>("faces",
                            "slopes of a .glb: planes (flat, as far as the volume knows them) or voxels (stairs)",
                            {.group = "Output", .option = "--faces"}),
    };
    return kMembers;
}

}  // namespace svt::writers

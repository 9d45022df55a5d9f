#include <svt/readers/read_options.hpp>

#include <svt/core/text.hpp>
#include <svt/record/record.hpp>

#include <fmt/format.h>

#include <string>

namespace svt::readers {
namespace {

using record::Codec, record::Faults, record::Json, record::member;

// A code such as EPSG:25832 or 25832.
struct EpsgCode : record::PlainCodec<EpsgCode, int> {
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, int& to) {
        std::string text;
        Codec<std::string>::read(faults, json, path, option, text);
        std::string_view digits = text;
        if (equalsIgnoringCase(digits.substr(0, 5), "EPSG:")) digits.remove_prefix(5);
        to = parseInteger<int>(digits).value_or(0);
        if (to <= 0)
            faults.add(path,
                       fmt::format("{} '{}': expected the EPSG code of a projection in metres, such as EPSG:25832",
                                   option.option, text));
    }
    static Json write(const Option&, int from) { return fmt::format("EPSG:{}", from); }
};

}  // namespace

record::Members<ReadOptions> membersOf(const ReadOptions*) noexcept {
    static constexpr record::Member<ReadOptions> kMembers[] = {
        record::memberAs<EpsgCode, &ReadOptions::crs>(
            "crs", "transform the model to this projection in metres, such as EPSG:25832",
            {.value = "CODE",
             .otherwise = "that of the file; degrees and feet are projected to the usual projection of the place",
             .group = "Model",
             .option = "--crs",
             .isForModels = true,
             .isForProjects = true}),
        member<&ReadOptions::keepFarFeatures>(
            "keepFarFeatures", "keep features that lie far away from all others",
            {.group = "Model", .option = "--keep-far-features", .isForModels = true, .isForProjects = true}),
        member<&ReadOptions::extrudeFootprints>(
            "extrudeFootprints", "make solids for features that have only a footprint and a height as attribute",
            {.group = "Model", .option = "--extrude-footprints", .isForModels = true, .isForProjects = true}),
        member<&ReadOptions::allowTruncated>(
            "allowTruncated", "read a file that was cut off (IFC, CityJSONSeq) up to the cut, with a warning",
            {.group = "Model", .option = "--allow-truncated", .isForModels = true, .isForProjects = true}),
        member<&ReadOptions::splitLayers>(
            "layers", "IFC: split walls and slabs into the layers of their material, each a separate object",
            {.group = "Model", .option = "--layers", .isForModels = true, .isForProjects = true}),
    };
    return kMembers;
}

}  // namespace svt::readers

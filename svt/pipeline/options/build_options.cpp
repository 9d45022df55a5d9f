#include <svt/core/text.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/record/record.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace svt::pipeline {
namespace {

using record::Codec, record::Faults, record::Json, record::member, record::memberAs, record::Not, record::PlainCodec;

// Three numbers as "800,700,400" or "800x700x400"; one number stands for all three.
// \param unit  of the numbers, for messages
void readTriple(Faults& faults, const Json& json, const std::string& path, const Option& option, std::string_view unit,
                Vec3d& to, std::string& text) {
    Codec<std::string>::read(faults, json, path, option, text);
    int count = 0;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find_first_of(",x", at), text.size());
        const auto value = parseNumber(withoutBlanks(std::string_view(text).substr(at, end - at)));
        if (!value || count == 3) {
            count = -1;
            break;
        }
        to[count++] = *value;
        at = end + 1;
    }
    if (count == 1) to = {to.x, to.x, to.x};
    if (count != 1 && count != 3)
        faults.add(path, fmt::format("{} '{}': expected one number or three such as 800,700,400 ({})", option.option,
                                     text, unit));
}

struct SampleCounts : PlainCodec<SampleCounts, Vec3i> {
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, Vec3i& to) {
        Vec3d values;
        std::string text;
        readTriple(faults, json, path, option, "samples, 2 to 65535", values, text);
        for (int axis = 0; axis < 3 && faults.isFine(); ++axis) {
            const double value = values[axis];
            if (!(value >= 2 && value <= volume::Grid::kMaxDimension) || value != std::floor(value))
                return faults.add(
                    path,
                    Error(Code::BadDimension,
                          fmt::format("{} {}: {} is out of range; whole numbers from 2 to {} samples are possible",
                                      option.option, text, value, volume::Grid::kMaxDimension)));
            to[axis] = static_cast<std::int32_t>(value);
        }
    }
    static Json write(const Option&, Vec3i from) { return fmt::format("{},{},{}", from.x, from.y, from.z); }
};

struct Distances : PlainCodec<Distances, Vec3d> {
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, Vec3d& to) {
        std::string text;
        readTriple(faults, json, path, option, "metres, greater than 0", to, text);
        for (int axis = 0; axis < 3 && faults.isFine(); ++axis)
            if (const double metres = to[axis]; !(metres > 0) || !std::isfinite(metres))
                faults.add(path, Error(Code::BadDimension,
                                       fmt::format(
                                           "{} {}: {} is out of range; metres greater than 0 are possible, such as 0.1",
                                           option.option, text, metres)));
    }
    static Json write(const Option&, Vec3d from) { return fmt::format("{},{},{}", from.x, from.y, from.z); }
};

// The memory of all the work, in MB. Half of it remains for the volume, because reading and meshing come before. The
// memory of the machine has no influence, so that the same options give the same volume everywhere.
struct WorkMemory : PlainCodec<WorkMemory, std::uint64_t> {
    static constexpr std::uint64_t kBytesOfMegabyte = 500000;

    static constexpr void describe(Option& option) { option.kind = OptionKind::Whole; }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option,
                     std::uint64_t& to) {
        std::uint64_t megabytes = 0;
        Codec<std::uint64_t>::read(faults, json, path, option, megabytes);
        to = std::min(to, megabytes * kBytesOfMegabyte);
    }
    static Json write(const Option&, std::uint64_t from) { return from / kBytesOfMegabyte; }
};

}  // namespace

// NOLINTNEXTLINE(readability-function-size): a list
record::Members<BuildOptions> membersOf(const BuildOptions*) noexcept {
    static constexpr record::Member<BuildOptions> kMembers[] = {
        memberAs<SampleCounts, &BuildOptions::dimension>("dimension",
                                                         "samples along x, y and z, such as 800,700,400 (2 to 65535)",
                                                         {.value = "X,Y,Z",
                                                          .group = "Grid",
                                                          .option = "--dimension",
                                                          .excludes = "--spacing",
                                                          .isForModels = true,
                                                          .isForProjects = true}),
        memberAs<Distances, &BuildOptions::spacing>(
            "spacing", "distance between samples in metres, one number or three",
            {.value = "M",
             .otherwise = "0.05; coarser for large models, finer for small ones",
             .group = "Grid",
             .option = "--spacing",
             .isForModels = true,
             .isForProjects = true}),
        member<&BuildOptions::axes>("axes", "axes of the grid: world, or building (turned to its dominant edge)",
                                    {.group = "Grid", .option = "--axes", .isForModels = true, .isForProjects = true}),
        member<&BuildOptions::lod, &model::LodChoice::lod>("lod", "use no finer level of detail than this",
                                                           {.least = 0,
                                                            .most = 4,
                                                            .otherwise = "the finest that each feature has",
                                                            .group = "Model",
                                                            .option = "--lod",
                                                            .isForModels = true,
                                                            .isForProjects = true}),
        memberAs<Not, &BuildOptions::assignThematicBodies>(
            "noBodies", "leave the material between hull and rooms to the building, not to its walls and slabs",
            {.group = "Model", .option = "--no-bodies", .isForModels = true, .isForProjects = true}),
        member<&BuildOptions::read>("read", "how files are read"),
        memberAs<WorkMemory, &BuildOptions::memoryBytes>(
            "memory",
            "memory limit; work that needs more ends with a message. Pictures of cities use half of it for tiles "
            "(1 GB without the option), and become coarser",
            {.unit = "MB",
             .least = 64,
             .most = 16777216,
             .otherwise = "the memory of the machine, or the limit of a control group or ulimit",
             .group = "Model",
             .option = "--memory"}),
        member<&BuildOptions::styleFile>(
            "style", "style file (JSON): colours, opacities and patterns by query",
            {.value = "FILE", .group = "Style", .option = "--style", .file = FileUse::Style, .isForModels = true}),
        member<&BuildOptions::usePatterns>(
            "patterns", "embed the built-in patterns: brick, concrete, timber, ...",
            {.group = "Style", .option = "--patterns", .isForModels = true, .isForProjects = true}),
        member<&BuildOptions::sheets>(
            "sheets", "open surfaces: thin (6-separating) or conservative (every voxel touched)",
            {.group = "Voxels", .option = "--sheets", .isForModels = true, .isForProjects = true}),
        memberAs<Not, &BuildOptions::keepThinParts>(
            "noThin", "drop parts of solids that are thinner than a voxel",
            {.group = "Voxels", .option = "--no-thin", .isForModels = true, .isForProjects = true}),
        member<&BuildOptions::threads>("threads", "number of threads; the result does not depend on it",
                                       {.least = 0,
                                        .most = 1024,
                                        .otherwise = "all cores",
                                        .group = "Voxels",
                                        .option = "--threads",
                                        .isForProjects = true}),
    };
    return kMembers;
}

}  // namespace svt::pipeline

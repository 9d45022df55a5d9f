#include <apps/cli/city/city_input.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/analyze/extents.hpp>

#include <fmt/format.h>

#include <numeric>

namespace svt::cli {
namespace {

struct InfoArguments {
    std::filesystem::path input;
    pipeline::BuildOptions build;
    bool json = false, tree = false;
};

// Voxels and volume, such as "own 1 voxels 0.000 m3".
std::string measureText(const char* which, const analyze::Measure& measure) {
    return fmt::format("  {} {} voxels{}", which, measure.voxels,
                       measure.volume ? fmt::format(" {:.3f} m3", *measure.volume) : "");
}

void printTree(const volume::SemanticVolume& volume) {
    const std::size_t count = volume.labels.labels.size();
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0U);
    const auto measures = analyze::measureFeatures(analyze::Extents(volume.labels), all,
                                                   analyze::ownMeasures(volume.labels, volume.grid));
    std::vector<int> depth(count, 0);
    for (std::size_t l = 0; l < count; ++l) {
        const volume::Label& label = volume.labels.labels[l];
        const auto& [number, own, total] = measures[l];
        if (label.parent != volume::kNoLabel) depth[l] = depth[label.parent] + 1;
        fmt::print("{:{}}{} {}{}{}", "", depth[l] * 2, label.className, label.name.empty() ? label.id : label.name,
                   label.name.empty() ? "" : "  id ", label.name.empty() ? "" : label.id);
        if (label.count != 0)
            fmt::print("  scalars {}..{}{}", label.first, label.first + label.count - 1, measureText("own", own));
        if (total.voxels != own.voxels) fmt::print("{}", measureText("total", total));
        if (label.count != 0) fmt::print("  {}", volume::fillingName(label.filling));
        fmt::print("\n");
    }
}

void printFigures(const volume::SemanticVolume& volume) {
    const auto d = volume.grid.dimension();
    const auto s = volume.grid.spacing();
    const auto o = volume.grid.origin();
    std::size_t objects = 0;
    std::uint64_t filled = 0;
    for (const volume::Label& label : volume.labels.labels) {
        objects += label.voxels != 0;
        filled += label.voxels;
    }
    fmt::print("model      {} ({})\n", volume.modelName.empty() ? "-" : volume.modelName, volume.source);
    fmt::print("crs        {}\n", volume.crsName.empty() ? "-" : volume.crsName);
    fmt::print("samples    {} x {} x {}\n", d.x, d.y, d.z);
    fmt::print("spacing    {:.6g} x {:.6g} x {:.6g} m\n", s.x, s.y, s.z);
    fmt::print("origin     {:.6f} {:.6f} {:.6f}\n", o.x, o.y, o.z);
    fmt::print("features   {}, of which {} have voxels\n", volume.labels.labels.size(), objects);
    fmt::print("scalars    {} bit, 1..{}\n", volume.labels.scalarBits(), volume.labels.scalarCount() - 1);
    fmt::print("filled     {:.1f} %\n", 100.0 * double(filled) / double(volume.grid.sampleCount()));
    fmt::print("columns    {:.1f} kB ({:.3f} % of a dense {}-bit volume)\n", double(volume.columns.sizeBytes()) / 1000,
               100.0 * double(volume.columns.sizeBytes()) /
                   (double(volume.grid.sampleCount()) * volume.labels.scalarBits() / 8),
               volume.labels.scalarBits());
    fmt::print("overlaps   {} pairs\n", volume.labels.overlaps.size());
}

Result<int> runInfo(const InfoArguments& arguments) {
    if (isCity(arguments.input)) {
        if (!arguments.tree) return printCity(arguments.input, arguments.json);
        return Error(Code::BadArgument, "--tree: a city has too many features to be listed; svt query lists them");
    }
    SVT_TRY(volume, loadVolume(arguments.input, arguments.build, TerminalProgress().get(), false));
    if (arguments.json) {
        print(infoJson(*volume));
    } else {
        printFigures(*volume);
        if (arguments.tree) printTree(*volume);
    }
    return kDone;
}

Members<InfoArguments> membersOf(const InfoArguments*) noexcept {
    using All = InfoArguments;
    static constexpr Member<All> kMembers[] = {
        modelInput<&All::input>(), part<&All::build>("build"),
        jsonOption<&All::json>(),  member<&All::tree>("--tree", "print the tree of features", {.group = "Output"}),
        quietOption<All>(),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kInfoCommand =
    commandOf<InfoArguments, runInfo>("info", "Show the contents of a volume, model or city");

}  // namespace svt::cli

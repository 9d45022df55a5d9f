#include <apps/cli/city/city_input.hpp>

#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/city/city_levels.hpp>
#include <svt/city/city_walk.hpp>
#include <svt/core/machine.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {

Result<int> printCity(const std::filesystem::path& folder, bool json) {
    SVT_TRY(city, city::City::open(folder));
    const Box3d& box = city->box();
    if (json) {
        print({{"buildings", city->buildings()},
               {"tiles", city->tiles()},
               {"packs", city->packs()},
               {"missingPacks", city->missingPacks()},
               {"skippedFeatures", city->skippedFeatures()},
               {"bytes", city->packBytes()},
               {"spacing", city->spacing()},
               {"topDetail", city->topDetail()},
               {"crs", city->crsName()},
               {"box", {toJson(box.min), toJson(box.max)}},
               {"plan", city->planDigest()}});
        return kDone;
    }
    fmt::print("{} buildings in {} tiles and {} packs, {:.1f} MB ({:.0f} bytes per building); {} features left out\n",
               city->buildings(), city->tiles(), city->packs(), double(city->packBytes()) / 1e6,
               double(city->packBytes()) / double(std::max<std::uint64_t>(1, city->buildings())),
               city->skippedFeatures());
    fmt::print("spacing {:g} m, and {:g} m with one label per building; by class {:g} to {:g} m (detail 2 to {}); {}\n",
               city->spacing(), 2 * city->spacing(), 4 * city->spacing(),
               city::spacingOf(city->topDetail(), city->spacing()).x, city->topDetail(),
               city->crsName().empty() ? "no CRS" : city->crsName());
    fmt::print("from ({:.1f}, {:.1f}, {:.1f}) to ({:.1f}, {:.1f}, {:.1f})\n", box.min.x, box.min.y, box.min.z,
               box.max.x, box.max.y, box.max.z);
    if (city->missingPacks() != 0) fmt::print("{} packs are missing\n", city->missingPacks());
    return kDone;
}

std::uint64_t tileMemory() {
    constexpr std::uint64_t kTileMemory = 1'000'000'000;
    const MemoryFigures memory = memoryFigures();
    return memory.limitedBy == "--memory" && memory.limitBytes ? *memory.limitBytes / 2 : kTileMemory;
}

Result<int> checkCity(const std::filesystem::path& folder) {
    SVT_TRY(city, city::City::open(folder));
    Diagnostics findings;
    SVT_TRY(counted, city::checkTiles(*city, TerminalProgress().get(), findings));
    fmt::print("{} tiles, of which {} are damaged; {} buildings, {} solids, of which {} had holes\n", counted->tiles,
               counted->damaged, counted->buildings, counted->solids, counted->open);
    printDiagnostics(findings, true);
    return findings.count(Severity::Warning) + findings.count(Severity::Error) != 0 ? kInvalid : kDone;
}

std::array<double, 4> rectangleOf(const std::vector<double>& box) {
    if (box.empty()) return city::kEverywhere;
    return {box[0], box[1], box[3], box[4]};
}

}  // namespace svt::cli

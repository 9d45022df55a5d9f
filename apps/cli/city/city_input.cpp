#include <apps/cli/city/city_input.hpp>

#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>

#include <svt/city/city_levels.hpp>
#include <svt/core/machine.hpp>
#include <svt/core/parallel.hpp>

#include <fmt/format.h>

#include <limits>
#include <optional>

namespace svt::cli {

int printCity(const std::filesystem::path& folder, bool json) {
    const auto city = city::City::open(folder);
    if (!city) return fail(city.error());
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
    fmt::print("{} buildings in {} tiles and {} packs, {:.1f} MB ({:.0f} bytes a building); {} features left out\n",
               city->buildings(), city->tiles(), city->packs(), double(city->packBytes()) / 1e6,
               double(city->packBytes()) / double(std::max<std::uint64_t>(1, city->buildings())),
               city->skippedFeatures());
    fmt::print("spacing {:g} m, and {:g} m with one label a building; by class {:g} to {:g} m (detail 2 to {}); {}\n",
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

Result<void> forEachTile(const city::City& city, const std::vector<double>& box, int threads, const Progress* progress,
                         const std::function<Result<void>(const volume::SemanticVolume&)>& work,
                         const std::function<bool(const city::IndexEntry&)>& isWanted) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::array<double, 4> rectangle{-kInfinity, -kInfinity, kInfinity, kInfinity};
    if (!box.empty()) rectangle = {box[0], box[1], box[3], box[4]};
    SVT_TRY(entries, city.find(0, rectangle));
    if (isWanted) std::erase_if(*entries, [&](const city::IndexEntry& entry) { return !isWanted(entry); });
    const std::size_t batch = 2 * static_cast<std::size_t>(threads > 0 ? threads : hardwareThreads());
    ProgressCounter counter(progress, "tiles", entries->size());
    for (std::size_t begin = 0; begin < entries->size(); begin += batch) {
        const std::size_t count = std::min(batch, entries->size() - begin);
        std::vector<std::optional<Result<volume::SemanticVolume>>> read(count);
        parallelFor(count, 1, threads, [&](std::size_t from, std::size_t to) {
            for (std::size_t n = from; n < to; ++n) read[n].emplace(city.read((*entries)[begin + n]));
        });
        if (Progress::isCancelled(progress)) return Error(Code::Cancelled, "stopped between tiles");
        for (auto& volume : read) {
            if (!*volume) return volume->error();
            SVT_DO(work(**volume));
            volume.reset();
            counter.add();
        }
    }
    return {};
}

}  // namespace svt::cli

#include <apps/cli/city/city_input.hpp>

#include <apps/cli/commands/commands.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>

#include <svt/core/parallel.hpp>

#include <fmt/format.h>

#include <limits>
#include <optional>

namespace svt::cli {

bool isCity(const std::filesystem::path& input) {
    // As it was given: the generic form has but one slash behind "http:".
    const std::string text = input.string();
    if (text.starts_with("http://") || text.starts_with("https://")) return true;
    std::error_code ignored;
    return std::filesystem::is_regular_file(input / "city.json", ignored);
}

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
               {"crs", city->crsName()},
               {"box", {toJson(box.min), toJson(box.max)}},
               {"plan", city->planDigest()}});
        return kDone;
    }
    fmt::print("{} buildings in {} tiles and {} packs, {:.1f} MB ({:.0f} bytes a building); {} features left out\n",
               city->buildings(), city->tiles(), city->packs(), double(city->packBytes()) / 1e6,
               double(city->packBytes()) / double(std::max<std::uint64_t>(1, city->buildings())),
               city->skippedFeatures());
    fmt::print("spacing {:g} m, and {:g} m with one label a building; {}\n", city->spacing(), 2 * city->spacing(),
               city->crsName().empty() ? "no CRS" : city->crsName());
    fmt::print("from ({:.1f}, {:.1f}, {:.1f}) to ({:.1f}, {:.1f}, {:.1f})\n", box.min.x, box.min.y, box.min.z,
               box.max.x, box.max.y, box.max.z);
    if (city->missingPacks() != 0) fmt::print("{} packs are missing\n", city->missingPacks());
    return kDone;
}

Result<volume::SemanticVolume> pageVolume(const std::filesystem::path& folder) {
    // Of the members: about as much as the page loads in some seconds, and draws within its memory.
    constexpr std::uint64_t kMostBytes = 6'000'000;
    constexpr double kMostSamples = 8192;
    const auto city = city::City::open(folder);
    if (!city) return city.error();
    const Box3d& box = city->box();
    const double extent = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
    city::Extract extract;
    extract.box = {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z};
    extract.hasBox = true;
    for (extract.detail = 0; extract.detail < city->topDetail(); ++extract.detail) {
        const auto entries = city::allTiles(*city, extract.detail);
        if (!entries) return entries.error();
        std::uint64_t bytes = 0;
        for (const city::IndexEntry& entry : *entries) bytes += entry.size;
        if (bytes <= kMostBytes && extent / city::spacingOf(extract.detail, city->spacing()).x <= kMostSamples) break;
    }
    auto volume = city::extractVolume(*city, extract);
    if (!volume) return volume;
    note(
        fmt::format("the page shows all of the city at detail {} ({}), voxels of {:g} m; svt city extract takes a "
                    "part at a finer one",
                    extract.detail,
                    extract.detail == 0   ? "all labels"
                    : extract.detail == 1 ? "one label a building"
                                          : "classes",
                    volume->grid.spacing().x));
    return volume;
}

Result<void> forEachTile(const city::City& city, const std::vector<double>& box, int threads, const Progress* progress,
                         const std::function<Result<void>(const volume::SemanticVolume&)>& work,
                         const std::function<bool(const city::IndexEntry&)>& isWanted) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::array<double, 4> rectangle{-kInfinity, -kInfinity, kInfinity, kInfinity};
    if (!box.empty()) rectangle = {box[0], box[1], box[3], box[4]};
    auto entries = city.find(0, rectangle);
    if (!entries) return entries.error();
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
            if (auto done = work(**volume); !done) return done;
            volume.reset();
            counter.add();
        }
    }
    return {};
}

}  // namespace svt::cli

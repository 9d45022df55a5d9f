#include <svt/city/city_walk.hpp>
#include <svt/core/parallel.hpp>

#include <algorithm>
#include <optional>
#include <vector>

namespace svt::city {

Result<void> forEachTile(const City& city, const std::array<double, 4>& rectangle, int threads,
                         const Progress* progress, const std::function<Result<void>(volume::SemanticVolume&)>& work,
                         const std::function<bool(const IndexEntry&)>& isWanted, TileFaces faces) {
    SVT_TRY(entries, city.find(0, rectangle));
    if (isWanted) std::erase_if(*entries, [&](const IndexEntry& entry) { return !isWanted(entry); });
    const std::size_t batch = 2 * static_cast<std::size_t>(threads > 0 ? threads : hardwareThreads());
    ProgressCounter counter(progress, "tiles", entries->size());
    for (std::size_t begin = 0; begin < entries->size(); begin += batch) {
        const std::size_t count = std::min(batch, entries->size() - begin);
        std::vector<std::optional<Result<volume::SemanticVolume>>> read(count);
        parallelFor(count, 1, threads, [&](std::size_t from, std::size_t to) {
            for (std::size_t n = from; n < to; ++n) {
                const IndexEntry& entry = (*entries)[begin + n];
                read[n].emplace(faces == TileFaces::Meshes ? city.readWithMeshes(entry) : city.read(entry));
            }
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

}  // namespace svt::city

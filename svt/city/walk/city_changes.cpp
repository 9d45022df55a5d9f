#include <svt/city/city_changes.hpp>

#include <svt/city/join/join_volumes.hpp>
#include <svt/core/parallel.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace svt::city {
namespace {

using TileNumber = std::tuple<int, std::int32_t, std::int32_t>;

TileNumber numberOf(const TileKey& tile) { return {tile.level, tile.x, tile.y}; }

// A tile that both states have, or only one.
struct TilePair {
    const IndexEntry *was = nullptr, *is = nullptr;
};

// Sets of tiles of limited size.
class Places {
public:
    static constexpr std::size_t kMostTiles = 16;

    explicit Places(std::size_t tiles) : above_(tiles), size_(tiles, 1) {
        std::iota(above_.begin(), above_.end(), std::size_t{0});
    }
    [[nodiscard]] std::size_t find(std::size_t tile) {
        while (above_[tile] != tile) tile = above_[tile] = above_[above_[tile]];
        return tile;
    }
    // False if the place would have too many tiles. \param most  of the place
    bool unite(std::size_t a, std::size_t b, std::size_t most) {
        a = find(a);
        b = find(b);
        if (a == b) return true;
        if (size_[a] + size_[b] > most) return false;
        above_[std::max(a, b)] = std::min(a, b);
        size_[std::min(a, b)] += size_[std::max(a, b)];
        return true;
    }

private:
    std::vector<std::size_t> above_, size_;
};

Result<void> checkComparable(const City& was, const City& is) {
    for (const City* city : {&was, &is})
        if (city->missingPacks() > 0)
            return Error(Code::CityIncomplete, fmt::format("{} packs of a city are missing; run 'svt city run' and "
                                                           "'svt city merge' before you compare it",
                                                           city->missingPacks()));
    if (was.spacing() != is.spacing())
        return Error(Code::BadArgument,
                     fmt::format("the cities have {} and {} m between samples; plan both with one spacing",
                                 was.spacing(), is.spacing()));
    if (!was.crsName().empty() && !is.crsName().empty() && was.crsName() != is.crsName())
        return Error(Code::BadArgument,
                     fmt::format("the cities have the reference systems '{}' and '{}'; plan both with "
                                 "one (--crs)",
                                 was.crsName(), is.crsName()));
    return {};
}

class ChangeFinder {
public:
    ChangeFinder(const City& was, const City& is, int threads, const Progress* progress)
        : was_(was), is_(is), threads_(threads), progress_(progress) {}

    Result<CityChanges> run() {
        SVT_TRY(before, was_.find(0, kEverywhere));
        SVT_TRY(after, is_.find(0, kEverywhere));
        std::map<TileNumber, TilePair> pairs;
        for (const IndexEntry& entry : *before) pairs[numberOf(entry.tile)].was = &entry;
        for (const IndexEntry& entry : *after) pairs[numberOf(entry.tile)].is = &entry;
        SVT_DO(keepChanged(pairs));
        Places places(changed_.size());
        joinDivided(places);
        SVT_DO(joinMoved(places));
        // Places in the order of their first tiles, and tiles as in the index.
        std::map<std::size_t, ChangedTiles> found;
        std::map<TileNumber, std::size_t> placeOf;
        for (std::size_t n = 0; n < changed_.size(); ++n) placeOf[changed_[n].first] = places.find(n);
        const auto add = [&](const std::vector<IndexEntry>& entries, std::vector<IndexEntry> ChangedTiles::*list) {
            for (const IndexEntry& entry : entries)
                if (const auto at = placeOf.find(numberOf(entry.tile)); at != placeOf.end())
                    (found[at->second].*list).push_back(entry);
        };
        add(*before, &ChangedTiles::was);
        add(*after, &ChangedTiles::is);
        for (auto& [first, tiles] : found) changes_.places.push_back(std::move(tiles));
        return std::move(changes_);
    }

private:
    // Compares the bytes of the tiles that both states have.
    Result<void> keepChanged(const std::map<TileNumber, TilePair>& pairs) {
        std::vector<std::pair<TileNumber, TilePair>> all(pairs.begin(), pairs.end());
        std::vector<char> isEqual(all.size(), 0);
        ProgressCounter counter(progress_, "tiles", all.size());
        SVT_DO(forEach(all.size(), [&](std::size_t n) -> Result<void> {
            const TilePair& pair = all[n].second;
            counter.add();
            if (pair.was == nullptr || pair.is == nullptr || pair.was->size != pair.is->size) return {};
            SVT_TRY(before, was_.readBytes(*pair.was));
            SVT_TRY(after, is_.readBytes(*pair.is));
            isEqual[n] = *before == *after;
            return {};
        }));
        for (std::size_t n = 0; n < all.size(); ++n) {
            if (isEqual[n] == 0) {
                changed_.push_back(all[n]);
                continue;
            }
            ++changes_.equalTiles;
            changes_.equalBuildings += all[n].second.was->buildings;
        }
        return {};
    }

    // Tiles inside of a tile of the other state.
    void joinDivided(Places& places) const {
        std::map<TileNumber, std::size_t> known;
        for (std::size_t n = 0; n < changed_.size(); ++n) known[changed_[n].first] = n;
        for (std::size_t n = 0; n < changed_.size(); ++n) {
            auto [level, x, y] = changed_[n].first;
            while (level < Plan::kTopLevel) {
                ++level;
                x >>= 1;
                y >>= 1;
                if (const auto at = known.find({level, x, y}); at != known.end())
                    places.unite(n, at->second, changed_.size());
            }
        }
    }

    // Adds the ids of the features of a tile that have no parent.
    static Result<void> addRootIds(const City& city, const IndexEntry& entry, std::vector<std::string>& ids) {
        SVT_TRY(bytes, city.readBytes(entry));
        const std::span<const std::byte> content = std::as_bytes(std::span(*bytes));
        SVT_TRY(tile, volume::openSvt(content, entry.tile.toString()));
        for (const volume::Label& label : tile->labels.labels)
            if (label.parent == volume::kNoLabel && !label.id.empty()) ids.push_back(label.id);
        return {};
    }

    // Tiles of one building. Ids are unique in a city.
    Result<void> joinMoved(Places& places) {
        std::vector<std::array<std::vector<std::string>, 2>> ids(changed_.size());
        const auto addIds = [&](std::size_t n) -> Result<void> {
            const TilePair& pair = changed_[n].second;
            for (const bool isNew : {false, true}) {
                const IndexEntry* entry = isNew ? pair.is : pair.was;
                if (entry != nullptr) SVT_DO(addRootIds(isNew ? is_ : was_, *entry, ids[n][isNew ? 1 : 0]));
            }
            return {};
        };
        SVT_DO(forEach(changed_.size(), addIds));
        std::unordered_map<std::string, std::size_t> tileOf;  // of the old state
        for (std::size_t n = 0; n < ids.size(); ++n)
            for (std::string& id : ids[n][0]) tileOf.try_emplace(std::move(id), n);
        for (std::size_t n = 0; n < ids.size(); ++n)
            for (const std::string& id : ids[n][1])
                if (const auto at = tileOf.find(id); at != tileOf.end())
                    places.unite(n, at->second, Places::kMostTiles);
        std::map<std::pair<std::size_t, std::size_t>, std::vector<std::string>> apart;  // by old and new tile
        for (std::size_t n = 0; n < ids.size(); ++n)
            for (std::string& id : ids[n][1])
                if (const auto at = tileOf.find(id); at != tileOf.end() && places.find(n) != places.find(at->second))
                    apart[{at->second, n}].push_back(std::move(id));
        for (auto& [tiles, moved] : apart) {
            std::sort(moved.begin(), moved.end());
            changes_.apart.push_back(
                {{{*changed_[tiles.first].second.was}, {*changed_[tiles.second].second.is}}, std::move(moved)});
        }
        return {};
    }

    // Calls work(n) for 0 .. count - 1 by several threads; the error of the smallest n.
    template <class Work>
    Result<void> forEach(std::size_t count, const Work& work) {
        std::vector<Result<void>> done(count);
        parallelFor(count, 1, threads_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; n < end; ++n)
                if (!Progress::isCancelled(progress_)) done[n] = work(n);
        });
        if (Progress::isCancelled(progress_)) return Error(Code::Cancelled, "stopped between tiles");
        for (Result<void>& one : done)
            if (!one) return one.error();
        return {};
    }

    const City &was_, &is_;
    int threads_;
    const Progress* progress_;
    std::vector<std::pair<TileNumber, TilePair>> changed_;
    CityChanges changes_;
};

Result<volume::SemanticVolume> readState(const City& city, const std::vector<IndexEntry>& entries) {
    if (entries.size() == 1) return city.readWithMeshes(entries.front());
    std::vector<volume::SemanticVolume> tiles;
    for (const IndexEntry& entry : entries) {
        SVT_TRY(tile, city.readWithMeshes(entry));
        tiles.push_back(std::move(*tile));
    }
    SVT_TRY(joined, joinVolumes(tiles));
    joined->vectors = joinTriangles(tiles, joined->grid);
    return joined;
}

volume::SemanticVolume emptyState(const volume::SemanticVolume& other) {
    volume::SemanticVolume volume;
    volume.grid = other.grid;
    volume.crsName = other.crsName;
    const Vec3i n = other.grid.dimension();
    constexpr std::int32_t kSize = volume::ColumnVolume::kTileSize;
    std::vector<volume::ColumnTileData> tiles;
    for (std::int32_t j = 0; j < n.y; j += kSize)
        for (std::int32_t i = 0; i < n.x; i += kSize) {
            volume::ColumnTileBuilder builder(std::min(kSize, n.x - i));
            const std::array<volume::Run, 1> empty{{{static_cast<std::uint32_t>(n.z), 0}}};
            const std::vector<std::uint16_t> row(std::size_t(std::min(kSize, n.x - i)), builder.addColumn(empty));
            for (std::int32_t y = j; y < std::min(j + kSize, n.y); ++y) builder.addRow(row);
            tiles.push_back(builder.finish());
        }
    volume.columns = volume::ColumnVolume::fromTiles(n, std::move(tiles));
    return volume;
}

}  // namespace

Result<CityChanges> findCityChanges(const City& was, const City& is, int threads, const Progress* progress) {
    SVT_DO(checkComparable(was, is));
    return ChangeFinder(was, is, threads, progress).run();
}

std::vector<char> takeGeometry(volume::SemanticVolume& volume, const std::vector<std::string>& ids, bool areKept) {
    std::vector<volume::Label>& labels = volume.labels.labels;
    std::vector<char> isTaken(labels.size(), 0);
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        const bool isNamed = labels[l].parent != volume::kNoLabel
                                 ? isTaken[labels[l].parent] != (areKept ? 1 : 0)
                                 : std::binary_search(ids.begin(), ids.end(), labels[l].id);
        if (isNamed == areKept) continue;
        isTaken[l] = 1;
        labels[l].voxels = 0;
    }
    std::erase_if(volume.vectors.triangles, [&](const auto& triangle) { return isTaken[triangle.label] != 0; });
    return isTaken;
}

Result<PlaceStates> readPlace(const City& was, const City& is, const ChangedTiles& place) {
    PlaceStates states;
    if (!place.was.empty()) {
        SVT_TRY(before, readState(was, place.was));
        states.was = std::move(*before);
    }
    if (!place.is.empty()) {
        SVT_TRY(after, readState(is, place.is));
        states.is = std::move(*after);
    }
    if (place.was.empty()) states.was = emptyState(states.is);
    if (place.is.empty()) states.is = emptyState(states.was);
    return states;
}

}  // namespace svt::city

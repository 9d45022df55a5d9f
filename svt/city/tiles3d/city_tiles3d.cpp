#include <svt/city/city_tiles3d.hpp>

#include <svt/city/city_levels.hpp>
#include <svt/core/parallel.hpp>
#include <svt/writers/city_tileset.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace svt::city {
namespace {

using writers::TileContent;

/// The content of a square of the quadtree: tiles of detail 0 or 1, or the columns of a coarser one.
struct Square {
    writers::QuadtreeNode node;
    int detail = 0;
    std::vector<IndexEntry> tiles;
    std::array<double, 4> rectangle{};
};

/// The quadtree: its root is the least one of 1024 m or more whose quarters are the tiles of the city.
class CitySquares {
public:
    CitySquares(const City& city, int finest) : city_(city), finestDetail_(finest) {}

    Result<void> find() {
        SVT_TRY(entries, city_.find(0, kEverywhere));
        SVT_TRY(coarse, city_.find(1, kEverywhere));
        if (entries->empty()) return Error(Code::NothingSelected, "the city has no tiles");
        layOut(*entries);
        for (const IndexEntry& entry : finestDetail_ == 0 ? *entries : *coarse) add(entry, true);
        for (const IndexEntry& entry : *coarse) add(entry, false);
        return {};
    }

    [[nodiscard]] writers::CityTilesetFrame frame() const {
        writers::CityTilesetFrame frame;
        frame.corner = {double(west_), double(south_), city_.box().min.z};
        frame.side = std::ldexp(1, rootLevel_);
        frame.levels = rootLevel_ - finest_ + 1;
        frame.crsName = city_.crsName();
        return frame;
    }
    /// By level, the finest first, then row by row.
    [[nodiscard]] std::vector<Square> squares() const {
        std::vector<Square> result;
        for (const auto& [key, square] : squares_) result.push_back(square);
        return result;
    }

private:
    void layOut(const std::vector<IndexEntry>& entries) {
        std::int64_t east = INT64_MIN, north = INT64_MIN;
        west_ = south_ = INT64_MAX;
        for (const IndexEntry& entry : entries) {
            const std::int64_t side = std::int64_t{1} << entry.tile.level;
            west_ = std::min(west_, entry.tile.x * side);
            south_ = std::min(south_, entry.tile.y * side);
            east = std::max(east, (entry.tile.x + 1) * side);
            north = std::max(north, (entry.tile.y + 1) * side);
            finest_ = std::min(finest_, entry.tile.level);
        }
        constexpr std::int64_t kLargest = std::int64_t{1} << Plan::kTopLevel;
        west_ = floorTo(west_, kLargest);
        south_ = floorTo(south_, kLargest);
        while (std::int64_t{1} << rootLevel_ < std::max(east - west_, north - south_)) ++rootLevel_;
    }

    static std::int64_t floorTo(std::int64_t value, std::int64_t step) {
        return (value >= 0 ? value / step : -((-value + step - 1) / step)) * step;
    }

    // The finest detail, 1 at least, with at most 256 columns along a side of 2^level metres.
    [[nodiscard]] int detailOf(int level) const {
        int detail = 1;
        while (detail < city_.topDetail() && std::ldexp(1, level) > kLevelCells * spacingOf(detail, city_.spacing()).x)
            ++detail;
        return detail;
    }

    // The square of a tile, or a square around it.
    void add(const IndexEntry& entry, bool isOwn) {
        const std::int64_t side = std::int64_t{1} << entry.tile.level;
        const std::int64_t x = entry.tile.x * side - west_, y = entry.tile.y * side - south_;
        const int from = entry.tile.level + (isOwn ? 0 : 1), to = isOwn ? entry.tile.level : rootLevel_;
        for (int level = from; level <= to; ++level) {
            const writers::QuadtreeNode node{rootLevel_ - level, static_cast<std::uint32_t>(x >> level),
                                             static_cast<std::uint32_t>(y >> level)};
            Square& square = squares_[{level, node.y, node.x}];
            square.node = node;
            square.detail = isOwn ? finestDetail_ : detailOf(level);
            const double size = std::ldexp(1, level);
            const double west = double(west_) + node.x * size, south = double(south_) + node.y * size;
            square.rectangle = {west, south, west + size, south + size};
            if (square.detail < kFirstClassDetail) square.tiles.push_back(entry);
        }
    }

    const City& city_;
    int finestDetail_;
    std::int64_t west_ = 0, south_ = 0;
    int rootLevel_ = Plan::kTopLevel, finest_ = Plan::kTopLevel;
    std::map<std::array<std::int64_t, 3>, Square> squares_;
};

Result<std::vector<volume::SemanticVolume>> volumesOf(const City& city, const Square& square) {
    std::vector<volume::SemanticVolume> volumes;
    for (const IndexEntry& entry : square.tiles) {
        SVT_TRY(volume, city.read(entry));
        volumes.push_back(std::move(*volume));
    }
    if (square.detail < kFirstClassDetail) return volumes;
    Extract extract;
    extract.detail = square.detail;
    extract.hasBox = true;
    const auto& [west, south, east, north] = square.rectangle;
    extract.box = {west, south, city.box().min.z - 1000, east, north, city.box().max.z + 1000};
    auto volume = extractVolume(city, extract);
    // A building may stand over the border of its tile, so that no column has its middle here.
    if (!volume && volume.error().code() == Code::NothingSelected) return volumes;
    if (!volume) return volume.error();
    volumes.push_back(std::move(*volume));
    return volumes;
}

}  // namespace

Result<std::uint64_t> writeCityTiles(const City& city, const std::filesystem::path& path,
                                     const writers::VolumeWriteOptions& options, int finest, int threads,
                                     const Progress* progress) {
    CitySquares found(city, finest);
    SVT_DO(found.find());
    writers::CityTilesetFrame frame = found.frame();
    frame.source = path.filename().string();
    frame.write = options;
    frame.write.progress = progress;
    SVT_TRY(tileset, writers::CityTileset::create(path, frame));
    const std::vector<Square> squares = found.squares();
    const std::size_t batch = 2 * static_cast<std::size_t>(threads > 0 ? threads : hardwareThreads());
    ProgressCounter counter(progress, "tiles", squares.size());
    for (std::size_t begin = 0; begin < squares.size(); begin += batch) {
        const std::size_t count = std::min(batch, squares.size() - begin);
        std::vector<std::optional<Result<TileContent>>> made(count);
        parallelFor(count, 1, threads, [&](std::size_t from, std::size_t to) {
            for (std::size_t n = from; n < to; ++n) {
                const Square& square = squares[begin + n];
                const double error = square.detail == finest ? 0 : spacingOf(square.detail, city.spacing()).x;
                const auto volumes = volumesOf(city, square);
                made[n].emplace(volumes ? (*tileset)->make(*volumes, error) : Result<TileContent>(volumes.error()));
            }
        });
        for (std::size_t n = 0; n < count; ++n) {
            if (!*made[n]) return made[n]->error();
            SVT_DO((*tileset)->add(squares[begin + n].node, **made[n]));
            made[n].reset();
            counter.add();
        }
        if (Progress::isCancelled(progress)) return Error(Code::Cancelled, "stopped between tiles; nothing was left");
    }
    return (*tileset)->finish();
}

}  // namespace svt::city

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

constexpr int kFaceLevel = 11;  // squares of 2^11 m have the faces of their tiles, simplified; smaller ones nothing
constexpr double kMostColumns = 128;  // along the side of larger squares
constexpr double kFaceCubes = 256;    // along the side of a square with simplified faces

/// The content of a square of the quadtree: tiles, simplified to the spacing of the detail; or the columns of a coarse
/// detail.
struct Square {
    writers::QuadtreeNode node;
    int detail = 0;
    bool isOwn = false;  // of tiles, not around them
    std::vector<IndexEntry> tiles;
    std::array<double, 4> rectangle{};
};

/// The quadtree: its root is the least one of 1024 m or more whose quarters are the tiles of the city.
class CitySquares {
public:
    CitySquares(const City& city, int finest) : city_(city), finestDetail_(finest) {}

    Result<void> find() {
        SVT_TRY(entries, city_.find(0, kEverywhere));
        if (entries->empty()) return Error(Code::NothingSelected, "the city has no tiles");
        layOut(*entries);
        for (const IndexEntry& entry : *entries) add(entry, true);
        for (const IndexEntry& entry : *entries) add(entry, false);
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

    // The finest detail, 1 at least, with at most kMostColumns along a side of 2^level metres.
    [[nodiscard]] int detailOf(int level) const {
        int detail = 1;
        while (detail < city_.topDetail() && std::ldexp(1, level) > kMostColumns * spacingOf(detail, city_.spacing()).x)
            ++detail;
        return detail;
    }

    // The square of a tile, or a square around it.
    void add(const IndexEntry& entry, bool isOwn) {
        const std::int64_t side = std::int64_t{1} << entry.tile.level;
        const std::int64_t x = entry.tile.x * side - west_, y = entry.tile.y * side - south_;
        const int from = isOwn ? entry.tile.level : std::max(entry.tile.level + 1, kFaceLevel);
        const int to = isOwn ? entry.tile.level : rootLevel_;
        for (int level = from; level <= to; ++level) {
            const writers::QuadtreeNode node{rootLevel_ - level, static_cast<std::uint32_t>(x >> level),
                                             static_cast<std::uint32_t>(y >> level)};
            Square& square = squares_[{level, node.y, node.x}];
            square.node = node;
            square.detail = isOwn ? finestDetail_ : detailOf(level);
            square.isOwn = isOwn;
            const double size = std::ldexp(1, level);
            const double west = double(west_) + node.x * size, south = double(south_) + node.y * size;
            square.rectangle = {west, south, west + size, south + size};
            if (level <= kFaceLevel) square.tiles.push_back(entry);
        }
    }

    const City& city_;
    int finestDetail_;
    std::int64_t west_ = 0, south_ = 0;
    int rootLevel_ = Plan::kTopLevel, finest_ = Plan::kTopLevel;
    std::map<std::array<std::int64_t, 3>, Square> squares_;
};

// The columns of a coarse detail; nothing if there are none.
Result<std::optional<volume::SemanticVolume>> columnsOf(const City& city, const Square& square) {
    Extract extract;
    extract.detail = square.detail;
    extract.hasBox = true;
    const auto& [west, south, east, north] = square.rectangle;
    extract.box = {west, south, city.box().min.z - 1000, east, north, city.box().max.z + 1000};
    auto volume = extractVolume(city, extract);
    if (volume) return std::optional(std::move(*volume));
    // A building may stand over the border of its tile, so that no column has its middle here.
    if (volume.error().code() == Code::NothingSelected) return std::optional<volume::SemanticVolume>();
    return volume.error();
}

Result<TileContent> contentOf(const City& city, const Square& square, const writers::CityTileset& tileset) {
    const double spacing = spacingOf(square.detail, city.spacing()).x;
    std::size_t given = 0;
    if (square.tiles.empty())
        return tileset.make(
            [&]() -> Result<std::optional<volume::SemanticVolume>> {
                if (given++ > 0) return std::optional<volume::SemanticVolume>();
                return columnsOf(city, square);
            },
            spacing, 0);
    const double side = square.rectangle[2] - square.rectangle[0];
    const double coarse = std::max(side / kFaceCubes, 2 * city.spacing());
    const double cell = !square.isOwn ? coarse : square.detail > 0 ? spacing : 0;
    return tileset.make(
        [&]() -> Result<std::optional<volume::SemanticVolume>> {
            if (given == square.tiles.size()) return std::optional<volume::SemanticVolume>();
            SVT_TRY(volume, city.readWithMeshes(square.tiles[given++]));
            return std::optional(std::move(*volume));
        },
        square.isOwn ? 0 : cell, cell);
}

}  // namespace

Result<CityTilesReport> writeCityTiles(const City& city, const std::filesystem::path& path,
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
    CityTilesReport report;
    for (std::size_t begin = 0; begin < squares.size(); begin += batch) {
        const std::size_t count = std::min(batch, squares.size() - begin);
        std::vector<std::optional<Result<TileContent>>> made(count);
        parallelFor(count, 1, threads, [&](std::size_t from, std::size_t to) {
            for (std::size_t n = from; n < to; ++n) made[n].emplace(contentOf(city, squares[begin + n], **tileset));
        });
        for (std::size_t n = 0; n < count; ++n) {
            if (!*made[n]) return made[n]->error();
            if (squares[begin + n].isOwn) {
                ++report.tiles;
                report.voxelTiles += (*made[n])->hasVoxels ? 1 : 0;
            }
            SVT_DO((*tileset)->add(squares[begin + n].node, **made[n]));
            made[n].reset();
            counter.add();
        }
        if (Progress::isCancelled(progress)) return Error(Code::Cancelled, "stopped between tiles; nothing was left");
    }
    SVT_TRY(bytes, (*tileset)->finish());
    report.bytes = *bytes;
    return report;
}

}  // namespace svt::city

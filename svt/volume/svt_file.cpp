#include <svt/core/file.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/volume/zip_container.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

namespace svt::volume {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays of a .svt are used in place");
static_assert(sizeof(Run) == 8 && std::is_trivially_copyable_v<Run>, "runs are stored as {u32 end, u32 scalar}");

constexpr std::string_view kMimeType = "application/vnd.svt+zip";
constexpr std::string_view kMimeEntry = "mimetype";
constexpr std::size_t kMimeOffset = 38;  // 30 bytes of local header and the 8 of its name

Error bad(std::string message) { return Error(Code::BadVolume, std::move(message)); }

/// Counts that `columns/tiles` stores per tile; the height of the tile follows from the grid.
struct TileCounts {
    std::uint32_t rows = 0;     ///< distinct rows
    std::uint32_t columns = 0;  ///< distinct columns
    std::uint32_t runs = 0;
};
static_assert(sizeof(TileCounts) == 12);

// ---------------------------------------------------------------------------------------------- writing

Result<void> checkWritable(const SemanticVolume& volume) {
    const auto wrong = [](std::string message) { return Error(Code::BadArgument, std::move(message)); };
    const Vec3i grid = volume.grid.dimension();
    const Vec3i columns = volume.columns.dimension();
    if (grid != columns)
        return wrong(fmt::format("the grid has {} x {} x {} samples, the columns have {} x {} x {}", grid.x, grid.y,
                                 grid.z, columns.x, columns.y, columns.z));
    if (auto checked = checkLabels(volume.labels); !checked) return wrong(checked.error().message());
    const Scalar scalarCount = volume.labels.scalarCount();
    for (const ColumnTile& tile : volume.columns.tiles())
        for (const Run& run : tile.runs)
            if (run.scalar >= scalarCount) return wrong(fmt::format("scalar {} belongs to no label", run.scalar));
    return {};
}

// ---------------------------------------------------------------------------------------------- reading

/// What the views of an opened volume point into.
struct Storage {
    std::shared_ptr<const void> bytes;
    std::vector<std::vector<std::uint64_t>> copies;  // of arrays that stand unaligned
};

/// The entries of a file by name.
class Entries {
public:
    explicit Entries(std::vector<ZipEntry> entries) : entries_(std::move(entries)) {}

    /// Checked data of an entry. \return BadVolume where it is missing, BadChecksum where it is damaged
    [[nodiscard]] Result<std::span<const std::byte>> data(std::string_view name) const {
        for (const ZipEntry& entry : entries_) {
            if (entry.name != name) continue;
            if (auto checked = checkCrc(entry); !checked) return checked.error();
            return entry.data;
        }
        return bad(fmt::format("the entry '{}' is missing; the file is no complete .svt, build it again", name));
    }
    [[nodiscard]] Result<std::string_view> text(std::string_view name) const {
        const auto found = data(name);
        if (!found) return found.error();
        return std::string_view(reinterpret_cast<const char*>(found->data()), found->size());
    }
    /// Entries of other names: not used, but damage in them is told.
    [[nodiscard]] Result<void> checkOthers(std::span<const std::string_view> used) const {
        for (const ZipEntry& entry : entries_) {
            if (std::find(used.begin(), used.end(), entry.name) != used.end()) continue;
            if (auto checked = checkCrc(entry); !checked) return checked;
        }
        return {};
    }

private:
    std::vector<ZipEntry> entries_;
};

/// One array of all tiles, taken tile by tile from its entry.
template <class T>
class TileArray {
public:
    static Result<TileArray> open(const Entries& entries, std::string_view name, Storage& storage) {
        const auto data = entries.data(name);
        if (!data) return data.error();
        if (data->size() % sizeof(T) != 0)
            return bad(fmt::format("entry '{}' has {} bytes, no multiple of {}", name, data->size(), sizeof(T)));
        TileArray array;
        array.name_ = name;
        const std::byte* first = data->data();
        if (reinterpret_cast<std::uintptr_t>(first) % alignof(T) != 0) {
            auto& copy = storage.copies.emplace_back((data->size() + 7) / 8);
            std::memcpy(copy.data(), first, data->size());
            first = reinterpret_cast<const std::byte*>(copy.data());
        }
        array.rest_ = {reinterpret_cast<const T*>(first), data->size() / sizeof(T)};
        return array;
    }

    /// The next `count` elements as the view of a tile.
    Result<void> take(std::uint64_t count, std::span<const T>& view) {
        if (count > rest_.size())
            return bad(fmt::format("entry '{}' is shorter than the counts of the tiles say", name_));
        view = rest_.first(static_cast<std::size_t>(count));
        rest_ = rest_.subspan(static_cast<std::size_t>(count));
        return {};
    }
    [[nodiscard]] Result<void> checkEnd() const {
        if (rest_.empty()) return {};
        return bad(fmt::format("entry '{}' is longer than the counts of the tiles say", name_));
    }

private:
    std::string_view name_;
    std::span<const T> rest_;
};

constexpr std::string_view kTiles = "columns/tiles";
constexpr std::string_view kRowOf = "columns/row-of";
constexpr std::string_view kRowColumns = "columns/row-columns";
constexpr std::string_view kStarts = "columns/starts";
constexpr std::string_view kRuns = "columns/runs";
constexpr std::string_view kHeader = "svt.json";
constexpr std::string_view kLabels = "labels.json";
constexpr std::string_view kUsed[] = {kMimeEntry, kHeader, kLabels, kTiles, kRowOf, kRowColumns, kStarts, kRuns};

Result<ColumnVolume> readColumns(const Entries& entries, const SvtHeader& header,
                                 std::shared_ptr<const void> keepAlive) {
    auto storage = std::make_shared<Storage>();
    storage->bytes = std::move(keepAlive);
    auto counts = TileArray<TileCounts>::open(entries, kTiles, *storage);
    if (!counts) return counts.error();
    auto rowOf = TileArray<std::uint8_t>::open(entries, kRowOf, *storage);
    if (!rowOf) return rowOf.error();
    auto rowColumns = TileArray<std::uint16_t>::open(entries, kRowColumns, *storage);
    if (!rowColumns) return rowColumns.error();
    auto starts = TileArray<std::uint32_t>::open(entries, kStarts, *storage);
    if (!starts) return starts.error();
    auto runs = TileArray<Run>::open(entries, kRuns, *storage);
    if (!runs) return runs.error();

    constexpr std::int32_t kTile = ColumnVolume::kTileSize;
    const Vec3i dimension = header.grid.dimension();
    const std::int32_t tilesX = (dimension.x + kTile - 1) / kTile;
    const std::int32_t tilesY = (dimension.y + kTile - 1) / kTile;
    std::span<const TileCounts> tileCounts;
    if (auto taken = counts->take(std::uint64_t(tilesX) * std::uint64_t(tilesY), tileCounts); !taken)
        return taken.error();
    if (auto end = counts->checkEnd(); !end) return end.error();

    std::vector<ColumnTile> tiles(tileCounts.size());
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        const TileCounts& count = tileCounts[t];
        const auto x = static_cast<std::int32_t>(t % std::size_t(tilesX));
        const auto y = static_cast<std::int32_t>(t / std::size_t(tilesX));
        const auto width = static_cast<std::uint64_t>(std::min(kTile, dimension.x - x * kTile));
        const auto height = static_cast<std::uint64_t>(std::min(kTile, dimension.y - y * kTile));
        ColumnTile& tile = tiles[t];
        for (const auto& taken :
             {rowOf->take(height, tile.rowOf), rowColumns->take(width * count.rows, tile.rowColumns),
              starts->take(std::uint64_t{count.columns} + 1, tile.columnStart), runs->take(count.runs, tile.runs)})
            if (!taken) return bad(fmt::format("tile {}: {}", t, taken.error().message()));
    }
    for (const auto& end : {rowOf->checkEnd(), rowColumns->checkEnd(), starts->checkEnd(), runs->checkEnd()})
        if (!end) return end.error();
    return ColumnVolume::fromViews(dimension, std::move(tiles), header.scalarCount, std::move(storage));
}

Result<SemanticVolume> readEntries(std::span<const std::byte> bytes, std::shared_ptr<const void> keepAlive) {
    if (bytes.empty()) return bad("the file is empty");
    if (!looksLikeSvt(bytes))
        return bad(
            "this is no .svt: a ZIP whose first entry is 'mimetype' with 'application/vnd.svt+zip' is expected, "
            "and the file may be cut short. Build one from a model with 'svt build'.");
    auto found = readZip(bytes);
    if (!found) return found.error();
    const Entries entries(std::move(*found));
    const auto mime = entries.text(kMimeEntry);
    if (!mime) return mime.error();
    if (*mime != kMimeType) return bad("the entry 'mimetype' says something else than application/vnd.svt+zip");
    const auto headerText = entries.text(kHeader);
    if (!headerText) return headerText.error();
    auto header = readHeaderJson(*headerText);
    if (!header) return header.error();
    const auto labelsText = entries.text(kLabels);
    if (!labelsText) return labelsText.error();
    auto labels = readLabelsJson(*labelsText);
    if (!labels) return labels.error();
    if (labels->scalarCount() != header->scalarCount)
        return bad(fmt::format("svt.json speaks of {} scalars, the labels have {}", header->scalarCount,
                               labels->scalarCount()));
    auto columns = readColumns(entries, *header, std::move(keepAlive));
    if (!columns) return columns.error();
    if (auto others = entries.checkOthers(kUsed); !others) return others.error();
    return SemanticVolume{header->grid,
                          std::move(*labels),
                          std::move(*columns),
                          std::move(header->crsName),
                          std::move(header->modelName),
                          std::move(header->source)};
}

}  // namespace

bool looksLikeSvt(std::span<const std::byte> head) noexcept {
    constexpr std::string_view kLocalHeader("PK\3\4", 4);
    if (head.size() < kMimeOffset + kMimeType.size()) return false;
    const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
    return text.starts_with(kLocalHeader) && text.substr(30, 8) == kMimeEntry &&
           text.substr(kMimeOffset, kMimeType.size()) == kMimeType;
}

Result<std::uint64_t> writeSvt(const SemanticVolume& volume, const std::filesystem::path& path) {
    if (auto checked = checkWritable(volume); !checked) return checked.error();
    const std::string header = writeHeaderJson(volume);
    const std::string labels = writeLabelsJson(volume.labels);
    if (labels.size() > kMaxLabelsBytes)
        return Error(Code::BadArgument, fmt::format("the label table takes {} bytes as JSON, {} are possible",
                                                    labels.size(), kMaxLabelsBytes));
    const auto tiles = volume.columns.tiles();
    std::vector<TileCounts> counts;
    counts.reserve(tiles.size());
    std::vector<ZipSource> entries(std::size(kUsed));
    for (std::size_t e = 0; e < entries.size(); ++e) entries[e].name = kUsed[e];
    entries[0].isAligned = false;
    entries[0].parts = {std::as_bytes(std::span(kMimeType))};
    entries[1].parts = {std::as_bytes(std::span(header))};
    entries[2].parts = {std::as_bytes(std::span(labels))};
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        const ColumnTile& tile = tiles[t];
        const auto width =
            volume.columns.tileWidth(static_cast<std::int32_t>(t % std::size_t(volume.columns.tilesX())));
        counts.push_back({static_cast<std::uint32_t>(tile.rowColumns.size() / static_cast<std::size_t>(width)),
                          static_cast<std::uint32_t>(tile.columnStart.size() - 1),
                          static_cast<std::uint32_t>(tile.runs.size())});
        entries[4].parts.push_back(std::as_bytes(tile.rowOf));
        entries[5].parts.push_back(std::as_bytes(tile.rowColumns));
        entries[6].parts.push_back(std::as_bytes(tile.columnStart));
        entries[7].parts.push_back(std::as_bytes(tile.runs));
    }
    entries[3].parts = {std::as_bytes(std::span(counts))};
    return writeZip(path, entries);
}

Result<SemanticVolume> readSvt(std::span<const std::byte> bytes, std::shared_ptr<const void> keepAlive,
                               const std::string& name) {
    auto volume = readEntries(bytes, std::move(keepAlive));
    if (!volume) return Error(volume.error().code(), volume.error().message(), Place{name, 0, 0, {}});
    return volume;
}

Result<SemanticVolume> readSvt(const std::filesystem::path& path) {
    auto file = MappedFile::open(path);
    if (!file) return file.error();
    auto mapped = std::make_shared<const MappedFile>(std::move(*file));
    return readSvt(mapped->bytes(), mapped, path.string());
}

}  // namespace svt::volume

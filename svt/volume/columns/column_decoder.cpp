#include <svt/core/bytes.hpp>
#include <svt/volume/columns/column_codec.hpp>
#include <svt/volume/columns/column_dictionary.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::volume {
namespace {

/// Reads a stream. After a read beyond the end, or of a number over 32 bits, isGood() is false and all further reads
/// return 0.
class StreamReader {
public:
    StreamReader() = default;
    explicit StreamReader(std::span<const std::uint8_t> bytes) : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

    [[nodiscard]] bool isAtEnd() const noexcept { return at_ == end_; }
    [[nodiscard]] bool isGood() const noexcept { return isGood_; }

    std::uint32_t byte() noexcept {
        if (at_ == end_) return fail();
        return *at_++;
    }
    std::uint32_t number() noexcept {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 35; shift += 7) {
            if (at_ == end_) return fail();
            const std::uint8_t byte = *at_++;
            value |= std::uint64_t{byte & 0x7Fu} << shift;
            if (byte < 0x80) return value <= 0xFFFFFFFFu ? static_cast<std::uint32_t>(value) : fail();
        }
        return fail();
    }

private:
    std::uint32_t fail() noexcept {
        isGood_ = false;
        at_ = end_;
        return 0;
    }

    const std::uint8_t* at_ = nullptr;
    const std::uint8_t* end_ = nullptr;
    bool isGood_ = true;
};

/// Assembles a tile row by row.
class TileAssembly {
public:
    explicit TileAssembly(std::int32_t width) : builder_(width), row_(static_cast<std::size_t>(width)) {}

    /// Sets columns [begin, end) of the current row to `column` of the block.
    void set(std::size_t begin, std::size_t end, std::uint32_t column) {
        if (column >= localOf_.size()) localOf_.resize(std::max<std::size_t>(column + 1, 2 * localOf_.size()), 0);
        std::uint16_t& local = localOf_[column];
        if (local == 0) {
            columns_.push_back(column);
            local = static_cast<std::uint16_t>(columns_.size());  // 64 * 64 at most
        }
        std::fill(row_.begin() + static_cast<std::ptrdiff_t>(begin), row_.begin() + static_cast<std::ptrdiff_t>(end),
                  static_cast<std::uint16_t>(local - 1));
    }
    void endRow() { builder_.addRow(row_); }
    void repeatRow() { builder_.repeatRow(); }

    [[nodiscard]] ColumnTileBuilder& rows() noexcept { return builder_; }
    /// The columns of the tile in the order of first use, by their numbers in the block.
    [[nodiscard]] std::span<const std::uint32_t> columns() const noexcept { return columns_; }

private:
    ColumnTileBuilder builder_;
    std::vector<std::uint16_t> row_;
    std::vector<std::uint16_t> localOf_;  // column of the block -> 1 + number in the tile, 0: not used yet
    std::vector<std::uint32_t> columns_;
};

class BlockDecoder {
public:
    BlockDecoder(const PerStream<std::span<const std::uint8_t>>& streams, const BlockShape& shape, Scalar scalarCount,
                 std::uint64_t arrayBytes)
        : shape_(shape), scalarCount_(scalarCount), arrayBytes_(arrayBytes), bytesLeft_(arrayBytes) {
        for (std::size_t s = 0; s < kBlockStreams; ++s) readers_[s] = StreamReader(streams[s]);
    }

    Result<std::vector<ColumnTileData>> decode() {
        if (reader(BlockStream::Repeats).number() != 0) refuse("its first row repeats a row");
        for (std::int32_t tileY = 0; tileY < shape_.tilesY() && !reason_; ++tileY) decodeTileRow(tileY);
        for (const StreamReader& reader : readers_) {
            if (!reader.isAtEnd()) refuse("a stream is longer than the rows need");
            if (!reader.isGood()) reason_ = "a stream is too short, or a number in it too large";
        }
        if (repeats_ != kToTheEnd) refuse("rows are repeated beyond its end");
        if (reason_) return Error(Code::BadVolume, reason_);
        return std::move(tiles_);
    }

private:
    static constexpr std::uint32_t kToTheEnd = 0xFFFFFFFFu;  // value of repeats_ after the last coded row

    StreamReader& reader(BlockStream which) noexcept { return readers_[static_cast<std::size_t>(which)]; }

    /// Records the first error. Always returns false.
    bool refuse(const char* reason) noexcept {
        if (!reason_) reason_ = reason;
        return false;
    }

    void decodeTileRow(std::int32_t tileY) {
        std::vector<TileAssembly> assemblies;
        for (std::int32_t tileX = 0; tileX < shape_.tilesX(); ++tileX) assemblies.emplace_back(shape_.tileWidth(tileX));
        for (std::int32_t y = 0; y < shape_.tileHeight(tileY); ++y) {
            const bool isRepeated = repeats_ > 0;
            if (!isRepeated && !decodeRow()) return;
            if (isRepeated && repeats_ != kToTheEnd) --repeats_;
            if (isRepeated && y > 0)
                for (TileAssembly& assembly : assemblies) assembly.repeatRow();
            else
                spread(assemblies);
        }
        for (TileAssembly& assembly : assemblies)
            if (!finish(assembly)) return;
    }

    /// Decodes a row into above_, and how many times it is repeated into repeats_.
    bool decodeRow() {
        row_.clear();
        std::size_t upper = 0;
        std::uint32_t begin = 0;
        const auto width = static_cast<std::uint32_t>(shape_.width);
        while (begin < width) {
            const std::uint32_t operation = reader(BlockStream::Operations).byte();
            const std::uint32_t kind = operation % kOperationKinds;
            const std::uint32_t movement = operation / kOperationKinds;
            if (movement > 2 * kMaxShift + 1 || (kind == kInsert && movement != 0)) return refuse("unknown operation");
            Segment segment;
            if (kind < kReplace) upper += kind;
            if (kind != kInsert && upper >= above_.size())
                return refuse("a segment refers to a missing segment of the row above");
            if (kind < kReplace)
                segment.column = above_[upper].column;
            else if (!decodeColumn(upper, segment.column))
                return false;
            const std::int64_t end = kind == kInsert ? std::int64_t{begin} + 1 + reader(BlockStream::Widths).number()
                                     : movement == 0
                                         ? above_[upper].end + fromZigzag(reader(BlockStream::Shifts).number())
                                         : std::int64_t{above_[upper].end} + movement - (kMaxShift + 1);
            if (kind != kInsert) ++upper;
            if (end <= begin || end > width) return refuse("a segment reaches outside its row");
            begin = segment.end = static_cast<std::uint32_t>(end);
            row_.push_back(segment);
        }
        std::swap(row_, above_);
        StreamReader& repeats = reader(BlockStream::Repeats);
        repeats_ = repeats.isAtEnd() ? kToTheEnd : repeats.number();
        return true;
    }

    /// Decodes a new column, predicted from the last segment of the current row and segment `upper` of the row above.
    bool decodeColumn(std::size_t upper, std::uint32_t& number) {
        fresh_.clear();
        ReferenceColumn left, above;
        if (!row_.empty()) left.runs = dictionary_.column(row_.back().column);
        if (upper < above_.size()) above.runs = dictionary_.column(above_[upper].column);
        const auto top = static_cast<std::uint32_t>(shape_.nz);
        std::uint32_t height = 0;
        Scalar last = kNoScalar;
        while (height < top) {
            const std::uint32_t command = reader(BlockStream::Commands).byte();
            if (command >= kCopy) {
                if (!copyRuns(command - kCopy, (command - kCopy) % 2 == 0 ? left : above, height, last)) return false;
            } else if (command == kNewRun) {
                const Scalar scalar = reader(BlockStream::Scalars).number();
                const std::uint64_t end = std::uint64_t{height} + 1 + reader(BlockStream::Heights).number();
                if (end > top) return refuse("a run reaches beyond the top");
                if (scalar >= scalarCount_) return refuse("a scalar is in no label's range");
                if (scalar == last) return refuse("adjacent runs have one scalar");
                fresh_.push_back({static_cast<std::uint32_t>(end), scalar});
            } else if (!moveRun(command, left, above, height, last)) {
                return false;
            }
            height = fresh_.back().end;
            last = fresh_.back().scalar;
        }
        number = dictionary_.add(fresh_);
        // Each column of the block is used by at least one tile, so its runs count against the limit.
        if (std::uint64_t{dictionary_.runCount()} * sizeof(Run) > arrayBytes_)
            return refuse("its arrays take more bytes than the index states");
        return true;
    }

    bool copyRuns(std::uint32_t argument, ReferenceColumn& reference, std::uint32_t height, Scalar last) {
        const std::size_t first = reference.next(height, last);
        const std::size_t count =
            argument < 2 ? reference.runs.size() - std::min(first, reference.runs.size()) : argument / 2;
        if (count == 0 || count > reference.runs.size() || first > reference.runs.size() - count)
            return refuse("runs that do not exist are copied");
        const auto copied = reference.runs.subspan(first, count);
        fresh_.insert(fresh_.end(), copied.begin(), copied.end());
        return true;
    }

    bool moveRun(std::uint32_t command, ReferenceColumn& left, ReferenceColumn& above, std::uint32_t height,
                 Scalar last) {
        if (command >= kFirstUnused) return refuse("unknown command");
        const bool isLeft = command == kMoveLeft || (command >= kNearLeft && command < kNearAbove);
        ReferenceColumn& reference = isLeft ? left : above;
        const std::size_t run = reference.next(height, last);
        if (run >= reference.runs.size()) return refuse("a run that does not exist is moved");
        std::int64_t moved = 0;
        if (command < kNearLeft) {
            moved = fromZigzag(reader(BlockStream::Moves).number());
        } else {
            const std::uint32_t index = command - (isLeft ? kNearLeft : kNearAbove);
            moved = std::int64_t{index} - (index < 2 ? 2 : 1);
        }
        const std::int64_t end = reference.runs[run].end + moved;
        if (end <= height || end > shape_.nz) return refuse("a run ends below its begin or beyond the top");
        fresh_.push_back({static_cast<std::uint32_t>(end), reference.runs[run].scalar});
        return true;
    }

    /// Adds the last decoded row to each tile.
    void spread(std::vector<TileAssembly>& assemblies) {
        std::uint32_t begin = 0;
        for (const Segment& segment : above_) {
            while (begin < segment.end) {
                const std::uint32_t tileX = begin / ColumnVolume::kTileSize, base = tileX * ColumnVolume::kTileSize;
                const std::uint32_t end = std::min<std::uint32_t>(segment.end, base + ColumnVolume::kTileSize);
                assemblies[tileX].set(begin - base, end - base, segment.column);
                begin = end;
            }
        }
        for (TileAssembly& assembly : assemblies) assembly.endRow();
    }

    /// Appends the finished tile, with the runs of its columns.
    bool finish(TileAssembly& assembly) {
        ColumnTileData tile = assembly.rows().finish();
        tile.rowColumns.shrink_to_fit();
        const auto columns = assembly.columns();
        std::size_t runCount = 0;
        for (const std::uint32_t column : columns) runCount += dictionary_.column(column).size();
        const std::uint64_t bytes =
            arrayBytesOf(tile.view()) + columns.size() * sizeof(std::uint32_t) + std::uint64_t{runCount} * sizeof(Run);
        if (bytes > bytesLeft_) return refuse("its arrays take more bytes than the index states");
        bytesLeft_ -= bytes;
        tile.columnStart.reserve(columns.size() + 1);
        tile.runs.reserve(runCount);
        for (const std::uint32_t column : columns) {
            const auto runs = dictionary_.column(column);
            tile.runs.insert(tile.runs.end(), runs.begin(), runs.end());
            tile.columnStart.push_back(static_cast<std::uint32_t>(tile.runs.size()));
        }
        tiles_.push_back(std::move(tile));
        return true;
    }

    BlockShape shape_;
    Scalar scalarCount_;
    std::uint64_t arrayBytes_;
    std::uint64_t bytesLeft_;  // rest of arrayBytes_ for the remaining tiles
    PerStream<StreamReader> readers_;
    ColumnDictionary dictionary_;
    std::vector<Segment> row_, above_;  // the row being decoded, and the last decoded one
    std::vector<Run> fresh_;            // the column being decoded
    std::uint32_t repeats_ = 0;         // remaining repetitions of above_ before the next coded row
    std::vector<ColumnTileData> tiles_;
    const char* reason_ = nullptr;
};

}  // namespace

Result<std::vector<ColumnTileData>> decodeBlock(const PerStream<std::span<const std::uint8_t>>& streams,
                                                const BlockShape& shape, Scalar scalarCount, std::uint64_t arrayBytes) {
    return BlockDecoder(streams, shape, scalarCount, arrayBytes).decode();
}

}  // namespace svt::volume

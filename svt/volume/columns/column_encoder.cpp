#include <svt/core/bytes.hpp>
#include <svt/volume/columns/column_codec.hpp>
#include <svt/volume/columns/column_dictionary.hpp>

#include <algorithm>
#include <cstdlib>

namespace svt::volume {
namespace {

/// How many segments ahead to search for a column in the row above, and for an upper column in the current row.
constexpr std::size_t kLookAhead = 3;
static_assert(kLookAhead + 1 == kReplace, "kinds 0 to 3 leave out 0 to 3 segments");

class BlockEncoder {
public:
    BlockEncoder(std::span<const ColumnTile> tiles, const BlockShape& shape)
        : tiles_(tiles), shape_(shape), numbers_(tiles.size()) {
        for (std::size_t t = 0; t < tiles.size(); ++t) {
            numbers_[t].reserve(tiles[t].columnStart.size() - 1);
            for (std::uint32_t c = 0; c + 1 < tiles[t].columnStart.size(); ++c)
                numbers_[t].push_back(dictionary_.add(tiles[t].column(c)));
        }
    }

    BlockStreams encode() {
        std::uint32_t repeats = 0;
        for (std::int32_t y = 0; y < shape_.height; ++y) {
            if (y > 0 && (isRepeatOfRow(y) || (readRow(y), row_ == above_))) {
                ++repeats;
                continue;
            }
            if (y == 0) readRow(y);
            appendVarint(stream(BlockStream::Repeats), repeats);
            repeats = 0;
            encodeRow();
            std::swap(row_, above_);
        }
        return std::move(streams_);
    }

private:
    std::vector<std::uint8_t>& stream(BlockStream which) noexcept { return streams_[static_cast<std::size_t>(which)]; }

    /// Whether row y equals the row before according to the row numbers of all tiles.
    [[nodiscard]] bool isRepeatOfRow(std::int32_t y) const noexcept {
        const auto inTile = static_cast<std::size_t>(y % ColumnVolume::kTileSize);
        if (inTile == 0) return false;
        const auto first = static_cast<std::size_t>(y / ColumnVolume::kTileSize * shape_.tilesX());
        for (std::size_t t = first; t < first + static_cast<std::size_t>(shape_.tilesX()); ++t)
            if (tiles_[t].rowOf[inTile] != tiles_[t].rowOf[inTile - 1]) return false;
        return true;
    }

    /// Segments of row y across all tiles.
    void readRow(std::int32_t y) {
        row_.clear();
        for (std::int32_t tileX = 0; tileX < shape_.tilesX(); ++tileX) {
            const auto t = static_cast<std::size_t>(y / ColumnVolume::kTileSize * shape_.tilesX() + tileX);
            const auto width = static_cast<std::size_t>(shape_.tileWidth(tileX));
            const std::size_t number = tiles_[t].rowOf[static_cast<std::size_t>(y % ColumnVolume::kTileSize)];
            const auto columns = tiles_[t].rowColumns.subspan(number * width, width);
            const auto base = static_cast<std::uint32_t>(tileX * ColumnVolume::kTileSize);
            for (std::size_t x = 0; x < width;) {
                const std::uint16_t local = columns[x];
                do ++x;
                while (x < width && columns[x] == local);
                const std::uint32_t column = numbers_[t][local];
                if (!row_.empty() && row_.back().column == column)
                    row_.back().end = base + static_cast<std::uint32_t>(x);
                else
                    row_.push_back({base + static_cast<std::uint32_t>(x), column});
            }
        }
    }

    [[nodiscard]] std::span<const Run> columnOf(const std::vector<Segment>& row, std::size_t segment) const noexcept {
        return segment < row.size() ? dictionary_.column(row[segment].column) : std::span<const Run>{};
    }

    void encodeRow() {
        std::size_t upper = 0;
        std::uint32_t begin = 0;
        for (std::size_t s = 0; s < row_.size(); ++s) {
            const Segment& segment = row_[s];
            std::uint32_t kind = kReplace;
            for (std::uint32_t skipped = 0; skipped <= kLookAhead && kind == kReplace; ++skipped)
                if (upper + skipped < above_.size() && above_[upper + skipped].column == segment.column) kind = skipped;
            if (kind < kReplace) {
                upper += kind;
            } else {
                if (upper >= above_.size() || reappearsSoon(s, above_[upper].column)) kind = kInsert;
                encodeColumn(dictionary_.column(segment.column), s > 0 ? columnOf(row_, s - 1) : std::span<const Run>{},
                             columnOf(above_, upper));
            }
            std::uint32_t movement = 0;
            if (kind == kInsert) {
                appendVarint(stream(BlockStream::Widths), segment.end - begin - 1);
            } else {
                const auto shift =
                    static_cast<std::int32_t>(segment.end) - static_cast<std::int32_t>(above_[upper++].end);
                if (std::abs(shift) <= kMaxShift)
                    movement = static_cast<std::uint32_t>(shift + kMaxShift + 1);
                else
                    appendVarint(stream(BlockStream::Shifts), zigzag(shift));
            }
            stream(BlockStream::Operations).push_back(static_cast<std::uint8_t>(kind + kOperationKinds * movement));
            begin = segment.end;
        }
    }

    /// Whether one of the next segments of the current row has `column`; then the current segment is an insertion.
    [[nodiscard]] bool reappearsSoon(std::size_t segment, std::uint32_t column) const noexcept {
        for (std::size_t s = segment + 1; s < row_.size() && s <= segment + kLookAhead; ++s)
            if (row_[s].column == column) return true;
        return false;
    }

    void encodeColumn(std::span<const Run> runs, std::span<const Run> leftRuns, std::span<const Run> aboveRuns) {
        ReferenceColumn left{leftRuns}, above{aboveRuns};
        std::uint32_t height = 0;
        Scalar last = kNoScalar;
        for (std::size_t r = 0; r < runs.size();) {
            const std::size_t inLeft = left.next(height, last);
            const std::size_t inAbove = above.next(height, last);
            const std::size_t fromLeft = commonRuns(runs.subspan(r), leftRuns, inLeft);
            const std::size_t fromAbove =
                r + fromLeft == runs.size() ? 0 : commonRuns(runs.subspan(r), aboveRuns, inAbove);
            if (const std::size_t count = std::max(fromLeft, fromAbove); count > 0) {
                const auto number = static_cast<std::uint32_t>(r + count == runs.size() ? 0 : count);
                stream(BlockStream::Commands)
                    .push_back(static_cast<std::uint8_t>(kCopy + 2 * number + (fromAbove > fromLeft ? 1 : 0)));
                r += count;
            } else {
                if (inLeft < leftRuns.size() && leftRuns[inLeft].scalar == runs[r].scalar)
                    encodeMove(runs[r].end, leftRuns[inLeft].end, kNearLeft, kMoveLeft);
                else if (inAbove < aboveRuns.size() && aboveRuns[inAbove].scalar == runs[r].scalar)
                    encodeMove(runs[r].end, aboveRuns[inAbove].end, kNearAbove, kMoveAbove);
                else
                    encodeNewRun(runs[r], height);
                ++r;
            }
            height = runs[r - 1].end;
            last = runs[r - 1].scalar;
        }
    }

    /// Count of runs that can be copied starting at `from`; at most kMaxCopy unless they reach the top.
    static std::size_t commonRuns(std::span<const Run> runs, std::span<const Run> reference,
                                  std::size_t from) noexcept {
        std::size_t count = 0;
        while (count < runs.size() && from + count < reference.size() && runs[count] == reference[from + count])
            ++count;
        return count == runs.size() ? count : std::min<std::size_t>(count, kMaxCopy);
    }

    void encodeMove(std::uint32_t end, std::uint32_t reference, std::uint32_t near, std::uint32_t far) {
        const std::int32_t moved = static_cast<std::int32_t>(end) - static_cast<std::int32_t>(reference);
        if (std::abs(moved) <= 2) {  // never 0, since the run would have been copied
            const std::int32_t index = moved < 0 ? moved + 2 : moved + 1;
            stream(BlockStream::Commands)
                .push_back(static_cast<std::uint8_t>(near + static_cast<std::uint32_t>(index)));
        } else {
            stream(BlockStream::Commands).push_back(static_cast<std::uint8_t>(far));
            appendVarint(stream(BlockStream::Moves), zigzag(moved));
        }
    }

    void encodeNewRun(const Run& run, std::uint32_t height) {
        stream(BlockStream::Commands).push_back(static_cast<std::uint8_t>(kNewRun));
        appendVarint(stream(BlockStream::Scalars), run.scalar);
        appendVarint(stream(BlockStream::Heights), run.end - height - 1);
    }

    std::span<const ColumnTile> tiles_;
    BlockShape shape_;
    ColumnDictionary dictionary_;
    std::vector<std::vector<std::uint32_t>> numbers_;  // per tile: its columns in the dictionary
    std::vector<Segment> row_, above_;
    BlockStreams streams_;
};

}  // namespace

BlockStreams encodeBlock(std::span<const ColumnTile> tiles, const BlockShape& shape) {
    return BlockEncoder(tiles, shape).encode();
}

}  // namespace svt::volume

#include <svt/illustrate/shell/enclosed_air.hpp>

#include <svt/core/parallel.hpp>

#include <algorithm>
#include <numeric>

namespace svt::illustrate {
namespace {

using volume::ColumnTile;
using volume::ColumnVolume;
using volume::Run;

// Joins two values of the surroundings of background: 0 (unknown), a group, or kNoGroupValue (several groups, or the
// outside).
std::uint32_t joined(std::uint32_t a, std::uint32_t b) noexcept {
    return a == 0 ? b : b == 0 || a == b ? a : kNoGroupValue;
}

// Union-find; each set stores the group that surrounds it. The smaller number becomes the root.
class AirParts {
public:
    explicit AirParts(std::size_t count = 0) : parent_(count), around_(count, 0) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    std::uint32_t add() {
        parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
        around_.push_back(0);
        return parent_.back();
    }
    std::uint32_t root(std::uint32_t part) {
        while (parent_[part] != part) part = parent_[part] = parent_[parent_[part]];
        return part;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        if (a == b) return;
        if (b < a) std::swap(a, b);
        parent_[b] = a;
        around_[a] = joined(around_[a], around_[b]);
    }
    void note(std::uint32_t part, std::uint32_t value) {
        const std::uint32_t r = root(part);
        around_[r] = joined(around_[r], value);
    }
    [[nodiscard]] std::uint32_t around(std::uint32_t part) { return around_[root(part)]; }
    [[nodiscard]] std::size_t size() const noexcept { return parent_.size(); }

private:
    std::vector<std::uint32_t> parent_, around_;
};

// Joins the background of two adjacent columns, and records what surrounds it.
template <class PartOfA, class PartOfB>
void joinColumns(std::span<const Run> a, PartOfA partOfA, std::span<const Run> b, PartOfB partOfB,
                 std::span<const std::uint32_t> valueOfScalar, AirParts& parts) {
    std::uint32_t airA = 0, airB = 0;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        const std::uint32_t valueA = valueOfScalar[a[i].scalar], valueB = valueOfScalar[b[j].scalar];
        if (valueA == 0 && valueB == 0)
            parts.join(partOfA(airA), partOfB(airB));
        else if (valueA == 0)
            parts.note(partOfA(airA), valueB);
        else if (valueB == 0)
            parts.note(partOfB(airB), valueA);
        const std::uint32_t endA = a[i].end, endB = b[j].end;
        if (endA <= endB) {
            airA += valueA == 0 ? 1 : 0;
            ++i;
        }
        if (endB <= endA) {
            airB += valueB == 0 ? 1 : 0;
            ++j;
        }
    }
}

}  // namespace

// The nodes of one tile, joined within the tile to parts, which are numbered in the order of their first nodes.
class EnclosedAir::TileScan {
public:
    TileScan(const ColumnVolume& columns, std::size_t t, std::span<const std::uint32_t> valueOfScalar)
        : tile_(columns.tiles()[t]), valueOfScalar_(valueOfScalar) {
        tileX_ = static_cast<std::int32_t>(t % std::size_t(columns.tilesX()));
        tileY_ = static_cast<std::int32_t>(t / std::size_t(columns.tilesX()));
        isLastX_ = tileX_ + 1 == columns.tilesX();
        isLastY_ = tileY_ + 1 == columns.tilesY();
        out_.width = static_cast<std::size_t>(columns.tileWidth(tileX_));
    }

    void run() {
        std::uint8_t stretch = 0;
        for (std::size_t y = 0; y < tile_.rowOf.size(); ++y) {
            const bool isNew = y == 0 || tile_.rowOf[y] != tile_.rowOf[y - 1];
            if (isNew && y != 0) ++stretch;
            out_.stretchOfRow.push_back(stretch);
            if (isNew) addStretch(y);
            // Only the border row itself needs to be marked: rows of a stretch share their nodes.
            if ((y == 0 && tileY_ == 0) || (y + 1 == tile_.rowOf.size() && isLastY_)) markRowOutside(y);
        }
        number();
    }

    [[nodiscard]] std::span<const Run> column(std::size_t x, std::size_t y) const {
        return tile_.column(tile_.rowColumns[tile_.rowOf[y] * out_.width + x]);
    }
    [[nodiscard]] std::uint32_t firstNode(std::size_t x, std::size_t y) const {
        return out_.firstNode[x + out_.width * out_.stretchOfRow[y]];
    }
    [[nodiscard]] std::size_t width() const { return out_.width; }
    [[nodiscard]] std::size_t height() const { return tile_.rowOf.size(); }

    Tile out_;
    std::vector<std::uint32_t> partOfNode;
    std::vector<std::uint32_t> around;  // per part

private:
    void addStretch(std::size_t y) {
        for (std::size_t x = 0; x < out_.width; ++x) {
            const auto runs = column(x, y);
            const bool isAsBefore = x > 0 && runs.data() == column(x - 1, y).data();
            out_.firstNode.push_back(isAsBefore ? out_.firstNode.back() : addCell(runs));
            const bool isBorder = (x == 0 && tileX_ == 0) || (x + 1 == out_.width && isLastX_);
            if (isBorder) markOutside(runs, out_.firstNode.back());
            if (x > 0 && !isAsBefore) join(x - 1, y, x, y);
            if (y > 0) {
                const bool isJoined = isAsBefore && firstNode(x - 1, y - 1) == firstNode(x, y - 1);
                if (!isJoined) join(x, y - 1, x, y);
            }
        }
    }

    std::uint32_t addCell(std::span<const Run> runs) {
        const auto first = static_cast<std::uint32_t>(parts_.size());
        for (std::size_t r = 0; r < runs.size(); ++r) {
            if (valueOfScalar_[runs[r].scalar] != 0) continue;
            const std::uint32_t node = parts_.add();
            parts_.note(node, r == 0 ? kNoGroupValue : valueOfScalar_[runs[r - 1].scalar]);
            parts_.note(node, r + 1 == runs.size() ? kNoGroupValue : valueOfScalar_[runs[r + 1].scalar]);
        }
        return first;
    }

    void join(std::size_t xa, std::size_t ya, std::size_t xb, std::size_t yb) {
        const std::uint32_t a = firstNode(xa, ya), b = firstNode(xb, yb);
        joinColumns(
            column(xa, ya), [&](std::uint32_t air) { return a + air; }, column(xb, yb),
            [&](std::uint32_t air) { return b + air; }, valueOfScalar_, parts_);
    }

    void markOutside(std::span<const Run> runs, std::uint32_t first) {
        for (const Run& r : runs)
            if (valueOfScalar_[r.scalar] == 0) parts_.note(first++, kNoGroupValue);
    }

    void markRowOutside(std::size_t y) {
        for (std::size_t x = 0; x < out_.width; ++x) markOutside(column(x, y), firstNode(x, y));
    }

    void number() {
        partOfNode.resize(parts_.size());
        for (std::uint32_t node = 0; node < partOfNode.size(); ++node) {
            const std::uint32_t root = parts_.root(node);
            if (root == node) {
                partOfNode[node] = static_cast<std::uint32_t>(around.size());
                around.push_back(parts_.around(node));
            } else {
                partOfNode[node] = partOfNode[root];
            }
        }
        parts_ = AirParts();
    }

    const ColumnTile& tile_;
    std::span<const std::uint32_t> valueOfScalar_;
    std::int32_t tileX_ = 0, tileY_ = 0;
    bool isLastX_ = false, isLastY_ = false;
    AirParts parts_;
};

EnclosedAir EnclosedAir::none(const ColumnVolume& columns) {
    EnclosedAir air;
    air.tiles_.resize(columns.tiles().size());
    return air;
}

EnclosedAir EnclosedAir::find(const ColumnVolume& columns, std::span<const std::uint32_t> valueOfScalar, int threads) {
    const std::size_t tileCount = columns.tiles().size(), tilesX = std::size_t(columns.tilesX());
    std::vector<TileScan> scans;
    scans.reserve(tileCount);
    for (std::size_t t = 0; t < tileCount; ++t) scans.emplace_back(columns, t, valueOfScalar);
    parallelFor(tileCount, 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) scans[t].run();
    });

    // Join across the borders of tiles.
    std::vector<std::uint32_t> base(tileCount + 1, 0);
    for (std::size_t t = 0; t < tileCount; ++t)
        base[t + 1] = base[t] + static_cast<std::uint32_t>(scans[t].around.size());
    AirParts parts(base.back());
    for (std::size_t t = 0; t < tileCount; ++t)
        for (std::size_t p = 0; p < scans[t].around.size(); ++p)
            parts.note(base[t] + static_cast<std::uint32_t>(p), scans[t].around[p]);
    const auto join = [&](std::size_t ta, std::size_t xa, std::size_t ya, std::size_t tb, std::size_t xb,
                          std::size_t yb) {
        const std::uint32_t a = scans[ta].firstNode(xa, ya), b = scans[tb].firstNode(xb, yb);
        joinColumns(
            scans[ta].column(xa, ya), [&](std::uint32_t air) { return base[ta] + scans[ta].partOfNode[a + air]; },
            scans[tb].column(xb, yb), [&](std::uint32_t air) { return base[tb] + scans[tb].partOfNode[b + air]; },
            valueOfScalar, parts);
    };
    for (std::size_t t = 0; t < tileCount; ++t) {
        if ((t + 1) % tilesX != 0)
            for (std::size_t y = 0; y < scans[t].height(); ++y) join(t, scans[t].width() - 1, y, t + 1, 0, y);
        if (t + tilesX < tileCount)
            for (std::size_t x = 0; x < scans[t].width(); ++x) join(t, x, scans[t].height() - 1, t + tilesX, x, 0);
    }

    EnclosedAir air;
    for (std::size_t t = 0; t < tileCount; ++t) {
        Tile tile = std::move(scans[t].out_);
        bool isAny = false;
        for (const std::uint32_t part : scans[t].partOfNode) {
            const std::uint32_t around = parts.around(base[t] + part);
            tile.valueOfNode.push_back(around == kNoGroupValue ? 0 : around);
            isAny = isAny || tile.valueOfNode.back() != 0;
        }
        if (!isAny) tile = {};
        air.tiles_.push_back(std::move(tile));
    }
    return air;
}

}  // namespace svt::illustrate

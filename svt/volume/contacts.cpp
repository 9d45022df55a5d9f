#include <svt/volume/contacts.hpp>

#include <svt/core/parallel.hpp>

#include <algorithm>
#include <unordered_map>

namespace svt::volume {
namespace {

// Contacts of one tile: within it, and across its upper borders.
class TileContacts {
public:
    TileContacts(const ColumnVolume& columns, std::span<const std::uint32_t> labelOfScalar)
        : columns_(columns), labelOfScalar_(labelOfScalar) {}

    std::vector<Contact> find(std::size_t t) {
        faces_.clear();
        const auto tileX = static_cast<std::int32_t>(t % std::size_t(columns_.tilesX()));
        const auto tileY = static_cast<std::int32_t>(t / std::size_t(columns_.tilesX()));
        const ColumnTile& tile = columns_.tiles()[t];
        const auto width = static_cast<std::size_t>(columns_.tileWidth(tileX));
        addWithinRows(tile, width);
        addBetweenRows(tile, width);
        if (tileX + 1 < columns_.tilesX())
            addRight(tile, width, columns_.tiles()[t + 1], std::size_t(columns_.tileWidth(tileX + 1)));
        if (tileY + 1 < columns_.tilesY()) addAbove(tile, width, columns_.tiles()[t + std::size_t(columns_.tilesX())]);
        std::vector<Contact> found;
        for (const auto& [key, faces] : faces_)
            found.push_back({static_cast<std::uint32_t>(key >> 32), static_cast<std::uint32_t>(key), faces});
        return found;
    }

private:
    [[nodiscard]] std::uint32_t labelOf(Scalar scalar) const noexcept {
        return scalar < labelOfScalar_.size() ? labelOfScalar_[scalar] : kNoLabel;
    }

    void add(Scalar s, Scalar t, std::size_t axis, std::uint64_t count) {
        const std::uint32_t a = labelOf(s), b = labelOf(t);
        if (a == b || a == kNoLabel || b == kNoLabel) return;
        faces_[std::uint64_t(std::min(a, b)) << 32 | std::max(a, b)][axis] += count;
    }

    // Faces between two columns side by side, `weight` times.
    void addPair(std::span<const Run> a, std::span<const Run> b, std::size_t axis, std::uint64_t weight) {
        std::uint32_t begin = 0;
        for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
            const std::uint32_t end = std::min(a[i].end, b[j].end);
            if (a[i].scalar != b[j].scalar) add(a[i].scalar, b[j].scalar, axis, weight * (end - begin));
            begin = end;
            i += a[i].end == end ? 1 : 0;
            j += b[j].end == end ? 1 : 0;
        }
    }

    // Along z, and along x between the columns of a row; each distinct row once for all its uses.
    void addWithinRows(const ColumnTile& tile, std::size_t width) {
        std::vector<std::uint64_t> rowUses(tile.rowColumns.size() / width, 0);
        for (const std::uint8_t row : tile.rowOf) ++rowUses[row];
        std::vector<std::uint64_t> uses(tile.columnStart.size() - 1, 0);
        for (std::size_t e = 0; e < tile.rowColumns.size(); ++e) {
            uses[tile.rowColumns[e]] += rowUses[e / width];
            if (e % width + 1 < width && tile.rowColumns[e] != tile.rowColumns[e + 1])
                addPair(tile.column(tile.rowColumns[e]), tile.column(tile.rowColumns[e + 1]), 0, rowUses[e / width]);
        }
        for (std::size_t c = 0; c < uses.size(); ++c) {
            const auto runs = tile.column(static_cast<std::uint32_t>(c));
            for (std::size_t r = 0; r + 1 < runs.size(); ++r) add(runs[r].scalar, runs[r + 1].scalar, 2, uses[c]);
        }
    }

    void addBetweenRows(const ColumnTile& tile, std::size_t width) {
        for (std::size_t y = 0; y + 1 < tile.rowOf.size(); ++y)
            if (tile.rowOf[y] != tile.rowOf[y + 1])
                addRows(tile, tile.rowOf[y] * width, tile, tile.rowOf[y + 1] * width, width);
    }

    void addRows(const ColumnTile& a, std::size_t rowA, const ColumnTile& b, std::size_t rowB, std::size_t width) {
        for (std::size_t x = 0; x < width;) {
            const std::uint16_t columnA = a.rowColumns[rowA + x], columnB = b.rowColumns[rowB + x];
            std::size_t end = x + 1;
            while (end < width && a.rowColumns[rowA + end] == columnA && b.rowColumns[rowB + end] == columnB) ++end;
            addPair(a.column(columnA), b.column(columnB), 1, end - x);
            x = end;
        }
    }

    void addRight(const ColumnTile& tile, std::size_t width, const ColumnTile& right, std::size_t rightWidth) {
        for (std::size_t y = 0; y < tile.rowOf.size();) {
            std::size_t end = y + 1;
            while (end < tile.rowOf.size() && tile.rowOf[end] == tile.rowOf[y] && right.rowOf[end] == right.rowOf[y])
                ++end;
            addPair(tile.column(tile.rowColumns[tile.rowOf[y] * width + width - 1]),
                    right.column(right.rowColumns[right.rowOf[y] * rightWidth]), 0, end - y);
            y = end;
        }
    }

    void addAbove(const ColumnTile& tile, std::size_t width, const ColumnTile& above) {
        addRows(tile, tile.rowOf.back() * width, above, above.rowOf.front() * width, width);
    }

    const ColumnVolume& columns_;
    std::span<const std::uint32_t> labelOfScalar_;
    std::unordered_map<std::uint64_t, std::array<std::uint64_t, 3>> faces_;
};

}  // namespace

std::vector<Contact> labelContacts(const ColumnVolume& columns, std::span<const std::uint32_t> labelOfScalar,
                                   int threads) {
    std::vector<std::vector<Contact>> ofTile(columns.tiles().size());
    parallelFor(ofTile.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        TileContacts contacts(columns, labelOfScalar);
        for (std::size_t t = begin; t < end; ++t) ofTile[t] = contacts.find(t);
    });
    std::vector<Contact> all;
    for (const auto& found : ofTile) all.insert(all.end(), found.begin(), found.end());
    std::sort(all.begin(), all.end(),
              [](const Contact& s, const Contact& t) { return s.a != t.a ? s.a < t.a : s.b < t.b; });
    std::size_t count = 0;
    for (const Contact& contact : all) {
        if (count != 0 && all[count - 1].a == contact.a && all[count - 1].b == contact.b)
            for (std::size_t axis = 0; axis < 3; ++axis) all[count - 1].faces[axis] += contact.faces[axis];
        else
            all[count++] = contact;
    }
    all.resize(count);
    return all;
}

}  // namespace svt::volume

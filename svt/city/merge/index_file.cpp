#include <svt/city/merge/index_file.hpp>

#include <svt/city/base/sha256.hpp>
#include <svt/city/city_levels.hpp>
#include <svt/core/bytes.hpp>

#include <algorithm>
#include <tuple>

namespace svt::city {
namespace {

constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kRefsOfPage = 290;

void appendSigned(std::string& to, std::int64_t value) { appendVarint(to, zigzag(value)); }
std::int64_t takeSigned(ByteReader& from) { return fromZigzag(from.takeVarint()); }

// The tile of a level whose south-western corner has this Morton number.
TileKey tileOf(std::uint64_t morton, int level) {
    const auto gather = [](std::uint64_t v) {
        v &= 0x5555555555555555ull;
        v = (v | v >> 1) & 0x3333333333333333ull;
        v = (v | v >> 2) & 0x0F0F0F0F0F0F0F0Full;
        v = (v | v >> 4) & 0x00FF00FF00FF00FFull;
        v = (v | v >> 8) & 0x0000FFFF0000FFFFull;
        return (v | v >> 16) & 0xFFFFFFFFull;
    };
    const auto cell = [&](std::uint64_t metres) {
        return static_cast<std::int32_t>((static_cast<std::int64_t>(metres) - (std::int64_t{1} << 31)) >> level);
    };
    return {level, cell(gather(morton)), cell(gather(morton >> 1))};
}

void appendEntry(std::string& to, const IndexEntry& entry, const IndexEntry& before, bool isFirst) {
    appendVarint(to, mortonOf(entry.tile) - (isFirst ? 0 : mortonOf(before.tile)));
    appendVarint(to, static_cast<std::uint64_t>(entry.tile.level));
    appendSigned(to, std::int64_t{entry.pack} - (isFirst ? 0 : std::int64_t{before.pack}));
    appendVarint(to, entry.offset / 8);
    appendVarint(to, entry.size);
    appendSigned(to, entry.lowest);
    appendVarint(to, static_cast<std::uint64_t>(entry.highest - entry.lowest));
    appendVarint(to, entry.buildings);
}

// Rectangle of samples: the corner relative to that of the entry before, and the size.
void appendRectangle(std::string& to, const std::array<std::int32_t, 4>& own,
                     const std::array<std::int32_t, 4>& before) {
    appendSigned(to, std::int64_t{own[0]} - before[0]);
    appendSigned(to, std::int64_t{own[1]} - before[1]);
    appendVarint(to, static_cast<std::uint64_t>(std::int64_t{own[2]} - own[0]));
    appendVarint(to, static_cast<std::uint64_t>(std::int64_t{own[3]} - own[1]));
}

// \return whether it can be one
bool takeRectangle(ByteReader& from, const std::array<std::int32_t, 4>& before, std::array<std::int32_t, 4>& own) {
    const std::array<std::int64_t, 2> low{before[0] + takeSigned(from), before[1] + takeSigned(from)};
    for (const std::size_t axis : {0u, 1u}) {
        const std::uint64_t size = from.takeVarint();
        constexpr std::int64_t kMost = 2'147'483'647;
        if (low[axis] < -kMost || low[axis] > kMost || size > kMost || low[axis] + std::int64_t(size) > kMost)
            return false;
        own[axis] = static_cast<std::int32_t>(low[axis]);
        own[axis + 2] = static_cast<std::int32_t>(low[axis] + std::int64_t(size));
    }
    return true;
}

void appendRef(std::string& to, const PageRef& ref) {
    appendAs<std::uint8_t>(to, ref.detail, ref.isLeaf ? 0 : 1, 0, 0);
    appendBytes(to, ref.size, ref.offset, ref.rectangle, ref.lowest, ref.highest, ref.members, ref.checksum);
}

// \param below  content of a page with one reference or entry
void widen(PageRef& ref, const PageRef& below, bool isFirst) {
    if (isFirst) {
        ref.rectangle = below.rectangle;
        ref.lowest = below.lowest;
        ref.highest = below.highest;
    }
    for (const std::size_t n : {0u, 1u}) ref.rectangle[n] = std::min(ref.rectangle[n], below.rectangle[n]);
    for (const std::size_t n : {2u, 3u}) ref.rectangle[n] = std::max(ref.rectangle[n], below.rectangle[n]);
    ref.lowest = std::min(ref.lowest, below.lowest);
    ref.highest = std::max(ref.highest, below.highest);
    ref.members += below.members;
}

// Pages, one after the other, with offsets from the start of the first.
struct Pages {
    std::string bytes;
    std::vector<PageRef> refs;

    void add(PageRef ref, const std::string& page) {
        ref.offset = bytes.size();
        ref.size = static_cast<std::uint32_t>(page.size());
        ref.checksum = idHash(page);
        refs.push_back(ref);
        bytes += page;
    }
};

void addLeaves(const std::vector<PlacedEntry>& entries, Pages& pages) {
    for (std::size_t begin = 0; begin < entries.size();) {
        PageRef ref;
        ref.detail = entries[begin].entry.detail;
        std::string rows, rectangles;
        std::array<std::int32_t, 4> before{};
        std::size_t end = begin;
        for (; end < entries.size() && entries[end].entry.detail == ref.detail &&
               rows.size() + rectangles.size() < kIndexPage - 120;
             ++end) {
            appendEntry(rows, entries[end].entry, entries[end == begin ? begin : end - 1].entry, end == begin);
            appendRectangle(rectangles, entries[end].rectangle, before);
            before = entries[end].rectangle;
            PageRef own;
            own.rectangle = entries[end].rectangle;
            own.lowest = entries[end].entry.lowest;
            own.highest = entries[end].entry.highest;
            own.members = entries[end].entry.size;
            widen(ref, own, end == begin);
        }
        std::string page;
        appendAs<std::uint8_t>(page, ref.detail, 0);
        appendAs<std::uint16_t>(page, end - begin);
        pages.add(ref, page + rows + rectangles);
        begin = end;
    }
}

// Pages of references, until the rest fits into the root.
void addInner(Pages& pages) {
    while (pages.refs.size() > kRefsOfPage) {
        const std::vector<PageRef> below = std::move(pages.refs);
        pages.refs.clear();
        for (std::size_t begin = 0; begin < below.size();) {
            PageRef ref;
            ref.detail = below[begin].detail;
            ref.isLeaf = false;
            std::string page;
            std::size_t end = begin;
            for (; end < below.size() && end - begin < kRefsOfPage && below[end].detail == ref.detail; ++end) {
                appendRef(page, below[end]);
                widen(ref, below[end], end == begin);
            }
            pages.add(ref, page);
            begin = end;
        }
    }
}

}  // namespace

std::string indexBytes(std::vector<PlacedEntry> entries) {
    const auto key = [](const PlacedEntry& e) {
        return std::tuple(-e.entry.detail, mortonOf(e.entry.tile), e.entry.tile.level);
    };
    std::sort(entries.begin(), entries.end(),
              [&](const PlacedEntry& a, const PlacedEntry& b) { return key(a) < key(b); });
    Pages pages;
    addLeaves(entries, pages);
    addInner(pages);
    std::string root;
    for (const PageRef& ref : pages.refs) appendRef(root, ref);
    std::string bytes("svtindx\0", 8);
    appendAs<std::uint32_t>(bytes, kVersion, pages.refs.size());
    appendAs<std::uint64_t>(bytes, root.size(), idHash(root));
    return bytes + root + pages.bytes;
}

std::optional<std::vector<PageRef>> takeRefs(std::string_view page) {
    if (page.size() % PageRef::kBytes != 0) return std::nullopt;
    std::vector<PageRef> refs;
    ByteReader from(page);
    while (from.left() > 0) {
        PageRef ref;
        ref.detail = from.take<std::uint8_t>();
        ref.isLeaf = from.take<std::uint8_t>() == 0;
        from.skip(2);
        from.take(ref.size, ref.offset, ref.rectangle, ref.lowest, ref.highest, ref.members, ref.checksum);
        if (ref.size > 2 * kIndexPage) return std::nullopt;
        refs.push_back(ref);
    }
    return refs;
}

std::optional<std::vector<IndexEntry>> takeEntries(std::string_view page) {
    ByteReader from(page);
    const int detail = from.take<std::uint8_t>();
    from.skip(1);
    const auto count = from.take<std::uint16_t>();
    std::vector<IndexEntry> entries;
    std::uint64_t morton = 0;
    std::int64_t pack = 0;
    for (std::uint16_t n = 0; n < count && from.isGood(); ++n) {
        IndexEntry entry;
        entry.detail = detail;
        morton += from.takeVarint();
        const std::uint64_t level = from.takeVarint();
        if (level > static_cast<std::uint64_t>(detail < kFirstClassDetail ? Plan::kTopLevel : kMaxLevel))
            return std::nullopt;
        entry.tile = tileOf(morton, static_cast<int>(level));
        pack += takeSigned(from);
        if (pack < 0 || pack > 0xFFFFFFFF) return std::nullopt;
        entry.pack = static_cast<std::uint32_t>(pack);
        entry.offset = from.takeVarint() * 8;
        entry.size = from.takeVarint();
        entry.lowest = static_cast<std::int32_t>(takeSigned(from));
        entry.highest = static_cast<std::int32_t>(entry.lowest + static_cast<std::int64_t>(from.takeVarint()));
        entry.buildings = static_cast<std::uint32_t>(from.takeVarint());
        entries.push_back(entry);
    }
    // Cities of version 1 end here.
    std::array<std::int32_t, 4> before{};
    if (from.left() > 0)
        for (IndexEntry& entry : entries) {
            if (!from.isGood() || !takeRectangle(from, before, entry.rectangle)) return std::nullopt;
            before = entry.rectangle;
        }
    if (!from.isGood() || from.left() != 0) return std::nullopt;
    return entries;
}

std::string idsBytes(std::vector<IdEntry> entries) {
    const auto key = [](const IdEntry& e) { return std::tuple(e.hash, mortonOf(e.tile), e.label); };
    std::sort(entries.begin(), entries.end(), [&](const IdEntry& a, const IdEntry& b) { return key(a) < key(b); });
    std::string fence, pages;
    for (std::size_t begin = 0; begin < entries.size(); begin += kIdsOfPage) {
        appendBytes(fence, entries[begin].hash);
        std::string page;
        for (std::size_t n = begin; n < std::min(entries.size(), begin + kIdsOfPage); ++n) {
            const auto& [hash, tile, label] = entries[n];
            appendBytes(page, hash, tile.x, tile.y, label, std::int32_t{tile.level});
        }
        page.resize(kIdPage - 8, '\0');
        appendBytes(page, idHash(page));
        pages += page;
    }
    std::string bytes("svtids\0\0", 8);
    appendAs<std::uint32_t>(bytes, kVersion, kIdsOfPage);
    appendAs<std::uint64_t>(bytes, entries.size(), fence.size(), idHash(fence));
    return bytes + fence + pages;
}

}  // namespace svt::city

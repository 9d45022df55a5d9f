#include <svt/city/merge/index_file.hpp>

#include <svt/city/base/bytes.hpp>
#include <svt/city/base/sha256.hpp>
#include <svt/city/city_levels.hpp>

#include <algorithm>
#include <tuple>

namespace svt::city {
namespace {

constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kRefsOfPage = 290;

void putVarint(std::string& to, std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) to += static_cast<char>(value | 0x80);
    to += static_cast<char>(value);
}
void putSigned(std::string& to, std::int64_t value) {
    putVarint(to, static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63));
}
std::uint64_t takeVarint(Taker& from) {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
        const auto byte = from.take<std::uint8_t>();
        value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
        if (byte < 0x80) break;
    }
    return value;
}
std::int64_t takeSigned(Taker& from) {
    const std::uint64_t value = takeVarint(from);
    return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
}

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

void putEntry(std::string& to, const IndexEntry& entry, const IndexEntry& before, bool isFirst) {
    putVarint(to, mortonOf(entry.tile) - (isFirst ? 0 : mortonOf(before.tile)));
    putVarint(to, static_cast<std::uint64_t>(entry.tile.level));
    putSigned(to, std::int64_t{entry.pack} - (isFirst ? 0 : std::int64_t{before.pack}));
    putVarint(to, entry.offset / 8);
    putVarint(to, entry.size);
    putSigned(to, entry.lowest);
    putVarint(to, static_cast<std::uint64_t>(entry.highest - entry.lowest));
    putVarint(to, entry.buildings);
}

// Where samples lie: the corner from that of the entry before, and the size.
void putRectangle(std::string& to, const std::array<std::int32_t, 4>& own, const std::array<std::int32_t, 4>& before) {
    putSigned(to, std::int64_t{own[0]} - before[0]);
    putSigned(to, std::int64_t{own[1]} - before[1]);
    putVarint(to, static_cast<std::uint64_t>(std::int64_t{own[2]} - own[0]));
    putVarint(to, static_cast<std::uint64_t>(std::int64_t{own[3]} - own[1]));
}

// \return whether it can be one
bool takeRectangle(Taker& from, const std::array<std::int32_t, 4>& before, std::array<std::int32_t, 4>& own) {
    const std::array<std::int64_t, 2> low{before[0] + takeSigned(from), before[1] + takeSigned(from)};
    for (const std::size_t axis : {0u, 1u}) {
        const std::uint64_t size = takeVarint(from);
        constexpr std::int64_t kMost = 2'147'483'647;
        if (low[axis] < -kMost || low[axis] > kMost || size > kMost || low[axis] + std::int64_t(size) > kMost)
            return false;
        own[axis] = static_cast<std::int32_t>(low[axis]);
        own[axis + 2] = static_cast<std::int32_t>(low[axis] + std::int64_t(size));
    }
    return true;
}

void putRef(std::string& to, const PageRef& ref) {
    put(to, static_cast<std::uint8_t>(ref.detail));
    put(to, static_cast<std::uint8_t>(ref.isLeaf ? 0 : 1));
    put(to, std::uint16_t{0});
    put(to, ref.size);
    put(to, ref.offset);
    for (const std::int32_t value : ref.rectangle) put(to, value);
    put(to, ref.lowest);
    put(to, ref.highest);
    put(to, ref.members);
    put(to, ref.checksum);
}

// \param below  what a page of one reference or entry would have
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

// Pages, one after the other, with offsets from the begin of the first.
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
            putEntry(rows, entries[end].entry, entries[end == begin ? begin : end - 1].entry, end == begin);
            putRectangle(rectangles, entries[end].rectangle, before);
            before = entries[end].rectangle;
            PageRef own;
            own.rectangle = entries[end].rectangle;
            own.lowest = entries[end].entry.lowest;
            own.highest = entries[end].entry.highest;
            own.members = entries[end].entry.size;
            widen(ref, own, end == begin);
        }
        std::string page;
        put(page, static_cast<std::uint8_t>(ref.detail));
        put(page, std::uint8_t{0});
        put(page, static_cast<std::uint16_t>(end - begin));
        pages.add(ref, page + rows + rectangles);
        begin = end;
    }
}

// Pages of references, until the root can hold what is left.
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
                putRef(page, below[end]);
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
    for (const PageRef& ref : pages.refs) putRef(root, ref);
    std::string bytes("svtindx\0", 8);
    put(bytes, kVersion);
    put(bytes, static_cast<std::uint32_t>(pages.refs.size()));
    put(bytes, static_cast<std::uint64_t>(root.size()));
    put(bytes, idHash(root));
    return bytes + root + pages.bytes;
}

std::optional<std::vector<PageRef>> takeRefs(std::string_view page) {
    if (page.size() % PageRef::kBytes != 0) return std::nullopt;
    std::vector<PageRef> refs;
    Taker from(page);
    while (from.left() > 0) {
        PageRef ref;
        ref.detail = from.take<std::uint8_t>();
        ref.isLeaf = from.take<std::uint8_t>() == 0;
        from.take<std::uint16_t>();
        ref.size = from.take<std::uint32_t>();
        ref.offset = from.take<std::uint64_t>();
        for (std::int32_t& value : ref.rectangle) value = from.take<std::int32_t>();
        ref.lowest = from.take<std::int32_t>();
        ref.highest = from.take<std::int32_t>();
        ref.members = from.take<std::uint64_t>();
        ref.checksum = from.take<std::uint64_t>();
        if (ref.size > 2 * kIndexPage) return std::nullopt;
        refs.push_back(ref);
    }
    return refs;
}

std::optional<std::vector<IndexEntry>> takeEntries(std::string_view page) {
    Taker from(page);
    const int detail = from.take<std::uint8_t>();
    from.take<std::uint8_t>();
    const auto count = from.take<std::uint16_t>();
    std::vector<IndexEntry> entries;
    std::uint64_t morton = 0;
    std::int64_t pack = 0;
    for (std::uint16_t n = 0; n < count && from.isGood(); ++n) {
        IndexEntry entry;
        entry.detail = detail;
        morton += takeVarint(from);
        const std::uint64_t level = takeVarint(from);
        if (level > static_cast<std::uint64_t>(detail < kFirstClassDetail ? Plan::kTopLevel : kMaxLevel))
            return std::nullopt;
        entry.tile = tileOf(morton, static_cast<int>(level));
        pack += takeSigned(from);
        if (pack < 0 || pack > 0xFFFFFFFF) return std::nullopt;
        entry.pack = static_cast<std::uint32_t>(pack);
        entry.offset = takeVarint(from) * 8;
        entry.size = takeVarint(from);
        entry.lowest = static_cast<std::int32_t>(takeSigned(from));
        entry.highest = static_cast<std::int32_t>(entry.lowest + static_cast<std::int64_t>(takeVarint(from)));
        entry.buildings = static_cast<std::uint32_t>(takeVarint(from));
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
        put(fence, entries[begin].hash);
        std::string page;
        for (std::size_t n = begin; n < std::min(entries.size(), begin + kIdsOfPage); ++n) {
            put(page, entries[n].hash);
            put(page, entries[n].tile.x);
            put(page, entries[n].tile.y);
            put(page, entries[n].label);
            put(page, static_cast<std::uint32_t>(entries[n].tile.level));
        }
        page.resize(kIdPage - 8, '\0');
        put(page, idHash(page));
        pages += page;
    }
    std::string bytes("svtids\0\0", 8);
    put(bytes, kVersion);
    put(bytes, static_cast<std::uint32_t>(kIdsOfPage));
    put(bytes, static_cast<std::uint64_t>(entries.size()));
    put(bytes, static_cast<std::uint64_t>(fence.size()));
    put(bytes, idHash(fence));
    return bytes + fence + pages;
}

}  // namespace svt::city

#include <svt/volume/zip_entries.hpp>

#include <svt/core/bytes.hpp>
#include <svt/volume/file/bad_volume.hpp>
#include <svt/volume/file/zip_container.hpp>
#include <svt/volume/file/zstd_frame.hpp>

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <unordered_set>

namespace svt::volume {
namespace {

// Constants of APPNOTE.TXT; zip_container.cpp reads whole files.
constexpr std::uint32_t kRangeLocalSignature = 0x04034B50, kRangeCentralSignature = 0x02014B50;
constexpr std::uint32_t kRangeEndSignature = 0x06054B50, kRangeEnd64Signature = 0x06064B50;
constexpr std::uint32_t kRangeLocatorSignature = 0x07064B50;
constexpr std::size_t kRangeLocalSize = 30, kRangeCentralSize = 46, kRangeEndSize = 22, kRangeEnd64Size = 56;
constexpr std::size_t kRangeLocatorSize = 20;
constexpr std::size_t kRangeTailSize = kRangeEndSize + kRangeLocatorSize + kRangeEnd64Size;
constexpr std::uint16_t kRangeZip64 = 0x0001;
constexpr std::uint32_t kRangeIn64 = 0xFFFFFFFFu;

std::span<const std::byte> asBytes(const std::string& text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

struct DirectoryPlace {
    std::uint64_t offset = 0, size = 0;
};

// The place of the central directory, from the last bytes of the file.
Result<DirectoryPlace> findDirectory(std::span<const std::byte> tail, std::uint64_t fileSize) {
    if (tail.size() < kRangeEndSize) return badVolume("the file is too short for a ZIP");
    const std::size_t end = tail.size() - kRangeEndSize;
    if (loadBytes<std::uint32_t>(tail, end) != kRangeEndSignature)
        return badVolume("the file does not end with the end record of a ZIP: it is cut short, or bytes were added");
    DirectoryPlace place{loadBytes<std::uint32_t>(tail, end + 16), loadBytes<std::uint32_t>(tail, end + 12)};
    std::uint64_t directoryEnd = fileSize - kRangeEndSize;
    const bool is64 =
        place.offset == kRangeIn64 || place.size == kRangeIn64 || loadBytes<std::uint16_t>(tail, end + 10) == 0xFFFFu;
    if (is64) {
        if (tail.size() < kRangeTailSize ||
            loadBytes<std::uint32_t>(tail, end - kRangeLocatorSize) != kRangeLocatorSignature ||
            loadBytes<std::uint32_t>(tail, end - kRangeLocatorSize - kRangeEnd64Size) != kRangeEnd64Signature)
            return badVolume("the ZIP64 end record is missing or damaged");
        const std::size_t end64 = end - kRangeLocatorSize - kRangeEnd64Size;
        place = {loadBytes<std::uint64_t>(tail, end64 + 48), loadBytes<std::uint64_t>(tail, end64 + 40)};
        directoryEnd = fileSize - kRangeTailSize;
    }
    if (place.offset > directoryEnd || place.size != directoryEnd - place.offset)
        return badVolume("the central directory does not end at the end record: the file is cut short or damaged");
    if (place.size > ZipRanges::kMaxDirectory)
        return Error(Code::InputTooBig, fmt::format("the central directory has {} bytes, {} are possible", place.size,
                                                    ZipRanges::kMaxDirectory));
    return place;
}

// Replaces sizes and the offset by those of the ZIP64 field where they refer to it.
bool takeZip64(std::span<const std::byte> extra, EntryPlace& entry) {
    std::uint64_t* const fields[] = {&entry.size, &entry.packedSize, &entry.headerOffset};
    if (std::all_of(std::begin(fields), std::end(fields), [](const std::uint64_t* f) { return *f != kRangeIn64; }))
        return true;
    for (std::size_t at = 0; extra.size() - at >= 4;) {
        const auto id = loadBytes<std::uint16_t>(extra, at);
        const std::size_t size = loadBytes<std::uint16_t>(extra, at + 2);
        if (size > extra.size() - at - 4) return false;
        if (id == kRangeZip64) {
            std::size_t next = at + 4;
            for (std::uint64_t* field : fields) {
                if (*field != kRangeIn64) continue;
                if (at + 4 + size - next < 8) return false;
                *field = loadBytes<std::uint64_t>(extra, next);
                next += 8;
            }
            return true;
        }
        at += 4 + size;
    }
    return false;
}

// Takes the entry at `at` from the directory and moves `at` behind it.
Result<EntryPlace> takeEntry(std::span<const std::byte> directory, std::size_t& at, std::uint64_t directoryOffset) {
    if (directory.size() - at < kRangeCentralSize || loadBytes<std::uint32_t>(directory, at) != kRangeCentralSignature)
        return badVolume("the central directory is damaged");
    const std::size_t nameSize = loadBytes<std::uint16_t>(directory, at + 28);
    const std::size_t extraSize = loadBytes<std::uint16_t>(directory, at + 30);
    const std::size_t commentSize = loadBytes<std::uint16_t>(directory, at + 32);
    if (nameSize + extraSize + commentSize > directory.size() - at - kRangeCentralSize)
        return badVolume("an entry reaches beyond the central directory");
    EntryPlace entry;
    entry.name.assign(reinterpret_cast<const char*>(directory.data()) + at + kRangeCentralSize, nameSize);
    entry.crc = loadBytes<std::uint32_t>(directory, at + 16);
    entry.packedSize = loadBytes<std::uint32_t>(directory, at + 20);
    entry.size = loadBytes<std::uint32_t>(directory, at + 24);
    entry.headerOffset = loadBytes<std::uint32_t>(directory, at + 42);
    const auto flags = loadBytes<std::uint16_t>(directory, at + 8),
               method = loadBytes<std::uint16_t>(directory, at + 10);
    entry.isDeflated = method == 8;
    if (!takeZip64(directory.subspan(at + kRangeCentralSize + nameSize, extraSize), entry) || (flags & 9u) != 0 ||
        (method != 0 && method != 8) || (!entry.isDeflated && entry.size != entry.packedSize) ||
        entry.headerOffset > directoryOffset || entry.packedSize > directoryOffset - entry.headerOffset)
        return badVolume("an entry of the central directory is damaged, or of a kind that a .svt has not");
    at += kRangeCentralSize + nameSize + extraSize + commentSize;
    return entry;
}

}  // namespace

Result<ZipRanges> ZipRanges::open(ReadRange read, std::uint64_t size) {
    const std::uint64_t tailSize = std::min<std::uint64_t>(size, kRangeTailSize);
    SVT_TRY(tail, read(size - tailSize, static_cast<std::size_t>(tailSize)));
    if (tail->size() != tailSize) return badVolume("the end of the file is missing");
    SVT_TRY(place, findDirectory(asBytes(*tail), size));
    SVT_TRY(text, read(place->offset, static_cast<std::size_t>(place->size)));
    const std::span<const std::byte> directory = asBytes(*text);
    if (directory.size() != place->size) return badVolume("the central directory is missing");
    ZipRanges ranges;
    std::unordered_set<std::string> names;
    for (std::size_t at = 0; at < directory.size();) {
        SVT_TRY(entry, takeEntry(directory, at, place->offset));
        if (!names.insert(entry->name).second) return badVolume("an entry occurs twice in the file");
        ranges.entries_.push_back(std::move(*entry));
    }
    ranges.read_ = std::move(read);
    ranges.size_ = size;
    return ranges;
}

Result<ZipRanges> ZipRanges::open(const std::filesystem::path& path) {
    SVT_TRY(opened, PartFile::open(path));
    const auto file = std::make_shared<const PartFile>(std::move(*opened));
    return open([file](std::uint64_t offset, std::size_t size) { return file->readAll(offset, size); }, file->size());
}

const EntryPlace* ZipRanges::find(std::string_view name) const noexcept {
    for (const EntryPlace& entry : entries_)
        if (entry.name == name) return &entry;
    return nullptr;
}

Result<std::uint64_t> ZipRanges::dataOffset(const EntryPlace& entry) const {
    if (size_ - entry.headerOffset < kRangeLocalSize) return badVolume("an entry has no local header");
    SVT_TRY(header, read_(entry.headerOffset, kRangeLocalSize));
    const std::span<const std::byte> bytes = asBytes(*header);
    if (bytes.size() != kRangeLocalSize || loadBytes<std::uint32_t>(bytes, 0) != kRangeLocalSignature ||
        loadBytes<std::uint32_t>(bytes, 14) != entry.crc ||
        (loadBytes<std::uint16_t>(bytes, 8) == 8) != entry.isDeflated)
        return badVolume("a local header and the central directory contradict each other");
    const std::uint64_t offset = entry.headerOffset + kRangeLocalSize + loadBytes<std::uint16_t>(bytes, 26) +
                                 loadBytes<std::uint16_t>(bytes, 28);
    if (offset > size_ || entry.packedSize > size_ - offset) return badVolume("an entry reaches outside of the file");
    return offset;
}

Result<std::vector<std::byte>> ZipRanges::unpacked(const EntryPlace& entry, std::uint64_t maxBytes) const {
    if (entry.size > maxBytes || entry.packedSize > maxBytes + 1024)
        return Error(Code::InputTooBig,
                     fmt::format("the entry '{}' has {} bytes, {} are possible", entry.name, entry.size, maxBytes));
    SVT_TRY(offset, dataOffset(entry));
    SVT_TRY(packed, read_(*offset, static_cast<std::size_t>(entry.packedSize)));
    if (packed->size() != entry.packedSize) return badVolume("the bytes of an entry are missing");
    std::vector<std::byte> buffer;
    SVT_TRY(data, unpack({entry.name, asBytes(*packed), entry.crc, entry.size, entry.isDeflated}, maxBytes, buffer));
    return std::vector<std::byte>(data->begin(), data->end());
}

Result<std::uint64_t> writeWithEntries(std::span<const std::byte> input, const std::filesystem::path& output,
                                       const std::function<bool(std::string_view)>& isKept,
                                       std::span<const NewEntry> entries) {
    SVT_TRY(found, readZip(input));
    // Tools find the type of the file by its first entry.
    constexpr std::string_view kFirst = "mimetype";
    std::stable_sort(found->begin(), found->end(),
                     [&](const ZipEntry& a, const ZipEntry& b) { return a.name == kFirst && b.name != kFirst; });
    std::vector<ZipSource> sources;
    std::unordered_set<std::string_view> names;
    for (const ZipEntry& entry : *found) {
        if (!isKept(entry.name)) continue;
        ZipSource source{std::string(entry.name), {entry.data}, entry.name != kFirst, false, {}};
        source.packed = PackedAs{entry.size, entry.crc, entry.isDeflated};
        sources.push_back(std::move(source));
        names.insert(entry.name);
    }
    for (const NewEntry& entry : entries) {
        if (!names.insert(entry.name).second)
            return Error(Code::BadArgument, fmt::format("the entry '{}' exists already", entry.name));
        sources.push_back({entry.name, entry.parts, true, entry.isDeflated, {}});
    }
    return writeZip(output, sources);
}

std::uint32_t checksumOf(std::span<const std::byte> bytes) { return crc32Of(bytes); }

Result<std::vector<std::byte>> packFrame(std::span<const std::uint8_t> bytes, std::string_view what) {
    return compressNumbers(bytes, what);
}

Result<std::vector<std::uint8_t>> unpackFrame(std::span<const std::byte> frame, std::uint64_t maxBytes,
                                              std::string_view what) {
    const std::uint64_t size = ZSTD_getFrameContentSize(frame.data(), frame.size());
    if (size != ZSTD_CONTENTSIZE_ERROR && size != ZSTD_CONTENTSIZE_UNKNOWN && size > maxBytes)
        return badVolume(fmt::format("{}: a frame unpacks to {} bytes, at most {} are possible", what, size, maxBytes));
    return unpackNumbers(frame, what);
}

}  // namespace svt::volume

#include <svt/core/bytes.hpp>
#include <svt/core/deflate.hpp>
#include <svt/core/file.hpp>
#include <svt/core/parallel.hpp>
#include <svt/volume/file/bad_volume.hpp>
#include <svt/volume/file/zip_container.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <unordered_set>

namespace svt::volume {
namespace {

constexpr std::uint32_t kLocalSignature = 0x04034B50;
constexpr std::uint32_t kCentralSignature = 0x02014B50;
constexpr std::uint32_t kEndSignature = 0x06054B50;
constexpr std::uint32_t kEnd64Signature = 0x06064B50;
constexpr std::uint32_t kLocator64Signature = 0x07064B50;
constexpr std::size_t kLocalSize = 30;
constexpr std::size_t kCentralSize = 46;
constexpr std::size_t kEndSize = 22;
constexpr std::size_t kEnd64Size = 56;
constexpr std::size_t kLocator64Size = 20;

constexpr std::uint16_t kZip64Extra = 0x0001;
constexpr std::uint16_t kPaddingExtra = 0x5653;  // the bytes "SV": zeros up to the alignment
constexpr std::uint16_t kVersion20 = 20;
constexpr std::uint16_t kVersion45 = 45;  // ZIP64
constexpr std::uint16_t kMadeByUnix = 3 << 8;
constexpr std::uint16_t kDate1980 = (1 << 5) | 1;  // 1 January 1980, the earliest date of a ZIP
constexpr std::uint32_t kFileMode = 0100644u << 16;
constexpr std::uint32_t kIn64 = 0xFFFFFFFFu;  // "see the ZIP64 field"
constexpr std::uint16_t kIn64Count = 0xFFFFu;

constexpr std::uint16_t kFlagEncrypted = 1u << 0;
constexpr std::uint16_t kFlagDescriptor = 1u << 3;
constexpr std::uint16_t kFlagUtf8 = 1u << 11;

constexpr std::size_t kMaxEntries = 65535;
constexpr std::size_t kMaxNameBytes = 255;
constexpr std::size_t kCrcPiece = std::size_t{4} << 20;
constexpr std::size_t kDeflatePiece = std::size_t{1} << 20;
constexpr std::uint16_t kStored = 0;
constexpr std::uint16_t kDeflated = 8;

// ---------------------------------------------------------------------------------------------- writing

/// The fields common to both headers of an entry.
struct Placed {
    std::uint64_t size = 0;
    std::uint64_t packedSize = 0;
    std::uint64_t offset = 0;
    std::uint32_t crc = 0;
    std::uint16_t method = kStored;
};

/// Maximum unpacked size for `packedSize` bytes. Deflate could reach a ratio of 1032.
constexpr std::uint64_t maxUnpacked(std::uint64_t packedSize) noexcept {
    return (std::uint64_t{64} << 20) + 128 * packedSize;
}

/// Deflates all parts in parallel, as pieces of one stream. The pieces do not depend on the number of threads.
std::vector<std::vector<std::byte>> deflateParts(std::span<const std::span<const std::byte>> parts) {
    std::vector<std::span<const std::byte>> pieces;
    for (auto part : parts)
        for (; !part.empty(); part = part.subspan(pieces.back().size()))
            pieces.push_back(part.first(std::min(part.size(), kDeflatePiece)));
    std::vector<std::vector<std::byte>> packed(pieces.size());
    parallelFor(pieces.size(), 1, 0, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) packed[p] = deflatePiece(pieces[p], -1, p + 1 == pieces.size());
    });
    return packed;
}

std::string localHeader(const ZipSource& entry, const Placed& placed, std::uint64_t zip64From) {
    const bool is64 = std::max(placed.size, placed.packedSize) >= zip64From;
    std::size_t extra = is64 ? 20 : 0;
    std::size_t padding = 0;
    if (entry.isAligned) {
        const std::uint64_t unpadded = placed.offset + kLocalSize + entry.name.size() + extra + 4;
        padding = static_cast<std::size_t>((kZipAlignment - unpadded % kZipAlignment) % kZipAlignment);
        extra += 4 + padding;
    }
    std::string r;
    appendBytes(r, kLocalSignature);
    // Version, flags, method, time, date.
    appendAs<std::uint16_t>(r, is64 ? kVersion45 : kVersion20, 0, placed.method, 0, kDate1980);
    appendAs<std::uint32_t>(r, placed.crc, is64 ? kIn64 : placed.packedSize, is64 ? kIn64 : placed.size);
    appendAs<std::uint16_t>(r, entry.name.size(), extra);
    r += entry.name;
    if (is64) {
        appendAs<std::uint16_t>(r, kZip64Extra, 16);
        appendBytes(r, placed.size, placed.packedSize);
    }
    if (entry.isAligned) {
        appendAs<std::uint16_t>(r, kPaddingExtra, padding);
        r.append(padding, '\0');
    }
    return r;
}

void appendCentralHeader(std::string& r, const ZipSource& entry, const Placed& placed, std::uint64_t zip64From) {
    const bool isSize64 = std::max(placed.size, placed.packedSize) >= zip64From;
    const bool isOffset64 = placed.offset >= zip64From;
    const std::size_t extraData = (isSize64 ? 16u : 0u) + (isOffset64 ? 8u : 0u);
    const std::uint16_t version = extraData > 0 ? kVersion45 : kVersion20;
    appendBytes(r, kCentralSignature);
    // Two versions, flags, method, time, date.
    appendAs<std::uint16_t>(r, kMadeByUnix | version, version, 0, placed.method, 0, kDate1980);
    appendAs<std::uint32_t>(r, placed.crc, isSize64 ? kIn64 : placed.packedSize, isSize64 ? kIn64 : placed.size);
    // Sizes of name, extra field and comment; disk; internal attributes.
    appendAs<std::uint16_t>(r, entry.name.size(), extraData > 0 ? 4 + extraData : 0, 0, 0, 0);
    appendAs<std::uint32_t>(r, kFileMode, isOffset64 ? kIn64 : placed.offset);
    r += entry.name;
    if (extraData > 0) {
        appendAs<std::uint16_t>(r, kZip64Extra, extraData);
        if (isSize64) appendBytes(r, placed.size, placed.packedSize);
        if (isOffset64) appendBytes(r, placed.offset);
    }
}

void appendEnd(std::string& r, std::uint64_t count, std::uint64_t offset, std::uint64_t zip64From) {
    const std::uint64_t size = r.size();
    const bool is64 = offset >= zip64From || size >= zip64From || count >= kIn64Count;
    if (is64) {
        appendBytes(r, kEnd64Signature);
        appendAs<std::uint64_t>(r, kEnd64Size - 12);
        appendAs<std::uint16_t>(r, kMadeByUnix | kVersion45, kVersion45);
        appendAs<std::uint32_t>(r, 0, 0);  // this disk, disk of the directory
        appendBytes(r, count, count, size, offset);
        appendBytes(r, kLocator64Signature, std::uint32_t{0}, offset + size, std::uint32_t{1});  // disks
    }
    appendBytes(r, kEndSignature);
    appendAs<std::uint16_t>(r, 0, 0, is64 ? kIn64Count : count, is64 ? kIn64Count : count);
    appendAs<std::uint32_t>(r, is64 ? kIn64 : size, is64 ? kIn64 : offset);
    appendAs<std::uint16_t>(r, 0);  // comment
}

// ---------------------------------------------------------------------------------------------- reading

/// The location of the central directory, from the records at the end of the file.
struct Directory {
    std::uint64_t count = 0;
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
};

Result<Directory> readEnd(std::span<const std::byte> bytes) {
    if (bytes.size() < kEndSize || loadBytes<std::uint32_t>(bytes, bytes.size() - kEndSize) != kEndSignature)
        return badVolume("the file does not end with the end record of a ZIP: it is cut short, or bytes were added");
    const std::size_t end = bytes.size() - kEndSize;
    if (loadBytes<std::uint16_t>(bytes, end + 20) != 0)
        return badVolume("the end record states a comment that is not there");
    if (loadBytes<std::uint32_t>(bytes, end + 4) != 0 ||
        loadBytes<std::uint16_t>(bytes, end + 8) != loadBytes<std::uint16_t>(bytes, end + 10))
        return badVolume("the archive is split into several files; join them first");
    Directory directory{loadBytes<std::uint16_t>(bytes, end + 10), loadBytes<std::uint32_t>(bytes, end + 16),
                        loadBytes<std::uint32_t>(bytes, end + 12)};
    std::size_t directoryEnd = end;
    const bool is64 = directory.count == kIn64Count || directory.offset == kIn64 || directory.size == kIn64;
    if (is64) {
        if (end < kLocator64Size + kEnd64Size ||
            loadBytes<std::uint32_t>(bytes, end - kLocator64Size) != kLocator64Signature)
            return badVolume("the ZIP64 locator is missing before the end record");
        const std::size_t end64 = end - kLocator64Size - kEnd64Size;
        if (loadBytes<std::uint64_t>(bytes, end - kLocator64Size + 8) != end64 ||
            loadBytes<std::uint32_t>(bytes, end - kLocator64Size + 4) != 0 ||
            loadBytes<std::uint32_t>(bytes, end - kLocator64Size + 16) != 1 ||
            loadBytes<std::uint32_t>(bytes, end64) != kEnd64Signature ||
            loadBytes<std::uint64_t>(bytes, end64 + 4) != kEnd64Size - 12 ||
            loadBytes<std::uint64_t>(bytes, end64 + 16) != 0 ||
            loadBytes<std::uint64_t>(bytes, end64 + 24) != loadBytes<std::uint64_t>(bytes, end64 + 32))
            return badVolume("the ZIP64 end record is damaged");
        const Directory large{loadBytes<std::uint64_t>(bytes, end64 + 32), loadBytes<std::uint64_t>(bytes, end64 + 48),
                              loadBytes<std::uint64_t>(bytes, end64 + 40)};
        const auto differs = [](std::uint64_t small, std::uint64_t sentinel, std::uint64_t value) {
            return small != sentinel && small != value;
        };
        if (differs(directory.count, kIn64Count, large.count) || differs(directory.offset, kIn64, large.offset) ||
            differs(directory.size, kIn64, large.size))
            return badVolume("the ZIP64 end record and the end record contradict each other");
        directory = large;
        directoryEnd = end64;
    }
    if (directory.offset > directoryEnd || directory.size != directoryEnd - directory.offset)
        return badVolume(
            fmt::format("the central directory of {} bytes at {} does not end at {}: the file is cut short or damaged",
                        directory.size, directory.offset, directoryEnd));
    if (directory.count > kMaxEntries || directory.count > directory.size / kCentralSize)
        return badVolume(
            fmt::format("{} entries do not fit in {} bytes of central directory", directory.count, directory.size));
    return directory;
}

/// The reason why a name is invalid, or empty. Unpacking with any tool must never write outside the target folder.
std::string_view wrongName(std::string_view name) noexcept {
    if (name.empty()) return "is empty";
    if (name.size() > kMaxNameBytes) return "is longer than 255 bytes";
    for (const char c : name) {
        if (c < 0x20 || c > 0x7E) return "holds a character that is not printable ASCII";
        if (c == '\\') return "holds a backslash";
        if (c == ':') return "holds a colon";
    }
    if (name.front() == '/') return "is an absolute path";
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t end = std::min(name.find('/', begin), name.size());
        const std::string_view part = name.substr(begin, end - begin);
        if (part.empty() || part == "." || part == "..") return "has a folder that is empty, '.' or '..'";
        begin = end + 1;
    }
    return {};
}

/// A name, escaped for messages.
std::string shown(std::string_view name) {
    std::string text = "'";
    for (const char c : name.substr(0, 80)) {
        if (c >= 0x20 && c <= 0x7E)
            text += c;
        else
            text += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
    return text + (name.size() > 80 ? "...'" : "'");
}

std::string_view textAt(std::span<const std::byte> bytes, std::size_t offset, std::size_t size) noexcept {
    return {reinterpret_cast<const char*>(bytes.data()) + offset, size};
}

/// The data of the ZIP64 extra field in `extra` (empty if there is none), or nullopt if the fields are malformed.
std::optional<std::span<const std::byte>> zip64Field(std::span<const std::byte> extra) {
    std::span<const std::byte> found;
    bool isFound = false;
    while (!extra.empty()) {
        if (extra.size() < 4) return std::nullopt;
        const auto id = loadBytes<std::uint16_t>(extra, 0);
        const auto size = loadBytes<std::uint16_t>(extra, 2);
        if (size > extra.size() - 4) return std::nullopt;
        if (id == kZip64Extra) {
            if (isFound) return std::nullopt;
            isFound = true;
            found = extra.subspan(4, size);
        }
        extra = extra.subspan(4 + std::size_t{size});
    }
    return found;
}

/// Replaces fields with the value "see ZIP64" by those of the extra field, in the order of the specification.
Result<void> resolve64(std::span<const std::byte> extra, std::initializer_list<std::uint64_t*> fields) {
    const auto data = zip64Field(extra);
    if (!data) return badVolume("has an extra field that is damaged");
    std::size_t at = 0;
    for (std::uint64_t* field : fields) {
        if (*field != kIn64) continue;
        if (data->size() < at + 8) return badVolume("lacks a size or offset in its ZIP64 field");
        *field = loadBytes<std::uint64_t>(*data, at);
        at += 8;
    }
    if (at != data->size()) return badVolume("has a ZIP64 field with more than is needed");
    return {};
}

Result<void> checkKind(std::uint16_t flags, std::uint16_t method) {
    if ((flags & kFlagEncrypted) != 0) return badVolume("is encrypted; a .svt holds plain entries only");
    if ((flags & kFlagDescriptor) != 0)
        return badVolume("has its size after the data; a .svt has it in front. Pack the file again with 'zip -0 -X'");
    if ((flags & ~kFlagUtf8) != 0) return badVolume(fmt::format("has flags 0x{:04x} that are not understood", flags));
    if (method != kStored && method != kDeflated)
        return badVolume(
            fmt::format("is compressed with method {}; a .svt holds entries that are stored or deflated", method));
    return {};
}

/// An entry and the range of its local header and data in the file.
struct Located {
    ZipEntry entry;
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
};

/// Checks the local header at `offset` against the central directory.
/// \return the entry with its data, or BadVolume
Result<Located> readLocal(std::span<const std::byte> bytes, ZipEntry entry, std::uint64_t offset,
                          std::uint64_t packedSize, std::uint64_t directoryOffset) {
    if (offset > directoryOffset || directoryOffset - offset < kLocalSize)
        return badVolume("has an offset outside the file");
    const auto at = static_cast<std::size_t>(offset);
    if (loadBytes<std::uint32_t>(bytes, at) != kLocalSignature) return badVolume("has no local header at its offset");
    const auto method = loadBytes<std::uint16_t>(bytes, at + 8);
    SVT_DO(checkKind(loadBytes<std::uint16_t>(bytes, at + 6), method));
    const std::size_t nameSize = loadBytes<std::uint16_t>(bytes, at + 26);
    const std::size_t extraSize = loadBytes<std::uint16_t>(bytes, at + 28);
    const std::uint64_t dataOffset = offset + kLocalSize + nameSize + extraSize;
    if (dataOffset > directoryOffset || packedSize > directoryOffset - dataOffset)
        return badVolume(fmt::format("has {} bytes at {}, which reach outside the file", packedSize, dataOffset));
    std::uint64_t localSize = loadBytes<std::uint32_t>(bytes, at + 22);
    std::uint64_t localPacked = loadBytes<std::uint32_t>(bytes, at + 18);
    const auto extra = bytes.subspan(at + kLocalSize + nameSize, extraSize);
    SVT_DO(resolve64(extra, {&localSize, &localPacked}));
    if (textAt(bytes, at + kLocalSize, nameSize) != entry.name || localSize != entry.size ||
        localPacked != packedSize || loadBytes<std::uint32_t>(bytes, at + 14) != entry.crc ||
        (method == kDeflated) != entry.isDeflated)
        return badVolume("differs between its local header and the central directory");
    entry.data = bytes.subspan(static_cast<std::size_t>(dataOffset), static_cast<std::size_t>(packedSize));
    return Located{entry, offset, dataOffset + packedSize};
}

/// Inflates the data of an entry into `buffer`.
/// \return false if they are invalid or do not give exactly `entry.size` bytes
bool inflateInto(const ZipEntry& entry, std::vector<std::byte>& buffer) {
    Inflated unpacked = inflateBytes(entry.data, DeflateFormat::Raw, entry.size, entry.size);
    buffer = std::move(unpacked.bytes);
    return unpacked.status == InflateStatus::Done && unpacked.taken == entry.data.size() && buffer.size() == entry.size;
}

}  // namespace

std::uint32_t crc32Of(std::span<const std::byte> bytes, std::uint32_t before) {
    if (bytes.size() <= kCrcPiece) return zipChecksum(bytes, before);
    const std::size_t pieces = (bytes.size() + kCrcPiece - 1) / kCrcPiece;
    std::vector<std::uint32_t> crcs(pieces);
    const auto sizeOf = [&](std::size_t p) { return std::min(kCrcPiece, bytes.size() - p * kCrcPiece); };
    parallelFor(pieces, 1, 0, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) crcs[p] = zipChecksum(bytes.subspan(p * kCrcPiece, sizeOf(p)));
    });
    for (std::size_t p = 0; p < pieces; ++p) before = joinedChecksum(before, crcs[p], sizeOf(p));
    return before;
}

namespace {

// A container in memory, with the calls of AtomicFile.
struct MemoryFile {
    std::vector<std::byte> bytes;

    [[nodiscard]] std::uint64_t size() const noexcept { return bytes.size(); }
    Result<void> write(std::span<const std::byte> part) {
        bytes.insert(bytes.end(), part.begin(), part.end());
        return {};
    }
    Result<void> write(std::string_view text) { return write(std::as_bytes(std::span(text.data(), text.size()))); }
};

template <class File>
Result<void> putZip(File& file, std::span<const ZipSource> entries, std::uint64_t zip64From) {
    std::string directory;
    for (const ZipSource& entry : entries) {
        Placed placed;
        placed.offset = file.size();
        for (const auto part : entry.parts) {
            if (!entry.packed) placed.crc = crc32Of(part, placed.crc);
            placed.size += part.size();
        }
        placed.packedSize = placed.size;
        if (entry.packed) {
            placed.size = entry.packed->size;
            placed.crc = entry.packed->crc;
            placed.method = entry.packed->isDeflated ? kDeflated : kStored;
        }
        std::vector<std::span<const std::byte>> parts = entry.parts;
        std::vector<std::vector<std::byte>> packed;
        if (entry.isDeflated && !entry.packed) {
            packed = deflateParts(entry.parts);
            std::uint64_t packedSize = 0;
            for (const auto& piece : packed) packedSize += piece.size();
            if (packedSize < placed.size && placed.size <= maxUnpacked(packedSize)) {
                placed.method = kDeflated;
                placed.packedSize = packedSize;
                parts.assign(packed.begin(), packed.end());
            }
        }
        SVT_DO(file.write(localHeader(entry, placed, zip64From)));
        for (const auto part : parts)
            if (auto written = file.write(part); !written) return written.error();
        appendCentralHeader(directory, entry, placed, zip64From);
    }
    appendEnd(directory, entries.size(), file.size(), zip64From);
    return file.write(directory);
}

}  // namespace

Result<std::uint64_t> writeZip(const std::filesystem::path& path, std::span<const ZipSource> entries,
                               std::uint64_t zip64From) {
    SVT_TRY(file, AtomicFile::create(path));
    SVT_DO(putZip(*file, entries, zip64From));
    return file->commit();
}

Result<std::vector<std::byte>> zipBytes(std::span<const ZipSource> entries) {
    MemoryFile file;
    SVT_DO(putZip(file, entries, 0xFFFFFFFFu));
    return std::move(file.bytes);
}

Result<std::vector<ZipEntry>> readZip(std::span<const std::byte> bytes) {
    SVT_TRY(directory, readEnd(bytes));
    std::vector<Located> found;
    found.reserve(static_cast<std::size_t>(directory->count));
    std::unordered_set<std::string_view> names;
    auto at = static_cast<std::size_t>(directory->offset);
    const std::size_t end = at + static_cast<std::size_t>(directory->size);
    for (std::uint64_t e = 0; e < directory->count; ++e) {
        if (end - at < kCentralSize || loadBytes<std::uint32_t>(bytes, at) != kCentralSignature)
            return badVolume(fmt::format("entry {} of the central directory is damaged", e));
        const std::size_t nameSize = loadBytes<std::uint16_t>(bytes, at + 28);
        const std::size_t extraSize = loadBytes<std::uint16_t>(bytes, at + 30);
        const std::size_t commentSize = loadBytes<std::uint16_t>(bytes, at + 32);
        if (nameSize + extraSize + commentSize > end - at - kCentralSize)
            return badVolume(fmt::format("entry {} of the central directory reaches beyond its end", e));
        ZipEntry entry;
        entry.name = textAt(bytes, at + kCentralSize, nameSize);
        entry.crc = loadBytes<std::uint32_t>(bytes, at + 16);
        const auto wrong = [&](std::string_view what) {
            return badVolume(fmt::format("entry {} {}", shown(entry.name), what));
        };
        if (const auto reason = wrongName(entry.name); !reason.empty())
            return wrong(fmt::format("has a name that {}", reason));
        if (!names.insert(entry.name).second) return wrong("occurs twice in the file");
        if (auto kind = checkKind(loadBytes<std::uint16_t>(bytes, at + 8), loadBytes<std::uint16_t>(bytes, at + 10));
            !kind)
            return wrong(kind.error().message());
        if (loadBytes<std::uint16_t>(bytes, at + 34) != 0) return wrong("is in another part of a split archive");
        entry.size = loadBytes<std::uint32_t>(bytes, at + 24);
        entry.isDeflated = loadBytes<std::uint16_t>(bytes, at + 10) == kDeflated;
        std::uint64_t packedSize = loadBytes<std::uint32_t>(bytes, at + 20);
        std::uint64_t offset = loadBytes<std::uint32_t>(bytes, at + 42);
        const auto extra = bytes.subspan(at + kCentralSize + nameSize, extraSize);
        if (auto resolved = resolve64(extra, {&entry.size, &packedSize, &offset}); !resolved)
            return wrong(resolved.error().message());
        if (entry.size != packedSize && !entry.isDeflated) return wrong("has two sizes, although it is stored");
        auto located = readLocal(bytes, entry, offset, packedSize, directory->offset);
        if (!located) return wrong(located.error().message());
        found.push_back(*located);
        at += kCentralSize + nameSize + extraSize + commentSize;
    }
    if (at != end) return badVolume("the central directory holds more than its entries");

    std::vector<std::size_t> order(found.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return found[a].begin < found[b].begin; });
    for (std::size_t o = 1; o < order.size(); ++o)
        if (found[order[o]].begin < found[order[o - 1]].end)
            return badVolume(fmt::format("entries {} and {} overlap", shown(found[order[o - 1]].entry.name),
                                         shown(found[order[o]].entry.name)));
    std::vector<ZipEntry> entries;
    entries.reserve(found.size());
    for (const Located& located : found) entries.push_back(located.entry);
    return entries;
}

Result<std::span<const std::byte>> unpack(const ZipEntry& entry, std::uint64_t maxBytes,
                                          std::vector<std::byte>& buffer) {
    if (entry.size > maxBytes)
        return Error(Code::InputTooBig,
                     fmt::format("entry {} has {} bytes, {} are possible", shown(entry.name), entry.size, maxBytes));
    std::span<const std::byte> data = entry.data;
    if (entry.isDeflated) {
        if (entry.size > maxUnpacked(data.size()))
            return badVolume(fmt::format("entry {} cannot unpack from {} bytes to {}, at most {} are possible",
                                         shown(entry.name), data.size(), entry.size, maxUnpacked(data.size())));
        if (!inflateInto(entry, buffer))
            return badVolume(
                fmt::format("entry {} cannot be unpacked: the file is damaged. Copy it again or build the "
                            "volume again.",
                            shown(entry.name)));
        data = buffer;
    }
    if (const std::uint32_t actual = crc32Of(data); actual != entry.crc)
        return Error(
            Code::BadChecksum,
            fmt::format("the data of entry {} have CRC32 {:08x}, {:08x} is expected: the file is damaged. Copy "
                        "it again or build the volume again.",
                        shown(entry.name), actual, entry.crc));
    return data;
}

}  // namespace svt::volume

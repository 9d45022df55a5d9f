#include <svt/readers/format/zip_member.hpp>

#include <svt/core/bytes.hpp>
#include <svt/core/deflate.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace svt::readers {
namespace {

using ZipBytes = std::span<const std::byte>;

// Records of APPNOTE.TXT of PKWARE, 4.3: sizes without names, extra fields and comments.
constexpr std::size_t kEndSize = 22, kCentralSize = 46, kLocalSize = 30;
constexpr std::size_t kMaxComment = 65535;

bool hasSignature(ZipBytes bytes, std::size_t at, std::uint32_t signature) noexcept {
    return at + 4 <= bytes.size() && loadBytes<std::uint32_t>(bytes, at) == signature;
}

// The end of the central directory, and the number of bytes after it and its comment.
struct ZipEnd {
    std::size_t offset = 0, beyond = 0;
};

// The record that ends at the end of the file, or else the last record.
std::optional<ZipEnd> findEnd(ZipBytes bytes) noexcept {
    if (bytes.size() < kEndSize) return std::nullopt;
    std::optional<ZipEnd> found;
    const std::size_t last = bytes.size() - kEndSize, first = last > kMaxComment ? last - kMaxComment : 0;
    for (std::size_t at = last + 1; at-- > first;) {
        if (!hasSignature(bytes, at, 0x06054B50)) continue;
        const std::size_t comment = loadBytes<std::uint16_t>(bytes, at + 20), room = last - at;
        if (comment == room) return ZipEnd{at, 0};
        if (!found) found = ZipEnd{at, comment < room ? room - comment : 0};
    }
    return found;
}

// A file in the directory of the archive.
struct DirectoryEntry {
    std::string name;
    std::uint32_t flags = 0, method = 0, checksum = 0, packed = 0, size = 0, local = 0;
};

// The files of the directory; nothing if it is damaged.
std::optional<std::vector<DirectoryEntry>> readDirectory(ZipBytes bytes, std::size_t end) {
    std::vector<DirectoryEntry> entries;
    const std::size_t begin = loadBytes<std::uint32_t>(bytes, end + 16),
                      size = loadBytes<std::uint32_t>(bytes, end + 12);
    std::size_t at = begin;
    for (std::uint32_t left = loadBytes<std::uint16_t>(bytes, end + 10); left > 0; --left) {
        if (at > end || end - at < kCentralSize || !hasSignature(bytes, at, 0x02014B50)) return std::nullopt;
        const std::size_t nameSize = loadBytes<std::uint16_t>(bytes, at + 28);
        const std::size_t next = at + kCentralSize + nameSize + loadBytes<std::uint16_t>(bytes, at + 30) +
                                 loadBytes<std::uint16_t>(bytes, at + 32);
        if (next > end) return std::nullopt;
        entries.push_back({std::string(reinterpret_cast<const char*>(bytes.data()) + at + kCentralSize, nameSize),
                           loadBytes<std::uint16_t>(bytes, at + 8), loadBytes<std::uint16_t>(bytes, at + 10),
                           loadBytes<std::uint32_t>(bytes, at + 16), loadBytes<std::uint32_t>(bytes, at + 20),
                           loadBytes<std::uint32_t>(bytes, at + 24), loadBytes<std::uint32_t>(bytes, at + 42)});
        at = next;
    }
    if (at - begin != size) return std::nullopt;
    return entries;
}

bool isWanted(const DirectoryEntry& entry, std::span<const std::string_view> extensions) {
    const std::string lower = lowerAscii(entry.name);
    const std::string_view file = std::string_view(lower).substr(lower.find_last_of("/\\") + 1);
    if (file.starts_with("._") || lower.starts_with("__macosx/")) return false;
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](std::string_view extension) { return lower.ends_with(extension); });
}

// The packed bytes of a file, if its local header has the same name as the directory.
std::optional<ZipBytes> packedBytes(ZipBytes bytes, std::size_t end, const DirectoryEntry& entry) noexcept {
    const std::size_t local = entry.local;
    if (local > end || end - local < kLocalSize || !hasSignature(bytes, local, 0x04034B50)) return std::nullopt;
    const std::size_t nameSize = loadBytes<std::uint16_t>(bytes, local + 26), nameAt = local + kLocalSize;
    const std::size_t begin = nameAt + nameSize + loadBytes<std::uint16_t>(bytes, local + 28);
    if (begin > end || entry.packed > end - begin) return std::nullopt;
    const std::string_view name(reinterpret_cast<const char*>(bytes.data()) + nameAt, nameSize);
    if (name != entry.name) return std::nullopt;
    return bytes.subspan(begin, entry.packed);
}

// "'a.ifc', 'b.ifc' and 3 more".
std::string namesOf(const std::vector<DirectoryEntry>& entries) {
    constexpr std::size_t kShown = 10;
    std::string text;
    for (std::size_t n = 0; n < std::min(entries.size(), kShown); ++n)
        text += fmt::format("{}'{}'", n == 0 ? "" : ", ", entries[n].name.substr(0, 80));
    if (entries.size() > kShown) text += fmt::format(" and {} more", entries.size() - kShown);
    return text;
}

Error failed(Code code, std::string_view archive, std::string message) {
    return {code, std::move(message), {std::string(archive), 0, 0, {}}};
}

// A file that can be unpacked.
Result<ZipMember> openMember(ZipBytes bytes, std::size_t end, const DirectoryEntry& entry, std::string_view archive) {
    constexpr std::uint32_t kInExtraField = 0xFFFFFFFFu;
    if ((entry.flags & 1) != 0)
        return failed(Code::CannotOpen, archive, fmt::format("'{}' in the zip archive is encrypted", entry.name));
    if (entry.method != 0 && entry.method != 8)
        return failed(Code::CannotOpen, archive,
                      fmt::format("'{}' in the zip archive is packed by method {}, not deflate; unpack it first",
                                  entry.name, entry.method));
    if (entry.packed == kInExtraField || entry.size == kInExtraField || entry.local == kInExtraField)
        return failed(Code::CannotOpen, archive,
                      fmt::format("'{}' is in a ZIP64 archive, which cannot be read; unpack it first", entry.name));
    const auto packed = packedBytes(bytes, end, entry);
    if (!packed)
        return failed(
            Code::CannotOpen, archive,
            fmt::format("'{}' in the zip archive is damaged: it does not stand where the directory says; copy "
                        "or download the archive again",
                        entry.name));
    return ZipMember{entry.name, *packed, entry.size, entry.checksum, entry.method == 8};
}

}  // namespace

bool isZip(ZipBytes bytes) noexcept { return hasSignature(bytes, 0, 0x04034B50); }

Result<ZipMember> findZipMember(ZipBytes bytes, std::string_view archive,
                                std::span<const std::string_view> extensions) {
    const auto end = findEnd(bytes);
    if (!end)
        return failed(Code::CannotOpen, archive,
                      "the zip archive has no directory at its end; the file seems to be cut off");
    if (end->beyond != 0)
        return failed(
            Code::CannotOpen, archive,
            fmt::format("{} bytes stand behind the end of the zip archive; copy or download it again", end->beyond));
    auto entries = readDirectory(bytes, end->offset);
    if (!entries) return failed(Code::CannotOpen, archive, "the directory of the zip archive is damaged");
    const bool isVolume = std::ranges::any_of(*entries, [](const auto& entry) { return entry.name == "svt.json"; });
    std::erase_if(*entries, [&](const DirectoryEntry& entry) { return !isWanted(entry, extensions); });
    if (entries->empty())
        return failed(Code::UnknownFormat, archive,
                      isVolume
                          ? "this is a volume (.svt), and a model is expected; give the model from which it was built"
                          : "this is a zip archive without an IFC file (.ifc); unpack it first");
    if (entries->size() > 1)
        return failed(Code::CannotOpen, archive,
                      fmt::format("the zip archive holds {} models, and one is expected: {}; unpack it and read them "
                                  "one by one",
                                  entries->size(), namesOf(*entries)));
    return openMember(bytes, end->offset, entries->front(), archive);
}

Result<void> checkZipMember(const ZipMember& member, ZipBytes unpacked, std::string_view archive) {
    const auto damaged = [&](const std::string& what) {
        return failed(Code::CannotOpen, archive,
                      fmt::format("'{}' in the zip archive is damaged: {}; copy or download the archive again",
                                  member.name, what));
    };
    if (unpacked.size() != member.size)
        return damaged(fmt::format("it has {} bytes, and the archive says {}", unpacked.size(), member.size));
    if (const std::uint32_t checksum = zipChecksum(unpacked); checksum != member.checksum)
        return damaged(fmt::format("its CRC-32 is {:08x}, and the archive says {:08x}", checksum, member.checksum));
    return {};
}

}  // namespace svt::readers

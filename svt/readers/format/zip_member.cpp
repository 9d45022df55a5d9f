#include <svt/readers/format/zip_member.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::readers {
namespace {

using ZipBytes = std::span<const std::byte>;

// Records of APPNOTE.TXT of PKWARE, 4.3: sizes without names, extra fields and comments.
constexpr std::size_t kEndSize = 22, kCentralSize = 46, kLocalSize = 30;
constexpr std::size_t kMaxComment = 65535;

std::uint32_t number(ZipBytes bytes, std::size_t at, int size) noexcept {
    std::uint32_t value = 0;
    for (int i = size - 1; i >= 0; --i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + std::size_t(i)]);
    return value;
}

bool hasSignature(ZipBytes bytes, std::size_t at, std::uint32_t signature) noexcept {
    return at + 4 <= bytes.size() && number(bytes, at, 4) == signature;
}

// Offset of the end of the central directory, or npos.
std::size_t findEnd(ZipBytes bytes) noexcept {
    if (bytes.size() < kEndSize) return std::string_view::npos;
    const std::size_t last = bytes.size() - kEndSize, first = last > kMaxComment ? last - kMaxComment : 0;
    for (std::size_t at = last + 1; at-- > first;)
        if (hasSignature(bytes, at, 0x06054B50)) return at;
    return std::string_view::npos;
}

}  // namespace

bool isZip(ZipBytes bytes) noexcept { return hasSignature(bytes, 0, 0x04034B50); }

Result<ZipMember> findZipMember(ZipBytes bytes, std::string_view archive,
                                std::span<const std::string_view> extensions) {
    const auto fail = [&](Code code, std::string message) {
        return Error(code, std::move(message), {std::string(archive), 0, 0, {}});
    };
    const std::size_t end = findEnd(bytes);
    if (end == std::string_view::npos)
        return fail(Code::CannotOpen, "the zip archive has no directory at its end; the file seems to be cut off");
    std::size_t at = number(bytes, end + 16, 4);
    for (std::uint32_t left = number(bytes, end + 10, 2); left > 0; --left) {
        if (at > end || end - at < kCentralSize || !hasSignature(bytes, at, 0x02014B50)) break;
        const std::size_t nameSize = number(bytes, at + 28, 2);
        const std::size_t next = at + kCentralSize + nameSize + number(bytes, at + 30, 2) + number(bytes, at + 32, 2);
        if (next > end) break;
        const std::string name(reinterpret_cast<const char*>(bytes.data()) + at + kCentralSize, nameSize);
        const std::string lower = lowerAscii(name);
        const bool isWanted = std::any_of(extensions.begin(), extensions.end(),
                                          [&](std::string_view extension) { return lower.ends_with(extension); });
        if (!isWanted) {
            at = next;
            continue;
        }
        const std::uint32_t method = number(bytes, at + 10, 2);
        if ((number(bytes, at + 8, 2) & 1) != 0)
            return fail(Code::CannotOpen, fmt::format("'{}' in the zip archive is encrypted", name));
        if (method != 0 && method != 8)
            return fail(Code::CannotOpen,
                        fmt::format("'{}' in the zip archive is packed by method {}, not deflate; unpack it first",
                                    name, method));
        const std::size_t local = number(bytes, at + 42, 4), packed = number(bytes, at + 20, 4);
        if (local > end || end - local < kLocalSize || !hasSignature(bytes, local, 0x04034B50)) break;
        const std::size_t begin = local + kLocalSize + number(bytes, local + 26, 2) + number(bytes, local + 28, 2);
        if (begin > end || packed > end - begin) break;
        return ZipMember{name, bytes.subspan(begin, packed), number(bytes, at + 24, 4), method == 8};
    }
    if (at > end || !hasSignature(bytes, at, 0x02014B50))
        if (at != end) return fail(Code::CannotOpen, "the directory of the zip archive is damaged");
    return fail(Code::UnknownFormat, "this is a zip archive without an IFC file (.ifc); unpack it first");
}

}  // namespace svt::readers

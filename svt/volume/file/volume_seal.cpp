#include <svt/volume/volume_json.hpp>

#include <svt/core/deflate.hpp>

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <span>
#include <vector>

namespace svt::volume {
namespace {

constexpr std::string_view kSealMark = "svt-seal ";
constexpr std::size_t kHexDigits = 8;

template <class T>
std::uint32_t checksumOf(std::span<const T> values, std::uint32_t before = 0) noexcept {
    return zipChecksum(std::as_bytes(values), before);
}

/// For each distinct row of a tile the checksum of its samples, whatever the numbers of its columns are.
std::vector<std::uint32_t> rowChecksums(const ColumnTile& tile, std::size_t width) {
    std::vector<std::uint32_t> ofColumn, ofRow, row(width);
    for (std::uint32_t c = 0; c + 1 < tile.columnStart.size(); ++c) ofColumn.push_back(checksumOf(tile.column(c)));
    for (std::size_t at = 0; at + width <= tile.rowColumns.size(); at += width) {
        for (std::size_t x = 0; x < width; ++x) row[x] = ofColumn[tile.rowColumns[at + x]];
        ofRow.push_back(checksumOf(std::span<const std::uint32_t>(row)));
    }
    return ofRow;
}

}  // namespace

std::uint32_t tableChecksum(const SemanticVolume& volume) {
    const std::string header = writeHeaderJson(volume), labels = writeLabelsJson(volume.labels);
    return checksumOf(std::span<const char>(labels), checksumOf(std::span<const char>(header)));
}

std::uint32_t columnsChecksum(const ColumnVolume& columns) {
    const Vec3i d = columns.dimension();
    const std::array<std::int32_t, 3> sizes{d.x, d.y, d.z};
    std::uint32_t checksum = checksumOf(std::span<const std::int32_t>(sizes));
    std::size_t number = 0;
    for (const ColumnTile& tile : columns.tiles()) {
        const auto tileX = static_cast<std::int32_t>(number++ % static_cast<std::size_t>(columns.tilesX()));
        const auto ofRow = rowChecksums(tile, static_cast<std::size_t>(columns.tileWidth(tileX)));
        for (const std::uint8_t row : tile.rowOf)
            checksum = checksumOf(std::span<const std::uint32_t>(&ofRow[row], 1), checksum);
    }
    return checksum;
}

std::string sealText(const SemanticVolume& volume, const ColumnVolume& columns) {
    return fmt::format("{}{:08x} {:08x}", kSealMark, tableChecksum(volume), columnsChecksum(columns));
}

std::optional<VolumeSeal> readSeal(std::string_view text) noexcept {
    const std::size_t size = kSealMark.size() + 2 * kHexDigits + 1;
    if (!text.starts_with(kSealMark) || text.size() < size) return std::nullopt;
    VolumeSeal seal;
    const auto read = [&](std::size_t at, std::uint32_t& to) {
        const char* begin = text.data() + at;
        return std::from_chars(begin, begin + kHexDigits, to, 16).ptr == begin + kHexDigits;
    };
    if (!read(kSealMark.size(), seal.table) || !read(kSealMark.size() + kHexDigits + 1, seal.columns))
        return std::nullopt;
    return seal;
}

}  // namespace svt::volume

#include <svt/fields/field_blocks.hpp>

#include <svt/core/bytes.hpp>
#include <svt/fields/codec/block_codec.hpp>
#include <svt/fields/codec/field_entries.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::fields {
namespace {

std::span<const std::byte> bytesOfText(const std::string& text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

Error wrongBlock(const std::string& name, std::string_view why) {
    return Error(Code::BadField, fmt::format("field '{}': {}", name, why));
}

}  // namespace

Result<FieldBlocks> FieldBlocks::open(volume::ReadRange read, std::uint64_t fileSize, const std::string& name) {
    SVT_TRY(file, volume::ZipRanges::open(std::move(read), fileSize));
    SVT_TRY(stored, findField(*file, name));
    FieldBlocks blocks;
    blocks.stored_ = std::move(*stored);
    const FieldHead& head = blocks.stored_.head;
    if (head.kind != FieldKind::Grid) return wrongBlock(name, "only fields of kind grid have blocks");
    SVT_TRY(indexEntry, findEntry(*file, entryName(name, "index")));
    SVT_TRY(framesEntry, findEntry(*file, entryName(name, "blocks")));
    if (framesEntry->isDeflated) return wrongBlock(name, "its blocks are deflated, they must be stored");
    const std::uint64_t count = blocksOf(head, blocks.stored_.code);
    const std::uint64_t expected = count * indexRecordBytes(blocks.stored_.code, head.components);
    if (indexEntry->size != expected)
        return wrongBlock(name,
                          fmt::format("its index has {} bytes; {} blocks take {}", indexEntry->size, count, expected));
    SVT_TRY(index, file->unpacked(*indexEntry, expected));
    SVT_TRY(offset, file->dataOffset(*framesEntry));
    blocks.framesOffset_ = *offset;
    SVT_DO(blocks.readIndex(*index, framesEntry->packedSize));
    blocks.file_ = std::make_shared<const volume::ZipRanges>(std::move(*file));
    return blocks;
}

Result<FieldBlocks> FieldBlocks::open(const std::filesystem::path& path, const std::string& name) {
    SVT_TRY(opened, PartFile::open(path));
    const auto file = std::make_shared<const PartFile>(std::move(*opened));
    auto blocks = open([file](std::uint64_t offset, std::size_t size) { return file->readAll(offset, size); },
                       file->size(), name);
    if (!blocks) return inFile(blocks.error(), path);
    return blocks;
}

Result<void> FieldBlocks::readIndex(const std::vector<std::byte>& index, std::uint64_t frameBytes) {
    const FieldCode& code = stored_.code;
    const auto components = std::size_t(head().components);
    const std::size_t record = indexRecordBytes(code, head().components);
    const std::size_t count = index.size() / record;
    entries_.reserve(count);
    ranges_.reserve(count * components);
    std::uint64_t offset = 0;
    for (std::size_t b = 0; b < count; ++b) {
        const std::size_t at = b * record;
        Entry entry{offset, loadBytes<std::uint32_t>(index, at), loadBytes<std::uint32_t>(index, at + 4)};
        for (std::size_t c = 0; c < components; ++c) {
            const auto range = loadRange(index, at + 8 + c * 2 * code.bytes(), code);
            const bool isMissing = std::isnan(range.first) && std::isnan(range.second);
            const bool isRange =
                std::isfinite(range.first) && std::isfinite(range.second) && range.first <= range.second;
            if (!isMissing && !isRange)
                return wrongBlock(head().name, fmt::format("block {} of its index has a range that is not valid", b));
            if (entry.size == 0 && !isMissing && range.first != range.second)
                return wrongBlock(head().name,
                                  fmt::format("block {} of its index has several values, but no bytes", b));
            ranges_.push_back(range);
        }
        if (entry.size == 0 && entry.crc != 0)
            return wrongBlock(head().name, fmt::format("block {} of its index has a checksum, but no bytes", b));
        offset += entry.size;
        entries_.push_back(entry);
    }
    if (offset != frameBytes)
        return wrongBlock(head().name,
                          fmt::format("its blocks have {} bytes, the index states {}", frameBytes, offset));
    return {};
}

std::size_t FieldBlocks::entryOf(std::int32_t level, std::size_t time, Vec3i block) const noexcept {
    std::uint64_t first = 0;
    for (std::int32_t l = 0; l < level; ++l) first += blocksOf(head().lattice, l) * head().times.size();
    const Vec3i count = blockCount(head().lattice, level);
    return static_cast<std::size_t>(first + blocksOf(head().lattice, level) * time) + std::size_t(block.x) +
           std::size_t(count.x) * (std::size_t(block.y) + std::size_t(count.y) * std::size_t(block.z));
}

Result<FieldBlocks::Block> FieldBlocks::read(std::int32_t level, std::size_t time, Vec3i block) const {
    const std::string place =
        fmt::format("block {},{},{} of level {} and time {}", block.x, block.y, block.z, level, time);
    if (level < 0 || level >= stored_.code.levels || time >= head().times.size())
        return wrongBlock(head().name, "it has no " + place);
    const Vec3i count = blockCount(head().lattice, level), size = levelSize(head().lattice, level);
    Block made;
    for (int axis = 0; axis < 3; ++axis) {
        if (block[axis] < 0 || block[axis] >= count[axis]) return wrongBlock(head().name, "it has no " + place);
        made.first[axis] = block[axis] * kBlockNodes;
        made.size[axis] = std::min(kBlockNodes, size[axis] - made.first[axis]);
    }
    const std::size_t nodes = std::size_t(made.size.x) * std::size_t(made.size.y) * std::size_t(made.size.z);
    const auto components = std::size_t(head().components);
    const std::size_t number = entryOf(level, time, block);
    const Entry& entry = entries_[number];
    if (entry.size == 0) {
        for (std::size_t c = 0; c < components; ++c)
            made.values.insert(made.values.end(), nodes, ranges_[number * components + c].first);
        return made;
    }
    SVT_TRY(frame, file_->bytes(framesOffset_ + entry.offset, entry.size));
    if (frame->size() != entry.size) return wrongBlock(head().name, place + " is missing");
    if (volume::checksumOf(bytesOfText(*frame)) != entry.crc)
        return wrongBlock(head().name, place +
                                           " has another CRC32 than the index states: the file is damaged. Add the "
                                           "field again.");
    const std::uint64_t expected = nodes * components * stored_.code.bytes();
    const auto bytes = volume::unpackFrame(bytesOfText(*frame), expected, place);
    if (!bytes) return wrongBlock(head().name, bytes.error().message());
    if (bytes->size() != expected)
        return wrongBlock(head().name,
                          fmt::format("{} unpacks to {} bytes, {} are expected", place, bytes->size(), expected));
    auto values = decodeValues(std::as_bytes(std::span(*bytes)), stored_.code);
    if (!values) return wrongBlock(head().name, place + ": " + values.error().message());
    made.values = std::move(*values);
    return made;
}

std::optional<std::pair<float, float>> FieldBlocks::range(std::int32_t level, std::size_t time, Vec3i block,
                                                          std::int32_t component) const noexcept {
    const auto& range = ranges_[entryOf(level, time, block) * std::size_t(head().components) + std::size_t(component)];
    if (std::isnan(range.first)) return std::nullopt;
    return range;
}

}  // namespace svt::fields

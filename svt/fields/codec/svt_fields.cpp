#include <svt/fields/svt_fields.hpp>

#include <svt/core/file.hpp>
#include <svt/core/parallel.hpp>
#include <svt/fields/check_field.hpp>
#include <svt/fields/codec/block_codec.hpp>
#include <svt/fields/codec/field_entries.hpp>
#include <svt/fields/codec/field_json.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/volume/zip_entries.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_set>

namespace svt::fields {
namespace {

using volume::EntryPlace;
using volume::NewEntry;
using volume::ZipRanges;

// A file for reading by ranges.
struct OpenedFile {
    volume::ReadRange read;
    std::uint64_t size = 0;
};

Result<OpenedFile> openFile(const std::filesystem::path& path) {
    SVT_TRY(opened, PartFile::open(path));
    const auto file = std::make_shared<const PartFile>(std::move(*opened));
    return OpenedFile{[file](std::uint64_t offset, std::size_t size) { return file->readAll(offset, size); },
                      file->size()};
}

Error tooBig(const FieldHead& head, std::uint64_t bytes, std::uint64_t most) {
    return Error(Code::InputTooBig,
                 fmt::format("field '{}': its values take {} bytes, {} are possible", head.name, bytes, most));
}

Result<Field> readGrid(const volume::ReadRange& read, std::uint64_t fileSize, const std::string& name,
                       std::uint64_t maxBytes, int threads) {
    SVT_TRY(blocks, FieldBlocks::open(read, fileSize, name));
    Field field;
    field.head = blocks->head();
    const std::uint64_t count = valueCount(field.head, 0);
    if (count > maxBytes / sizeof(float)) return tooBig(field.head, count * sizeof(float), maxBytes);
    field.values.resize(static_cast<std::size_t>(count));
    const Vec3i n = field.head.lattice.size, number = blockCount(field.head.lattice, 0);
    const std::size_t places = placeCount(field.head, 0), perTime = std::size_t(blocksOf(field.head.lattice, 0));
    const auto components = std::size_t(field.head.components);
    std::vector<std::optional<Error>> errors(perTime * field.head.times.size());
    const auto copyBlock = [&](std::size_t time, const FieldBlocks::Block& block) {
        const float* from = block.values.data();
        for (std::size_t c = 0; c < components; ++c)
            for (std::int32_t z = 0; z < block.size.z; ++z)
                for (std::int32_t y = 0; y < block.size.y; ++y) {
                    float* to = field.values.data() + (time * components + c) * places + std::size_t(block.first.x) +
                                std::size_t(n.x) * (std::size_t(block.first.y + y) +
                                                    std::size_t(n.y) * std::size_t(block.first.z + z));
                    std::copy_n(from, block.size.x, to);
                    from += block.size.x;
                }
    };
    parallelFor(errors.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            const auto at = static_cast<std::int32_t>(b % perTime);
            auto block =
                blocks->read(0, b / perTime, {at % number.x, at / number.x % number.y, at / number.x / number.y});
            if (block)
                copyBlock(b / perTime, *block);
            else
                errors[b] = block.error();
        }
    });
    for (const auto& error : errors)
        if (error) return *error;
    return field;
}

Result<Field> readValues(const ZipRanges& file, const StoredField& stored, std::uint64_t maxBytes) {
    SVT_TRY(entry, findEntry(file, entryName(stored.head.name, "values")));
    const std::uint64_t perPlace = std::uint64_t{stored.head.times.size()} *
                                   static_cast<std::uint64_t>(stored.head.components) * stored.code.bytes();
    const std::uint64_t bytes = entry->size / stored.code.bytes() * sizeof(float);
    if (bytes > maxBytes) return tooBig(stored.head, bytes, maxBytes);
    const bool isWhole = stored.head.kind == FieldKind::Points ? entry->size == perPlace * stored.head.points.size()
                                                               : entry->size % perPlace == 0;
    if (!isWhole)
        return Error(Code::BadField,
                     fmt::format("field '{}': its values have {} bytes, which are not {} for each place",
                                 stored.head.name, entry->size, perPlace));
    SVT_TRY(data, file.unpacked(*entry, maxBytes));
    auto values = decodeValues(*data, stored.code);
    if (!values)
        return Error(Code::BadField, fmt::format("field '{}': {}", stored.head.name, values.error().message()));
    return Field{stored.head, std::move(*values)};
}

// The entries of one new field; they own their bytes.
struct MadeField {
    StoredField stored;
    std::vector<std::byte> index, values;
    std::vector<std::vector<std::byte>> frames;
};

Result<MadeField> makeField(const Field& field, std::size_t labelCount, int threads) {
    SVT_DO(checkField(field, labelCount));
    SVT_TRY(code, codeFor(field));
    MadeField made;
    made.stored.head = field.head;
    made.stored.code = *code;
    std::optional<std::pair<float, float>>& range = made.stored.range;
    for (const float value : field.values) {
        if (std::isnan(value)) continue;
        if (!range) range.emplace(value, value);
        range->first = std::min(range->first, value);
        range->second = std::max(range->second, value);
    }
    if (range && !code->isFloat)
        range.emplace(valueOf(codeOf(range->first, *code), *code), valueOf(codeOf(range->second, *code), *code));
    if (field.head.kind == FieldKind::Grid) {
        SVT_TRY(blocks, encodeBlocks(field, *code, threads));
        made.index = std::move(blocks->index);
        made.frames = std::move(blocks->frames);
    } else {
        made.values = encodeValues(field.values, *code);
    }
    return made;
}

void addEntries(const MadeField& made, std::vector<NewEntry>& entries) {
    const std::string& name = made.stored.head.name;
    if (made.stored.head.kind != FieldKind::Grid) {
        entries.push_back({entryName(name, "values"), {std::span<const std::byte>(made.values)}, true});
        return;
    }
    entries.push_back({entryName(name, "index"), {std::span<const std::byte>(made.index)}, false});
    NewEntry blocks{entryName(name, "blocks"), {}, false};
    for (const auto& frame : made.frames)
        if (!frame.empty()) blocks.parts.emplace_back(frame);
    entries.push_back(std::move(blocks));
}

// The name of the field that an entry belongs to; empty for other entries.
std::string_view fieldOfEntry(std::string_view entry) {
    if (!entry.starts_with(kFieldsFolder)) return {};
    entry.remove_prefix(kFieldsFolder.size());
    return entry.substr(0, entry.find('/'));
}

// The fields that stay, and the new ones at the place of those that they replace.
Result<std::vector<StoredField>> mergedFields(std::vector<StoredField> before, const std::vector<MadeField>& made,
                                              std::span<const std::string> removed) {
    for (const std::string& name : removed)
        if (std::none_of(before.begin(), before.end(), [&](const StoredField& f) { return f.head.name == name; }))
            return unknownField(name, before);
    std::vector<StoredField> merged;
    for (StoredField& field : before)
        if (std::find(removed.begin(), removed.end(), field.head.name) == removed.end())
            merged.push_back(std::move(field));
    for (const MadeField& one : made) {
        const auto found = std::find_if(merged.begin(), merged.end(),
                                        [&](const StoredField& f) { return f.head.name == one.stored.head.name; });
        if (found == merged.end())
            merged.push_back(one.stored);
        else
            *found = one.stored;
    }
    if (merged.size() > kMaxFields)
        return Error(Code::BadField,
                     fmt::format("the volume would have {} fields, {} are possible", merged.size(), kMaxFields));
    return merged;
}

}  // namespace

Result<std::vector<ListedField>> listFields(const volume::ReadRange& read, std::uint64_t fileSize) {
    SVT_TRY(file, ZipRanges::open(read, fileSize));
    SVT_TRY(stored, storedFields(*file));
    std::vector<ListedField> listed;
    for (StoredField& field : *stored) {
        std::uint64_t bytes = 0;
        for (const EntryPlace& entry : file->entries())
            if (fieldOfEntry(entry.name) == field.head.name) bytes += entry.packedSize;
        listed.push_back({std::move(field), bytes});
    }
    return listed;
}

Result<std::vector<ListedField>> listFields(const std::filesystem::path& path) {
    SVT_TRY(file, openFile(path));
    auto listed = listFields(file->read, file->size);
    if (!listed) return inFile(listed.error(), path);
    return listed;
}

Result<std::vector<FieldHead>> readFieldHeads(const std::filesystem::path& path) {
    SVT_TRY(listed, listFields(path));
    std::vector<FieldHead> heads;
    for (ListedField& field : *listed) heads.push_back(std::move(field.stored.head));
    return heads;
}

Result<Field> readField(const volume::ReadRange& read, std::uint64_t fileSize, const std::string& name,
                        std::uint64_t maxBytes, int threads) {
    SVT_TRY(file, ZipRanges::open(read, fileSize));
    SVT_TRY(stored, findField(*file, name));
    if (stored->head.kind == FieldKind::Grid) return readGrid(read, fileSize, name, maxBytes, threads);
    return readValues(*file, *stored, maxBytes);
}

Result<Field> readField(const std::filesystem::path& path, const std::string& name, std::uint64_t maxBytes,
                        int threads) {
    SVT_TRY(file, openFile(path));
    auto field = readField(file->read, file->size, name, maxBytes, threads);
    if (!field) return inFile(field.error(), path);
    return field;
}

Result<std::uint64_t> writeFields(const std::filesystem::path& input, const std::filesystem::path& output,
                                  std::span<const Field> fields, std::span<const std::string> removed, int threads) {
    SVT_TRY(file, FileBytes::read(input));
    SVT_TRY(tables, volume::openSvt(file->bytes(), input.string()));
    // The fields come from the same bytes, because another program may replace the file meanwhile.
    const std::span<const std::byte> bytes = file->bytes();
    const auto read = [bytes](std::uint64_t offset, std::size_t size) -> Result<std::string> {
        return std::string(reinterpret_cast<const char*>(bytes.data()) + offset, size);
    };
    auto ranges = ZipRanges::open(read, bytes.size());
    if (!ranges) return inFile(ranges.error(), input);
    auto before = storedFields(*ranges);
    if (!before) return inFile(before.error(), input);
    std::vector<MadeField> made;
    std::unordered_set<std::string_view> replaced;
    for (const Field& field : fields) {
        if (!replaced.insert(field.head.name).second)
            return Error(Code::BadField, fmt::format("two fields have the name '{}'", field.head.name));
        SVT_TRY(one, makeField(field, tables->labels.labels.size(), threads));
        made.push_back(std::move(*one));
    }
    for (const std::string& name : removed) replaced.insert(name);
    SVT_TRY(merged, mergedFields(std::move(*before), made, removed));
    SVT_TRY(json, writeFieldsJson(*merged));
    const std::string heads = std::move(*json);
    std::vector<NewEntry> entries;
    if (!merged->empty()) entries.push_back({std::string(kFieldsJson), {std::as_bytes(std::span(heads))}, true});
    for (const MadeField& one : made) addEntries(one, entries);
    const auto isKept = [&](std::string_view entry) {
        return entry != kFieldsJson && !replaced.contains(fieldOfEntry(entry));
    };
    return volume::writeWithEntries(file->bytes(), output, isKept, entries);
}

}  // namespace svt::fields

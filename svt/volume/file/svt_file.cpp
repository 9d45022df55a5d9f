#include <svt/core/file.hpp>
#include <svt/volume/file/bad_volume.hpp>
#include <svt/volume/file/zip_container.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/volume/volume_json.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace svt::volume {
namespace {

static_assert(std::endian::native == std::endian::little, "the index of the blocks is used as it stands in the file");

constexpr std::string_view kMimeType = "application/vnd.svt+zip";
constexpr std::size_t kMimeOffset = 38;  // 30 bytes of local header and the 8 of its name

constexpr std::string_view kMimeEntry = "mimetype";
constexpr std::string_view kHeader = "svt.json";
constexpr std::string_view kLabels = "labels.json";
constexpr std::string_view kIndex = "columns/index";
constexpr std::string_view kBlocks = "columns/blocks";
// Optional entries:
constexpr std::string_view kVectors = "meshes/shapes";
constexpr std::string_view kPlanes = "meshes/planes";
constexpr std::string_view kFootprints = "meshes/footprints";
constexpr std::string_view kTenthParts = "meshes/parts";  // of older files, instead of kVectors
constexpr std::string_view kUsed[] = {kMimeEntry, kHeader, kLabels,     kIndex,     kBlocks,
                                      kVectors,   kPlanes, kFootprints, kTenthParts};

Error named(const Error& error, const std::string& file) {
    return Error(error.code(), error.message(), Place{file, 0, 0, {}});
}

Result<void> checkWritable(const SemanticVolume& volume) {
    const auto wrong = [](std::string message) { return Error(Code::BadArgument, std::move(message)); };
    const Vec3i grid = volume.grid.dimension();
    const Vec3i columns = volume.columns.dimension();
    if (grid != columns)
        return wrong(fmt::format("the grid has {} x {} x {} samples, the columns have {} x {} x {}", grid.x, grid.y,
                                 grid.z, columns.x, columns.y, columns.z));
    if (auto checked = checkLabels(volume.labels); !checked) return wrong(checked.error().message());
    const Scalar scalarCount = volume.labels.scalarCount();
    for (const ColumnTile& tile : volume.columns.tiles())
        for (const Run& run : tile.runs)
            if (run.scalar >= scalarCount) return wrong(fmt::format("scalar {} belongs to no label", run.scalar));
    if (auto checked = checkVectorParts(volume.vectors, volume.labels.labels.size()); !checked)
        return wrong(checked.error().message());
    if (auto checked = checkVectorParts(volume.footprints, volume.labels.labels.size()); !checked)
        return wrong(checked.error().message());
    if (auto checked = checkFacePlanes(volume.planes, grid); !checked) return wrong(checked.error().message());
    return {};
}

/// The entries of a file by name.
class Entries {
public:
    explicit Entries(std::vector<ZipEntry> entries) : entries_(std::move(entries)) {}

    [[nodiscard]] bool has(std::string_view name) const {
        return std::any_of(entries_.begin(), entries_.end(), [&](const ZipEntry& entry) { return entry.name == name; });
    }
    [[nodiscard]] Result<ZipEntry> find(std::string_view name) const {
        for (const ZipEntry& entry : entries_)
            if (entry.name == name) return entry;
        return badVolume(fmt::format("the entry '{}' is missing; the .svt is incomplete, build it again", name));
    }
    /// Data of a stored or deflated entry, with checked CRC; unpacked into `buffer` if deflated.
    [[nodiscard]] Result<std::string_view> text(std::string_view name, std::uint64_t maxBytes,
                                                std::vector<std::byte>& buffer) const {
        SVT_TRY(entry, find(name));
        SVT_TRY(data, unpack(*entry, maxBytes, buffer));
        return std::string_view(reinterpret_cast<const char*>(data->data()), data->size());
    }
    /// An entry that must be stored (not deflated), as a view of the file. Its CRC is not checked.
    [[nodiscard]] Result<ZipEntry> stored(std::string_view name) const {
        auto entry = find(name);
        if (entry && entry->isDeflated)
            return badVolume(fmt::format(
                "the entry '{}' is deflated, it must be stored; pack the file again with 'zip -0 -X'", name));
        return entry;
    }
    /// Checks the CRC of stored entries with unknown names: they are not used, but damage is reported.
    [[nodiscard]] Result<void> checkOthers() const {
        std::vector<std::byte> buffer;
        for (const ZipEntry& entry : entries_) {
            if (entry.isDeflated || std::find(std::begin(kUsed), std::end(kUsed), entry.name) != std::end(kUsed))
                continue;
            SVT_DO(unpack(entry, entry.size, buffer));
        }
        return {};
    }

private:
    std::vector<ZipEntry> entries_;
};

Result<Entries> openEntries(std::span<const std::byte> bytes) {
    if (bytes.empty()) return badVolume("the file is empty");
    if (!looksLikeSvt(bytes))
        return badVolume(
            "this is not a .svt: a ZIP whose first entry is 'mimetype' with 'application/vnd.svt+zip' is expected, "
            "and the file may be cut short. Build one from a model with 'svt build'.");
    SVT_TRY(found, readZip(bytes));
    return Entries(std::move(*found));
}

Result<SvtBlocks> readTables(const Entries& entries) {
    std::vector<std::byte> buffer;
    SVT_TRY(mime, entries.stored(kMimeEntry));
    SVT_TRY(mimeText, entries.text(kMimeEntry, mime->size, buffer));
    if (*mimeText != kMimeType) return badVolume("the text of the entry 'mimetype' is not application/vnd.svt+zip");
    SVT_TRY(headerText, entries.text(kHeader, kMaxHeaderBytes, buffer));
    SVT_TRY(header, readHeaderJson(*headerText));
    SVT_TRY(labelsText, entries.text(kLabels, kMaxLabelsBytes, buffer));
    SVT_TRY(labels, readLabelsJson(*labelsText));
    if (labels->scalarCount() != header->scalarCount)
        return badVolume(
            fmt::format("svt.json states {} scalars, the labels have {}", header->scalarCount, labels->scalarCount()));
    SVT_TRY(index, entries.stored(kIndex));
    SVT_DO(unpack(*index, index->size, buffer));
    SVT_TRY(frames, entries.stored(kBlocks));
    SVT_TRY(blocks,
            ColumnBlocks::open(header->grid.dimension(), header->scalarCount, index->data, frames->data.size()));
    return SvtBlocks{header->grid,
                     std::move(*labels),
                     std::move(*blocks),
                     frames->data,
                     std::move(header->crsName),
                     std::move(header->modelName),
                     std::move(header->source)};
}

/// Reads an optional entry by `read(frame)`.
template <class Content, class Read>
Result<Content> readOptional(const Entries& entries, std::string_view name, Read read) {
    if (!entries.has(name)) return Content();
    SVT_TRY(entry, entries.stored(name));
    std::vector<std::byte> buffer;
    SVT_TRY(frame, unpack(*entry, entry->size, buffer));
    return read(*frame);
}

Result<SemanticVolume> readEntries(std::span<const std::byte> bytes) {
    SVT_TRY(entries, openEntries(bytes));
    SVT_TRY(tables, readTables(*entries));
    std::vector<std::byte> buffer;
    SVT_TRY(frames, entries->stored(kBlocks));
    SVT_DO(unpack(*frames, frames->size, buffer));
    SVT_DO(entries->checkOthers());
    SVT_TRY(columns, tables->blocks.decodeAll(tables->frames));
    using Frame = std::span<const std::byte>;
    const bool isOld = !entries->has(kVectors);
    auto vectors = readOptional<VectorParts>(*entries, isOld ? kTenthParts : kVectors, [&](Frame frame) {
        return isOld ? readTenthParts(frame, tables->labels.labels.size())
                     : readVectorParts(frame, tables->labels.labels.size());
    });
    if (!vectors) return vectors.error();
    auto planes = readOptional<std::vector<FacePlane>>(
        *entries, kPlanes, [&](Frame frame) { return readFacePlanes(frame, tables->grid.dimension()); });
    if (!planes) return planes.error();
    auto footprints = readOptional<VectorParts>(
        *entries, kFootprints, [&](Frame frame) { return readVectorParts(frame, tables->labels.labels.size()); });
    if (!footprints) return footprints.error();
    return SemanticVolume{tables->grid,
                          std::move(tables->labels),
                          std::move(*columns),
                          std::move(tables->crsName),
                          std::move(tables->modelName),
                          std::move(tables->source),
                          std::move(*vectors),
                          std::move(*planes),
                          std::move(*footprints)};
}

}  // namespace

bool looksLikeSvt(std::span<const std::byte> head) noexcept {
    constexpr std::string_view kLocalHeader("PK\3\4", 4);
    if (head.size() < kMimeOffset + kMimeType.size()) return false;
    const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
    return text.starts_with(kLocalHeader) && text.substr(30, 8) == kMimeEntry &&
           text.substr(kMimeOffset, kMimeType.size()) == kMimeType;
}

bool isSvtFile(const std::filesystem::path& path) {
    const auto file = PartFile::open(path);
    if (!file) return false;
    const auto head = file->read(0, 4096);
    return head && looksLikeSvt(std::as_bytes(std::span(*head)));
}

namespace {

// Hands the entries of a volume's file to `write`.
template <class Write>
auto withEntries(const SemanticVolume& volume, Write&& write) -> decltype(write(std::span<const ZipSource>())) {
    SVT_DO(checkWritable(volume));
    const std::string header = writeHeaderJson(volume);
    const std::string labels = writeLabelsJson(volume.labels);
    if (labels.size() > kMaxLabelsBytes)
        return Error(Code::BadArgument, fmt::format("the label table takes {} bytes as JSON, {} are possible",
                                                    labels.size(), kMaxLabelsBytes));
    SVT_TRY(compressed, compressColumns(volume.columns));
    std::vector<std::byte> vectors, planes, footprints;
    if (!volume.vectors.isEmpty()) {
        SVT_TRY(frame, compressVectorParts(volume.vectors));
        vectors = std::move(*frame);
    }
    if (!volume.planes.empty()) {
        SVT_TRY(frame, compressFacePlanes(volume.planes));
        planes = std::move(*frame);
    }
    if (!volume.footprints.isEmpty()) {
        SVT_TRY(frame, compressVectorParts(volume.footprints));
        footprints = std::move(*frame);
    }
    std::vector<ZipSource> entries(5);
    for (std::size_t e = 0; e < entries.size(); ++e) entries[e].name = kUsed[e];
    entries[0].isAligned = false;
    entries[0].parts = {std::as_bytes(std::span(kMimeType))};
    entries[1].parts = {std::as_bytes(std::span(header))};
    entries[2].parts = {std::as_bytes(std::span(labels))};
    entries[2].isDeflated = true;
    entries[3].parts = {std::as_bytes(std::span(compressed->index))};
    entries[4].parts.assign(compressed->frames.begin(), compressed->frames.end());
    if (!vectors.empty()) entries.push_back({std::string(kVectors), {std::span<const std::byte>(vectors)}});
    if (!planes.empty()) entries.push_back({std::string(kPlanes), {std::span<const std::byte>(planes)}});
    if (!footprints.empty()) entries.push_back({std::string(kFootprints), {std::span<const std::byte>(footprints)}});
    return write(std::span<const ZipSource>(entries));
}

}  // namespace

Result<std::uint64_t> writeSvt(const SemanticVolume& volume, const std::filesystem::path& path) {
    return withEntries(volume, [&](std::span<const ZipSource> entries) { return writeZip(path, entries); });
}

Result<std::vector<std::byte>> svtBytes(const SemanticVolume& volume) {
    return withEntries(volume, [](std::span<const ZipSource> entries) { return zipBytes(entries); });
}

Result<SemanticVolume> readSvt(std::span<const std::byte> bytes, const std::string& name) {
    auto volume = readEntries(bytes);
    if (!volume) return named(volume.error(), name);
    return volume;
}

Result<SemanticVolume> readSvt(const std::filesystem::path& path) {
    SVT_TRY(file, FileBytes::read(path));
    return readSvt(file->bytes(), path.string());
}

Result<SvtBlocks> openSvt(std::span<const std::byte> bytes, const std::string& name) {
    const auto entries = openEntries(bytes);
    if (!entries) return named(entries.error(), name);
    auto tables = readTables(*entries);
    if (!tables) return named(tables.error(), name);
    return tables;
}

}  // namespace svt::volume

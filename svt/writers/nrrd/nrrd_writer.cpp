#include <svt/core/file.hpp>
#include <svt/volume/dense.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/writers/nrrd/gzip_writer.hpp>
#include <svt/writers/nrrd_writer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

namespace svt::writers {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are written as they stand in memory");

constexpr std::uint64_t kSlabBytes = std::uint64_t{16} << 20;

std::string vectorText(Vec3d v) { return fmt::format("({},{},{})", v.x, v.y, v.z); }

/// A value of `key:=value`: backslashes and line breaks are escaped, as the format requires.
void appendKeyValue(std::string& header, std::string_view key, std::string_view value) {
    header += key;
    header += ":=";
    for (const char c : value) {
        if (c == '\\')
            header += "\\\\";
        else if (c == '\n')
            header += "\\n";
        else
            header += c;
    }
    header += '\n';
}

std::string headerOf(const volume::SemanticVolume& volume, int bits, NrrdEncoding encoding) {
    const volume::Grid& grid = volume.grid;
    const Vec3i dimension = grid.dimension();
    std::string header = "NRRD0004\n# Semantic volume texture; see the keys svt_*\n";
    header += fmt::format("type: uint{}\ndimension: 3\nspace dimension: 3\n", bits);
    header += fmt::format("sizes: {} {} {}\n", dimension.x, dimension.y, dimension.z);
    header += fmt::format("space directions: {} {} {}\n", vectorText(grid.worldFromIndexDirection({1, 0, 0})),
                          vectorText(grid.worldFromIndexDirection({0, 1, 0})),
                          vectorText(grid.worldFromIndexDirection({0, 0, 1})));
    header += "kinds: domain domain domain\nendian: little\n";
    header += fmt::format("encoding: {}\n", encoding == NrrdEncoding::Gzip ? "gzip" : "raw");
    header += "space units: \"m\" \"m\" \"m\"\n";
    header += fmt::format("space origin: {}\n", vectorText(grid.origin()));

    std::string json;
    const auto text = [&](std::string_view key, std::string_view value) {
        json.clear();
        volume::appendJsonString(json, value, volume::JsonCharacters::AsciiOnly);
        appendKeyValue(header, key, json);
    };
    text("svt_model", volume.modelName);
    text("svt_source", volume.source);
    text("svt_crs", volume.crsName);
    appendKeyValue(header, "svt_label_count", fmt::format("{}", volume.labels.labels.size()));
    for (std::size_t l = 0; l < volume.labels.labels.size(); ++l) {
        json.clear();
        volume::appendJsonLabel(json, volume.labels.labels[l], volume::JsonCharacters::AsciiOnly);
        appendKeyValue(header, fmt::format("svt_label_{}", l), json);
    }
    return header + "\n";
}

/// Expands the columns box by box in file order and passes each box to `sink`.
template <class T, class Sink>
Result<void> writeSamples(const volume::ColumnVolume& columns, const NrrdOptions& options, Sink sink) {
    const Vec3i dimension = columns.dimension();
    const std::uint64_t rowBytes = std::uint64_t(dimension.x) * sizeof(T);
    const std::uint64_t sliceBytes = rowBytes * std::uint64_t(dimension.y);
    // Several slices at once; if one slice is too large, bands of whole tiles of one slice.
    const auto slices = static_cast<std::int32_t>(
        std::clamp<std::uint64_t>(kSlabBytes / sliceBytes, 1, static_cast<std::uint64_t>(dimension.z)));
    constexpr std::int32_t kTile = volume::ColumnVolume::kTileSize;
    const auto bandTiles = std::max<std::uint64_t>(1, kSlabBytes / (rowBytes * kTile));
    const auto rows = sliceBytes <= kSlabBytes ? dimension.y
                                               : static_cast<std::int32_t>(std::min<std::uint64_t>(
                                                     bandTiles * kTile, static_cast<std::uint64_t>(dimension.y)));
    std::vector<T> slab;
    for (std::int32_t k = 0; k < dimension.z; k += slices) {
        for (std::int32_t j = 0; j < dimension.y; j += rows) {
            if (Progress::isCancelled(options.progress))
                return Error(Code::Cancelled, "writing the NRRD was stopped; no file was left");
            const volume::DenseBox box{j, std::min(j + rows, dimension.y), k, std::min(k + slices, dimension.z)};
            slab.resize(std::size_t(dimension.x) * std::size_t(box.jEnd - box.jBegin) *
                        std::size_t(box.kEnd - box.kBegin));
            volume::copyBox<T>(columns, box, slab, options.threads);
            if (auto done = sink(std::as_bytes(std::span(slab))); !done) return done;
        }
        Progress::tell(options.progress, "nrrd", double(std::min(k + slices, dimension.z)) / dimension.z);
    }
    return {};
}

template <class T>
Result<void> writeData(const volume::ColumnVolume& columns, const NrrdOptions& options, AtomicFile& file) {
    if (options.encoding == NrrdEncoding::Raw)
        return writeSamples<T>(columns, options, [&](auto bytes) { return file.write(bytes); });
    GzipWriter gzip(file, options.threads);
    if (auto done = writeSamples<T>(columns, options, [&](auto bytes) { return gzip.write(bytes); }); !done)
        return done;
    return gzip.finish();
}

}  // namespace

Result<std::uint64_t> writeNrrd(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                const NrrdOptions& options) {
    const Vec3i dimension = volume.grid.dimension();
    const Vec3i columns = volume.columns.dimension();
    if (dimension != columns)
        return Error(Code::BadArgument,
                     fmt::format("the grid has {} x {} x {} samples, the columns have {} x {} x {}", dimension.x,
                                 dimension.y, dimension.z, columns.x, columns.y, columns.z));
    const volume::Scalar largest = volume::largestScalar(volume.columns);
    if (largest >= volume.labels.scalarCount())
        return Error(Code::BadArgument, fmt::format("scalar {} belongs to no label", largest));
    const int bits = volume.labels.scalarBits();
    auto file = AtomicFile::create(path);
    if (!file) return file.error();
    if (auto written = file->write(headerOf(volume, bits, options.encoding)); !written) return written.error();
    const auto done = bits == 8    ? writeData<std::uint8_t>(volume.columns, options, *file)
                      : bits == 16 ? writeData<std::uint16_t>(volume.columns, options, *file)
                                   : writeData<std::uint32_t>(volume.columns, options, *file);
    if (!done) return done.error();
    return file->commit();
}

}  // namespace svt::writers

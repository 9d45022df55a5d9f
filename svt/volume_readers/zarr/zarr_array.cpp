#include <svt/volume_readers/zarr/zarr_array.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string_view>

namespace svt::volume_readers {
namespace {

using ZarrJson = nlohmann::ordered_json;

constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 36;
constexpr std::uint64_t kMostFiles = std::uint64_t{1} << 24;
constexpr std::uint64_t kMostSide = 65535;

Error badZarr(std::string message) { return {Code::BadImage, std::move(message)}; }

/// A member of an object, or null.
const ZarrJson& member(const ZarrJson& json, const char* key) {
    static const ZarrJson kNull;
    if (!json.is_object()) return kNull;
    const auto found = json.find(key);
    return found == json.end() ? kNull : *found;
}

std::string textOf(const ZarrJson& json) { return json.is_string() ? json.get<std::string>() : std::string(); }

/// Whole numbers from 1 on.
Result<std::vector<std::uint64_t>> sizesOf(const ZarrJson& json, const char* what, std::uint64_t most) {
    std::vector<std::uint64_t> sizes;
    if (!json.is_array() || json.size() < 3 || json.size() > ZarrArray::kMostAxes)
        return badZarr(fmt::format(
            "{} is not a list of three sizes (z, y, x), or of up to five that begin with axes of one sample", what));
    for (const ZarrJson& size : json) {
        if (!size.is_number_unsigned() || size.get<std::uint64_t>() == 0 || size.get<std::uint64_t>() > most)
            return badZarr(fmt::format("{} has the size {}; 1 to {} are possible", what, size.dump(), most));
        sizes.push_back(size.get<std::uint64_t>());
    }
    return sizes;
}

Result<void> checkSizes(const ZarrArray& array) {
    const std::size_t axes = array.shape.size();
    if (array.file.size() != axes || array.chunk.size() != axes)
        return badZarr("chunks and array differ in their number of axes");
    std::uint64_t samples = 1, files = 1, bytes = static_cast<std::uint64_t>(array.itemBytes), fileBytes = bytes;
    for (std::size_t a = 0; a < axes; ++a) {
        if (a + 3 < axes && array.shape[a] != 1)
            return badZarr(
                fmt::format("axis {} of {} has {} samples; before z, y and x an axis has one (a single time "
                            "and channel)",
                            a, axes, array.shape[a]));
        if (array.file[a] % array.chunk[a] != 0) return badZarr("a shard is not a whole number of chunks");
        samples *= array.shape[a];  // at most 65535^3
        files *= (array.shape[a] + array.file[a] - 1) / array.file[a];
        if (array.chunk[a] > kMostChunkBytes / bytes || array.file[a] > (kMostChunkBytes << 10) / fileBytes)
            return badZarr("a chunk has more than 1 GiB; write the array with smaller chunks");
        bytes *= array.chunk[a];
        fileBytes *= array.file[a];
    }
    if (samples > kMostSamples)
        return badZarr(
            fmt::format("{} samples are more than the {} that are read; give a coarser level", samples, kMostSamples));
    if (files > kMostFiles || array.chunksOfFile() > kMostFiles || files * array.chunksOfFile() > kMostFiles * 4)
        return badZarr("the array has too many chunks; write it with larger ones");
    return {};
}

Result<CodecKind> codecOf(const std::string& name) {
    if (name == "zlib") return CodecKind::Zlib;
    if (name == "gzip") return CodecKind::Gzip;
    if (name == "zstd") return CodecKind::Zstd;
    if (name == "lz4") return CodecKind::Lz4;
    if (name == "blosc") return CodecKind::Blosc;
    if (name == "crc32c") return CodecKind::Crc32c;
    return badZarr(fmt::format("chunks packed by '{}' cannot be read; none, zlib, gzip, zstd, LZ4 and Blosc can",
                               name.substr(0, 80)));
}

/// The bits of a sample in memory, from the number in the metadata.
Result<std::uint64_t> fillOf(const ZarrJson& json) {
    if (json.is_null()) return std::uint64_t{0};
    if (json.is_boolean()) return std::uint64_t{json.get<bool>() ? 1u : 0u};
    if (json.is_number_unsigned()) return json.get<std::uint64_t>();
    if (json.is_number_integer()) return static_cast<std::uint64_t>(json.get<std::int64_t>());
    return badZarr(fmt::format("the fill value {} is not a whole number", json.dump().substr(0, 80)));
}

Error noLabels(const std::string& type) {
    return badZarr(
        fmt::format("samples of the type '{}' cannot be labels; whole numbers of 8 to 64 bits are expected. If the "
                    "image has labels, give their folder, such as IMAGE.zarr/labels/NAME",
                    type.substr(0, 80)));
}

Result<ZarrArray> readVersion2(const ZarrJson& json) {
    ZarrArray array;
    const std::string type = textOf(member(json, "dtype"));
    if (type.size() != 3 || std::string_view("<>|").find(type[0]) == std::string_view::npos ||
        std::string_view("uib").find(type[1]) == std::string_view::npos ||
        std::string_view("1248").find(type[2]) == std::string_view::npos || (type[1] == 'b' && type[2] != '1'))
        return noLabels(type.empty() ? "none" : type);
    array.itemBytes = type[2] - '0';
    array.isSigned = type[1] == 'i';
    array.isBigEndian = type[0] == '>';
    SVT_TRY(shape, sizesOf(member(json, "shape"), "the shape", kMostSide));
    SVT_TRY(chunk, sizesOf(member(json, "chunks"), "the chunks", kMostChunkBytes));
    array.shape = std::move(*shape);
    array.chunk = array.file = std::move(*chunk);
    array.order.resize(array.shape.size());
    std::iota(array.order.begin(), array.order.end(), std::size_t{0});
    const std::string order = textOf(member(json, "order"));
    if (order == "F")
        std::reverse(array.order.begin(), array.order.end());
    else if (order != "C")
        return badZarr("the order of the samples is neither C nor F");
    if (const ZarrJson& filters = member(json, "filters"); !filters.is_null() && !filters.empty())
        return badZarr("the chunks have filters, which cannot be read; write them without");
    if (const ZarrJson& compressor = member(json, "compressor"); !compressor.is_null()) {
        SVT_TRY(codec, codecOf(textOf(member(compressor, "id"))));
        array.codecs.push_back(*codec);
    }
    const std::string separator = textOf(member(json, "dimension_separator"));
    if (!separator.empty() && separator != "/" && separator != ".")
        return badZarr("the separator of dimensions is neither '.' nor '/'");
    array.separator = separator.empty() ? '.' : separator[0];
    SVT_TRY(fill, fillOf(member(json, "fill_value")));
    array.fill = *fill;
    return array;
}

/// Codecs of version 3: at most one that permutes axes, then the byte order, then compressors.
Result<void> readChain(const ZarrJson& json, ZarrArray& array) {
    bool hasBytes = false;
    for (const ZarrJson& codec : json) {
        const std::string name = codec.is_string() ? textOf(codec) : textOf(member(codec, "name"));
        const ZarrJson& told = member(codec, "configuration");
        if (name == "transpose") {
            const ZarrJson& order = member(told, "order");
            std::vector<std::size_t> axes;
            for (const ZarrJson& axis : order.is_array() ? order : ZarrJson::array())
                if (axis.is_number_unsigned()) axes.push_back(axis.get<std::size_t>());
            // The form in earlier drafts of version 3.
            if (order == "C" || order == "F")
                for (std::size_t axis = 0; axis < array.shape.size(); ++axis)
                    axes.push_back(order == "C" ? axis : array.shape.size() - 1 - axis);
            std::vector<std::size_t> sorted = axes;
            std::sort(sorted.begin(), sorted.end());
            std::vector<std::size_t> expected(array.shape.size());
            std::iota(expected.begin(), expected.end(), std::size_t{0});
            if (sorted != expected || hasBytes)
                return badZarr("the order of a transpose is not a permutation of the axes");
            std::vector<std::size_t> turned;
            for (const std::size_t axis : axes) turned.push_back(array.order[axis]);
            array.order = std::move(turned);
        } else if (name == "bytes") {
            array.isBigEndian = textOf(member(told, "endian")) == "big";
            hasBytes = true;
        } else {
            if (!hasBytes) return badZarr(fmt::format("the codec '{}' stands before 'bytes'", name.substr(0, 80)));
            SVT_TRY(kind, codecOf(name));
            array.codecs.push_back(*kind);
        }
    }
    if (!hasBytes) return badZarr("the codecs lack 'bytes'");
    if (array.codecs.size() > 8) return badZarr("the codecs are too many");
    return {};
}

Result<void> readShards(const ZarrJson& told, ZarrArray& array) {
    SVT_TRY(chunk, sizesOf(member(told, "chunk_shape"), "the chunk of a shard", kMostChunkBytes));
    if (chunk->size() != array.shape.size()) return badZarr("chunks and array differ in their number of axes");
    array.chunk = std::move(*chunk);
    array.isSharded = true;
    const std::string place = textOf(member(told, "index_location"));
    if (!place.empty() && place != "end" && place != "start")
        return badZarr("the place of the index of shards is unknown");
    array.isIndexAtEnd = place != "start";
    ZarrArray index;
    index.shape = array.shape;
    index.order.resize(array.shape.size());
    std::iota(index.order.begin(), index.order.end(), std::size_t{0});
    SVT_DO(readChain(member(told, "index_codecs"), index));
    for (const CodecKind codec : index.codecs)
        if (codec != CodecKind::Crc32c) return badZarr("the index of shards is packed, which cannot be read");
    array.indexCodecs = index.codecs;
    array.isIndexBigEndian = index.isBigEndian;
    return readChain(member(told, "codecs"), array);
}

Result<ZarrArray> readVersion3(const ZarrJson& json) {
    ZarrArray array;
    const std::string type = textOf(member(json, "data_type"));
    const std::string_view bits =
        std::string_view(type).substr(std::min(type.size(), type.find_first_of("0123456789")));
    const std::string_view kind = std::string_view(type).substr(0, type.size() - bits.size());
    if (type != "bool" &&
        ((kind != "uint" && kind != "int") || (bits != "8" && bits != "16" && bits != "32" && bits != "64")))
        return noLabels(type.empty() ? "none" : type);
    array.itemBytes = type == "bool" || bits == "8" ? 1 : bits == "16" ? 2 : bits == "32" ? 4 : 8;
    array.isSigned = kind == "int";
    SVT_TRY(shape, sizesOf(member(json, "shape"), "the shape", kMostSide));
    array.shape = std::move(*shape);
    const ZarrJson& grid = member(json, "chunk_grid");
    if (textOf(member(grid, "name")) != "regular") return badZarr("the chunks are not a regular grid");
    SVT_TRY(file, sizesOf(member(member(grid, "configuration"), "chunk_shape"), "the chunks", std::uint64_t{1} << 31));
    array.chunk = array.file = std::move(*file);
    array.order.resize(array.shape.size());
    std::iota(array.order.begin(), array.order.end(), std::size_t{0});
    const ZarrJson& keys = member(json, "chunk_key_encoding");
    const std::string naming = keys.is_string() ? textOf(keys) : textOf(member(keys, "name"));
    if (naming != "default" && naming != "v2") return badZarr("how the chunks are named is unknown");
    const std::string separator = textOf(member(member(keys, "configuration"), "separator"));
    if (!separator.empty() && separator != "/" && separator != ".")
        return badZarr("how the chunks are named is unknown");
    array.separator = separator.empty() ? (naming == "v2" ? '.' : '/') : separator[0];
    if (naming == "default") array.prefix = std::string("c") + array.separator;
    const ZarrJson& codecs = member(json, "codecs");
    if (!codecs.is_array() || codecs.empty()) return badZarr("the codecs are missing");
    if (const ZarrJson& transformers = member(json, "storage_transformers");
        !transformers.is_null() && !transformers.empty())
        return badZarr("the array has storage transformers, which cannot be read");
    const bool isSharded = textOf(member(codecs.front(), "name")) == "sharding_indexed";
    if (isSharded && codecs.size() > 1) return badZarr("shards that are packed as a whole cannot be read");
    SVT_DO(isSharded ? readShards(member(codecs.front(), "configuration"), array) : readChain(codecs, array));
    SVT_TRY(fill, fillOf(member(json, "fill_value")));
    array.fill = *fill;
    return array;
}

/// Metres in a unit of OME-NGFF (UDUNITS-2); 0: unknown.
double metresIn(const std::string& unit) {
    struct Unit {
        std::string_view name;
        double metres;
    };
    constexpr Unit kUnits[] = {{"", 1},
                               {"meter", 1},
                               {"metre", 1},
                               {"kilometer", 1000},
                               {"decimeter", 0.1},
                               {"centimeter", 0.01},
                               {"millimeter", 1e-3},
                               {"micrometer", 1e-6},
                               {"nanometer", 1e-9},
                               {"angstrom", 1e-10},
                               {"inch", 0.0254},
                               {"foot", 0.3048},
                               {"yard", 0.9144}};
    for (const Unit& known : kUnits)
        if (known.name == unit) return known.metres;
    return 0;
}

/// Applies a list of transformations to the last three axes.
Result<void> applyTransformations(const ZarrJson& list, const std::array<double, 3>& metres, ZarrScale& scale) {
    if (list.is_null()) return {};
    for (const ZarrJson& step : list) {
        const std::string type = textOf(member(step, "type"));
        if (type == "identity") continue;
        const ZarrJson& numbers = member(step, type.c_str());
        if ((type != "scale" && type != "translation") || !numbers.is_array() || numbers.size() < 3 ||
            numbers.size() > ZarrArray::kMostAxes)
            return badZarr(fmt::format("the transformation '{}' cannot be read; a scale and a translation are expected",
                                       type.substr(0, 80)));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const ZarrJson& number = numbers[numbers.size() - 1 - axis];
            if (!number.is_number() || !std::isfinite(number.get<double>()))
                return badZarr("a transformation has something else than numbers");
            if (type == "scale") {
                scale.scale[axis] *= number.get<double>();
                scale.translation[axis] *= number.get<double>();
            } else {
                scale.translation[axis] += number.get<double>() * metres[axis];
            }
        }
    }
    return {};
}

/// The last three axes are z, y and x. \return metres of x, y, z
Result<std::array<double, 3>> unitsOf(const ZarrJson& axes) {
    std::array<double, 3> metres{1, 1, 1};
    if (axes.is_null()) return metres;  // before 0.3: t, c, z, y, x
    if (!axes.is_array() || axes.size() < 3 || axes.size() > ZarrArray::kMostAxes)
        return badZarr("the axes are not three to five");
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const ZarrJson& told = axes[axes.size() - 1 - axis];
        const std::string name = told.is_string() ? textOf(told) : textOf(member(told, "name"));
        if (name != std::string(1, "xyz"[axis]))
            return badZarr(fmt::format("the axes end with '{}' where '{}' is expected: they are z, y, x in this order",
                                       name.substr(0, 80), "xyz"[axis]));
        const std::string unit = textOf(member(told, "unit"));
        metres[axis] = metresIn(unit);
        if (metres[axis] == 0) return badZarr(fmt::format("the unit '{}' is unknown", unit.substr(0, 80)));
    }
    return metres;
}

}  // namespace

std::uint64_t ZarrArray::chunkBytes() const noexcept {
    return std::accumulate(chunk.begin(), chunk.end(), static_cast<std::uint64_t>(itemBytes), std::multiplies<>());
}

std::uint64_t ZarrArray::chunksOfFile() const noexcept {
    std::uint64_t count = 1;
    for (std::size_t a = 0; a < file.size(); ++a) count *= file[a] / chunk[a];
    return count;
}

Result<ZarrArray> readZarrArray(const ZarrJson& json) {
    const ZarrJson& version = member(json, "zarr_format");
    SVT_TRY(array, version == 2   ? readVersion2(json)
                   : version == 3 ? readVersion3(json)
                                  : Result<ZarrArray>(badZarr("the version of Zarr is neither 2 nor 3")));
    SVT_DO(checkSizes(*array));
    return array;
}

Result<ZarrScale> readZarrScale(const ZarrJson& attributes) {
    const ZarrJson& inner = member(attributes, "ome");
    const ZarrJson& ome = inner.is_object() ? inner : attributes;
    const ZarrJson& scales = member(ome, "multiscales");
    if (!scales.is_array() || scales.empty()) {
        const ZarrJson& labels = member(ome, "labels");
        if (labels.is_array() && !labels.empty() && labels.front().is_string())
            return badZarr(fmt::format("the folder holds several labellings; give one of them, such as its folder '{}'",
                                       textOf(labels.front()).substr(0, 80)));
        return badZarr("the folder is neither an array of Zarr nor an image of OME-NGFF (no 'multiscales' in it)");
    }
    const ZarrJson& first = scales.front();
    const ZarrJson& levels = member(first, "datasets");
    ZarrScale scale;
    if (levels.is_array() && !levels.empty()) scale.path = textOf(member(levels.front(), "path"));
    if (!isPathInside(scale.path))
        return badZarr(
            fmt::format("the finest level is '{}', which is not a folder in this one", scale.path.substr(0, 80)));
    SVT_TRY(metres, unitsOf(member(first, "axes")));
    scale.scale = *metres;
    for (const ZarrJson* from : {&levels.front(), &first})
        SVT_DO(applyTransformations(member(*from, "coordinateTransformations"), *metres, scale));
    const ZarrJson& label = member(ome, "image-label");
    scale.colors = member(label, "colors");
    scale.properties = member(label, "properties");
    return scale;
}

bool isPathInside(std::string_view path) noexcept {
    if (path.empty() || path.find_first_of(std::string_view("\\:\0", 3)) != std::string_view::npos) return false;
    while (true) {
        const std::string_view name = path.substr(0, path.find('/'));
        if (name.empty() || name == "." || name == "..") return false;
        if (name.size() == path.size()) return true;
        path.remove_prefix(name.size() + 1);
    }
}

}  // namespace svt::volume_readers

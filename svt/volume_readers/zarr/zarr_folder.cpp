#include <svt/core/bytes.hpp>
#include <svt/core/machine.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/volume_readers/read_label_volume.hpp>
#include <svt/volume_readers/samples/label_image.hpp>
#include <svt/volume_readers/zarr/zarr_array.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

namespace svt::volume_readers {
namespace {

namespace fs = std::filesystem;
using ZarrJson = nlohmann::ordered_json;

constexpr std::uint64_t kMostJsonBytes = std::uint64_t{1} << 30;

Error inFile(const fs::path& file, Code code, std::string message) {
    return {code, std::move(message), Place{file.string(), 0, 0, {}}};
}

/// A file in the folder `root`, a path without links; empty if the file does not exist.
Result<std::optional<FileBytes>> openInside(const fs::path& root, const fs::path& file, std::uint64_t maxBytes) {
    std::error_code failed;
    if (!fs::exists(file, failed)) return std::optional<FileBytes>();
    const fs::path real = fs::canonical(file, failed);
    if (failed || std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first != root.end())
        return inFile(file, Code::BadImage, "it leads out of the folder of the volume, and is not followed there");
    SVT_TRY(opened, FileBytes::read(real, maxBytes));
    return std::optional<FileBytes>(std::move(*opened));
}

/// The JSON of a file; null if the file does not exist.
Result<ZarrJson> readJsonInside(const fs::path& root, const fs::path& file) {
    SVT_TRY(opened, openInside(root, file, kMostJsonBytes));
    if (!*opened) return ZarrJson();
    const std::string_view text = (*opened)->text();
    // Limits the depth, because nlohmann parses recursively.
    int depth = 0, deepest = 0;
    for (const char c : text) {
        depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
        deepest = std::max(deepest, depth);
    }
    if (deepest > 1000) return inFile(file, Code::BadJson, "the JSON is nested too deeply");
    ZarrJson json = ZarrJson::parse(text.begin(), text.end(), nullptr, false);
    if (!json.is_object()) return inFile(file, Code::BadJson, "the file is not a JSON object");
    return json;
}

/// Reads the samples of chunks, one band of chunks at a time.
class ZarrSource {
public:
    ZarrSource(fs::path root, fs::path folder, ZarrArray array, int outBytes)
        : root_(std::move(root)), folder_(std::move(folder)), array_(std::move(array)), outBytes_(outBytes) {
        const std::size_t axes = array_.shape.size();
        for (std::size_t n = 0; n < 3; ++n) {
            shape_[n] = array_.shape[axes - 3 + n];
            chunk_[n] = array_.chunk[axes - 3 + n];
            file_[n] = array_.file[axes - 3 + n];
        }
        sliceBytes_ = shape_[1] * shape_[2] * static_cast<std::uint64_t>(outBytes_);
    }

    /// Bytes of a band: chunks that have the same z.
    [[nodiscard]] std::uint64_t bandBytes() const noexcept { return sliceBytes_ * std::min(chunk_[0], shape_[0]); }

    Result<void> read(std::span<std::byte> out) {
        if (out.empty()) return {};
        if (at_ == band_.size()) SVT_DO(readBand());
        if (out.size() > band_.size() - at_) return Error(Code::BadImage, "the samples are fewer than the sizes say");
        std::copy_n(band_.begin() + static_cast<std::ptrdiff_t>(at_), out.size(), out.begin());
        at_ += out.size();
        return {};
    }

private:
    using Index = std::array<std::uint64_t, 3>;

    Result<void> readBand() {
        if (z_ >= shape_[0]) return Error(Code::BadImage, "the samples are fewer than the sizes say");
        const std::uint64_t depth = std::min(chunk_[0], shape_[0] - z_);
        band_.resize(static_cast<std::size_t>(sliceBytes_ * depth));
        at_ = 0;
        SVT_DO(fillBand());
        for (std::uint64_t y = 0; y < shape_[1]; y += file_[1])
            for (std::uint64_t x = 0; x < shape_[2]; x += file_[2])
                SVT_DO(readFile({z_ / file_[0], y / file_[1], x / file_[2]}));
        z_ += depth;
        return {};
    }

    Result<void> fillBand() {
        std::uint32_t value = 0;
        if (!narrow(array_.fill, value)) return tooLarge();
        if (value == 0) {
            std::fill(band_.begin(), band_.end(), std::byte{0});
            return {};
        }
        for (std::size_t at = 0; at < band_.size(); at += static_cast<std::size_t>(outBytes_))
            std::memcpy(band_.data() + at, &value, static_cast<std::size_t>(outBytes_));
        return {};
    }

    /// The bits of a sample for the output. Negative samples of up to 32 bits keep their bits; readColumns() rejects
    /// them.
    [[nodiscard]] bool narrow(std::uint64_t bits, std::uint32_t& value) const noexcept {
        value = static_cast<std::uint32_t>(bits);
        return array_.itemBytes < 8 || bits <= (array_.isSigned ? 0x7FFFFFFFu : 0xFFFFFFFFu);
    }
    static Error tooLarge() {
        return {Code::BadImage, "a sample is negative or has more than 32 bits; labels are whole numbers from 0 on"};
    }

    Result<void> readFile(const Index& number) {
        std::string name = array_.prefix;
        for (std::size_t a = 3; a < array_.shape.size(); ++a) name += std::string("0") + array_.separator;
        name += fmt::format("{}{}{}{}{}", number[0], array_.separator, number[1], array_.separator, number[2]);
        SVT_TRY(opened, openInside(root_, folder_ / name, kMostChunkBytes << 6));
        if (!*opened) return {};
        const Index first{number[0] * file_[0], number[1] * file_[1], number[2] * file_[2]};
        auto done = array_.isSharded ? readShard((*opened)->bytes(), first) : readChunk((*opened)->bytes(), first);
        if (done || !done.error().where().file.empty()) return done;
        return inFile(folder_ / name, done.error().code(), done.error().message());
    }

    /// The chunks of a shard that lie in the band.
    Result<void> readShard(std::span<const std::byte> bytes, const Index& first) {
        const std::uint64_t count = array_.chunksOfFile(), indexBytes = 16 * count + 4 * array_.indexCodecs.size();
        if (bytes.size() < indexBytes) return Error(Code::BadImage, "a shard is cut short: its index is missing");
        std::vector<std::byte> index;
        const auto stored = array_.isIndexAtEnd ? bytes.last(static_cast<std::size_t>(indexBytes))
                                                : bytes.first(static_cast<std::size_t>(indexBytes));
        index.assign(stored.begin(), stored.end());
        for (std::size_t c = array_.indexCodecs.size(); c-- > 0;) {
            SVT_TRY(checked, unpackChunk(array_.indexCodecs[c], index, 0));
            index = std::move(*checked);
        }
        const Index counts{file_[0] / chunk_[0], file_[1] / chunk_[1], file_[2] / chunk_[2]};
        const std::uint64_t z = (z_ - first[0]) / chunk_[0];
        for (std::uint64_t y = 0; y < counts[1]; ++y)
            for (std::uint64_t x = 0; x < counts[2]; ++x) {
                const Index begin{first[0] + z * chunk_[0], first[1] + y * chunk_[1], first[2] + x * chunk_[2]};
                if (begin[1] >= shape_[1] || begin[2] >= shape_[2]) continue;
                const std::size_t entry = static_cast<std::size_t>((z * counts[1] + y) * counts[2] + x) * 16;
                const std::uint64_t offset = indexNumber(index, entry), size = indexNumber(index, entry + 8);
                if (offset == ~std::uint64_t{0} && size == offset) continue;
                if (offset > bytes.size() || size > bytes.size() - offset)
                    return Error(Code::BadImage,
                                 "the index of a shard leads out of its file: it is damaged or cut short");
                const auto part = bytes.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(size));
                SVT_DO(readChunk(part, begin));
            }
        return {};
    }

    [[nodiscard]] std::uint64_t indexNumber(std::span<const std::byte> index, std::size_t at) const noexcept {
        return loadNumber(index, at, 8, array_.isIndexBigEndian ? std::endian::big : std::endian::little);
    }

    Result<void> readChunk(std::span<const std::byte> stored, const Index& first) {
        std::vector<std::byte> bytes;
        const std::uint64_t size = array_.chunkBytes();
        for (std::size_t c = array_.codecs.size(); c-- > 0;) {
            SVT_TRY(unpacked, unpackChunk(array_.codecs[c], stored, size));
            bytes = std::move(*unpacked);
            stored = bytes;
        }
        if (stored.size() != size)
            return Error(Code::BadImage, fmt::format("a chunk has {} bytes, {} are expected", stored.size(), size));
        return array_.itemBytes == 1   ? place<std::uint8_t>(stored, first)
               : array_.itemBytes == 2 ? place<std::uint16_t>(stored, first)
               : array_.itemBytes == 4 ? place<std::uint32_t>(stored, first)
                                       : place<std::uint64_t>(stored, first);
    }

    /// Puts the samples of a chunk that lie in the array into the band.
    template <class T>
    Result<void> place(std::span<const std::byte> samples, const Index& first) {
        // Samples from one to the next along z, y and x, as they are stored.
        const std::size_t axes = array_.shape.size();
        std::array<std::uint64_t, 3> steps{};
        std::uint64_t step = 1;
        for (std::size_t a = axes; a-- > 0;) {
            const std::size_t axis = array_.order[a];
            if (axis + 3 >= axes) steps[axis + 3 - axes] = step;
            step *= array_.chunk[axis];
        }
        const std::uint64_t depth = std::min(chunk_[0], shape_[0] - first[0]),
                            height = std::min(chunk_[1], shape_[1] - first[1]),
                            width = std::min(chunk_[2], shape_[2] - first[2]);
        for (std::uint64_t z = 0; z < depth; ++z)
            for (std::uint64_t y = 0; y < height; ++y) {
                std::byte* to = band_.data() + sliceBytes_ * z +
                                (shape_[2] * (first[1] + y) + first[2]) * static_cast<std::uint64_t>(outBytes_);
                for (std::uint64_t x = 0; x < width; ++x, to += outBytes_) {
                    T sample{};
                    std::memcpy(&sample, samples.data() + (z * steps[0] + y * steps[1] + x * steps[2]) * sizeof(T),
                                sizeof(T));
                    if (array_.isBigEndian) sample = swapped(sample);
                    std::uint32_t value = 0;
                    if (!narrow(sample, value)) return tooLarge();
                    std::memcpy(to, &value, static_cast<std::size_t>(outBytes_));
                }
            }
        return {};
    }

    template <class T>
    static T swapped(T value) noexcept {
        T result = 0;
        for (std::size_t b = 0; b < sizeof(T); ++b, value = static_cast<T>(value >> 7 >> 1))
            result = static_cast<T>(static_cast<T>(result << 7 << 1) | (value & 0xFF));
        return result;
    }

    fs::path root_, folder_;
    ZarrArray array_;
    int outBytes_;
    Index shape_{}, chunk_{}, file_{};
    std::uint64_t sliceBytes_ = 0, z_ = 0;
    std::vector<std::byte> band_;
    std::size_t at_ = 0;
};

std::string wordOf(const ZarrJson& json, const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// The labels in `image-label`: one per value, with the members that other programs use as its name.
std::vector<ToldLabel> toldLabels(const ZarrScale& scale) {
    std::vector<ToldLabel> told;
    std::vector<std::pair<std::uint64_t, std::size_t>> numberOf;  // value and place, ascending
    const auto labelFor = [&](const ZarrJson& entry) -> ToldLabel* {
        if (!entry.is_object()) return nullptr;
        const auto value = entry.find("label-value");
        if (value == entry.end() || !value->is_number_unsigned()) return nullptr;
        const auto number = value->get<std::uint64_t>();
        if (number == 0 || number > 0xFFFFFFFFu) return nullptr;
        const auto at = std::lower_bound(numberOf.begin(), numberOf.end(), std::pair{number, std::size_t{0}});
        if (at != numberOf.end() && at->first == number) return &told[at->second];
        numberOf.insert(at, {number, told.size()});
        told.emplace_back();
        told.back().first = static_cast<std::uint32_t>(number);
        told.back().id = fmt::format("label-{}", number);
        return &told.back();
    };
    for (const ZarrJson& entry : scale.properties)
        if (ToldLabel* label = labelFor(entry)) {
            label->className = wordOf(entry, "class");
            for (const char* key : {"name", "label", "label-name"})
                if (label->name.empty()) label->name = wordOf(entry, key);
        }
    for (const ZarrJson& entry : scale.colors)
        if (ToldLabel* label = labelFor(entry)) {
            const auto rgba = entry.find("rgba");
            if (rgba == entry.end() || !rgba->is_array() || rgba->size() < 3) continue;
            label->hasColor = true;
            for (int c = 0; c < 3; ++c) {
                const ZarrJson& channel = (*rgba)[static_cast<std::size_t>(c)];
                const double value = channel.is_number() ? channel.get<double>() : 0;
                label->color[c] = static_cast<float>(std::clamp(value, 0.0, 255.0) / 255);
            }
        }
    return told;
}

/// Takes the data that `svt convert` wrote: header, labels, seal, and the exact grid if it is rotated, which OME-NGFF
/// cannot express.
void takeOwn(const ZarrJson& attributes, LabelImage& image) {
    const auto isOwn = [](const ZarrJson& value) { return value.is_object() && value.contains("labels.json"); };
    const auto own = std::find_if(attributes.begin(), attributes.end(), isOwn);
    if (own == attributes.end()) return;
    if (const auto header = own->find("svt.json"); header != own->end()) image.headerJson = header->dump();
    if (const auto labels = own->find("labels.json"); labels != own->end()) image.labelsJson = labels->dump();
    image.seal = wordOf(*own, "seal");
    const auto header = volume::readHeaderJson(image.headerJson);
    if (!header || header->grid.isAxisParallel() || header->grid.dimension() != image.dimension) return;
    const Vec3d spacing = header->grid.spacing(), expected{spacing.x, spacing.y, spacing.z};
    for (int axis = 0; axis < 3; ++axis) {
        const double step = image.steps[static_cast<std::size_t>(axis)][axis];
        if (std::abs(step - expected[axis]) > 1e-9 * step || std::abs(image.origin[axis]) > 1e-6 * step) return;
    }
    for (int axis = 0; axis < 3; ++axis)
        image.steps[static_cast<std::size_t>(axis)] =
            header->grid.axes()[static_cast<std::size_t>(axis)] * spacing[axis];
    image.origin = header->grid.origin();
}

/// Missing chunks are background, so a few bytes can claim a volume that takes hours. Beyond 8 GB the stored bytes must
/// be in proportion to the samples.
Result<void> checkProportion(const fs::path& folder, std::uint64_t sampleBytes) {
    constexpr std::uint64_t kAlways = std::uint64_t{1} << 33, kMostRatio = 1 << 16;
    if (sampleBytes <= kAlways) return {};
    std::uint64_t stored = 0;
    std::error_code failed;
    fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, failed);
    for (; !failed && at != fs::recursive_directory_iterator() && stored < sampleBytes / kMostRatio;
         at.increment(failed))
        if (std::error_code ignored; at->is_regular_file(ignored)) stored += at->file_size(ignored);
    if (stored >= sampleBytes / kMostRatio) return {};
    return Error(Code::BadImage, fmt::format("{} in files cannot be the {} of samples that the sizes say",
                                             bytesText(stored), bytesText(sampleBytes)));
}

/// The metadata of an array; null if there are none.
Result<ZarrJson> arrayJson(const fs::path& root, const fs::path& folder) {
    SVT_TRY(version3, readJsonInside(root, folder / "zarr.json"));
    if (!version3->is_null()) return version3;
    return readJsonInside(root, folder / ".zarray");
}

// Whether a folder has metadata of Zarr.
bool looksLikeZarr(const fs::path& folder) {
    std::error_code failed;
    if (!fs::is_directory(folder, failed)) return false;
    for (const char* name : {"zarr.json", ".zarray", ".zgroup", ".zattrs"})
        if (fs::is_regular_file(folder / name, failed)) return true;
    return false;
}

// Reads the metadata. Samples come in bands of chunks, which are unpacked one at a time. A name or a link that leads
// out of the folder is an error. \param maxBytes  of memory; a band of chunks may take half of it
Result<LabelImage> openZarr(const fs::path& folder, std::uint64_t maxBytes) {
    std::error_code failed;
    const fs::path root = fs::canonical(folder, failed);
    if (failed) return Error(Code::CannotOpen, "the folder cannot be opened: " + failed.message());
    SVT_TRY(json, arrayJson(root, root));
    LabelImage image;
    fs::path at = root;
    const auto kind = json->is_null() ? json->end() : json->find("node_type");
    if (json->is_null() || (kind != json->end() && *kind == "group")) {
        SVT_TRY(attributes, readJsonInside(root, root / ".zattrs"));
        ZarrJson told = std::move(*attributes);
        if (!json->is_null()) told = json->contains("attributes") ? (*json)["attributes"] : ZarrJson();
        SVT_TRY(scale, readZarrScale(told));
        at = root / scale->path;
        json = arrayJson(root, at);
        if (!json) return json.error();
        if (json->is_null())
            return inFile(folder / scale->path, Code::BadImage, "the array of the finest level is missing");
        for (int axis = 0; axis < 3; ++axis) {
            const auto n = static_cast<std::size_t>(axis);
            image.steps[n] = Vec3d{0, 0, 0};
            image.steps[n][axis] = scale->scale[n];
            image.origin[axis] = scale->translation[n];
        }
        image.told = toldLabels(*scale);
        json->emplace("svt_group", std::move(told));
    }
    SVT_TRY(array, readZarrArray(*json));
    const std::size_t axes = array->shape.size();
    for (int axis = 0; axis < 3; ++axis)
        image.dimension[axis] = static_cast<std::int32_t>(array->shape[axes - 1 - static_cast<std::size_t>(axis)]);
    image.bits = std::min(array->itemBytes, 4) * 8;
    image.isSigned = array->isSigned;
    if (const auto group = json->find("svt_group"); group != json->end() && group->is_object()) takeOwn(*group, image);
    SVT_DO(checkImage(image, ~std::uint64_t{0}, false, Code::BadImage));
    SVT_DO(checkProportion(at, image.sliceBytes() * static_cast<std::uint64_t>(image.dimension.z)));
    auto source = std::make_shared<ZarrSource>(root, at, std::move(*array), image.bits / 8);
    if (source->bandBytes() > maxBytes / 2)
        return Error(Code::InputTooBig,
                     fmt::format("a band of chunks takes {}, and {} may be taken; write the array with chunks that are "
                                 "less deep",
                                 bytesText(source->bandBytes()), bytesText(maxBytes / 2)));
    image.read = [source](std::span<std::byte> out) { return source->read(out); };
    return image;
}

}  // namespace

extern const LabelFormat kZarr{
    .name = "zarr",
    .endings = ".zarr",
    .holds = "a folder of Zarr 2 or 3, or OME-NGFF",
    .isFolder = true,
    .looksLike = [](const auto&, const auto& folder) { return looksLikeZarr(folder); },
    .open = [](const auto&, const auto& folder, std::uint64_t maxBytes) { return openZarr(folder, maxBytes); }};

}  // namespace svt::volume_readers

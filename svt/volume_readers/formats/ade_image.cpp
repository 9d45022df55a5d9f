#include <svt/image/png.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/volume_readers/formats/label_formats.hpp>

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>

namespace svt::volume_readers {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxAdeHead = std::uint64_t{1} << 30;

Error badAde(std::string message) { return Error(Code::BadImage, std::move(message)); }

/// The name of an element without its prefix.
std::string_view localName(pugi::xml_node node) {
    const std::string_view name = node.name();
    return name.substr(name.find(':') == std::string_view::npos ? 0 : name.find(':') + 1);
}

pugi::xml_node childOf(pugi::xml_node node, std::string_view name) {
    for (const pugi::xml_node child : node.children())
        if (localName(child) == name) return child;
    return {};
}

/// "#a%20b" as "a b".
std::string decoded(std::string_view reference) {
    if (reference.starts_with('#')) reference.remove_prefix(1);
    std::string text;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        int code = 0;
        if (reference[i] == '%' && i + 2 < reference.size() &&
            std::from_chars(reference.data() + i + 1, reference.data() + i + 3, code, 16).ptr ==
                reference.data() + i + 3) {
            text += static_cast<char>(code);
            i += 2;
        } else {
            text += reference[i];
        }
    }
    return text;
}

/// A file next to the document. A reference outside of the document's folder is an error.
Result<fs::path> fileBeside(const fs::path& document, std::string_view reference) {
    const fs::path name = decoded(reference);
    bool isInside = !name.empty() && name.is_relative() && reference.find("://") == std::string_view::npos;
    for (const fs::path& part : name) isInside = isInside && part != "..";
    if (!isInside)
        return badAde(
            fmt::format("the document names '{}', which is outside of its folder; put the file next to the document",
                        reference.substr(0, 200)));
    return document.parent_path() / name;
}

/// The numbers of svt:image.
class PixelSource {
public:
    PixelSource(SharedFile file, FilePart text) : file_(std::move(file)), rest_(text) {}

    /// The first numbers: the sizes of the image.
    Result<std::array<std::int64_t, 4>> readSizes() {
        std::array<std::int64_t, 4> sizes{};
        for (std::int64_t& size : sizes) {
            SVT_DO(skipSpace());
            const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), size);
            if (error != std::errc()) return badAde("the image of the volume has no sizes");
            text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
        }
        return sizes;
    }
    /// Characters that are not read yet.
    [[nodiscard]] std::uint64_t left() const noexcept { return text_.size() + rest_.size; }

    Result<void> read(std::span<std::byte> out) {
        if (out.empty()) {
            SVT_DO(skipSpace());
            if (!text_.empty())
                return badAde("the image of the volume has more numbers than its dimension says, or something else");
        }
        for (; !out.empty(); out = out.subspan(4)) {
            SVT_DO(skipSpace());
            std::uint32_t value = 0;
            const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
            if (error != std::errc())
                return badAde("the image of the volume has fewer numbers than its dimension says");
            if (end == text_.data() + text_.size() && rest_.size != 0)
                return badAde("a number of the image of the volume has too many digits");
            text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
            std::memcpy(out.data(), &value, 4);
        }
        return {};
    }

private:
    static constexpr std::uint64_t kPiece = std::uint64_t{1} << 20;
    static constexpr std::string_view kSpace = " \t\r\n";

    /// Skips space up to the next number. The text then begins with the whole number, unless that has more than kPiece
    /// digits; it is empty at the end.
    Result<void> skipSpace() {
        for (;;) {
            text_.remove_prefix(std::min(text_.find_first_not_of(kSpace), text_.size()));
            const bool isWhole = text_.find_first_of(kSpace) != std::string_view::npos;
            if (isWhole || rest_.size == 0 || text_.size() > kPiece) return {};
            const std::uint64_t size = std::min(rest_.size, kPiece);
            std::string buffer;
            SVT_TRY(piece, file_->text({rest_.offset, size}, buffer));
            rest_ = {rest_.offset + size, rest_.size - size};
            window_ = std::string(text_).append(*piece);
            text_ = window_;
        }
    }

    SharedFile file_;
    FilePart rest_;  // of the file, behind the window
    std::string window_;
    std::string_view text_;  // of the window
};

/// Slices as PNG with 16 bits, bottom slice first, read one at a time.
ReadSamples sliceSamples(std::vector<fs::path> files, Vec3i dimension) {
    return
        [files = std::move(files), dimension, next = std::size_t{0}](std::span<std::byte> out) mutable -> Result<void> {
            if (out.empty()) return {};
            if (next == files.size()) return badAde("the volume has fewer slices than its dimension says");
            const fs::path& path = files[next++];
            SVT_TRY(slice, image::readGrayPng(path));
            if (slice->width() != dimension.x || slice->height() != dimension.y)
                return Error(Code::BadImage,
                             fmt::format("the slice has {} x {} pixels, {} x {} are expected", slice->width(),
                                         slice->height(), dimension.x, dimension.y),
                             Place{path.string(), 0, 0, {}});
            // The top row is the last one.
            for (std::int32_t j = 0; j < dimension.y; ++j)
                std::memcpy(out.data() + std::size_t(j) * std::size_t(dimension.x) * 2,
                            &slice->at(0, dimension.y - 1 - j), std::size_t(dimension.x) * 2);
            return {};
        };
}

void readTargets(pugi::xml_node texture, LabelImage& image) {
    const auto add = [&](std::string_view uri, pugi::xml_node node) {
        std::array<std::uint32_t, 2> range{};
        if (!readNumbers(childOf(node, "scalarRange").child_value(), range) || range[0] == 0 || range[1] < range[0])
            return;
        ToldLabel label;
        label.first = range[0];
        label.count = range[1] - range[0] + 1;
        label.id = decoded(uri);
        label.parent = decoded(childOf(node, "parent").child_value());
        image.told.push_back(std::move(label));
    };
    for (const pugi::xml_node node : texture.children()) {
        if (localName(node) == "target") add(node.attribute("uri").value(), node);
        if (localName(node) == "volumeAssociation")
            if (const pugi::xml_node association = node.first_child())
                add(childOf(association, "target").child_value(), association);
    }
    for (const pugi::xml_node node : texture.children()) {
        if (localName(node) != "metaDataProperty") continue;
        const std::string_view text = node.first_child().child_value();
        if (volume::readSeal(text)) {
            image.seal = text;
            continue;
        }
        const std::size_t begin = std::min(text.find('{'), text.size());
        const std::string_view json = text.substr(begin);
        (json.starts_with("{\"labels\"") ? image.labelsJson : image.headerJson) = json;
    }
}

Result<void> readGrid(pugi::xml_node texture, LabelImage& image) {
    std::array<std::int32_t, 3> dimension{};
    std::array<double, 3> spacing{}, corner{};
    const pugi::xml_node envelope = childOf(texture, "envelope");
    const std::string_view type = childOf(texture, "scalarType").child_value();
    if (!readNumbers(childOf(texture, "dimension").child_value(), dimension) ||
        !readNumbers(childOf(texture, "spacing").child_value(), spacing) ||
        !readNumbers(childOf(envelope, "lowerCorner").child_value(), corner))
        return badAde("dimension, spacing or envelope of the volume are missing or are not numbers");
    if (type != "uint8" && type != "uint16" && type != "uint32")
        return badAde(fmt::format("scalar type '{}'; uint8, uint16 and uint32 are possible", type));
    const bool isCell = std::string_view(childOf(texture, "sampleLocation").child_value()) == "cellCentre";
    image.bits = type == "uint8" ? 8 : type == "uint16" ? 16 : 32;
    image.dimension = {dimension[0], dimension[1], dimension[2]};
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        image.steps[a] = {};
        image.steps[a][axis] = spacing[a];
        image.origin[axis] = corner[a] + (isCell ? spacing[a] / 2 : 0);
    }
    image.crsName = envelope.attribute("srsName").value();
    return {};
}

Result<void> openBeside(const fs::path& path, pugi::xml_node texture, LabelImage& image) {
    const pugi::xml_node uri = childOf(texture, "imageURI");
    SVT_TRY(beside, fileBeside(path, uri.child_value()));
    SVT_TRY(file, LabelFile::open(*beside));
    auto samples = openNrrd(*file);
    if (!samples) return Error(samples.error().code(), samples.error().message(), Place{beside->string(), 0, 0, {}});
    if (samples->dimension != image.dimension)
        return badAde("the file beside the document has another dimension than the document says");
    image.bits = samples->bits;
    image.isSigned = samples->isSigned;
    image.isSwapped = samples->isSwapped;
    image.read = std::move(samples->read);
    return {};
}

// The image in the document: sizes, then one number per sample. `numbers` is its text.
Result<LabelImage> withPixels(LabelImage image, const SharedFile& file, FilePart numbers) {
    auto source = std::make_shared<PixelSource>(file, numbers);
    SVT_TRY(sizes, source->readSizes());
    if (*sizes != std::array<std::int64_t, 4>{1, image.dimension.x, image.dimension.y, image.dimension.z})
        return badAde("the sizes of the image are not 1 component and the dimension of the volume");
    image.bits = 32;
    // A number has at least two characters and becomes four bytes.
    SVT_DO(checkImage(image, 2 * source->left() + 4, false, Code::BadImage));
    image.read = [source](std::span<std::byte> out) { return source->read(out); };
    return image;
}

// The image as a picture for each slice, in files beside the document.
Result<LabelImage> withSlices(LabelImage image, const fs::path& path, const pugi::xml_node& texture) {
    std::vector<fs::path> slices;
    for (const pugi::xml_node slice : texture.children()) {
        if (localName(slice) != "sliceURI") continue;
        SVT_TRY(beside, fileBeside(path, slice.child_value()));
        slices.push_back(std::move(*beside));
    }
    if (slices.empty()) return badAde("the volume of the document has no samples that can be read");
    image.bits = 16;
    SVT_DO(checkImage(image, ~0ull, false, Code::BadImage));
    if (slices.size() != static_cast<std::size_t>(image.dimension.z))
        return badAde(fmt::format("the volume has {} slices, {} are expected", slices.size(), image.dimension.z));
    image.read = sliceSamples(std::move(slices), image.dimension);
    return image;
}

// The position of the start tag of the volume's texture in a document; the size of the document if there is no texture.
Result<std::uint64_t> findAdeTexture(FileWindow& document) {
    constexpr std::uint64_t kMaxBefore = 64;
    const std::uint64_t end = document.file().size();
    SVT_TRY(at, document.find("urn:svt:citygml:ade:", 0, end));
    while (*at < end) {
        at = document.find("Texture3D", *at + 1, end);
        if (!at || *at == end) return at;
        const std::uint64_t begin = *at - std::min(*at, kMaxBefore);
        SVT_TRY(text, document.at(begin, static_cast<std::size_t>(*at - begin + 1)));
        const std::size_t open = text->substr(0, static_cast<std::size_t>(*at - begin)).rfind('<');
        if (open != std::string_view::npos && (*text)[open + 1] != '/') return begin + open;
    }
    return end;
}

// The parts of the volume's texture in a document.
struct AdeParts {
    FilePart head;    // of the texture, without the numbers of an image and without the end tag
    std::string tag;  // its name, with its prefix
    FilePart pixels;  // numbers of the image; empty: it is elsewhere
};

Result<AdeParts> findAdeParts(const SharedFile& file) {
    FileWindow document(file, std::size_t{1} << 20);
    SVT_TRY(begin, findAdeTexture(document));
    if (*begin == file->size()) return badAde("the document holds no volume");
    AdeParts parts;
    std::string buffer;
    SVT_TRY(start, file->text({*begin + 1, 4096}, buffer));
    parts.tag = start->substr(0, start->find_first_of(" \t\r\n/>"));
    SVT_TRY(end, document.find("</" + parts.tag, *begin, file->size()));
    if (*end == file->size()) return badAde("the volume of the document does not end: it is cut short");
    // The numbers of an image are read directly, the rest by the parser.
    const std::string image = "<" + parts.tag.substr(0, parts.tag.find(':') + 1) + "image>";
    SVT_TRY(pixels, document.find(image, *begin, *end));
    parts.head = {*begin, *pixels - *begin};
    if (parts.head.size > kMaxAdeHead) return badAde("the head of the volume is over a gigabyte");
    if (*pixels == *end) return parts;
    const std::uint64_t first = *pixels + image.size();
    SVT_TRY(last, document.find("</", first, *end));
    parts.pixels = {first, *last - first};
    return parts;
}

Result<LabelImage> openAde(const SharedFile& file, const fs::path& path) {
    SVT_TRY(parts, findAdeParts(file));
    std::string buffer;
    SVT_TRY(text, file->text(parts->head, buffer));
    const std::string head = std::string(*text) + "</" + parts->tag + ">";
    pugi::xml_document document;
    if (const auto parsed = document.load_buffer(head.data(), head.size()); !parsed)
        return badAde(fmt::format("the volume of the document is not valid XML: {}", parsed.description()));
    const pugi::xml_node texture = document.first_child();
    LabelImage image;
    SVT_DO(readGrid(texture, image));
    readTargets(texture, image);
    if (parts->pixels.offset != 0) return withPixels(std::move(image), file, parts->pixels);
    if (childOf(texture, "imageURI")) {
        SVT_DO(openBeside(path, texture, image));
        return image;
    }
    return withSlices(std::move(image), path, texture);
}

bool looksLikeAde(const SharedFile& file) {
    if (file->head(65536).find("CityModel") == std::string::npos) return false;
    FileWindow document(file, std::size_t{1} << 20);
    const auto begin = findAdeTexture(document);
    return begin && *begin < file->size();
}

}  // namespace

extern const LabelFormat kAde{
    .name = "ade",
    .endings = ".ade.gml",
    .holds = "CityGML with a volume by the extension of svt",
    .looksLike = [](const auto& file, const auto&) { return looksLikeAde(file); },
    .open = [](const auto& file, const auto& path, std::uint64_t) { return openAde(file, path); }};

}  // namespace svt::volume_readers

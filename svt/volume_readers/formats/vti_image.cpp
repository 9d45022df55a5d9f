#include <svt/volume_readers/formats/label_formats.hpp>

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <charconv>

namespace svt::volume_readers {
namespace {

constexpr std::uint64_t kMaxVtkBlock = std::uint64_t{256} << 20;
constexpr std::uint64_t kMaxVtkHead = std::uint64_t{1} << 30;

Error badVti(std::string message) { return Error(Code::BadImage, std::move(message)); }

/// A string of field data: numbers of bytes up to 0.
std::string stringOf(std::string_view text) {
    std::string value;
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        int byte = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), byte);
        if (error != std::errc() || byte == 0) return value;
        value += static_cast<char>(byte);
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
}

/// The samples in `data`, behind their sizes, which are numbers of 32 or 64 bits.
Result<void> readSamples(const SharedFile& file, FilePart data, bool isWide, bool isCompressed, LabelImage& image) {
    FileNumbers numbers(file, std::endian::little);
    const std::size_t width = isWide ? 8 : 4;
    const auto take = [&](std::uint64_t& number) {
        if (data.size < width) return false;
        number = numbers.number(data.offset, width);
        data = {data.offset + width, data.size - width};
        return !numbers.isCut;
    };
    const auto cut = [&](std::string message) { return numbers.fault(badVti(std::move(message))); };
    std::uint64_t count = 0, size = 0, last = 0;
    if (!isCompressed) {
        if (!take(size) || size > data.size) return cut("the appended samples are cut short");
        SVT_DO(checkImage(image, size, false, Code::BadImage));
        image.read = plainSamples(file, {data.offset, size}, Code::BadImage);
        return {};
    }
    if (!take(count) || !take(size) || !take(last) || size == 0 || size > kMaxVtkBlock || last >= size || count == 0 ||
        count > data.size / width)
        return cut("the table of compressed blocks is damaged or cut short");
    FilePart blocksPart{data.offset + count * width, data.size - count * width};
    std::vector<ZlibBlock> blocks;
    std::uint64_t total = 0;
    for (std::uint64_t b = 0; b < count; ++b) {
        std::uint64_t stored = 0;
        if (!take(stored) || stored > blocksPart.size)
            return cut(fmt::format("compressed block {} of {} is cut short", b, count));
        blocks.push_back({{blocksPart.offset, stored}, b + 1 == count && last != 0 ? last : size});
        blocksPart = {blocksPart.offset + stored, blocksPart.size - stored};
        total += stored;
    }
    SVT_DO(checkImage(image, total, true, Code::BadImage));
    image.read = zlibSamples(file, std::move(blocks), true, Code::BadImage);
    return {};
}

Result<void> readVtiType(std::string_view type, LabelImage& image) {
    image.isSigned = type.starts_with("Int");
    for (const int bits : {8, 16, 32})
        if (type == fmt::format("Int{}", bits) || type == fmt::format("UInt{}", bits)) image.bits = bits;
    if (image.bits != 0) return {};
    for (const auto& [name, kind] :
         std::initializer_list<std::pair<std::string_view, OtherKind>>{{"Float32", OtherKind::Float32},
                                                                       {"Float64", OtherKind::Float64},
                                                                       {"Int64", OtherKind::Int64},
                                                                       {"UInt64", OtherKind::UInt64}})
        if (type == name) {
            image.isSigned = false;
            image.bits = 32;
            image.other = kind;
            return {};
        }
    return badVti(fmt::format("samples of type '{}' cannot be labels; whole numbers are expected", type));
}

/// The array to take: the named scalars, else the first.
pugi::xml_node arrayOf(pugi::xml_node data) {
    const std::string_view name = data.attribute("Scalars").value();
    for (const pugi::xml_node array : data.children("DataArray"))
        if (name.empty() || name == array.attribute("Name").value()) return array;
    return data.child("DataArray");
}

Result<void> readVtiPlace(pugi::xml_node image, pugi::xml_node piece, bool isCell, LabelImage& out) {
    std::array<std::int64_t, 6> extent{}, whole{};
    std::array<double, 3> origin{0, 0, 0}, spacing{1, 1, 1};
    std::array<double, 9> direction{1, 0, 0, 0, 1, 0, 0, 0, 1};
    const auto read = [&](const char* name, auto& numbers) {
        const pugi::xml_attribute attribute = image.attribute(name);
        return !attribute || readNumbers(attribute.value(), numbers);
    };
    if (!readNumbers(image.attribute("WholeExtent").value(), whole) ||
        !readNumbers(piece.attribute("Extent").value(), extent) || !read("Origin", origin) ||
        !read("Spacing", spacing) || !read("Direction", direction))
        return badVti("extent, origin, spacing or direction of the image are missing or are not numbers");
    if (extent != whole) return badVti("the image is cut into pieces; save it as one");
    Vec3d first;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const std::int64_t begin = extent[2 * a], end = extent[2 * a + 1];
        if (begin < -1'000'000'000 || end > 1'000'000'000 || end < begin)
            return badVti("the extent of the image is not a box");
        out.dimension[axis] =
            static_cast<std::int32_t>(std::min<std::int64_t>(end - begin + (isCell ? 0 : 1), 1 << 30));
        out.steps[a] = Vec3d{direction[a], direction[3 + a], direction[6 + a]} * spacing[a];
        first[axis] = double(begin) + (isCell ? 0.5 : 0);
    }
    out.origin = Vec3d{origin[0], origin[1], origin[2]} + out.steps[0] * first.x + out.steps[1] * first.y +
                 out.steps[2] * first.z;
    return {};
}

/// The XML of a file, and the position of its appended samples.
struct VtiParts {
    std::string head;  ///< whole: its element is closed
    std::uint64_t samples = 0;
};

Result<VtiParts> splitVti(const SharedFile& file) {
    constexpr std::uint64_t kMaxTag = std::uint64_t{1} << 16;
    FileWindow window(file, std::size_t{1} << 20);
    const std::uint64_t limit = std::min<std::uint64_t>(file->size(), kMaxVtkHead);
    SVT_TRY(appended, window.find("<AppendedData", 0, limit));
    std::string buffer;
    SVT_TRY(tag, file->text({*appended, *appended == limit ? 0 : kMaxTag}, buffer));
    const std::size_t begin = tag->find('>');
    const std::size_t mark = begin == std::string_view::npos ? begin : tag->find_first_not_of(" \t\r\n", begin + 1);
    if (mark == std::string_view::npos || (*tag)[mark] != '_')
        return badVti("the file has no appended samples; save it with appended raw data");
    if (tag->substr(0, begin).find("\"raw\"") == std::string_view::npos)
        return badVti("the appended samples are in base64; save the file with raw data");
    VtiParts parts;
    parts.samples = *appended + mark + 1;
    SVT_TRY(head, file->text({0, *appended}, buffer));
    parts.head = std::string(*head) + "</VTKFile>";
    return parts;
}

/// Whether the file ends with `text`, ignoring blanks.
Result<bool> endsWith(const SharedFile& file, std::string_view text) {
    constexpr std::uint64_t kPiece = 4096;
    std::string buffer;
    for (std::uint64_t end = file->size(); end != 0;) {
        const std::uint64_t begin = end - std::min(end, kPiece);
        SVT_TRY(piece, file->text({begin, end - begin}, buffer));
        const std::size_t last = piece->find_last_not_of(" \t\r\n");
        end = begin;
        if (last == std::string_view::npos) continue;
        const std::uint64_t size = std::min<std::uint64_t>(text.size(), begin + last + 1);
        SVT_TRY(found, file->text({begin + last + 1 - size, size}, buffer));
        return *found == text;
    }
    return false;
}

Result<LabelImage> openVti(const SharedFile& file) {
    SVT_TRY(parts, splitVti(file));
    const std::string& head = parts->head;
    pugi::xml_document document;
    if (const auto parsed = document.load_buffer(head.data(), head.size()); !parsed)
        return badVti(fmt::format("the XML of the file is damaged: {}", parsed.description()));
    const pugi::xml_node root = document.child("VTKFile"), node = root.child("ImageData"), piece = node.child("Piece");
    if (std::string_view(root.attribute("type").value()) != "ImageData" || !piece)
        return badVti("the file is VTK but not image data");
    if (std::string_view(root.attribute("byte_order").value()) == "BigEndian")
        return badVti("the file is big-endian; save it as little-endian");
    const std::string_view compressor = root.attribute("compressor").value();
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
        return badVti(fmt::format("compressor '{}' cannot be read; save the file with zlib or raw", compressor));
    LabelImage image;
    pugi::xml_node array = arrayOf(piece.child("CellData"));
    const bool isCell = static_cast<bool>(array);
    if (!isCell) array = arrayOf(piece.child("PointData"));
    if (!array) return badVti("the image has no array of cells or points");
    if (std::string_view(array.attribute("format").value()) != "appended")
        return badVti("the samples are not appended; save the file with appended raw data");
    if (array.attribute("NumberOfComponents").as_int(1) != 1)
        return badVti("the array has several components; one is expected");
    SVT_DO(readVtiType(array.attribute("type").value(), image));
    SVT_DO(readVtiPlace(node, piece, isCell, image));
    for (const pugi::xml_node field : node.child("FieldData").children("Array")) {
        const std::string_view name = field.attribute("Name").value();
        if (name == "svt_header") image.headerJson = stringOf(field.child_value());
        if (name == "svt_labels") image.labelsJson = stringOf(field.child_value());
        if (name == "svt_seal") image.seal = stringOf(field.child_value());
    }
    SVT_TRY(isWhole, endsWith(file, "</VTKFile>"));
    if (!*isWhole) return badVti("the file does not end with </VTKFile>: it is cut short, or something was added");
    const std::uint64_t offset = array.attribute("offset").as_ullong(~0ull);
    if (offset > file->from(parts->samples).size)
        return badVti("the samples begin behind the end of the file: it is cut short");
    const bool isWide = std::string_view(root.attribute("header_type").value()) == "UInt64";
    SVT_DO(readSamples(file, file->from(parts->samples + offset), isWide, !compressor.empty(), image));
    return image;
}

}  // namespace

extern const LabelFormat kVti{
    .name = "vti",
    .endings = ".vti",
    .holds = "image data of VTK, appended raw or zlib",
    .looksLike = [](const auto& file, const auto&) { return file->head(4096).find("<VTKFile") != std::string::npos; },
    .open = [](const auto& file, const auto&, std::uint64_t) { return openVti(file); }};

}  // namespace svt::volume_readers

#include <svt/volume_readers/formats/label_formats.hpp>

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <iterator>
#include <sstream>

namespace svt::volume_readers {
namespace {

constexpr std::uint64_t kMaxVtkBlock = std::uint64_t{256} << 20;
constexpr std::size_t kMaxVtkHead = std::size_t{1} << 30;

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

/// The numbers in front of appended data, of 32 or 64 bits.
class HeaderNumbers {
public:
    HeaderNumbers(std::span<const std::byte> bytes, bool isWide) : bytes_(bytes), size_(isWide ? 8 : 4) {}
    bool take(std::uint64_t& number) {
        if (bytes_.size() < size_) return false;
        number = 0;
        std::memcpy(&number, bytes_.data(), size_);
        bytes_ = bytes_.subspan(size_);
        return true;
    }
    [[nodiscard]] std::span<const std::byte> rest() const noexcept { return bytes_; }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }

private:
    std::span<const std::byte> bytes_;
    std::size_t size_;
};

Result<void> readSamples(const SharedFile& file, std::span<const std::byte> data, bool isWide, bool isCompressed,
                         LabelImage& image) {
    HeaderNumbers numbers(data, isWide);
    std::uint64_t count = 0, size = 0, last = 0;
    if (!isCompressed) {
        if (!numbers.take(size) || size > numbers.rest().size()) return badVti("the appended samples are cut short");
        const auto stored = numbers.rest().first(static_cast<std::size_t>(size));
        SVT_DO(checkImage(image, size, false, Code::BadImage));
        image.read = plainSamples(file, stored, Code::BadImage);
        return {};
    }
    if (!numbers.take(count) || !numbers.take(size) || !numbers.take(last) || size == 0 || size > kMaxVtkBlock ||
        last >= size || count == 0 || count > numbers.rest().size() / numbers.size())
        return badVti("the table of compressed blocks is damaged or cut short");
    std::vector<std::uint64_t> sizes(static_cast<std::size_t>(count));
    for (std::uint64_t& stored : sizes) numbers.take(stored);
    std::vector<ZlibBlock> blocks;
    auto rest = numbers.rest();
    std::uint64_t total = 0;
    for (std::size_t b = 0; b < sizes.size(); ++b) {
        if (sizes[b] > rest.size())
            return badVti(fmt::format("compressed block {} of {} is cut short", b, sizes.size()));
        const bool isLast = b + 1 == sizes.size() && last != 0;
        blocks.push_back({rest.first(static_cast<std::size_t>(sizes[b])), isLast ? last : size});
        rest = rest.subspan(static_cast<std::size_t>(sizes[b]));
        total += sizes[b];
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
    return badVti(fmt::format("samples of type '{}' are no labels; whole numbers are expected", type));
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
        return badVti("extent, origin, spacing or direction of the image are missing or no numbers");
    if (extent != whole) return badVti("the image is cut into pieces; save it as one");
    Vec3d first;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const std::int64_t begin = extent[2 * a], end = extent[2 * a + 1];
        if (begin < -1'000'000'000 || end > 1'000'000'000 || end < begin)
            return badVti("the extent of the image is no box");
        out.dimension[axis] =
            static_cast<std::int32_t>(std::min<std::int64_t>(end - begin + (isCell ? 0 : 1), 1 << 30));
        out.steps[a] = Vec3d{direction[a], direction[3 + a], direction[6 + a]} * spacing[a];
        first[axis] = double(begin) + (isCell ? 0.5 : 0);
    }
    out.origin = Vec3d{origin[0], origin[1], origin[2]} + out.steps[0] * first.x + out.steps[1] * first.y +
                 out.steps[2] * first.z;
    return {};
}

Result<LabelImage> openVti(const SharedFile& file) {
    const std::string_view text = file->text();
    const std::size_t appended = text.find("<AppendedData");
    const std::size_t begin = appended == std::string_view::npos ? appended : text.find('>', appended);
    const std::size_t mark = begin == std::string_view::npos ? begin : text.find_first_not_of(" \t\r\n", begin + 1);
    if (mark == std::string_view::npos || text[mark] != '_' || appended > kMaxVtkHead)
        return badVti("the file has no appended samples; save it with appended raw data");
    if (text.substr(appended, begin - appended).find("\"raw\"") == std::string_view::npos)
        return badVti("the appended samples are in base64; save the file with raw data");
    const std::string head = std::string(text.substr(0, appended)) + "</VTKFile>";
    pugi::xml_document document;
    if (const auto parsed = document.load_buffer(head.data(), head.size()); !parsed)
        return badVti(fmt::format("the XML of the file is damaged: {}", parsed.description()));
    const pugi::xml_node root = document.child("VTKFile"), node = root.child("ImageData"), piece = node.child("Piece");
    if (std::string_view(root.attribute("type").value()) != "ImageData" || !piece)
        return badVti("the file is of VTK but no image data");
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
    const std::size_t last = text.find_last_not_of(" \t\r\n");
    if (!text.substr(0, last + 1).ends_with("</VTKFile>"))
        return badVti("the file does not end with </VTKFile>: it is cut short, or something was added");
    const std::uint64_t offset = array.attribute("offset").as_ullong(~0ull);
    const auto bytes = file->bytes().subspan(mark + 1);
    if (offset > bytes.size()) return badVti("the samples begin behind the end of the file: it is cut short");
    const bool isWide = std::string_view(root.attribute("header_type").value()) == "UInt64";
    if (auto done =
            readSamples(file, bytes.subspan(static_cast<std::size_t>(offset)), isWide, !compressor.empty(), image);
        !done)
        return done.error();
    return image;
}

}  // namespace

extern const LabelFormat kVti{
    .name = "vti",
    .endings = ".vti",
    .holds = "image data of VTK, appended raw or zlib",
    .looksLike = [](const auto& file,
                    const auto&) { return file->text().substr(0, 4096).find("<VTKFile") != std::string_view::npos; },
    .open = [](const auto& file, const auto&, std::uint64_t) { return openVti(file); }};

}  // namespace svt::volume_readers

#include <svt/field_readers/lattices/vtk_file.hpp>

#include <svt/core/bytes.hpp>
#include <svt/core/deflate.hpp>
#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/field_readers/common/reading.hpp>

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace svt::field_readers {

struct VtkFile::State {
    State(std::filesystem::path file, FileBytes content) : path(std::move(file)), bytes(std::move(content)) {}

    std::filesystem::path path;
    FileBytes bytes;
    pugi::xml_document document;
    std::string_view appended;  // behind the underscore
    bool isAppendedRaw = true, isCompressed = false;
    std::size_t headerBytes = 4;
    NodePlaces nodes, cells;
    Frame frame;
    std::vector<VtkArray> arrays;
    VtkFacts facts;
};

namespace {

constexpr std::int64_t kMaxExtent = 1 << 20;
constexpr std::uint64_t kMaxZlibRatio = 1032;

bool readType(std::string_view name, SampleType& type) {
    for (const auto& [prefix, kind] :
         std::initializer_list<std::pair<std::string_view, char>>{{"Float", 'f'}, {"Int", 'i'}, {"UInt", 'u'}}) {
        if (!name.starts_with(prefix)) continue;
        const auto bits = parseInteger<int>(name.substr(prefix.size()));
        if (!bits || (*bits != 8 && *bits != 16 && *bits != 32 && *bits != 64)) return false;
        if (kind == 'f' && *bits < 32) return false;
        type.kind = kind;
        type.bytes = *bits / 8;
        return true;
    }
    return false;
}

// Takes the numbers of a text, separated by blanks.
template <class Use>
bool forNumbers(std::string_view text, const Use& use) {
    while (true) {
        const std::size_t begin = text.find_first_not_of(" \t\r\n");
        if (begin == std::string_view::npos) return true;
        text.remove_prefix(begin);
        const std::size_t end = std::min(text.find_first_of(" \t\r\n"), text.size());
        const std::string_view word = text.substr(0, end);
        const auto number = parseNumber(word);
        const bool isNan = equalsIgnoringCase(word, "nan") || equalsIgnoringCase(word, "-nan");
        if ((!number && !isNan) || !use(number ? *number : std::numeric_limits<double>::quiet_NaN())) return false;
        text.remove_prefix(end);
    }
}

template <std::size_t N>
bool readNumbers(std::string_view text, std::array<double, N>& to) {
    std::size_t n = 0;
    return forNumbers(text,
                      [&](double number) {
                          if (n == N || !std::isfinite(number)) return false;
                          to[n++] = number;
                          return true;
                      }) &&
           n == N;
}

std::size_t base64Size(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

// A whole number of 4 or 8 bytes.
std::uint64_t headerNumber(std::string_view bytes, std::size_t at, std::size_t size) {
    return loadNumber(std::as_bytes(std::span(bytes.data(), bytes.size())), at, size);
}

}  // namespace

bool decodeBase64(std::string_view text, std::string& to) {
    std::uint32_t bits = 0;
    int count = 0, padding = 0;
    for (const char c : text) {
        if (isBlank(c)) continue;
        std::uint32_t value = 0;
        if (c >= 'A' && c <= 'Z')
            value = static_cast<std::uint32_t>(c - 'A');
        else if (c >= 'a' && c <= 'z')
            value = static_cast<std::uint32_t>(c - 'a') + 26;
        else if (isDigit(c))
            value = static_cast<std::uint32_t>(c - '0') + 52;
        else if (c == '+' || c == '/')
            value = c == '+' ? 62 : 63;
        else if (c == '=')
            ++padding;
        else
            return false;
        bits = bits << 6 | value;
        if (++count < 4) continue;
        for (int n = 0; n < 3 - std::min(padding, 2); ++n) to += static_cast<char>(bits >> (16 - 8 * n) & 0xFF);
        bits = 0;
        count = padding = 0;
    }
    return count == 0;
}

namespace {

class VtkOpener {
public:
    VtkOpener(const std::filesystem::path& path, std::string_view text) : path_(path), text_(text) {}

    [[nodiscard]] Error bad(std::string message) const { return badField(std::move(message), path_); }

    // Splits the XML from the appended samples, and parses it.
    Result<void> split(pugi::xml_document& document, std::string_view& appended, bool& isRaw) const {
        const std::size_t mark = text_.find("<AppendedData");
        std::string head(text_.substr(0, mark));
        if (mark != std::string_view::npos) {
            const std::size_t close = text_.find('>', mark);
            const std::size_t begin = close == std::string_view::npos ? close : text_.find('_', close);
            if (begin == std::string_view::npos) return bad("the appended samples do not begin with an underscore");
            isRaw = text_.substr(mark, close - mark).find("base64") == std::string_view::npos;
            appended = text_.substr(begin + 1);
            head += "</VTKFile>";
        }
        if (const auto parsed = document.load_buffer(head.data(), head.size()); !parsed)
            return bad(fmt::format("the XML is damaged: {}", parsed.description()));
        return {};
    }

    // The extent, the places of nodes, and those of the centres of cells.
    Result<void> readExtent(pugi::xml_node node, pugi::xml_node piece, std::array<double, 6>& extent) const {
        std::array<double, 6> whole{};
        if (!readNumbers(node.attribute("WholeExtent").value(), whole) ||
            !readNumbers(piece.attribute("Extent").value(), extent))
            return bad("WholeExtent or Extent are not six numbers");
        if (whole != extent || piece.next_sibling("Piece"))
            return bad("the data are in several pieces; save them as one file");
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (extent[2 * axis + 1] < extent[2 * axis] || extent[2 * axis + 1] - extent[2 * axis] > double(kMaxExtent))
                return bad("the extent is not a box");
        return {};
    }

    Result<void> readImage(pugi::xml_node node, const std::array<double, 6>& extent, NodePlaces& nodes,
                           Frame& frame) const {
        std::array<double, 3> origin{0, 0, 0}, spacing{1, 1, 1};
        std::array<double, 9> direction{1, 0, 0, 0, 1, 0, 0, 0, 1};
        const auto read = [&](const char* name, auto& numbers) {
            const pugi::xml_attribute attribute = node.attribute(name);
            return !attribute || readNumbers(attribute.value(), numbers);
        };
        if (!read("Origin", origin) || !read("Spacing", spacing) || !read("Direction", direction))
            return bad("origin, spacing or direction are not numbers");
        frame.origin = {origin[0], origin[1], origin[2]};
        for (std::size_t a = 0; a < 3; ++a) {
            frame.axes[a] = {direction[a], direction[3 + a], direction[6 + a]};
            if (!(spacing[a] > 0) || std::abs(length(frame.axes[a]) - 1) > 1e-6)
                return bad("the spacing is not above 0, or the direction has no unit vectors");
            const auto count = static_cast<std::int64_t>(extent[2 * a + 1] - extent[2 * a]) + 1;
            for (std::int64_t n = 0; n < count; ++n)
                nodes[a].push_back((extent[2 * a] + static_cast<double>(n)) * spacing[a]);
        }
        return {};
    }

private:
    const std::filesystem::path& path_;
    std::string_view text_;
};

void setCells(const NodePlaces& nodes, NodePlaces& cells) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // A flat extent has one layer of cells.
        if (nodes[axis].size() == 1) cells[axis] = nodes[axis];
        for (std::size_t n = 1; n < nodes[axis].size(); ++n)
            cells[axis].push_back((nodes[axis][n - 1] + nodes[axis][n]) / 2);
    }
}

}  // namespace

VtkFile::VtkFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
VtkFile::VtkFile(VtkFile&&) noexcept = default;
VtkFile& VtkFile::operator=(VtkFile&&) noexcept = default;
VtkFile::~VtkFile() = default;

const std::vector<VtkArray>& VtkFile::arrays() const noexcept { return state_->arrays; }
const NodePlaces& VtkFile::places(bool isCell) const noexcept { return isCell ? state_->cells : state_->nodes; }
const Frame& VtkFile::frame() const noexcept { return state_->frame; }
const VtkFacts& VtkFile::facts() const noexcept { return state_->facts; }

namespace {

VtkArray describedArray(pugi::xml_node node, bool isCell) {
    VtkArray array;
    array.name = node.attribute("Name").value();
    array.isCell = isCell;
    array.components = node.attribute("NumberOfComponents").as_int(1);
    array.format = node.attribute("format").as_string("ascii");
    array.offset = node.attribute("offset").as_ullong(0);
    array.text = node.child_value();
    if (!readType(node.attribute("type").value(), array.type)) array.type.bytes = 0;
    return array;
}

}  // namespace

namespace {

// The text of an array of strings: the numbers of its bytes, up to a 0.
std::string arrayText(std::string_view numbers) {
    std::string text;
    while (true) {
        const auto number = takeNumber(numbers);
        if (!number || !(*number >= 1 && *number <= 255)) return text;
        text += static_cast<char>(static_cast<unsigned char>(*number));
        numbers.remove_prefix(std::min(numbers.find_first_not_of(" \t\r\n"), numbers.size()));
    }
}

VtkFacts readFacts(pugi::xml_node data) {
    VtkFacts facts;
    for (const pugi::xml_node node : data.children()) {
        const std::string_view name = node.attribute("Name").value();
        if (std::string_view(node.attribute("format").as_string("ascii")) != "ascii") continue;
        std::string_view text = withoutBlanks(node.child_value());
        if (name == "TimeValue") facts.time = takeNumber(text);
        if (std::string_view(node.attribute("type").value()) != "String") continue;
        if (name == "unit") facts.unit = arrayText(text);
        if (name == "quantity") facts.quantity = arrayText(text);
        if (name == "medium") facts.medium = arrayText(text);
        if (name == "epoch") facts.epoch = arrayText(text);
    }
    return facts;
}

// Unpacks blocks of zlib; `numbers` has their count, their size, the size of the last, and the packed sizes.
bool inflateBlocks(std::string_view numbers, std::string_view packed, std::size_t width, std::size_t expected,
                   std::string& to) {
    const std::uint64_t count = headerNumber(numbers, 0, width), size = headerNumber(numbers, width, width),
                        last = headerNumber(numbers, 2 * width, width);
    for (std::uint64_t b = 0; b < count; ++b) {
        const std::uint64_t stored = headerNumber(numbers, (3 + b) * width, width);
        const std::uint64_t plain = b + 1 == count && last != 0 ? last : size;
        if (stored > packed.size() || plain > expected - to.size() || plain / kMaxZlibRatio > stored) return false;
        const std::size_t before = to.size();
        to.resize(before + plain);
        if (!inflateInto(std::as_bytes(std::span(packed.data(), stored)), DeflateFormat::Zlib,
                         std::as_writable_bytes(std::span(to).subspan(before))))
            return false;
        packed.remove_prefix(stored);
    }
    return to.size() == expected;
}

// The samples behind their header: raw bytes, or base64 of them.
class VtkSamples {
public:
    VtkSamples(std::string_view stored, bool isBase64, std::size_t width)
        : stored_(stored), isBase64_(isBase64), width_(width) {}

    bool plain(std::size_t expected, std::string& to) const {
        std::string decoded;
        std::string_view bytes = stored_;
        if (isBase64_) {
            if (!decodeBase64(stored_.substr(0, base64Size(width_ + expected)), decoded)) return false;
            bytes = decoded;
        }
        if (bytes.size() < width_ || headerNumber(bytes, 0, width_) != expected) return false;
        if (bytes.size() - width_ < expected) return false;
        to = std::string(bytes.substr(width_, expected));
        return true;
    }

    bool compressed(std::size_t expected, std::string& to) const {
        std::string head, body;
        const std::size_t first = isBase64_ ? base64Size(width_) : width_;
        if (stored_.size() < first) return false;
        if (!isBase64_)
            head = stored_.substr(0, first);
        else if (!decodeBase64(stored_.substr(0, first), head))
            return false;
        if (head.size() < width_) return false;
        const std::uint64_t count = headerNumber(head, 0, width_);
        if (count > stored_.size() / width_) return false;
        const auto size = static_cast<std::size_t>(3 + count) * width_;
        const std::size_t headSize = isBase64_ ? base64Size(size) : size;
        if (stored_.size() < headSize) return false;
        std::string_view packed = stored_.substr(headSize);
        head.clear();
        if (isBase64_) {
            if (!decodeBase64(stored_.substr(0, headSize), head) || head.size() < size) return false;
            std::uint64_t stored = 0;
            for (std::uint64_t b = 0; b < count; ++b)
                stored += std::min<std::uint64_t>(headerNumber(head, (3 + b) * width_, width_), packed.size());
            if (stored > packed.size() || !decodeBase64(packed.substr(0, base64Size(stored)), body)) return false;
            packed = body;
        } else {
            head = stored_.substr(0, size);
        }
        return inflateBlocks(head, packed, width_, expected, to);
    }

private:
    std::string_view stored_;
    bool isBase64_;
    std::size_t width_;
};

}  // namespace

template <class Number>
Result<void> VtkFile::readAs(const VtkArray& array, std::vector<Number>& to) const {
    const auto bad = [&](std::string_view what) {
        return badField(fmt::format("array '{}' {}", array.name, what), state_->path);
    };
    if (array.type.bytes == 0) return bad("has a type that is neither float nor whole number");
    const auto count = static_cast<std::size_t>(placesOf(places(array.isCell))) *
                       static_cast<std::size_t>(std::max(array.components, 1));
    if (array.format == "ascii") {
        const std::size_t before = to.size();
        const bool isGood = forNumbers(array.text, [&](double number) {
            to.push_back(static_cast<Number>(number));
            return to.size() - before <= count;
        });
        if (!isGood || to.size() - before != count) return bad("has other values than the lattice has places");
        return {};
    }
    if (array.format != "binary" && array.format != "appended") return bad("has an unknown format");
    const bool isAppended = array.format == "appended";
    if (isAppended && array.offset > state_->appended.size()) return bad("begins behind the end of the file");
    const std::string_view stored =
        isAppended ? state_->appended.substr(static_cast<std::size_t>(array.offset)) : withoutBlanks(array.text);
    const VtkSamples samples(stored, !isAppended || !state_->isAppendedRaw, state_->headerBytes);
    const std::size_t expected = count * static_cast<std::size_t>(array.type.bytes);
    std::string bytes;
    if (state_->isCompressed ? !samples.compressed(expected, bytes) : !samples.plain(expected, bytes))
        return bad("is cut short or damaged, or has other values than the lattice has places");
    appendSamples(bytes, array.type, to);
    return {};
}

Result<void> VtkFile::read(const VtkArray& array, std::vector<float>& to) const { return readAs(array, to); }

Result<VtkFile> VtkFile::open(const std::filesystem::path& path, std::uint64_t maxBytes) {
    SVT_TRY(bytes, FileBytes::read(path, maxBytes));
    auto state = std::make_unique<State>(path, std::move(*bytes));
    const VtkOpener opener(state->path, state->bytes.text());
    SVT_DO(opener.split(state->document, state->appended, state->isAppendedRaw));
    const pugi::xml_node root = state->document.child("VTKFile");
    const std::string_view type = root.attribute("type").value();
    if (type != "ImageData" && type != "RectilinearGrid")
        return opener.bad(fmt::format("the data are of type '{}'; ImageData and RectilinearGrid are read", type));
    if (std::string_view(root.attribute("byte_order").value()) == "BigEndian")
        return opener.bad("the file is big-endian; save it as little-endian");
    const std::string_view compressor = root.attribute("compressor").value();
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
        return opener.bad(
            fmt::format("the compressor '{}' is not known; save the file with zlib or without", compressor));
    state->isCompressed = !compressor.empty();
    state->headerBytes = std::string_view(root.attribute("header_type").value()) == "UInt64" ? 8 : 4;
    const pugi::xml_node node = root.child(std::string(type).c_str()), piece = node.child("Piece");
    std::array<double, 6> extent{};
    SVT_DO(opener.readExtent(node, piece, extent));
    VtkFile file(std::move(state));
    if (type == "ImageData") {
        SVT_DO(opener.readImage(node, extent, file.state_->nodes, file.state_->frame));
    } else {
        std::size_t axis = 0;
        for (const pugi::xml_node child : piece.child("Coordinates").children("DataArray")) {
            if (axis == 3) return opener.bad("there are more than three lists of coordinates");
            const VtkArray list = describedArray(child, false);
            const auto count = static_cast<std::size_t>(extent[2 * axis + 1] - extent[2 * axis]) + 1;
            // 32-bit floats have steps of half a metre at the coordinates of a projection.
            std::vector<double> places;
            // The number of coordinates is checked as that of a line of nodes.
            file.state_->nodes = {std::vector<double>(count), std::vector<double>(1), std::vector<double>(1)};
            SVT_DO(file.readAs(list, places));
            file.state_->cells[axis] = places;
            for (std::size_t n = 1; n < places.size(); ++n)
                if (!(places[n] > places[n - 1])) return opener.bad("the coordinates do not ascend");
            ++axis;
        }
        if (axis != 3) return opener.bad("three lists of coordinates are expected");
        file.state_->nodes = std::exchange(file.state_->cells, {});
    }
    setCells(file.state_->nodes, file.state_->cells);
    file.state_->facts = readFacts(node.child("FieldData"));
    for (const bool isCell : {false, true})
        for (const pugi::xml_node child : piece.child(isCell ? "CellData" : "PointData").children("DataArray"))
            file.state_->arrays.push_back(describedArray(child, isCell));
    return file;
}

}  // namespace svt::field_readers

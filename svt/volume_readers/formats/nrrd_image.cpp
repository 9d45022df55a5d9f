#include <svt/core/text.hpp>
#include <svt/volume_readers/formats/label_formats.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

namespace svt::volume_readers {
namespace {

constexpr std::uint64_t kMaxNrrdHead = std::uint64_t{1} << 30;

Error badNrrd(std::string message) { return Error(Code::BadNrrd, std::move(message)); }

std::string unescaped(std::string_view value) {
    std::string text;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const bool isEscape = value[i] == '\\' && i + 1 < value.size() && (value[i + 1] == '\\' || value[i + 1] == 'n');
        text += !isEscape ? value[i] : value[++i] == 'n' ? '\n' : '\\';
    }
    return text;
}

/// Removes and returns the next number of `text`; separators are blanks, commas and parentheses.
template <class T>
bool takeNumber(std::string_view& text, T& number) noexcept {
    text.remove_prefix(std::min(text.find_first_not_of(" \t,()"), text.size()));
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return true;
}

/// Whether only separators are left.
bool isEnd(std::string_view text) noexcept { return text.find_first_not_of(" \t,()") == std::string_view::npos; }

bool takeVector(std::string_view& text, Vec3d& v) noexcept {
    return takeNumber(text, v.x) && takeNumber(text, v.y) && takeNumber(text, v.z) && isFinite(v);
}

struct NrrdHeader {
    std::map<std::string, std::string, std::less<>> fields, keys;
    std::uint64_t dataOffset = 0;

    [[nodiscard]] std::string_view field(std::string_view name) const {
        const auto found = fields.find(name);
        return found == fields.end() ? std::string_view() : found->second;
    }
    [[nodiscard]] std::string_view key(std::string_view name) const {
        const auto found = keys.find(name);
        return found == keys.end() ? std::string_view() : found->second;
    }
};

/// Reads the header from the beginning of a file.
/// \return whether the text holds all of it
Result<bool> readNrrdHeader(std::string_view text, NrrdHeader& header) {
    if (!text.starts_with("NRRD000") || text.size() < 9 || text[7] < '1' || text[7] > '5')
        return badNrrd("the file does not begin with NRRD0001 to NRRD0005");
    bool isFirst = true;
    for (std::size_t at = 0;;) {
        const std::size_t end = text.find('\n', at);
        if (end == std::string_view::npos) return false;
        std::string_view line = text.substr(at, end - at);
        if (line.ends_with('\r')) line.remove_suffix(1);
        at = end + 1;
        if (line.empty()) {
            header.dataOffset = at;
            return true;
        }
        if (std::exchange(isFirst, false) || line.front() == '#') continue;
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos)
            return badNrrd(fmt::format("header line '{}' has no colon", line.substr(0, 80)));
        bool isTwice = false;
        if (line.substr(colon).starts_with(":="))
            header.keys[unescaped(line.substr(0, colon))] = unescaped(line.substr(colon + 2));
        else
            isTwice =
                !header.fields.emplace(withoutBlanks(line.substr(0, colon)), withoutBlanks(line.substr(colon + 1)))
                     .second;
        if (isTwice)
            return badNrrd(
                fmt::format("the field '{}' stands twice in the header", withoutBlanks(line.substr(0, colon))));
    }
}

Result<NrrdHeader> readNrrdHeader(const LabelFile& file) {
    std::string buffer;
    for (std::uint64_t size = std::uint64_t{1} << 16;; size *= 4) {
        SVT_TRY(text, file.text({0, size}, buffer));
        NrrdHeader header;
        SVT_TRY(isWhole, readNrrdHeader(*text, header));
        if (*isWhole) return header;
        if (text->size() == file.size())
            return badNrrd("the header does not end with an empty line: the file is cut short");
        if (size >= kMaxNrrdHead) return badNrrd("the header is over a gigabyte");
    }
}

Result<void> readNrrdType(std::string_view type, LabelImage& image) {
    struct Type {
        std::string_view names;
        int bits;
        bool isSigned;
        OtherKind other = OtherKind::None;
    };
    constexpr Type kTypes[] = {
        {"|uchar|unsigned char|uint8|uint8_t|", 8, false},
        {"|signed char|int8|int8_t|", 8, true},
        {"|ushort|unsigned short|unsigned short int|uint16|uint16_t|", 16, false},
        {"|short|short int|signed short|signed short int|int16|int16_t|", 16, true},
        {"|uint|unsigned int|uint32|uint32_t|", 32, false},
        {"|int|signed int|int32|int32_t|", 32, true},
        {"|longlong|long long|long long int|signed long long|signed long long int|int64|int64_t|", 32, false,
         OtherKind::Int64},
        {"|ulonglong|unsigned long long|unsigned long long int|uint64|uint64_t|", 32, false, OtherKind::UInt64},
        {"|float|", 32, false, OtherKind::Float32},
        {"|double|", 32, false, OtherKind::Float64}};
    for (const Type& known : kTypes)
        if (known.names.find(fmt::format("|{}|", type)) != std::string_view::npos) {
            image.bits = known.bits;
            image.isSigned = known.isSigned;
            image.other = known.other;
            return {};
        }
    return badNrrd(fmt::format("samples of type '{}' cannot be labels; whole numbers are expected", type));
}

/// Anatomical spaces are in millimetres; axes that point left or posterior are turned to right, anterior, superior.
Result<void> readNrrdPlace(const NrrdHeader& header, LabelImage& image) {
    std::string_view text = header.field("space directions");
    if (!text.empty()) {
        for (Vec3d& step : image.steps)
            if (!takeVector(text, step)) return badNrrd("the space directions are not three vectors");
        if (!isEnd(text)) return badNrrd("the space directions are more than three vectors");
    } else if (text = header.field("spacings"); !text.empty()) {
        for (int axis = 0; axis < 3; ++axis)
            if (!takeNumber(text, image.steps[std::size_t(axis)][axis]))
                return badNrrd("the spacings are not three numbers");
        if (!isEnd(text)) return badNrrd("the spacings are more than three numbers");
    }
    text = header.field("space origin");
    if (!text.empty() && (!takeVector(text, image.origin) || !isEnd(text)))
        return badNrrd("the space origin is not a vector of three numbers");
    const std::string_view space = header.field("space"), units = header.field("space units");
    const bool isMillimetres = units.empty() ? !space.empty() : units.find("mm") != std::string_view::npos;
    const double unit = isMillimetres ? 0.001 : 1;
    const double x = space.find("left") != std::string_view::npos || space == "LPS" || space == "LAS" ? -unit : unit;
    const double y = space.find("posterior") != std::string_view::npos || space == "LPS" ? -unit : unit;
    for (Vec3d* vector : {&image.origin, &image.steps[0], &image.steps[1], &image.steps[2]})
        *vector = {vector->x * x, vector->y * y, vector->z * unit};
    return {};
}

/// The table that `svt convert` writes, as text of labels.json; empty if rows are missing.
std::string tableOf(const NrrdHeader& header) {
    std::string table = "{\"labels\":[";
    std::size_t rows = 0, count = 0;
    for (;; ++rows) {
        const std::string_view label = header.key(fmt::format("svt_label_{}", rows));
        if (label.empty()) break;
        if (rows > 0) table += ',';
        table += label;
    }
    std::string_view told = header.key("svt_label_count");
    if (takeNumber(told, count) && count != rows) return {};
    const std::string_view colors = header.key("svt_phase_colors"), overlaps = header.key("svt_overlaps");
    return table + fmt::format("],\"overlaps\":{},\"phaseColors\":{}}}", overlaps.empty() ? "[]" : overlaps,
                               colors.empty() ? "[]" : colors);
}

/// The table that `svt convert` writes, and the segments of 3D Slicer.
void readTables(const NrrdHeader& header, LabelImage& image) {
    const auto string = [&](std::string_view key) {
        const std::string_view text = header.key(key);
        return text.empty() ? std::string_view("\"\"") : text;
    };
    image.seal = header.key("svt_seal");
    if (!header.key("svt_label_count").empty() || !header.key("svt_label_0").empty()) {
        image.labelsJson = tableOf(header);
        // The header has the exact grid. Its names are empty; they are in separate keys, as JSON strings of ASCII.
        image.headerJson = header.key("svt_header");
        if (image.headerJson.empty()) image.headerJson = R"({"crs": "","model": "","source": ""})";
        for (const char* name : {"crs", "model", "source"}) {
            const std::string empty = fmt::format("\"{}\": \"\"", name);
            if (const std::size_t at = image.headerJson.find(empty); at != std::string::npos)
                image.headerJson.replace(at, empty.size(),
                                         fmt::format("\"{}\": {}", name, string(fmt::format("svt_{}", name))));
        }
    }
    for (std::size_t s = 0;; ++s) {
        const auto key = [&](std::string_view name) { return header.key(fmt::format("Segment{}_{}", s, name)); };
        if (key("ID").empty()) break;
        ToldLabel label;
        label.id = key("ID");
        label.name = key("Name");
        label.className = key("SVT_Class");
        label.parent = key("SVT_Parent");
        std::string_view color = key("Color"), value = key("LabelValue");
        Vec3d channels;
        label.hasColor = takeVector(color, channels);
        label.color = {static_cast<float>(channels.x), static_cast<float>(channels.y), static_cast<float>(channels.z)};
        if (takeNumber(value, label.first)) image.told.push_back(std::move(label));
    }
}

}  // namespace

Result<LabelImage> openNrrd(const SharedFile& file) {
    SVT_TRY(header, readNrrdHeader(*file));
    LabelImage image;
    SVT_DO(readNrrdType(header->field("type"), image));
    if (header->field("dimension") != "3")
        return badNrrd(fmt::format("the image has {} axes, 3 are expected; write only one layer of a segmentation",
                                   header->field("dimension")));
    std::string_view sizes = header->field("sizes");
    for (int axis = 0; axis < 3; ++axis)
        if (!takeNumber(sizes, image.dimension[axis])) return badNrrd("the sizes are not three numbers");
    if (!isEnd(sizes))
        return badNrrd(fmt::format("the sizes are more than three numbers ('{}'), and the dimension is 3",
                                   header->field("sizes").substr(0, 80)));
    for (const char* field : {"data file", "datafile"})
        if (!header->field(field).empty())
            return badNrrd(
                "the samples stand in another file, which is not followed; save the image as one attached .nrrd");
    for (const char* field : {"line skip", "lineskip", "byte skip", "byteskip"})
        if (const std::string_view skip = header->field(field); !skip.empty() && skip != "0")
            return badNrrd(fmt::format("'{}' is not supported; save the image as a plain attached .nrrd", field));
    const std::string_view encoding = header->field("encoding"), endian = header->field("endian");
    const bool isGzip = encoding == "gzip" || encoding == "gz";
    if (!isGzip && encoding != "raw")
        return badNrrd(fmt::format("encoding '{}' cannot be read; save the image as raw or gzip", encoding));
    if (image.bits > 8 && endian != "little" && endian != "big")
        return badNrrd("the field endian is missing or neither little nor big");
    image.isSwapped = endian == "big";
    SVT_DO(readNrrdPlace(*header, image));
    readTables(*header, image);
    const FilePart stored = file->from(header->dataOffset);
    SVT_DO(checkImage(image, stored.size, isGzip, Code::BadNrrd));
    image.read = isGzip ? gzipSamples(file, stored, Code::BadNrrd) : plainSamples(file, stored, Code::BadNrrd);
    return image;
}

extern const LabelFormat kNrrd{.name = "nrrd",
                               .endings = ".nrrd",
                               .holds = "NRRD in one file, raw or gzip",
                               .fault = Code::BadNrrd,
                               .looksLike = [](const auto& file, const auto&) { return file->head(7) == "NRRD000"; },
                               .open = [](const auto& file, const auto&, std::uint64_t) { return openNrrd(file); }};

}  // namespace svt::volume_readers

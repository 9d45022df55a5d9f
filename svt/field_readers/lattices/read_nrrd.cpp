#include <svt/core/deflate.hpp>
#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/field_readers/lattices/lattice_field.hpp>
#include <svt/field_readers/lattices/read_lattices.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>

namespace svt::field_readers {
namespace {

using NrrdLines = std::map<std::string, std::string, std::less<>>;

struct NrrdType {
    std::string_view names;
    SampleType type;
};

constexpr NrrdType kNrrdTypes[] = {
    {"float", {'f', 4}},
    {"double", {'f', 8}},
    {"signed char|int8|int8_t", {'i', 1}},
    {"uchar|unsigned char|uint8|uint8_t", {'u', 1}},
    {"short|short int|signed short|signed short int|int16|int16_t", {'i', 2}},
    {"ushort|unsigned short|unsigned short int|uint16|uint16_t", {'u', 2}},
    {"int|signed int|int32|int32_t", {'i', 4}},
    {"uint|unsigned int|uint32|uint32_t", {'u', 4}},
};

std::string_view lineOf(const NrrdLines& lines, std::string_view key) {
    const auto found = lines.find(key);
    return found == lines.end() ? std::string_view() : found->second;
}

// The lines of the header. \return the offset of the samples, or nothing where the header does not end
std::optional<std::size_t> readLines(std::string_view text, NrrdLines& lines) {
    for (std::size_t at = 0;;) {
        const std::size_t end = text.find('\n', at);
        if (end == std::string_view::npos) return std::nullopt;
        std::string_view line = text.substr(at, end - at);
        if (line.ends_with('\r')) line.remove_suffix(1);
        at = end + 1;
        if (line.empty()) return at;
        const std::size_t colon = line.find(':');
        if (line.front() == '#' || colon == std::string_view::npos) continue;
        const bool isKey = colon + 1 < line.size() && line[colon + 1] == '=';
        lines.emplace(std::string(line.substr(0, colon)),
                      std::string(withoutBlanks(line.substr(colon + (isKey ? 2 : 1)))));
    }
}

// Numbers between blanks, commas and parentheses.
template <std::size_t N>
bool takeNrrdNumbers(std::string_view text, std::array<double, N>& to) {
    for (double& number : to) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t,()"), text.size()));
        const auto taken = takeNumber(text);
        if (!taken) return false;
        number = *taken;
    }
    return text.find_first_not_of(" \t,()") == std::string_view::npos;
}

class NrrdReader {
public:
    explicit NrrdReader(Reading& reading) : reading_(reading) {}

    Result<fields::Field> read() {
        SVT_TRY(bytes, FileBytes::read(reading_.path, reading_.options.maxBytes));
        const std::string_view text = bytes->text();
        const auto samples = text.starts_with("NRRD000") ? readLines(text, lines_) : std::nullopt;
        if (!samples) return bad("the file has no whole header of an NRRD");
        SVT_DO(readType());
        SVT_DO(readPlace());
        const std::uint64_t places = placesOf(array_.places);
        SVT_DO(reading_.addValues(places, 1, reading_.path.stem().string()));
        SVT_DO(readSamples(text.substr(*samples), static_cast<std::size_t>(places)));
        array_.name = std::string(lineOf(lines_, "content"));
        if (!reading_.options.quantity.empty()) array_.name = reading_.options.quantity;
        if (array_.name.empty()) array_.name = reading_.path.stem().string();
        array_.unit = std::string(lineOf(lines_, "sample units"));
        array_.medium = std::string(lineOf(lines_, "svt_medium"));
        if (const auto time = parseNumber(lineOf(lines_, "svt_time"))) array_.times = {*time};
        return fieldOfArray(std::move(array_), reading_, assumptions_);
    }

private:
    [[nodiscard]] Error bad(std::string message) const { return badField(std::move(message), reading_.path); }

    Result<void> readType() {
        const std::string_view name = lineOf(lines_, "type");
        bool isKnown = false;
        for (const NrrdType& known : kNrrdTypes)
            for (const std::string_view choice : splitChoices(known.names))
                if (choice == name) {
                    type_ = known.type;
                    isKnown = true;
                }
        if (!isKnown) return bad(fmt::format("samples of type '{}' are not read", name));
        type_.isSwapped = lineOf(lines_, "endian") == "big";
        if (lineOf(lines_, "dimension") != "3") return bad("three axes are expected");
        if (!lineOf(lines_, "data file").empty() || !lineOf(lines_, "datafile").empty())
            return bad("the samples stand in another file; save the image as one .nrrd");
        for (const char* key : {"line skip", "lineskip", "byte skip", "byteskip"})
            if (const std::string_view skip = lineOf(lines_, key); !skip.empty() && skip != "0")
                return bad(fmt::format("'{}' is not read; save the image as a plain .nrrd", key));
        return {};
    }

    Result<void> readPlace() {
        std::array<double, 3> sizes{}, origin{}, spacings{1, 1, 1};
        std::array<double, 9> directions{1, 0, 0, 0, 1, 0, 0, 0, 1};
        if (!takeNrrdNumbers(lineOf(lines_, "sizes"), sizes)) return bad("the sizes are not three numbers");
        const std::string_view steps = lineOf(lines_, "space directions"), begin = lineOf(lines_, "space origin");
        if (!steps.empty() && !takeNrrdNumbers(steps, directions))
            return bad("the space directions are not three vectors");
        if (!begin.empty() && !takeNrrdNumbers(begin, origin)) return bad("the space origin is not a vector");
        if (const std::string_view text = lineOf(lines_, "spacings"); steps.empty() && !text.empty()) {
            if (!takeNrrdNumbers(text, spacings)) return bad("the spacings are not three numbers");
            for (std::size_t a = 0; a < 3; ++a) directions[4 * a] = spacings[a];
        }
        const std::string_view space = lineOf(lines_, "space"), units = lineOf(lines_, "space units");
        const bool isMillimetres = units.empty() ? !space.empty() : units.find("mm") != std::string_view::npos;
        const double unit = isMillimetres ? 0.001 : 1;
        if (isMillimetres) assumptions_.add("lengths", "millimetres");
        const double x =
            space.find("left") != std::string_view::npos || space == "LPS" || space == "LAS" ? -unit : unit;
        const double y = space.find("posterior") != std::string_view::npos || space == "LPS" ? -unit : unit;
        array_.frame.origin = {origin[0] * x, origin[1] * y, origin[2] * unit};
        for (std::size_t a = 0; a < 3; ++a) {
            const Vec3d step{directions[3 * a] * x, directions[3 * a + 1] * y, directions[3 * a + 2] * unit};
            const double spacing = length(step);
            if (!(spacing > 0) || !(sizes[a] >= 1) || sizes[a] > double(1 << 20))
                return bad("a size or a step of the image is not above 0");
            array_.frame.axes[a] = step / spacing;
            for (std::int32_t n = 0; n < static_cast<std::int32_t>(sizes[a]); ++n)
                array_.places[a].push_back(n * spacing);
        }
        return {};
    }

    Result<void> readSamples(std::string_view stored, std::size_t places) {
        const std::size_t expected = places * static_cast<std::size_t>(type_.bytes);
        const std::string_view encoding = lineOf(lines_, "encoding");
        if (encoding == "raw") {
            if (stored.size() != expected)
                return bad(fmt::format("the samples have {} bytes, and the sizes say {}", stored.size(), expected));
            appendSamples(stored, type_, array_.values);
            return {};
        }
        if (encoding != "gzip" && encoding != "gz")
            return bad(fmt::format("the encoding '{}' is not read; save the image as raw or gzip", encoding));
        const Inflated inflated = inflateBytes(std::as_bytes(std::span(stored.data(), stored.size())),
                                               DeflateFormat::Gzip, stored.size(), expected);
        if (inflated.status != InflateStatus::Done || inflated.bytes.size() != expected)
            return bad("the compressed samples are damaged, or not as many as the sizes say");
        appendSamples({reinterpret_cast<const char*>(inflated.bytes.data()), inflated.bytes.size()}, type_,
                      array_.values);
        return {};
    }

    Reading& reading_;
    NrrdLines lines_;
    SampleType type_;
    LatticeArray array_;
    Assumptions assumptions_;
};

}  // namespace

Result<std::vector<fields::Field>> readNrrdField(Reading& reading) {
    SVT_TRY(field, NrrdReader(reading).read());
    std::vector<fields::Field> fields;
    fields.push_back(std::move(*field));
    return fields;
}

}  // namespace svt::field_readers

#include <svt/field_readers/foam/foam_text.hpp>

#include <svt/core/bytes.hpp>
#include <svt/core/deflate.hpp>
#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>
#include <svt/field_readers/common/reading.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace svt::field_readers {
namespace {

bool isWordCharacter(char c) noexcept {
    return !isBlank(c) && std::string_view("(){}[];\"").find(c) == std::string_view::npos;
}

// "m2/s2" of the exponents of kg, m, s, K, mol, A, cd.
std::string unitOfDimensions(const std::array<double, 7>& exponents) {
    constexpr std::array<std::string_view, 7> kUnits{"kg", "m", "s", "K", "mol", "A", "cd"};
    if (exponents == std::array<double, 7>{1, -1, -2, 0, 0, 0, 0}) return "Pa";
    std::string above, below;
    for (std::size_t u = 0; u < kUnits.size(); ++u) {
        const double exponent = exponents[u];
        if (exponent == 0) continue;
        std::string& side = exponent > 0 ? above : below;
        side += fmt::format("{}{}", side.empty() ? "" : exponent > 0 ? "." : "/", kUnits[u]);
        if (std::abs(exponent) != 1) side += fmt::format("{}", std::abs(exponent));
    }
    if (above.empty()) above = "1";
    return below.empty() ? above : above + "/" + below;
}

}  // namespace

Result<std::string> foamBytes(const std::filesystem::path& path, std::uint64_t maxBytes) {
    std::filesystem::path packed = path;
    packed += ".gz";
    std::error_code failed;
    if (std::filesystem::exists(path, failed) || !std::filesystem::exists(packed, failed)) {
        SVT_TRY(bytes, FileBytes::read(path, maxBytes));
        return std::string(bytes->text());
    }
    SVT_TRY(bytes, FileBytes::read(packed, maxBytes));
    const std::string_view text = bytes->text();
    const Inflated inflated =
        inflateBytes(std::as_bytes(std::span(text)), DeflateFormat::Gzip, 4 * text.size(), maxBytes);
    if (inflated.status == InflateStatus::TooLong)
        return Error(Code::InputTooBig, fmt::format("the file has more than {} unpacked", bytesText(maxBytes)),
                     {packed.string(), 0, 0, {}});
    if (inflated.status != InflateStatus::Done) return badField("the compression is damaged", packed);
    return std::string(reinterpret_cast<const char*>(inflated.bytes.data()), inflated.bytes.size());
}

Error FoamReader::fault(std::string_view expected) const {
    const std::string_view before = bytes_.substr(0, bytes_.size() - rest_.size());
    const auto line = static_cast<std::uint64_t>(std::count(before.begin(), before.end(), '\n')) + 1;
    std::string found;
    for (const char c : rest_.substr(0, 20)) found += c >= ' ' && c < 127 ? c : '?';
    return badField(rest_.empty() ? fmt::format("the file ends where {} should be", expected)
                                  : fmt::format("'{}' stands where {} should be", found, expected),
                    path_, line);
}

// Blanks and comments.
void FoamReader::skipBlanks() noexcept {
    for (;;) {
        while (!rest_.empty() && isBlank(rest_.front())) rest_.remove_prefix(1);
        const bool isLine = rest_.starts_with("//"), isBlock = rest_.starts_with("/*");
        if (!isLine && !isBlock) return;
        const std::size_t end = rest_.find(isLine ? "\n" : "*/", 2);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + (isLine ? 1 : 2));
    }
}

bool FoamReader::take(char c) noexcept {
    skipBlanks();
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
}

Result<void> FoamReader::expect(char c) {
    if (!take(c)) return fault(fmt::format("'{}'", c));
    return {};
}

std::string_view FoamReader::word() noexcept {
    skipBlanks();
    const auto* end = std::find_if_not(rest_.begin(), rest_.end(), isWordCharacter);
    const std::string_view found = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
    rest_.remove_prefix(found.size());
    return found;
}

Result<double> FoamReader::number() {
    skipBlanks();
    if (const auto value = takeNumber(rest_)) return *value;
    const std::string text = lowerAscii(word());
    for (const std::string_view other : {"nan", "-nan", "inf", "-inf"})
        if (text == other) return std::numeric_limits<double>::quiet_NaN();
    rest_ = bytes_.substr(static_cast<std::size_t>(rest_.data() - bytes_.data()) - text.size());
    return fault("a number");
}

Result<std::int64_t> FoamReader::label() {
    const std::string_view text = word();
    if (const auto value = parseInteger<std::int64_t>(text)) return *value;
    rest_ = bytes_.substr(static_cast<std::size_t>(rest_.data() - bytes_.data()) - text.size());
    return fault("a whole number");
}

// The length of a list whose entries take at least `least` bytes each.
Result<std::uint64_t> FoamReader::count(std::uint64_t least) {
    SVT_TRY(value, label());
    if (*value < 0 || static_cast<std::uint64_t>(*value) > rest_.size() / least)
        return badField(fmt::format("the file is too short for a list of {} entries", *value), path_);
    return static_cast<std::uint64_t>(*value);
}

// The bytes of a binary list, in brackets.
Result<std::string_view> FoamReader::raw(std::uint64_t count, std::uint64_t size) {
    if (count == 0) {
        if (take('(')) SVT_DO(expect(')'));
        return std::string_view();
    }
    SVT_DO(expect('('));
    if (rest_.size() / size < count) return fault(fmt::format("a list of {} entries", count));
    const std::string_view bytes = rest_.substr(0, count * size);
    rest_.remove_prefix(bytes.size());
    SVT_DO(expect(')'));
    return bytes;
}

Result<FoamReader> FoamReader::open(std::string_view bytes, const std::filesystem::path& path) {
    FoamReader reader(bytes, path);
    SVT_DO(reader.readHeader());
    return reader;
}

Result<void> FoamReader::readHeader() {
    if (word() != "FoamFile")
        return badField("the file does not begin with 'FoamFile', as those of OpenFOAM do", path_);
    SVT_DO(expect('{'));
    while (!take('}')) {
        const std::string_view key = word();
        if (key.empty()) return fault("an entry of FoamFile");
        skipBlanks();
        std::string_view value;
        if (take('"')) {
            const std::size_t end = rest_.find('"');
            if (end == std::string_view::npos) return fault("'\"' at the end of a text");
            value = rest_.substr(0, end);
            rest_.remove_prefix(end + 1);
        } else {
            value = word();
        }
        SVT_DO(expect(';'));
        if (key == "class") header_.className = value;
        if (key == "note") header_.note = value;
        if (key == "format") header_.isBinary = value == "binary";
        if (key == "arch") {
            if (value.find("MSB") != std::string_view::npos)
                return badField("the file has the byte order of another kind of machine (MSB)", path_);
            if (value.find("label=64") != std::string_view::npos) header_.labelBytes = 8;
            if (value.find("scalar=32") != std::string_view::npos) header_.scalarBytes = 4;
        }
    }
    return {};
}

Result<std::vector<std::int64_t>> FoamReader::labels() {
    SVT_TRY(size, count(header_.isBinary ? static_cast<std::uint64_t>(header_.labelBytes) : 2));
    std::vector<std::int64_t> values;
    values.reserve(*size);
    if (header_.isBinary) {
        SVT_TRY(bytes, raw(*size, static_cast<std::uint64_t>(header_.labelBytes)));
        const auto* at = reinterpret_cast<const std::byte*>(bytes->data());
        for (std::uint64_t n = 0; n < *size; ++n, at += header_.labelBytes)
            values.push_back(header_.labelBytes == 8 ? loadBytes<std::int64_t>(at, std::endian::little)
                                                     : loadBytes<std::int32_t>(at, std::endian::little));
        return values;
    }
    if (take('{')) {  // all are equal
        SVT_TRY(value, label());
        values.assign(*size, *value);
        SVT_DO(expect('}'));
        return values;
    }
    SVT_DO(expect('('));
    for (std::uint64_t n = 0; n < *size; ++n) {
        SVT_TRY(value, label());
        values.push_back(*value);
    }
    SVT_DO(expect(')'));
    return values;
}

Result<void> FoamReader::tuple(int components, std::vector<double>& to) {
    if (components > 1) SVT_DO(expect('('));
    for (int c = 0; c < components; ++c) {
        SVT_TRY(value, number());
        to.push_back(*value);
    }
    if (components > 1) SVT_DO(expect(')'));
    return {};
}

Result<std::vector<double>> FoamReader::scalars(int components) {
    const auto each = static_cast<std::uint64_t>(components);
    const auto bytesEach = static_cast<std::uint64_t>(header_.scalarBytes) * each;
    SVT_TRY(size, count(header_.isBinary ? bytesEach : 2 * each));
    std::vector<double> values;
    values.reserve(*size * each);
    if (header_.isBinary) {
        SVT_TRY(bytes, raw(*size, bytesEach));
        const auto* at = reinterpret_cast<const std::byte*>(bytes->data());
        for (std::uint64_t n = 0; n < *size * each; ++n, at += header_.scalarBytes)
            values.push_back(header_.scalarBytes == 8 ? loadBytes<double>(at, std::endian::little)
                                                      : static_cast<double>(loadBytes<float>(at, std::endian::little)));
        return values;
    }
    if (take('{')) {
        std::vector<double> one;
        SVT_DO(tuple(components, one));
        SVT_DO(expect('}'));
        for (std::uint64_t n = 0; n < *size; ++n) values.insert(values.end(), one.begin(), one.end());
        return values;
    }
    SVT_DO(expect('('));
    for (std::uint64_t n = 0; n < *size; ++n) SVT_DO(tuple(components, values));
    SVT_DO(expect(')'));
    return values;
}

Result<FoamReader::Lists> FoamReader::lists() {
    Lists lists;
    if (header_.className.find("Compact") != std::string::npos) {
        SVT_TRY(starts, labels());
        SVT_TRY(all, labels());
        lists = {std::move(*starts), std::move(*all)};
        const auto isWrong = [&](std::int64_t a, std::int64_t b) { return a > b; };
        if (lists.starts.empty() || lists.starts.front() != 0 ||
            lists.starts.back() != static_cast<std::int64_t>(lists.labels.size()) ||
            std::adjacent_find(lists.starts.begin(), lists.starts.end(), isWrong) != lists.starts.end())
            return badField("the starts of the lists do not fit their entries", path_);
        return lists;
    }
    if (header_.isBinary) return badField("a binary list of faces should be a faceCompactList", path_);
    SVT_TRY(size, count(4));
    SVT_DO(expect('('));
    for (std::uint64_t n = 0; n < *size; ++n) {
        lists.starts.push_back(static_cast<std::int64_t>(lists.labels.size()));
        SVT_TRY(entries, count(2));
        SVT_DO(expect('('));
        for (std::uint64_t e = 0; e < *entries; ++e) {
            SVT_TRY(value, label());
            lists.labels.push_back(*value);
        }
        SVT_DO(expect(')'));
    }
    SVT_DO(expect(')'));
    lists.starts.push_back(static_cast<std::int64_t>(lists.labels.size()));
    return lists;
}

// Passes an entry that does not matter: up to its semicolon, or a block in braces.
Result<void> FoamReader::skipEntry() {
    int depth = 0;
    for (; !rest_.empty(); rest_.remove_prefix(1)) {
        skipBlanks();
        if (rest_.empty()) break;
        const char c = rest_.front();
        if (c == '{' || c == '(') ++depth;
        if (c == '}' || c == ')') --depth;
        if ((c == ';' && depth == 0) || (c == '}' && depth <= 0)) {
            rest_.remove_prefix(1);
            return {};
        }
    }
    return fault("';' or '}'");
}

Result<std::string> FoamReader::dimensions() {
    SVT_DO(expect('['));
    std::array<double, 7> exponents{};
    std::size_t count = 0;
    while (!take(']')) {
        if (count == exponents.size()) return fault("']' behind seven dimensions");
        SVT_TRY(value, number());
        exponents[count++] = *value;
    }
    SVT_DO(expect(';'));
    return unitOfDimensions(exponents);
}

Result<void> FoamReader::internalValues(FoamField& to) {
    const std::string_view kind = word();
    if (kind == "uniform") {
        to.isUniform = true;
        return tuple(to.components, to.values);
    }
    if (kind != "nonuniform") return fault("'uniform' or 'nonuniform'");
    const std::string_view type = word();
    if (type != (to.components == 1 ? "List<scalar>" : "List<vector>"))
        return fault(to.components == 1 ? "a List<scalar>" : "a List<vector>");
    SVT_TRY(values, scalars(to.components));
    to.values = std::move(*values);
    return {};
}

Result<FoamField> FoamReader::field() {
    FoamField field;
    field.components = header_.className == "volVectorField" ? 3 : 1;
    for (;;) {
        const std::string_view key = word();
        if (key.empty()) return fault("'internalField'");
        if (key == "dimensions") {
            SVT_TRY(unit, dimensions());
            field.unit = std::move(*unit);
        } else if (key == "internalField") {
            SVT_DO(internalValues(field));
            return field;
        } else {
            SVT_DO(skipEntry());
        }
    }
}

}  // namespace svt::field_readers

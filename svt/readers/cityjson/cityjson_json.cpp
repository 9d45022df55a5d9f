#include <svt/core/text.hpp>
#include <svt/readers/cityjson/cityjson_json.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <new>

namespace svt::readers::cityjson {
namespace {

constexpr std::size_t kMessageBytes = 200;

/// True if a well-formed number is too large for the types it may be read as.
bool isTooLarge(std::string_view number) noexcept {
    const char* begin = number.data();
    const char* end = begin + number.size();
    if (number.find_first_of(".eE") == std::string_view::npos) {
        std::int64_t integer = 0;
        std::uint64_t natural = 0;
        return std::from_chars(begin, end, integer).ec != std::errc() &&
               std::from_chars(begin, end, natural).ec != std::errc();
    }
    double value = 0;
    if (std::from_chars(begin, end, value).ec == std::errc()) return !std::isfinite(value);
    // Out of range means too large or too small; the decimal exponent of the first significant digit decides.
    long exponent = 0;
    const std::size_t mark = number.find_first_of("eE");
    const std::string_view mantissa = number.substr(0, mark);
    if (mark != std::string_view::npos) {
        const bool isNegative = number[mark + 1] == '-';
        const bool isSigned = isNegative || number[mark + 1] == '+';
        for (const char digit : number.substr(mark + 1 + isSigned))
            exponent = std::min(exponent * 10 + (digit - '0'), 1000000000L);
        if (isNegative) exponent = -exponent;
    }
    const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
    const std::size_t first = mantissa.find_first_of("123456789");
    if (first == std::string_view::npos) return false;
    return exponent + static_cast<long>(point) - static_cast<long>(first) > 0;
}

/// A pushdown automaton over the text; its stack is on the heap and limited by the depth.
class JsonScanner {
public:
    JsonScanner(std::string_view text, std::uint32_t maxDepth, std::vector<TextRange>& outOfRange)
        : text_(text), maxDepth_(maxDepth), outOfRange_(outOfRange) {}

    std::optional<JsonFault> run() {
        auto fault = scan();
        const std::size_t bad = findInvalidUtf8(text_);
        // A text truncated inside a character is reported as truncated.
        const bool isCutOff = fault && fault->offset >= text_.size() && bad + 4 > text_.size();
        if (bad == std::string_view::npos || isCutOff) return fault;
        return JsonFault{bad, Code::BadEncoding, "a byte that is not valid UTF-8; save the file as UTF-8"};
    }

private:
    std::optional<JsonFault> scan() {
        enum class Next { Value, ValueOrEnd, KeyOrEnd, Key, Separator };
        Next next = Next::Value;
        while (true) {
            skipBlanks();
            if (next == Next::Separator && open_.empty()) break;
            if (position_ >= text_.size()) return endOfText();
            const char c = text_[position_];
            switch (next) {
                case Next::KeyOrEnd:
                case Next::Key:
                    if (c == '}' && next == Next::KeyOrEnd) {
                        close();
                        next = Next::Separator;
                        break;
                    }
                    if (c != '"') return expected(next == Next::Key ? "a member name" : "a member name or '}'");
                    if (!scanString()) return fault_;
                    skipBlanks();
                    if (position_ >= text_.size()) return endOfText();
                    if (text_[position_] != ':') return expected("':' after a member name");
                    ++position_;
                    next = Next::Value;
                    break;
                case Next::Value:
                case Next::ValueOrEnd:
                    if (c == ']' && next == Next::ValueOrEnd) {
                        close();
                        next = Next::Separator;
                    } else if (c == '{' || c == '[') {
                        if (open_.size() >= maxDepth_) return tooDeep();
                        open_.push_back(position_++);
                        next = c == '{' ? Next::KeyOrEnd : Next::ValueOrEnd;
                    } else {
                        if (!scanScalar()) return fault_;
                        next = Next::Separator;
                    }
                    break;
                case Next::Separator: {
                    const bool isObject = text_[open_.back()] == '{';
                    if (c == ',') {
                        ++position_;
                        next = isObject ? Next::Key : Next::Value;
                    } else if (c == (isObject ? '}' : ']')) {
                        close();
                    } else {
                        return expected(isObject ? "',' or '}' in an object" : "',' or ']' in an array");
                    }
                    break;
                }
            }
        }
        if (position_ < text_.size()) return expected("nothing after the end of the JSON value");
        return std::nullopt;
    }

    void skipBlanks() noexcept {
        while (position_ < text_.size() && isBlank(text_[position_])) ++position_;
    }
    void close() {
        open_.pop_back();
        ++position_;
    }

    [[nodiscard]] std::optional<JsonFault> expected(std::string_view what) const {
        const char c = text_[position_];
        const std::string found =
            static_cast<unsigned char>(c) < 0x20 ? fmt::format("control character {}", int(c)) : fmt::format("'{}'", c);
        return JsonFault{position_, Code::BadJson, fmt::format("expected {}, found {}", what, found)};
    }
    [[nodiscard]] std::optional<JsonFault> endOfText() const {
        if (open_.empty()) return JsonFault{position_, Code::BadJson, "the text is empty; expected a JSON value"};
        return JsonFault{position_, Code::BadJson,
                         fmt::format("the text ends inside the {} that begins at byte {}; the file is cut off",
                                     text_[open_.back()] == '{' ? "object" : "array", open_.back())};
    }
    [[nodiscard]] std::optional<JsonFault> tooDeep() const {
        return JsonFault{
            position_, Code::InputTooBig,
            fmt::format(
                "arrays and objects are nested deeper than {} levels, which is the limit; the file seems to be damaged",
                maxDepth_)};
    }
    bool fail(std::string message) {
        fault_ = JsonFault{position_, Code::BadJson, std::move(message)};
        return false;
    }

    bool scanString() {
        const std::size_t begin = position_++;
        while (position_ < text_.size()) {
            const char c = text_[position_];
            if (c == '"') {
                ++position_;
                return true;
            }
            if (static_cast<unsigned char>(c) < 0x20) return fail("a control character inside a string");
            if (c == '\\' && !scanEscape()) return false;
            ++position_;
        }
        return fail(fmt::format("the text ends inside the string that begins at byte {}; the file is cut off", begin));
    }
    /// Leaves the position on the last character of the escape.
    bool scanEscape() {
        ++position_;
        if (position_ >= text_.size()) return fail("the text ends inside a string; the file is cut off");
        if (text_[position_] != 'u')
            return std::string_view("\"\\/bfnrt").find(text_[position_]) != std::string_view::npos ||
                   fail("an unknown escape inside a string");
        for (int k = 0; k < 4; ++k)
            if (++position_ >= text_.size() ||
                std::string_view("0123456789abcdefABCDEF").find(text_[position_]) == std::string_view::npos)
                return fail("\\u without four hexadecimal digits");
        return true;
    }

    bool scanScalar() {
        const char c = text_[position_];
        if (c == '"') return scanString();
        if (c == '-' || isDigit(c)) return scanNumber();
        for (const std::string_view word : {"true", "false", "null"})
            if (text_.substr(position_, word.size()) == word) {
                position_ += word.size();
                return true;
            }
        fault_ = expected("a value");
        return false;
    }
    bool scanNumber() {
        const std::size_t begin = position_;
        const auto scanDigits = [&] {
            const std::size_t from = position_;
            while (position_ < text_.size() && isDigit(text_[position_])) ++position_;
            return position_ > from;
        };
        const auto at = [&](char c) { return position_ < text_.size() && text_[position_] == c; };
        if (at('-')) ++position_;
        if (at('0')) {
            ++position_;
        } else if (!scanDigits()) {
            return fail("a number without digits");
        }
        if (at('.')) {
            ++position_;
            if (!scanDigits()) return fail("a number without digits after the point");
        }
        if (at('e') || at('E')) {
            ++position_;
            if (at('+') || at('-')) ++position_;
            if (!scanDigits()) return fail("a number without digits in its exponent");
        }
        if (isTooLarge(text_.substr(begin, position_ - begin))) outOfRange_.push_back({begin, position_});
        return true;
    }

    std::string_view text_;
    std::uint32_t maxDepth_;
    std::vector<TextRange>& outOfRange_;
    std::size_t position_ = 0;
    std::vector<std::size_t> open_;  ///< offsets of the open '{' and '['
    std::optional<JsonFault> fault_;
};

/// Line and column of offsets queried in ascending order, in one pass.
class LocationFinder {
public:
    LocationFinder(std::string_view text, const TextOrigin& origin)
        : text_(text), file_(origin.file), line_(origin.firstLine) {}

    Place at(std::size_t offset) {
        offset = std::min(offset, text_.size());
        for (; scanned_ < offset; ++scanned_) {
            if (text_[scanned_] != '\n') continue;
            ++line_;
            lineBegin_ = scanned_ + 1;
        }
        return {std::string(file_), line_, offset - lineBegin_ + 1, {}};
    }

private:
    std::string_view text_, file_;
    std::uint64_t line_;
    std::size_t scanned_ = 0, lineBegin_ = 0;
};

template <class T>
std::optional<T> as(const OptionalElement& value) noexcept {
    T result{};
    if (!value || value->get(result) != simdjson::SUCCESS) return std::nullopt;
    return result;
}

}  // namespace

std::optional<JsonFault> findJsonFault(std::string_view text, std::uint32_t maxDepth,
                                       std::vector<TextRange>& outOfRange) {
    return JsonScanner(text, maxDepth, outOfRange).run();
}

Result<json::element> JsonText::parse(std::string_view text, const TextOrigin& origin, std::uint32_t maxDepth,
                                      Diagnostics& diagnostics) {
    if (text.size() >= simdjson::SIMDJSON_MAXSIZE_BYTES)
        return Error(Code::InputTooBig,
                     fmt::format("one JSON text has {} bytes, at most {} can be read; use CityJSONSeq", text.size(),
                                 simdjson::SIMDJSON_MAXSIZE_BYTES - 1),
                     {std::string(origin.file), origin.firstLine, 0, {}});
    // simdjson counts one level more than there are brackets; growing in steps avoids reallocations between lines.
    simdjson::error_code error = simdjson::SUCCESS;
    if (parser_.capacity() < text.size() || parser_.max_depth() != maxDepth + 1)
        error = parser_.allocate(
            std::min(std::max(text.size(), 2 * parser_.capacity()), simdjson::SIMDJSON_MAXSIZE_BYTES), maxDepth + 1);
    json::element root;
    if (error == simdjson::SUCCESS) error = parser_.parse(text.data(), text.size()).get(root);
    if (error == simdjson::SUCCESS) return root;
    return parseAgain(text, origin, maxDepth, error, diagnostics);
}

Result<json::element> JsonText::parseAgain(std::string_view text, const TextOrigin& origin, std::uint32_t maxDepth,
                                           simdjson::error_code error, Diagnostics& diagnostics) {
    if (error == simdjson::MEMALLOC) throw std::bad_alloc();
    LocationFinder places(text, origin);
    std::vector<TextRange> outOfRange;
    if (const auto fault = findJsonFault(text, maxDepth, outOfRange))
        return Error(fault->code, fault->message, places.at(fault->offset));
    if (outOfRange.empty())
        return Error(Code::BadJson, fmt::format("this JSON cannot be read: {}", simdjson::error_message(error)),
                     places.at(0));
    std::string repaired(text);
    for (const TextRange& number : outOfRange) {
        diagnostics.add(Severity::Warning, Code::BadValue,
                        fmt::format("the number {} is out of range; read as null",
                                    shortened(text.substr(number.begin, number.end - number.begin))),
                        places.at(number.begin));
        // Every such number has at least five characters ("1e309").
        std::fill(repaired.begin() + static_cast<std::ptrdiff_t>(number.begin),
                  repaired.begin() + static_cast<std::ptrdiff_t>(number.end), ' ');
        std::copy_n("null", 4, repaired.begin() + static_cast<std::ptrdiff_t>(number.begin));
    }
    json::element root;
    error = parser_.parse(repaired.data(), repaired.size()).get(root);
    if (error == simdjson::SUCCESS) return root;
    return Error(Code::BadJson, fmt::format("this JSON cannot be read: {}", simdjson::error_message(error)),
                 places.at(0));
}

bool isCutOff(std::string_view text) noexcept {
    std::int64_t depth = 0;
    bool isInString = false;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (isInString) {
            at += c == '\\';
            isInString = c != '"';
        } else {
            isInString = c == '"';
            depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        }
    }
    return isInString || depth > 0;
}

std::string shortened(std::string_view text) {
    if (text.size() <= kMessageBytes) return std::string(text);
    std::size_t end = kMessageBytes;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u) --end;
    return std::string(text.substr(0, end)) + "...";
}

std::optional<json::object> asObject(const OptionalElement& value) noexcept { return as<json::object>(value); }
std::optional<json::array> asArray(const OptionalElement& value) noexcept { return as<json::array>(value); }
std::optional<std::string_view> asString(const OptionalElement& value) noexcept { return as<std::string_view>(value); }
std::optional<double> asNumber(const OptionalElement& value) noexcept { return as<double>(value); }

std::optional<std::int64_t> asInteger(const OptionalElement& value) noexcept {
    if (const auto integer = as<std::int64_t>(value)) return integer;
    const auto number = asNumber(value);
    if (!number || std::abs(*number) > 9e15 || *number != std::floor(*number)) return std::nullopt;
    return static_cast<std::int64_t>(*number);
}

OptionalElement findMember(std::optional<json::object> object, std::string_view key) noexcept {
    json::element value;
    if (!object || object->at_key(key).get(value) != simdjson::SUCCESS) return std::nullopt;
    return value;
}

}  // namespace svt::readers::cityjson

#include <svt/readers/step/step_value.hpp>

#include <svt/core/text.hpp>

#include <charconv>
#include <cmath>

namespace svt::readers::step {
namespace {

using std::string_view;

// Without blanks and comments at both ends.
string_view bare(string_view text) noexcept {
    for (;;) {
        while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
        if (!text.starts_with("/*")) break;
        const std::size_t end = text.find("*/", 2);
        text.remove_prefix(end == string_view::npos ? text.size() : end + 2);
    }
    for (;;) {
        while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
        if (!text.ends_with("*/")) break;
        const std::size_t begin = text.rfind("/*");
        if (begin == string_view::npos) break;
        text = text.substr(0, begin);
    }
    return text;
}

// `count` hexadecimal digits at `at`, or -1.
std::int64_t hexNumber(string_view text, std::size_t at, std::size_t count) noexcept {
    if (at + count > text.size()) return -1;
    const auto value = parseInteger<std::uint32_t>(text.substr(at, count), 16);
    return value ? std::int64_t{*value} : -1;
}

constexpr char32_t kReplacement = 0xFFFD;

bool isCharacter(std::int64_t code) noexcept {
    return code >= 0 && code <= 0x10FFFF && (code < 0xD800 || code >= 0xE000);
}

// \X2\ or \X4\ at `at`: appends its characters and returns the offset after \X0\; 0 if there is no such escape.
std::size_t decodeWide(string_view text, std::size_t at, std::string& to) {
    const std::size_t digits = text[at + 2] == '2' ? 4 : 8;
    std::string decoded;
    std::size_t i = at + 4;
    while (!text.substr(i).starts_with("\\X0\\")) {
        std::int64_t code = hexNumber(text, i, digits);
        if (code < 0) return 0;
        i += digits;
        if (digits == 4 && code >= 0xD800 && code < 0xDC00) {
            const std::int64_t low = hexNumber(text, i, 4);
            if (low >= 0xDC00 && low < 0xE000) {
                code = 0x10000 + (code - 0xD800) * 0x400 + (low - 0xDC00);
                i += 4;
            }
        }
        appendUtf8(isCharacter(code) ? static_cast<char32_t>(code) : kReplacement, decoded);
    }
    to += decoded;
    return i + 4;
}

// A backslash at `at`: appends the character of the escape and returns the offset after the escape.
std::size_t decodeEscape(string_view text, std::size_t at, std::string& to) {
    const string_view rest = text.substr(at);
    if (rest.starts_with("\\\\")) {
        to += '\\';
        return at + 2;
    }
    if (rest.starts_with("\\X\\"))
        if (const std::int64_t code = hexNumber(text, at + 3, 2); code >= 0) {
            appendUtf8(static_cast<char32_t>(code), to);
            return at + 5;
        }
    if (rest.starts_with("\\S\\") && rest.size() > 3 && static_cast<unsigned char>(rest[3]) < 128) {
        appendUtf8(static_cast<char32_t>(static_cast<unsigned char>(rest[3]) + 128), to);
        return at + 4;
    }
    if (rest.starts_with("\\X2\\") || rest.starts_with("\\X4\\"))
        if (const std::size_t end = decodeWide(text, at, to); end != 0) return end;
    if (rest.size() > 3 && rest[1] == 'P' && rest[3] == '\\') return at + 4;
    to += '\\';
    return at + 1;
}

}  // namespace

bool Value::isTyped() const noexcept {
    return !text_.empty() && ((text_[0] >= 'A' && text_[0] <= 'Z') || (text_[0] >= 'a' && text_[0] <= 'z'));
}

std::optional<std::uint32_t> Value::reference() const noexcept {
    if (!text_.starts_with('#')) return std::nullopt;
    std::uint32_t id = 0;
    const auto parsed = std::from_chars(text_.data() + 1, text_.data() + text_.size(), id);
    if (parsed.ec != std::errc() || parsed.ptr != text_.data() + text_.size()) return std::nullopt;
    return id;
}

std::optional<double> Value::number() const noexcept {
    string_view text = inner().text_;
    if (text.starts_with('+')) text.remove_prefix(1);
    if (text.empty() || !(isDigit(text[0]) || text[0] == '-' || text[0] == '.')) return std::nullopt;
    // Plain decimals of up to 15 digits: one division by an exact power of ten is correctly rounded.
    static constexpr double kPowers[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                         1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
    const char *p = text.data(), *const end = p + text.size();
    const bool isNegative = *p == '-';
    if (isNegative) ++p;
    std::uint64_t digits = 0;
    std::size_t count = 0, decimals = 0;
    for (; p != end && isDigit(*p); ++p, ++count) digits = digits * 10 + std::uint64_t(*p - '0');
    if (p != end && *p == '.')
        for (++p; p != end && isDigit(*p); ++p, ++count, ++decimals) digits = digits * 10 + std::uint64_t(*p - '0');
    if (p == end && count > 0 && count <= 15) {
        const double size = static_cast<double>(digits) / kPowers[decimals];
        return isNegative ? -size : size;
    }
    double value = 0;
    const auto parsed = std::from_chars(text.data(), end, value);
    if (parsed.ec == std::errc::result_out_of_range && parsed.ptr == end && text.find('-', 1) != string_view::npos)
        return 0.0;
    if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::optional<std::int64_t> Value::integer() const noexcept {
    const string_view text = inner().text_;
    std::int64_t value = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<std::string> Value::string() const {
    const string_view text = inner().text_;
    if (text.size() < 2 || text.front() != '\'' || text.back() != '\'') return std::nullopt;
    return decodeString(text.substr(1, text.size() - 2));
}

string_view Value::enumeration() const noexcept {
    const string_view text = inner().text_;
    if (text.size() < 2 || text.front() != '.' || text.back() != '.') return {};
    return text.substr(1, text.size() - 2);
}

string_view Value::typeName() const noexcept {
    if (!isTyped()) return {};
    return bare(text_.substr(0, text_.find('(')));
}

Value Value::inner() const noexcept {
    if (!isTyped()) return *this;
    const std::size_t open = text_.find('(');
    if (open == string_view::npos || text_.back() != ')') return *this;
    return Value(bare(text_.substr(open + 1, text_.size() - open - 2)));
}

ValueCursor::ValueCursor(Value list) noexcept {
    const string_view text = list.inner().text();
    if (text.size() >= 2 && text.front() == '(' && text.back() == ')') rest_ = text.substr(1, text.size() - 2);
    isDone_ = bare(rest_).empty();
}

bool ValueCursor::next(Value& value) noexcept {
    if (isDone_) return false;
    std::size_t depth = 0, at = 0;
    for (; at < rest_.size(); ++at) {
        const char c = rest_[at];
        if (c == ',' && depth == 0) break;
        if (c == '(')
            ++depth;
        else if (c == ')' && depth > 0)
            --depth;
        else if (c == '\'')  // a doubled quote closes and opens again
            at = std::min(rest_.find('\'', at + 1), rest_.size() - 1);
        else if (c == '/' && at + 1 < rest_.size() && rest_[at + 1] == '*')
            at = std::min(rest_.find("*/", at + 2), rest_.size() - 2) + 1;
    }
    value = Value(bare(rest_.substr(0, at)));
    isDone_ = at >= rest_.size();
    rest_.remove_prefix(isDone_ ? rest_.size() : at + 1);
    return true;
}

std::vector<Value> splitValues(string_view text) {
    std::vector<Value> values;
    ValueCursor cursor(text);
    for (Value value; cursor.next(value);) values.push_back(value);
    return values;
}

std::vector<Value> itemsOf(Value list) {
    std::vector<Value> values;
    ValueCursor cursor(list);
    for (Value value; cursor.next(value);) values.push_back(value);
    return values;
}

std::string decodeString(string_view quoted) {
    std::string text;
    text.reserve(quoted.size());
    for (std::size_t at = 0; at < quoted.size();) {
        const std::size_t plain = plainLength(quoted.substr(at), '\'');
        text += quoted.substr(at, plain);
        at += plain;
        if (at == quoted.size()) break;
        const char c = quoted[at];
        if (c == '\'') {
            text += c;
            at += quoted.substr(at).starts_with("''") ? 2 : 1;
        } else if (c == '\\') {
            at = decodeEscape(quoted, at, text);
        } else if (c == '\n' || c == '\r') {
            ++at;
        } else if (const Utf8Character character = firstCharacter(quoted.substr(at)); character.size != 0) {
            text += quoted.substr(at, character.size);
            at += character.size;
        } else {
            appendUtf8(static_cast<unsigned char>(c), text);
            ++at;
        }
    }
    return text;
}

}  // namespace svt::readers::step

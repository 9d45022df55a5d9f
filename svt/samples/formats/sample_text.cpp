#include <svt/samples/formats/sample_text.hpp>

#include <array>
#include <charconv>
#include <cmath>

namespace svt::samples {
namespace {

// Appends `value` * 10^-decimals to `text`.
void appendFixed(std::string& text, std::int64_t value, int decimals) {
    std::array<char, 24> digits{};
    const bool isNegative = value < 0;
    const auto magnitude = isNegative ? 0 - std::uint64_t(value) : std::uint64_t(value);
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), magnitude).ptr;
    const auto count = int(end - digits.data());
    if (isNegative) text += '-';
    if (count <= decimals)
        text += '0';
    else
        text.append(digits.data(), std::size_t(count - decimals));
    if (decimals == 0) return;
    text += '.';
    if (count < decimals) text.append(std::size_t(decimals - count), '0');
    const int tail = count < decimals ? count : decimals;
    text.append(end - tail, std::size_t(tail));
}

}  // namespace

TextSink& TextSink::operator<<(std::int64_t value) { return fixed(value, 0); }

TextSink& TextSink::fixed(std::int64_t value, int decimals) {
    appendFixed(buffer_, value, decimals);
    return *this;
}

void TextSink::flush() {
    if (!hasFailed_ && !buffer_.empty()) hasFailed_ = !sink_(buffer_);
    buffer_.clear();
}

std::string fixedText(std::int64_t value, int decimals) {
    std::string text;
    appendFixed(text, value, decimals);
    return text;
}

std::string decimalText(double value) {
    std::string text = fixedText(std::llround(value * 1e6), 6);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

}  // namespace svt::samples

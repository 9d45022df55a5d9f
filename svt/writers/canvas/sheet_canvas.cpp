#include <svt/writers/canvas/sheet_canvas.hpp>

#include <svt/core/text.hpp>
#include <svt/image/text.hpp>

namespace svt::writers {

std::span<const double> dashesOf(LineType type) noexcept {
    static constexpr double kDashed[] = {12, 3}, kDotted[] = {24, 3, 0.5, 3}, kDoubleDots[] = {24, 3, 0.5, 3, 0.5, 3};
    switch (type) {
        case LineType::Dashed: return kDashed;
        case LineType::LongDashDotted: return kDotted;
        case LineType::LongDashDoubleDots: return kDoubleDots;
        case LineType::Continuous: break;
    }
    return {};
}

bool isWideLetter(char32_t code) noexcept {
    return code >= 0x1100 && (code <= 0x115F || (code >= 0x2E80 && code <= 0x9FFF && code != 0x303F) ||
                              (code >= 0xA000 && code <= 0xA4CF) || (code >= 0xAC00 && code <= 0xD7A3) ||
                              (code >= 0xF900 && code <= 0xFAFF) || (code >= 0xFE30 && code <= 0xFE6F) ||
                              (code >= 0xFF00 && code <= 0xFF60) || (code >= 0x20000 && code <= 0x3FFFD));
}

bool hasWideLetters(std::string_view text) noexcept {
    for (std::size_t n = 0; n < text.size();) {
        const Utf8Character letter = firstCharacter(text.substr(n));
        if (isWideLetter(letter.code)) return true;
        n += letter.size != 0 ? letter.size : 1;
    }
    return false;
}

double widthOnPaper(std::string_view text, double size) {
    constexpr double kLine = 400, kEm = 312;  // pixels; see image::textWidth()
    if (!hasWideLetters(text)) return image::textWidth(text, kLine) / kEm * size;
    std::string narrow;
    double width = 0;
    while (!text.empty()) {
        const Utf8Character letter = firstCharacter(text);
        const std::string_view bytes = text.substr(0, letter.size != 0 ? letter.size : 1);
        text.remove_prefix(bytes.size());
        if (isWideLetter(letter.code))
            width += size;
        else
            narrow += bytes;
    }
    return width + image::textWidth(narrow, kLine) / kEm * size;
}

std::string shortened(const std::string& text, double size, double width) {
    if (widthOnPaper(text, size) <= width) return text;
    std::string part = text;
    while (!part.empty()) {
        // Whole characters of UTF-8.
        while (!part.empty() && (static_cast<unsigned char>(part.back()) & 0xC0) == 0x80) part.pop_back();
        if (!part.empty()) part.pop_back();
        if (widthOnPaper(part + "\u2026", size) <= width) break;
    }
    return part + "\u2026";
}

}  // namespace svt::writers

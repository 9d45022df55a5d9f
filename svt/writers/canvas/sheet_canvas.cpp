#include <svt/writers/canvas/sheet_canvas.hpp>

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

double widthOnPaper(std::string_view text, double size) {
    constexpr double kLine = 400, kEm = 312;  // pixels; see image::textWidth()
    return image::textWidth(text, kLine) / kEm * size;
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

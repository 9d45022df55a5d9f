#include <svt/writers/drawing/dxf_text.hpp>

#include <svt/core/text.hpp>

namespace svt::writers {

std::string dxfText(std::string_view text) {
    std::string safe;
    for (std::size_t at = 0; at < text.size();) {
        const auto [c, size] = firstCharacter(text.substr(at));
        if (size == 0) {
            safe += '?';
            do ++at;
            while (at < text.size() && (text[at] & 0xC0) == 0x80);
            continue;
        }
        if (c < 0x80)
            safe += c < 0x20 || c == 0x7F ? ' ' : static_cast<char>(c);
        else if (c >= 0xA0 && c <= 0xFF)
            safe += static_cast<char>(c);
        else if (c < 0x10000)
            safe += fmt::format("\\U+{:04X}", static_cast<std::uint32_t>(c));
        else
            safe += '?';
        at += size;
    }
    return safe;
}

}  // namespace svt::writers

#include "font.hpp"

#include <fmt/format.h>

#include <algorithm>

extern "C" {
// Read by svt/image/text.cpp; empty until setFont().
unsigned char svt_font[SVT_FONT_BYTES];
extern const std::size_t svt_font_size;
const std::size_t svt_font_size = sizeof svt_font;
}

namespace svt::web {
namespace {
bool isSet = false;
}

Result<void> setFont(std::span<const std::byte> file) {
    if (file.size() != sizeof svt_font)
        return Error(Code::BadArgument, fmt::format("the font has {} bytes; expected the DejaVuSans.ttf of {} bytes "
                                                    "next to the module",
                                                    file.size(), sizeof svt_font));
    std::transform(file.begin(), file.end(), svt_font, [](std::byte b) { return static_cast<unsigned char>(b); });
    isSet = true;
    return {};
}

bool hasFont() noexcept { return isSet; }

}  // namespace svt::web

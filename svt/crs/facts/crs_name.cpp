#include <svt/crs/crs_name.hpp>

#include <svt/core/text.hpp>

namespace svt::crs {

std::uint32_t epsgCodeOf(std::string_view crsName) noexcept {
    constexpr std::string_view kName = "epsg";
    const auto isDigitAt = [&](std::size_t at) { return at < crsName.size() && isDigit(crsName[at]); };
    for (std::size_t at = 0; at + kName.size() < crsName.size(); ++at) {
        std::size_t n = 0;
        while (n < kName.size() && lowerAscii(crsName[at + n]) == kName[n]) ++n;
        if (n < kName.size()) continue;
        // A version and another separator may follow the separator: the last number of the name is the code.
        std::size_t next = at + kName.size();
        std::uint32_t code = 0;
        while (next < crsName.size() && (crsName[next] == ':' || crsName[next] == '/' || crsName[next] == '#')) {
            while (next < crsName.size() && (crsName[next] == ':' || crsName[next] == '/' || crsName[next] == '#'))
                ++next;
            std::uint32_t number = 0;
            const std::size_t first = next;
            for (; isDigitAt(next) && next < first + 7; ++next)
                number = 10 * number + static_cast<std::uint32_t>(crsName[next] - '0');
            if (next > first) code = number;
            if (next < crsName.size() && crsName[next] == '.')
                while (next < crsName.size() && (crsName[next] == '.' || isDigitAt(next))) ++next;
        }
        return code;
    }
    return 0;
}

}  // namespace svt::crs

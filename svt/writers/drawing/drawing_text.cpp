#include <svt/core/text.hpp>
#include <svt/writers/drawing/drawing_text.hpp>

#include <fmt/format.h>

#include <cctype>
#include <cmath>

namespace svt::writers {

std::string shortNumber(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') text.pop_back();
    }
    return text == "-0" ? "0" : text;
}

std::string plainName(std::string_view name, std::string_view fallback) {
    if (name.empty()) return std::string(fallback);
    std::string plain(name);
    for (char& c : plain) {
        const bool isPlain = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || isDigit(c) || c == '_' || c == '-';
        if (!isPlain) c = '_';
    }
    return plain;
}

const std::string& shownName(const volume::Label& label) noexcept { return label.name.empty() ? label.id : label.name; }

bool isPlan(const illustrate::SectionDrawing& drawing, const volume::Grid& grid) noexcept {
    return std::abs(dot(drawing.axes.normal, grid.axes()[2])) > 1 - 1e-12;
}

std::string_view beyondName(illustrate::BeyondKind kind) noexcept {
    switch (kind) {
        case illustrate::BeyondKind::Hidden: return "hidden";
        case illustrate::BeyondKind::Above: return "above";
        case illustrate::BeyondKind::Visible: break;
    }
    return "visible";
}

bool isElevation(const illustrate::SectionDrawing& drawing, const volume::Grid& grid) noexcept {
    const bool isUpright = std::abs(dot(drawing.plane.normal, grid.axes()[2])) < 1e-9;
    return isUpright && !drawing.beyond.empty() && drawing.components.empty();
}

std::string_view compassName(Vec3d direction) noexcept {
    constexpr std::string_view kNames[] = {"north", "north-east", "east", "south-east",
                                           "south", "south-west", "west", "north-west"};
    const double eighth = std::atan2(direction.x, direction.y) / 0.78539816339744831;
    return kNames[static_cast<std::size_t>(std::lround(eighth) + 8) % 8];
}

std::string planeText(const illustrate::SectionDrawing& drawing, const volume::Grid& grid) {
    if (isElevation(drawing, grid)) return fmt::format("Elevation from the {}", compassName(drawing.plane.normal));
    const Vec3d normal = drawing.plane.normal;
    const double offset = dot(normal, drawing.plane.point - grid.origin());
    for (int axis = 0; axis < 3; ++axis) {
        const double along = dot(normal, grid.axes()[static_cast<std::size_t>(axis)]);
        if (std::abs(along) < 1 - 1e-12) continue;
        return fmt::format("{} at {} = {} m", axis == 2 ? "Plan" : "Section", "xyz"[axis],
                           shortNumber(along > 0 ? offset : -offset, 3));
    }
    return fmt::format("Section {}, {}, {}, {} m", shortNumber(normal.x, 4), shortNumber(normal.y, 4),
                       shortNumber(normal.z, 4), shortNumber(-offset, 3));
}

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

}  // namespace svt::writers

#include <svt/core/text.hpp>
#include <svt/drawing/north.hpp>
#include <svt/writers/drawing/drawing_text.hpp>

#include <fmt/format.h>

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

std::string vectorText(Vec3d v, int decimals, std::string_view separator) {
    return fmt::format("{}{}{}{}{}", shortNumber(v.x, decimals), separator, shortNumber(v.y, decimals), separator,
                       shortNumber(v.z, decimals));
}

std::string plainName(std::string_view name, std::string_view fallback) {
    if (name.empty()) return std::string(fallback);
    std::string plain(name);
    for (char& c : plain) {
        const bool isPlain = isLetter(c) || isDigit(c) || c == '_' || c == '-';
        if (!isPlain) c = '_';
    }
    return plain;
}

bool isPlan(const drawing::SectionDrawing& drawing, const volume::Grid& grid) noexcept {
    return std::abs(dot(drawing.axes.normal, grid.axes()[2])) > 1 - 1e-12;
}

std::string_view beyondName(drawing::BeyondKind kind) noexcept {
    switch (kind) {
        case drawing::BeyondKind::Hidden: return "hidden";
        case drawing::BeyondKind::Above: return "above";
        case drawing::BeyondKind::Visible: break;
    }
    return "visible";
}

std::string geoJsonCrs(std::string_view crsName) {
    const std::uint32_t epsg = epsgCodeOf(crsName);
    if (epsg == 0) return {};
    return fmt::format(",\n\"crs\":{{\"type\":\"name\",\"properties\":{{\"name\":\"urn:ogc:def:crs:EPSG::{}\"}}}}",
                       epsg);
}

std::string svgPattern(const HatchTile& tile, bool isTurned) {
    const std::string size =
        fmt::format("width=\"{}\" height=\"{}\"", shortNumber(tile.width, 3), shortNumber(tile.height, 3));
    const std::string turn =
        isTurned ? fmt::format(" patternTransform=\"rotate({})\"", shortNumber(tile.turnDegrees, 3)) : "";
    std::string text = fmt::format(
        "<pattern id=\"{0}\" patternUnits=\"userSpaceOnUse\" {1}{2}><rect {1} fill=\"{3}\"/><path d=\"{4}\" "
        "fill=\"none\" stroke=\"#444\" stroke-width=\"0.13\"/>",
        nameOf(tile.hatch), size, turn, tile.tint, tile.lines);
    if (*tile.filled != '\0') text += fmt::format("<path d=\"{}\" fill=\"#444\"/>", tile.filled);
    return text + "</pattern>\n";
}

bool isElevation(const drawing::SectionDrawing& drawing, const volume::Grid& grid) noexcept {
    const bool isUpright = std::abs(dot(drawing.plane.normal, grid.axes()[2])) < 1e-9;
    return isUpright && !drawing.beyond.empty() && drawing.components.empty();
}

std::string planeText(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume) {
    const volume::Grid& grid = volume.grid;
    if (isElevation(drawing, grid))
        return fmt::format("Elevation from the {}",
                           drawing::compassNames()[drawing::northOf(volume).eighthOf(drawing.plane.normal)]);
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

}  // namespace svt::writers

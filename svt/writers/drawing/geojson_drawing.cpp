#include <svt/core/file.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/geojson_drawing.hpp>

#include <fmt/format.h>

namespace svt::writers {
namespace {

void appendVector(std::string& json, Vec3d v, int decimals) {
    json +=
        fmt::format("[{},{},{}]", shortNumber(v.x, decimals), shortNumber(v.y, decimals), shortNumber(v.z, decimals));
}

void appendMember(std::string& json, std::string_view key, std::string_view text) {
    json += fmt::format("\"{}\":", key);
    volume::appendJsonString(json, text);
}

void appendRing(std::string& json, const illustrate::Ring& ring, const illustrate::PlaneAxes& axes) {
    json += '[';
    for (std::size_t n = 0; n <= ring.size(); ++n) {
        if (n != 0) json += ',';
        appendVector(json, axes.worldFromPlane(ring[n % ring.size()]), 6);
    }
    json += ']';
}

void appendPolygons(std::string& json, const illustrate::SectionComponent& component,
                    const illustrate::PlaneAxes& axes) {
    json += "{\"type\":\"MultiPolygon\",\"coordinates\":[";
    for (const illustrate::SectionPolygon& polygon : component.polygons) {
        json += &polygon == &component.polygons.front() ? "[" : ",[";
        appendRing(json, polygon.outer, axes);
        for (const illustrate::Ring& hole : polygon.holes) {
            json += ',';
            appendRing(json, hole, axes);
        }
        json += ']';
    }
    json += "]}";
}

void appendLines(std::string& json, std::uint32_t label, const illustrate::SectionDrawing& drawing) {
    json += "{\"type\":\"MultiLineString\",\"coordinates\":[";
    bool isFirst = true;
    for (const illustrate::SectionLine& line : drawing.lines) {
        if (line.label != label) continue;
        json += isFirst ? "[" : ",[";
        isFirst = false;
        for (std::size_t n = 0; n < line.points.size(); ++n) {
            if (n != 0) json += ',';
            appendVector(json, drawing.axes.worldFromPlane(line.points[n]), 6);
        }
        json += ']';
    }
    json += "]}";
}

// Polygons, lines, or a collection of both.
void appendGeometry(std::string& json, const illustrate::SectionComponent& component,
                    const illustrate::SectionDrawing& drawing) {
    const bool hasLines = component.lineLength > 0;
    if (!hasLines) return appendPolygons(json, component, drawing.axes);
    if (component.polygons.empty()) return appendLines(json, component.label, drawing);
    json += "{\"type\":\"GeometryCollection\",\"geometries\":[";
    appendPolygons(json, component, drawing.axes);
    json += ',';
    appendLines(json, component.label, drawing);
    json += "]}";
}

// What stands beyond the cut: a feature per component and kind of line.
void appendBeyond(std::string& json, const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                  bool isFirst) {
    const std::vector<illustrate::BeyondLine>& lines = drawing.beyond;
    for (std::size_t n = 0; n < lines.size();) {
        const illustrate::BeyondLine first = lines[n];
        const volume::Label& label = volume.labels.labels[first.label];
        json += isFirst ? "\n" : ",\n";
        isFirst = false;
        json += "{\"type\":\"Feature\",\"properties\":{";
        appendMember(json, "id", label.id);
        json += ',';
        appendMember(json, "class", label.className);
        json += ',';
        appendMember(json, "name", label.name);
        json += ',';
        appendMember(json, "beyond", beyondName(first.kind));
        json += "},\"geometry\":{\"type\":\"MultiLineString\",\"coordinates\":[";
        for (std::size_t from = n; n < lines.size() && lines[n].kind == first.kind && lines[n].label == first.label;
             ++n) {
            json += n == from ? "[" : ",[";
            appendVector(json, drawing.axes.worldFromPlane(lines[n].from), 6);
            json += ',';
            appendVector(json, drawing.axes.worldFromPlane(lines[n].to), 6);
            json += ']';
        }
        json += "]}}";
    }
}

// How doors open: a feature per door.
void appendDoors(std::string& json, const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume) {
    for (const illustrate::DoorSwing& door : drawing.doors) {
        const volume::Label& label = volume.labels.labels[door.label];
        json += ",\n{\"type\":\"Feature\",\"properties\":{";
        appendMember(json, "id", label.id);
        json += ',';
        appendMember(json, "class", label.className);
        json += ',';
        appendMember(json, "name", label.name);
        json += ",\"swing\":true},\"geometry\":{\"type\":\"MultiLineString\",\"coordinates\":[";
        std::vector<std::vector<illustrate::PlanePoint>> lines = door.lines;
        for (const illustrate::DoorSwing::Arc& arc : door.arcs) lines.push_back(illustrate::pointsOf(arc));
        for (std::size_t n = 0; n < lines.size(); ++n) {
            json += n == 0 ? "[" : ",[";
            for (std::size_t p = 0; p < lines[n].size(); ++p) {
                if (p > 0) json += ',';
                appendVector(json, drawing.axes.worldFromPlane(lines[n][p]), 6);
            }
            json += ']';
        }
        json += "]}}";
    }
}

}  // namespace

std::string makeGeojson(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume) {
    const illustrate::PlaneAxes& axes = drawing.axes;
    std::string json = "{\"type\":\"FeatureCollection\",\n";
    appendMember(json, "name", planeText(drawing, volume.grid));
    if (const std::uint32_t epsg = epsgCodeOf(volume.crsName); epsg != 0)
        json += fmt::format(",\n\"crs\":{{\"type\":\"name\",\"properties\":{{\"name\":\"urn:ogc:def:crs:EPSG::{}\"}}}}",
                            epsg);
    json += ",\n\"plane\":{\"origin\":";
    appendVector(json, axes.origin, 6);
    for (const auto& [key, axis] : {std::pair("u", axes.u), std::pair("v", axes.v), std::pair("normal", axes.normal)}) {
        json += fmt::format(",\"{}\":", key);
        appendVector(json, axis, 15);
    }
    json += "},\n\"features\":[";
    bool isFirst = true;
    for (const illustrate::SectionComponent& component : drawing.components) {
        const volume::Label& label = volume.labels.labels[component.label];
        json += isFirst ? "\n" : ",\n";
        isFirst = false;
        json += "{\"type\":\"Feature\",";
        appendMember(json, "id", label.id);
        json += ",\"properties\":{";
        appendMember(json, "id", label.id);
        json += ',';
        appendMember(json, "class", label.className);
        json += ',';
        appendMember(json, "name", label.name);
        json +=
            fmt::format(",\"area\":{},\"areaBound\":{},\"exact\":{}}},\"geometry\":", shortNumber(component.area, 6),
                        shortNumber(component.areaBound, 6), component.isExact);
        appendGeometry(json, component, drawing);
        json += '}';
    }
    appendBeyond(json, drawing, volume, isFirst);
    appendDoors(json, drawing, volume);
    return json + "\n]}\n";
}

Result<std::uint64_t> writeGeojson(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                   const std::filesystem::path& path) {
    return writeFileAtomically(path, makeGeojson(drawing, volume));
}

}  // namespace svt::writers

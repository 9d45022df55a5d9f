#include <svt/volume/volume_json.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/field/field_marks.hpp>
#include <svt/writers/geojson_drawing.hpp>

#include <fmt/format.h>

namespace svt::writers {
namespace {

using PlaneLine = std::vector<drawing::PlanePoint>;

std::string jsonMember(std::string_view key, std::string_view text) {
    std::string json = fmt::format("\"{}\":", key);
    volume::appendJsonString(json, text);
    return json;
}

std::string jsonVector(Vec3d v, int decimals) { return "[" + vectorText(v, decimals, ",") + "]"; }

// The texts of all items in brackets.
template <class Items, class TextOf>
std::string jsonList(const Items& items, const TextOf& textOf) {
    std::string json;
    for (const auto& item : items) json += (json.empty() ? "" : ",") + textOf(item);
    return "[" + json + "]";
}

class GeojsonWriter {
public:
    GeojsonWriter(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume, const FieldLook& look)
        : drawing_(drawing), volume_(volume), look_(look) {}

    std::string write() {
        const drawing::PlaneAxes& axes = drawing_.axes;
        json_ = "{\"type\":\"FeatureCollection\",\n" + jsonMember("name", planeText(drawing_, volume_));
        json_ += geoJsonCrs(volume_.crsName) + ",\n\"plane\":{\"origin\":" + jsonVector(axes.origin, 6);
        for (const auto& [key, axis] :
             {std::pair("u", axes.u), std::pair("v", axes.v), std::pair("normal", axes.normal)})
            json_ += fmt::format(",\"{}\":{}", key, jsonVector(axis, 15));
        json_ += "},\n\"features\":[";
        for (const drawing::SectionComponent& component : drawing_.components)
            addFeature(component.label, jsonMember("id", labelOf(component.label).id) + ",",
                       fmt::format("\"area\":{},\"areaBound\":{},\"exact\":{}", shortNumber(component.area, 6),
                                   shortNumber(component.areaBound, 6), component.isExact),
                       geometryOf(component));
        addBeyond();
        // How doors open: a feature per door.
        for (const drawing::DoorSwing& door : drawing_.doors) {
            std::vector<PlaneLine> lines = door.lines;
            for (const drawing::DoorSwing::Arc& arc : door.arcs) lines.push_back(drawing::pointsOf(arc));
            addFeature(door.label, "", "\"swing\":true", multiLine(lines));
        }
        if (look_.isShown()) addField();
        return std::move(json_ += "\n]}\n");
    }

private:
    [[nodiscard]] const volume::Label& labelOf(std::uint32_t label) const { return volume_.labels.labels[label]; }

    void addFeature(std::uint32_t number, std::string_view head, std::string_view properties,
                    std::string_view geometry) {
        const volume::Label& label = labelOf(number);
        json_ +=
            fmt::format("{}{{\"type\":\"Feature\",{}\"properties\":{{{},{},{},{}}},\"geometry\":{}}}",
                        json_.back() == '[' ? "\n" : ",\n", head, jsonMember("id", label.id),
                        jsonMember("class", label.className), jsonMember("name", label.name), properties, geometry);
    }

    [[nodiscard]] std::string lineText(const PlaneLine& points) const {
        return jsonList(points, [&](drawing::PlanePoint p) { return jsonVector(drawing_.axes.worldFromPlane(p), 6); });
    }
    [[nodiscard]] std::string ringText(PlaneLine ring) const {
        ring.push_back(ring.front());
        return lineText(ring);
    }
    [[nodiscard]] std::string multiLine(const std::vector<PlaneLine>& lines) const {
        return "{\"type\":\"MultiLineString\",\"coordinates\":" +
               jsonList(lines, [&](const PlaneLine& line) { return lineText(line); }) + "}";
    }
    [[nodiscard]] std::string multiPolygon(const std::vector<drawing::SectionPolygon>& polygons) const {
        return "{\"type\":\"MultiPolygon\",\"coordinates\":" +
               jsonList(polygons,
                        [&](const drawing::SectionPolygon& polygon) {
                            std::vector<PlaneLine> rings{polygon.outer};
                            rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
                            return jsonList(rings, [&](const PlaneLine& ring) { return ringText(ring); });
                        }) +
               "}";
    }

    // Polygons, lines, or a collection of both.
    [[nodiscard]] std::string geometryOf(const drawing::SectionComponent& component) const {
        if (!(component.lineLength > 0)) return multiPolygon(component.polygons);
        std::vector<PlaneLine> lines;
        for (const drawing::SectionLine& line : drawing_.lines)
            if (line.label == component.label) lines.push_back(line.points);
        if (component.polygons.empty()) return multiLine(lines);
        return "{\"type\":\"GeometryCollection\",\"geometries\":[" + multiPolygon(component.polygons) + "," +
               multiLine(lines) + "]}";
    }

    // Adds lines beyond the cut: one feature per component and kind of line.
    void addBeyond() {
        const std::vector<drawing::BeyondLine>& all = drawing_.beyond;
        for (std::size_t n = 0; n < all.size();) {
            const drawing::BeyondLine first = all[n];
            std::vector<PlaneLine> lines;
            for (; n < all.size() && all[n].kind == first.kind && all[n].label == first.label; ++n)
                lines.push_back({all[n].from, all[n].to});
            addFeature(first.label, "", jsonMember("beyond", beyondName(first.kind)), multiLine(lines));
        }
    }

    void addFieldFeature(std::string_view properties, std::string_view geometry) {
        const drawing::FieldDrawing& field = *look_.field;
        json_ += fmt::format("{}{{\"type\":\"Feature\",\"properties\":{{{},{},\"seconds\":{},{}}},\"geometry\":{}}}",
                             json_.back() == '[' ? "\n" : ",\n", jsonMember("field", field.name),
                             jsonMember("unit", field.unit), shortNumber(field.seconds, 6), properties, geometry);
    }

    // A feature for the places without a value, for each band, for all lines of a value, and for each arrow.
    void addField() {
        const drawing::FieldDrawing& field = *look_.field;
        if (!field.missing.empty()) addFieldFeature("\"missing\":true", multiPolygon(field.missing));
        for (const drawing::FieldBand& band : field.bands)
            addFieldFeature(fmt::format("\"low\":{:.9g},\"high\":{:.9g},{}", band.low, band.high,
                                        jsonMember("fill", bandColor(look_, band))),
                            multiPolygon(band.polygons));
        for (std::size_t n = 0; n < field.isolines.size();) {
            const double value = field.isolines[n].value;
            std::vector<PlaneLine> lines;
            for (; n < field.isolines.size() && field.isolines[n].value == value; ++n)
                lines.push_back(field.isolines[n].points);
            addFieldFeature(fmt::format("\"value\":{:.9g}", value), multiLine(lines));
        }
        for (const drawing::FieldArrow& arrow : field.arrows)
            addFieldFeature(fmt::format("\"arrow\":{:.6g}", arrow.value), multiLine({{arrow.from, arrow.to}}));
    }

    const drawing::SectionDrawing& drawing_;
    const volume::SemanticVolume& volume_;
    const FieldLook& look_;
    std::string json_;
};

}  // namespace

std::string makeGeojson(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                        const FieldLook& look) {
    return GeojsonWriter(drawing, volume, look).write();
}

}  // namespace svt::writers

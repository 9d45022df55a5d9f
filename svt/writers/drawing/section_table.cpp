#include <svt/analyze/extents.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/section_table.hpp>
#include <svt/writers/table.hpp>

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace svt::writers {
namespace {

std::string jsonText(std::string_view text) {
    std::string json;
    volume::appendJsonString(json, text);
    return json;
}

// The cut of a unit, storey or building: the components of its extent that are drawn.
struct CutSpace {
    std::uint32_t label = 0;
    std::size_t components = 0;
    double area = 0;  // m2
};

std::vector<CutSpace> cutSpaces(const drawing::SectionDrawing& drawing, const volume::LabelTable& table) {
    std::vector<const drawing::SectionComponent*> componentOf(table.labels.size(), nullptr);
    for (const drawing::SectionComponent& component : drawing.components) componentOf[component.label] = &component;
    const analyze::Extents extents(table);
    std::vector<CutSpace> spaces;
    for (std::uint32_t l = 0; l < table.labels.size(); ++l) {
        if (!extents.standsForParts(l)) continue;
        CutSpace space{l};
        for (const std::uint32_t part : extents.of(l)) {
            if (componentOf[part] == nullptr) continue;
            ++space.components;
            space.area += componentOf[part]->area;
        }
        if (space.components > 0) spaces.push_back(space);
    }
    return spaces;
}

std::string hatchesJson(const std::vector<drawing::HatchUse>& uses) {
    const auto orNull = [](const std::string& text) { return text.empty() ? std::string("null") : jsonText(text); };
    std::string json;
    const char* separator = "";
    for (const auto& [choice, labels] : uses)
        json += fmt::format(
            "{}\n    {{\"hatch\": {}, \"source\": {}, \"material\": {}, \"word\": {}, \"components\": {}}}",
            std::exchange(separator, ","), jsonText(nameOf(choice.hatch)), jsonText(hatchSourceName(choice.source)),
            orNull(choice.material), orNull(choice.word), labels.size());
    return json;
}

}  // namespace

std::string makeSectionJson(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                            const std::vector<drawing::HatchUse>& hatches) {
    const drawing::PlaneAxes& axes = drawing.axes;
    std::string json = fmt::format(
        "{{\n  \"plane\": {{\"origin\": [{}], \"u\": [{}], \"v\": [{}], \"normal\": [{}], \"edgesInPlane\": {}, "
        "\"shift\": "
        "{}, \"bound\": {}}},\n"
        "  \"components\": [",
        vectorText(axes.origin, 6, ", "), vectorText(axes.u, 15, ", "), vectorText(axes.v, 15, ", "),
        vectorText(axes.normal, 15, ", "), drawing.edgesInPlane, shortNumber(drawing.planeShift, 6),
        shortNumber(drawing.plane.bound, 6));
    for (const drawing::SectionComponent& component : drawing.components) {
        const volume::Label& label = volume.labels.labels[component.label];
        json += fmt::format(
            "{}\n    {{\"id\": {}, \"class\": {}, \"name\": {}, \"polygons\": {}, \"area\": {}, \"areaBound\": {}, "
            "\"exact\": {}, \"lineLength\": {}}}",
            &component == &drawing.components.front() ? "" : ",", jsonText(label.id), jsonText(label.className),
            jsonText(label.name), component.polygons.size(), shortNumber(component.area, 6),
            shortNumber(component.areaBound, 6), component.isExact, shortNumber(component.lineLength, 6));
    }
    json += "\n  ],\n  \"classes\": [";
    for (const drawing::ClassArea& total : drawing.classes)
        json += fmt::format("{}\n    {{\"class\": {}, \"components\": {}, \"area\": {}}}",
                            &total == &drawing.classes.front() ? "" : ",", jsonText(total.className), total.components,
                            shortNumber(total.area, 6));
    json += "\n  ],\n  \"spaces\": [";
    const char* separator = "";
    for (const auto& [number, components, area] : cutSpaces(drawing, volume.labels)) {
        const volume::Label& label = volume.labels.labels[number];
        json += fmt::format("{}\n    {{\"id\": {}, \"class\": {}, \"name\": {}, \"components\": {}, \"area\": {}}}",
                            std::exchange(separator, ","), jsonText(label.id), jsonText(label.className),
                            jsonText(label.name), components, shortNumber(area, 6));
    }
    json += "\n  ]";
    if (!hatches.empty()) json += ",\n  \"hatches\": [" + hatchesJson(hatches) + "\n  ]";
    return json + fmt::format(",\n  \"area\": {}\n}}\n", shortNumber(drawing.area, 6));
}

std::string makeSectionCsv(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume) {
    std::string csv = "kind,id,class,name,polygons,area_m2,area_bound_m2,exact,line_length_m\r\n";
    std::size_t polygons = 0;
    for (const drawing::SectionComponent& component : drawing.components) {
        const volume::Label& label = volume.labels.labels[component.label];
        polygons += component.polygons.size();
        csv += csvLine(Row{"component", label.id, label.className, label.name, component.polygons.size(),
                           shortNumber(component.area, 6), shortNumber(component.areaBound, 6),
                           component.isExact ? "yes" : "no", shortNumber(component.lineLength, 6)});
    }
    for (const drawing::ClassArea& total : drawing.classes)
        csv += csvLine(Row{"class", {}, total.className, {}, {}, shortNumber(total.area, 6), {}, {}, {}});
    for (const auto& [number, components, area] : cutSpaces(drawing, volume.labels)) {
        const volume::Label& label = volume.labels.labels[number];
        csv += csvLine(Row{"space", label.id, label.className, label.name, {}, shortNumber(area, 6), {}, {}, {}});
    }
    return csv + csvLine(Row{"total", {}, {}, {}, polygons, shortNumber(drawing.area, 6), {}, {}, {}});
}

}  // namespace svt::writers

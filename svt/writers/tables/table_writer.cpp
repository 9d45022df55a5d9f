#include <svt/analyze/label_measures.hpp>
#include <svt/writers/tables/csv_text.hpp>
#include <svt/writers/tables/table_writer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <variant>
#include <vector>

namespace svt::writers {
namespace {

/// The attributes of all labels: name to the unit that all have, or none.
std::map<std::string, std::string> attributesOf(const volume::LabelTable& labels) {
    std::map<std::string, std::string> units;
    for (const volume::Label& label : labels.labels)
        for (const Attribute& attribute : label.attributes) {
            const auto [place, isNew] = units.emplace(attribute.name, attribute.unit);
            if (!isNew && place->second != attribute.unit) place->second.clear();
        }
    return units;
}

void appendAttribute(CsvText& csv, const volume::Label& label, const std::string& name) {
    const auto found = std::find_if(label.attributes.begin(), label.attributes.end(),
                                    [&](const Attribute& attribute) { return attribute.name == name; });
    if (found == label.attributes.end()) return csv.nothing();
    if (const auto* text = std::get_if<std::string>(&found->value)) return csv.field(*text);
    if (const auto* truth = std::get_if<bool>(&found->value)) return csv.field(*truth ? "true" : "false");
    if (const auto* integer = std::get_if<std::int64_t>(&found->value)) return csv.number(*integer);
    csv.number(std::get<double>(found->value));
}

void appendLabel(CsvText& csv, const volume::SemanticVolume& volume, std::size_t number,
                 const analyze::LabelMeasure& measure, double cubicMetres) {
    const volume::Label& label = volume.labels.labels[number];
    csv.number(number);
    csv.field(label.id);
    csv.field(label.className);
    csv.field(label.name);
    csv.field(label.parent == volume::kNoLabel ? std::string_view() : volume.labels.labels[label.parent].id);
    csv.number(label.first);
    csv.number(label.count);
    csv.number(label.voxels);
    csv.number(cubicMetres);
    csv.number(measure.area);
    csv.number(measure.outsideArea);
    const Box3d box = analyze::worldBox(measure.box, volume.grid);
    for (const Vec3d corner : {box.min, box.max})
        for (int axis = 0; axis < 3; ++axis) box.isEmpty() ? csv.nothing() : csv.number(corner[axis]);
    const auto byte = [](float c) { return static_cast<int>(std::clamp(c, 0.0f, 1.0f) * 255 + 0.5f); };
    csv.field(fmt::format("#{:02x}{:02x}{:02x}", byte(label.color.x), byte(label.color.y), byte(label.color.z)));
    csv.number(label.opacity);
    csv.field(volume::fillingName(label.filling));
}

}  // namespace

std::string makeObjectTable(const volume::SemanticVolume& volume, int threads) {
    const auto contacts = analyze::findContacts(volume.columns, volume.grid, volume.labels, threads);
    const auto measures = analyze::measureLabels(volume, contacts);
    const auto volumes = analyze::ownVolumes(volume.labels, volume.grid);
    const auto attributes = attributesOf(volume.labels);
    CsvText csv;
    for (const char* key :
         {"label",   "id",   "class", "name", "parent", "first", "count", "voxels", "volume",  "surface",
          "outside", "minX", "minY",  "minZ", "maxX",   "maxY",  "maxZ",  "color",  "opacity", "filling"})
        csv.field(key);
    for (const auto& [name, unit] : attributes)
        csv.field(unit.empty() ? "attribute:" + name : fmt::format("attribute:{} [{}]", name, unit));
    csv.endLine();
    for (std::size_t l = 0; l < volume.labels.labels.size(); ++l) {
        appendLabel(csv, volume, l, measures[l], volumes[l]);
        for (const auto& attribute : attributes) appendAttribute(csv, volume.labels.labels[l], attribute.first);
        csv.endLine();
    }
    return csv.take();
}

std::string makeContactTable(const volume::SemanticVolume& volume, int threads) {
    CsvText csv;
    for (const char* key : {"a", "aClass", "aName", "b", "bClass", "bName", "area", "facesX", "facesY", "facesZ"})
        csv.field(key);
    csv.endLine();
    for (const analyze::Contact& contact : analyze::findContacts(volume.columns, volume.grid, volume.labels, threads)) {
        for (const std::uint32_t number : {contact.a, contact.b}) {
            const bool isBackground = number == volume::kNoLabel;
            const volume::Label none;
            const volume::Label& label = isBackground ? none : volume.labels.labels[number];
            csv.field(label.id);
            csv.field(label.className);
            csv.field(label.name);
        }
        csv.number(contact.area);
        for (const std::uint64_t faces : contact.faces) csv.number(faces);
        csv.endLine();
    }
    return csv.take();
}

}  // namespace svt::writers

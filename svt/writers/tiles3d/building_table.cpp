#include <svt/writers/tiles3d/building_table.hpp>

#include <svt/model/classes.hpp>

#include <string>

namespace svt::writers {

nlohmann::ordered_json buildingTable(const std::vector<BuildingRow>& buildings, bool hasAttributes,
                                     GltfBuffer& buffer) {
    std::vector<std::string> ids, names, classes, attributes;
    std::vector<double> volumes, heights, lowest;
    for (const BuildingRow& building : buildings) {
        const volume::Label& label = building.label;
        ids.push_back(label.id);
        names.push_back(label.name);
        classes.push_back(label.className);
        volumes.push_back(building.volume);
        heights.push_back(building.highest - building.lowest);
        lowest.push_back(building.lowest);
        if (hasAttributes) attributes.push_back(attributesText(label));
    }
    PropertyTable table(buffer, buildings.size());
    table.strings("id", "id in the model, or classes in coarse content", ids);
    table.namesBesideIds(names, ids);
    table.names("class", "", classes);
    table.knownNumbers("volume", "m3", volumes);
    table.numbers("height", "m", heights);
    table.numbers("lowest", "m above datum", lowest);
    if (hasAttributes) table.attributes(attributes);
    return table.extension("building");
}

std::vector<std::uint32_t> buildingOfLabels(const volume::LabelTable& table) {
    const auto& labels = table.labels;
    std::vector<std::uint32_t> buildingOf(labels.size());
    std::vector<char> isInBuilding(labels.size(), 0);
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        const std::uint32_t parent = labels[l].parent;
        const bool hasParent = parent < l;
        const bool isBuilding = model::classRank(labels[l].className) == model::ClassRank::Building;
        isInBuilding[l] = isBuilding || (hasParent && isInBuilding[parent] != 0) ? 1 : 0;
        const bool isOutermost = isBuilding && !(hasParent && isInBuilding[parent] != 0);
        buildingOf[l] = hasParent && !isOutermost ? buildingOf[parent] : l;
    }
    return buildingOf;
}

}  // namespace svt::writers

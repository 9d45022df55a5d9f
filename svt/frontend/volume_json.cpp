#include <svt/frontend/volume_json.hpp>

#include <fmt/format.h>

#include <numeric>
#include <optional>

namespace svt::frontend {

Json toJson(const AttributeValue& value) {
    return std::visit([](const auto& v) { return Json(v); }, value);
}

Json toJson(Vec3d v) { return Json::array({v.x, v.y, v.z}); }
Json toJson(Vec3i v) { return Json::array({v.x, v.y, v.z}); }

Json gridJson(const volume::Grid& grid) {
    return {{"dimension", toJson(grid.dimension())},
            {"spacing", toJson(grid.spacing())},
            {"origin", toJson(grid.origin())},
            {"frame", Json::array({toJson(grid.axes()[0]), toJson(grid.axes()[1]), toJson(grid.axes()[2])})}};
}

Json toJson(const AttributeList& list) {
    if (list.isSingle()) return toJson(list.items.front().attribute->value);
    return Json::parse(toJsonText(list), nullptr, false);
}

Json labelJson(const volume::LabelTable& table, const analyze::FeatureMeasure& measure,
               const analyze::KnownVolume& volume, const volume::Grid& grid) {
    const volume::Label& label = table.labels[measure.label];
    const auto known = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
    Json json{{"id", label.id}, {"class", label.className}, {"name", label.name}};
    json["parent"] = label.parent == volume::kNoLabel ? Json(nullptr) : Json(table.labels[label.parent].id);
    json["first"] = label.first;
    json["count"] = label.count;
    json["ownVoxels"] = measure.own.voxels;
    json["totalVoxels"] = measure.total.voxels;
    json["ownVolume"] = known(measure.own.volume);
    json["totalVolume"] = known(measure.total.volume);
    json["countedVolume"] = measure.total.volume ? Json(measure.total.countedVolume) : Json(nullptr);
    json["solidVolume"] = known(analyze::solidVolumeOf(label));
    json["volume"] = known(volume.volume);
    json["volumeBound"] = volume.volume ? known(volume.bound) : Json(nullptr);
    json["volumeSource"] = volume.volume ? Json(analyze::volumeSourceName(volume.source)) : Json(nullptr);
    // Deprecated names: own voxels and their volume.
    json["voxels"] = label.voxels;
    json["voxelVolume"] = double(label.voxels) * grid.voxelVolume();
    json["closed"] = label.filling == volume::Filling::Solid || label.filling == volume::Filling::TJunctions;
    json["filling"] = volume::fillingName(label.filling);
    if (label.thinVoxels != 0) json["thinVoxels"] = label.thinVoxels;
    if (label.uncertainVoxels != 0) json["uncertainVoxels"] = label.uncertainVoxels;
    if (!label.groups.empty()) {
        Json groups = Json::array();
        for (const std::uint32_t group : label.groups) groups.push_back(table.labels[group].id);
        json["groups"] = std::move(groups);
    }
    if (!label.attributes.empty()) {
        Json attributes = Json::object();
        for (const AttributeList& list : attributeLists(label.attributes))
            attributes[std::string(list.name)] = toJson(list);
        json["attributes"] = std::move(attributes);
    }
    return json;
}

Json overlapsJson(const volume::LabelTable& table) {
    Json list = Json::array();
    for (const volume::Overlap& overlap : table.overlaps)
        list.push_back({{"a", table.labels[overlap.a].id},
                        {"b", table.labels[overlap.b].id},
                        {"voxels", overlap.voxels},
                        {"nested", overlap.isNested}});
    return list;
}

Json infoJson(const volume::SemanticVolume& volume) {
    Json json;
    json["grid"] = gridJson(volume.grid);
    json["scalarType"] = fmt::format("uint{}", volume.labels.scalarBits());
    json["crs"] = volume.crsName;
    json["name"] = volume.modelName;
    json["source"] = volume.source;
    json["objects"] = Json::array();
    json["features"] = Json::array();
    std::vector<std::uint32_t> all(volume.labels.labels.size());
    std::iota(all.begin(), all.end(), 0U);
    const auto own = analyze::ownMeasures(volume.labels, volume.grid);
    const analyze::Extents extents(volume.labels);
    const analyze::KnownVolumes volumes(volume.labels, volume.grid, extents);
    for (const auto& measure : analyze::measureFeatures(extents, all, own))
        json[volume.labels.labels[measure.label].count != 0 ? "objects" : "features"].push_back(
            labelJson(volume.labels, measure, volumes.of(measure.label), volume.grid));
    json["overlaps"] = overlapsJson(volume.labels);
    return json;
}

}  // namespace svt::frontend

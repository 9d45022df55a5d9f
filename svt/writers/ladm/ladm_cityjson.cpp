// CityJSON 2.0 with the extension LADM: attributes of units that begin with "+LA_", and the root property "+LADM" with
// parties, sources, boundary faces and relations.
#include <svt/core/text.hpp>
#include <svt/crs/crs_name.hpp>
#include <svt/writers/ladm/ladm_owner.hpp>
#include <svt/writers/ladm_writer.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace svt::writers {
namespace {

using analyze::LandAdministration;
using analyze::LegalSpace;
using volume::kNoLabel;
using OrderedJson = nlohmann::ordered_json;

constexpr double kCityJsonUnit = 1e-6;  // metres of a whole number

OrderedJson optionalNumber(const std::optional<double>& value) {
    return value ? OrderedJson(*value) : OrderedJson(nullptr);
}

OrderedJson jsonOf(const AttributeValue& value) {
    return std::visit([](const auto& known) { return OrderedJson(known); }, value);
}

class LadmCityJson {
public:
    LadmCityJson(const LandAdministration& administration, const volume::SemanticVolume& volume)
        : all_(administration), volume_(volume) {
        for (const LegalSpace& space : all_.spaces.spaces) box_.add(space.box);
        if (!box_.isEmpty()) origin_ = {std::floor(box_.min.x), std::floor(box_.min.y), std::floor(box_.min.z)};
    }

    std::string make() {
        OrderedJson objects = OrderedJson::object();
        for (std::uint32_t s = 0; s < all_.spaces.spaces.size(); ++s) addSpace(s, objects);
        OrderedJson document{{"type", "CityJSON"},
                             {"version", "2.0"},
                             {"extensions", {{"LADM", {{"url", kLadmExtensionUrl}, {"version", "1.0"}}}}},
                             {"transform",
                              {{"scale", {kCityJsonUnit, kCityJsonUnit, kCityJsonUnit}},
                               {"translate", {origin_.x, origin_.y, origin_.z}}}}};
        OrderedJson metadata = OrderedJson::object();
        if (!volume_.modelName.empty()) metadata["title"] = volume_.modelName;
        if (const auto code = static_cast<int>(crs::epsgCodeOf(volume_.crsName)); code != 0)
            metadata["referenceSystem"] = fmt::format("https://www.opengis.net/def/crs/EPSG/0/{}", code);
        if (!box_.isEmpty())
            metadata["geographicalExtent"] = {box_.min.x, box_.min.y, box_.min.z, box_.max.x, box_.max.y, box_.max.z};
        if (!metadata.empty()) document["metadata"] = std::move(metadata);
        document["CityObjects"] = std::move(objects);
        document["vertices"] = std::move(vertices_);
        document["+LADM"] = registered();
        return document.dump(-1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
    }

private:
    [[nodiscard]] const volume::Label& labelOf(std::uint32_t label) const { return volume_.labels.labels[label]; }
    [[nodiscard]] const std::string& idOf(std::uint32_t space) const {
        return labelOf(all_.spaces.spaces[space].label).id;
    }

    // The building that contains a label, or is it.
    [[nodiscard]] std::uint32_t buildingOf(std::uint32_t label) const {
        while (label != kNoLabel && labelOf(label).className != "Building") label = labelOf(label).parent;
        return label;
    }

    static OrderedJson& objectOf(const std::string& id, const char* type, OrderedJson& objects) {
        if (!objects.contains(id)) objects[id] = {{"type", type}};
        return objects[id];
    }

    void addSpace(std::uint32_t index, OrderedJson& objects) {
        const LegalSpace& space = all_.spaces.spaces[index];
        const volume::Label& label = labelOf(space.label);
        const std::uint32_t building = buildingOf(space.label);
        const std::string buildingId = building == kNoLabel ? "legal_spaces" : labelOf(building).id;
        OrderedJson& parent = objectOf(buildingId, "Building", objects);
        if (building != kNoLabel && !labelOf(building).name.empty())
            parent["attributes"]["name"] = labelOf(building).name;
        if (space.label == building) {
            addAttributes(index, parent);
            if (OrderedJson geometry = bodyOf(index); !geometry.is_null())
                parent["geometry"] = OrderedJson::array({std::move(geometry)});
            return;
        }
        parent["children"].push_back(label.id);  // the last use of `parent`: a new object moves the others
        OrderedJson& unit = objectOf(label.id, "BuildingUnit", objects);
        if (!label.name.empty()) unit["attributes"]["name"] = label.name;
        addAttributes(index, unit);
        unit["parents"] = OrderedJson::array({buildingId});
        if (OrderedJson geometry = bodyOf(index); !geometry.is_null())
            unit["geometry"] = OrderedJson::array({std::move(geometry)});
    }

    void addAttributes(std::uint32_t index, OrderedJson& object) const {
        const LegalSpace& space = all_.spaces.spaces[index];
        const volume::Label& label = labelOf(space.label);
        OrderedJson& attributes = object["attributes"];
        for (const AttributeList& list : attributeLists(label.attributes)) {
            const std::string name(list.name);
            if (name.starts_with('+') || attributes.contains(name) || isReplacedOwner(all_, name)) continue;
            attributes[name] =
                list.isSingle() ? jsonOf(list.items.front().attribute->value) : OrderedJson::parse(toJsonText(list));
        }
        if (const std::string owner = soleOwner(all_, index); !owner.empty()) attributes["owner"] = owner;
        attributes["+LA_LegalSpaceBuildingUnit"] = {{"suID", label.id},
                                                    {"class", label.className},
                                                    {"body", analyze::spaceBodyName(space.body)},
                                                    {"common", space.isCommon},
                                                    {"volume", optionalNumber(space.totalVolume)},
                                                    {"bodyVolume", optionalNumber(space.bodyVolume)},
                                                    {"spatialSource", all_.spatialFile}};
        std::map<std::string, OrderedJson> byClass;
        for (const analyze::PartyRight& right : all_.rights) {
            if (all_.units[right.unit].space != index) continue;
            const std::string share = analyze::shareText(right);
            byClass["+" + std::string(analyze::ladmClassName(right.rightType().of))].push_back(
                {{"type", right.rightType().name},
                 {"party", all_.parties[right.party]},
                 {"share", share.empty() ? OrderedJson(nullptr) : OrderedJson(share)},
                 {"administrativeSource", all_.sources[right.source]}});
        }
        for (auto& [name, rights] : byClass) attributes[name] = std::move(rights);
    }

    // The geometry of a unit; null without a body.
    OrderedJson bodyOf(std::uint32_t index) {
        const LegalSpace& space = all_.spaces.spaces[index];
        OrderedJson solids = OrderedJson::array();
        if (space.body == analyze::SpaceBody::Voxels) {
            if (OrderedJson shell = shellOfFaces(index); !shell.empty())
                solids.push_back(OrderedJson::array({std::move(shell)}));
        } else {
            for (const auto& solid : space.solids) {
                OrderedJson shell = OrderedJson::array();
                for (const analyze::SpaceTriangle& triangle : solid)
                    addPolygon({{triangle.begin(), triangle.end()}}, shell);
                if (!shell.empty()) solids.push_back(OrderedJson::array({std::move(shell)}));
            }
        }
        if (solids.empty()) return nullptr;
        if (solids.size() == 1) return {{"type", "Solid"}, {"lod", "3"}, {"boundaries", solids[0]}};
        return {{"type", "CompositeSolid"}, {"lod", "3"}, {"boundaries", std::move(solids)}};
    }

    // The faces of a space, counter-clockwise from outside.
    OrderedJson shellOfFaces(std::uint32_t space) {
        OrderedJson shell = OrderedJson::array();
        for (const analyze::BoundaryFace& face : all_.spaces.faces) {
            if (face.minus != space && face.plus != space) continue;
            auto rings = face.rings;
            if (face.plus == space)
                for (auto& ring : rings) std::reverse(ring.begin(), ring.end());
            addPolygon(rings, shell);
        }
        return shell;
    }

    // Polygons whose corners become one by rounding are left out.
    void addPolygon(const std::vector<std::vector<Vec3d>>& rings, OrderedJson& shell) {
        OrderedJson polygon = OrderedJson::array();
        for (const auto& ring : rings) {
            std::vector<std::size_t> corners;
            for (const Vec3d& p : ring)
                if (const std::size_t at = vertex(p); corners.empty() || corners.back() != at) corners.push_back(at);
            while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
            if (corners.size() >= 3)
                polygon.push_back(corners);
            else if (polygon.empty())
                return;
        }
        shell.push_back(std::move(polygon));
    }

    std::size_t vertex(Vec3d p) {
        std::array<std::int64_t, 3> whole{};
        for (int axis = 0; axis < 3; ++axis)
            whole[std::size_t(axis)] = std::llround((p[axis] - origin_[axis]) / kCityJsonUnit);
        const auto [at, isNew] = numberOf_.try_emplace(whole, numberOf_.size());
        if (isNew) vertices_.push_back(whole);
        return at->second;
    }

    [[nodiscard]] OrderedJson registered() const {
        OrderedJson parties = OrderedJson::array(), sources = OrderedJson::array(), faces = OrderedJson::array(),
                    relations = OrderedJson::array();
        for (const std::string& party : all_.parties) parties.push_back(party);
        for (const std::string& source : all_.sources)
            sources.push_back({{"type", "administrative source"}, {"name", source}});
        sources.push_back({{"type", "spatial source"}, {"name", all_.spatialFile}});
        for (std::size_t f = 0; f < all_.spaces.faces.size(); ++f) {
            const analyze::BoundaryFace& face = all_.spaces.faces[f];
            OrderedJson rings = OrderedJson::array();
            for (const auto& ring : face.rings) {
                OrderedJson points = OrderedJson::array();
                for (const Vec3d& p : ring) points.push_back({p.x, p.y, p.z});
                rings.push_back(std::move(points));
            }
            faces.push_back(
                {{"bfID", fmt::format("face-{}", f + 1)},
                 {"minus", idOf(face.minus)},
                 {"plus", face.plus == analyze::kNoSpace ? OrderedJson(nullptr) : OrderedJson(idOf(face.plus))},
                 {"direction", analyze::faceDirectionName(face.direction)},
                 {"area", face.area},
                 {"rings", std::move(rings)}});
        }
        for (const analyze::SpaceRelation& relation : all_.spaces.relations) {
            OrderedJson shared = OrderedJson::array();
            for (const std::uint32_t face : relation.faces) shared.push_back(fmt::format("face-{}", face + 1));
            relations.push_back({{"kind", analyze::relationName(relation.kind)},
                                 {"a", idOf(relation.a)},
                                 {"b", idOf(relation.b)},
                                 {"volume", optionalNumber(relation.volume)},
                                 {"area", optionalNumber(relation.area)},
                                 {"faces", std::move(shared)},
                                 {"exact", relation.isExact}});
        }
        return {{"LA_Party", std::move(parties)},
                {"LA_Source", std::move(sources)},
                {"LA_BoundaryFace", std::move(faces)},
                {"relations", std::move(relations)}};
    }

    const LandAdministration& all_;
    const volume::SemanticVolume& volume_;
    Box3d box_;
    Vec3d origin_;
    std::map<std::array<std::int64_t, 3>, std::size_t> numberOf_;
    OrderedJson vertices_ = OrderedJson::array();
};

}  // namespace

std::string makeLadmCityJson(const LandAdministration& administration, const volume::SemanticVolume& volume) {
    return LadmCityJson(administration, volume).make();
}

}  // namespace svt::writers

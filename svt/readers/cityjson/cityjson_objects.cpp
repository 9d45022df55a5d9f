#include <svt/readers/cityjson/cityjson_objects.hpp>

#include <svt/model/classes.hpp>
#include <svt/readers/cityjson/cityjson_geometry.hpp>
#include <svt/readers/gml/missing_values.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace svt::readers::cityjson {
namespace {

// Nested members repeat the path of their ancestors, so path and depth are limited: otherwise text could grow with
// both.
constexpr std::size_t kMaxPathBytes = 256;
constexpr int kMaxPathParts = 16;
constexpr std::size_t kMaxListItems = 1024;  // longer arrays are data, and stay text

constexpr std::array<std::string_view, 48> kObjectTypes{"Bridge",
                                                        "BridgePart",
                                                        "BridgeConstructionElement",
                                                        "BridgeConstructiveElement",
                                                        "BridgeFurniture",
                                                        "BridgeInstallation",
                                                        "BridgeRoom",
                                                        "Building",
                                                        "BuildingPart",
                                                        "BuildingFurniture",
                                                        "BuildingInstallation",
                                                        "BuildingConstructiveElement",
                                                        "BuildingRoom",
                                                        "BuildingStorey",
                                                        "BuildingUnit",
                                                        "CityFurniture",
                                                        "CityObjectGroup",
                                                        "GenericCityObject",
                                                        "LandUse",
                                                        "OtherConstruction",
                                                        "PlantCover",
                                                        "Railway",
                                                        "Road",
                                                        "SolitaryVegetationObject",
                                                        "TINRelief",
                                                        "TransportSquare",
                                                        "TransportationComplex",
                                                        "Track",
                                                        "Square",
                                                        "Tunnel",
                                                        "TunnelPart",
                                                        "TunnelConstructiveElement",
                                                        "TunnelFurniture",
                                                        "TunnelHollowSpace",
                                                        "TunnelInstallation",
                                                        "WaterBody",
                                                        "Waterway",
                                                        "GenericOccupiedSpace",
                                                        "Storey",
                                                        "Room",
                                                        "HollowSpace",
                                                        "ReliefFeature",
                                                        "IntBuildingInstallation",
                                                        "Door",
                                                        "Window",
                                                        "Section",
                                                        "Intersection",
                                                        "AuxiliaryTrafficSpace"};

std::optional<AttributeValue> scalarOf(json::element value) {
    switch (value.type()) {
        case json::element_type::STRING: return AttributeValue(std::string(*asString(value)));
        case json::element_type::INT64: return AttributeValue(*asInteger(value));
        case json::element_type::UINT64:
        case json::element_type::DOUBLE: return AttributeValue(*asNumber(value));
        case json::element_type::BOOL: {
            bool isTrue = false;
            if (value.get_bool().get(isTrue) != simdjson::SUCCESS) return std::nullopt;
            return AttributeValue(isTrue);
        }
        default: return std::nullopt;
    }
}

/// {"value": 22.3, "uom": "m"} is one measure, not two attributes.
bool appendMeasure(const std::string& name, json::object object, std::vector<Attribute>& attributes) {
    const auto value = findMember(object, "value");
    const auto unit = findMember(object, "uom");
    if (!value || !unit || !value->is_number() || !unit->is_string() || object.size() != 2) return false;
    if (!gml::isMissingValue(name, asNumber(*value).value_or(0)))
        attributes.push_back({name, *scalarOf(*value), std::string(*asString(*unit))});
    return true;
}

void appendValue(std::string name, json::element value, int parts, std::vector<Attribute>& attributes);

bool isMeasure(json::element value) {
    const auto object = asObject(value);
    std::vector<Attribute> unused;
    return object && appendMeasure({}, *object, unused);
}

/// An array as values with equal names, or as records if it holds objects. False for other arrays, such as nested ones.
bool appendArray(const std::string& name, json::array array, int parts, std::vector<Attribute>& attributes) {
    if (array.size() == 0 || array.size() > kMaxListItems) return false;
    bool areValues = true, areObjects = true;
    for (const json::element item : array) {
        areValues = areValues && (item.is_null() || scalarOf(item) || isMeasure(item));
        areObjects = areObjects && item.is_object();
    }
    if (!areValues && !areObjects) return false;
    std::uint32_t record = 0;
    for (const json::element item : array) {
        const std::size_t first = attributes.size();
        appendValue(name, item, parts, attributes);
        if (areValues) continue;
        // A record within a record has no number of its own.
        for (std::size_t n = first; n < attributes.size(); ++n)
            if (attributes[n].record != 0) return false;
        for (std::size_t n = first; n < attributes.size(); ++n) attributes[n].record = record;
        ++record;
    }
    return true;
}

void appendValue(std::string name, json::element value, int parts, std::vector<Attribute>& attributes) {
    if (value.is_null()) return;
    if (value.is_number() && gml::isMissingValue(name, asNumber(value).value_or(0))) return;
    if (auto scalar = scalarOf(value)) {
        attributes.push_back({std::move(name), std::move(*scalar), {}});
        return;
    }
    const auto object = asObject(value);
    if (object && appendMeasure(name, *object, attributes)) return;
    if (const auto array = asArray(value); array && parts < kMaxPathParts) {
        const std::size_t first = attributes.size();
        if (appendArray(name, *array, parts + 1, attributes)) return;
        attributes.resize(first);
    }
    if (!object || name.size() > kMaxPathBytes || parts >= kMaxPathParts) {
        attributes.push_back({std::move(name), simdjson::minify(value), {}});
        return;
    }
    for (const auto [key, member] : *object)
        appendValue(fmt::format("{}/{}", name, key), member, parts + 1, attributes);
}

std::vector<std::string> readIds(json::object object, std::string_view key, ParsedObject& parsed, const Place& place) {
    std::vector<std::string> ids;
    const auto value = findMember(object, key);
    if (!value || value->is_null()) return ids;
    const auto array = asArray(*value);
    if (!array) {
        parsed.diagnostics.add(Severity::Warning, Code::BadValue,
                               fmt::format("'{}' is not an array of ids; left out", key), place);
        return ids;
    }
    for (const json::element item : *array) {
        if (const auto id = asString(item))
            ids.emplace_back(*id);
        else
            parsed.diagnostics.add(Severity::Warning, Code::BadValue,
                                   fmt::format("an entry of '{}' is not a text; left out", key), place);
    }
    return ids;
}

/// `children_roles` is parallel to `children`, so an entry that is not text is kept as an empty role.
std::vector<std::string> readRoles(json::object object) {
    std::vector<std::string> roles;
    const auto array = asArray(findMember(object, "children_roles"));
    if (!array) return roles;
    for (const json::element item : *array) roles.emplace_back(asString(item).value_or(std::string_view()));
    return roles;
}

void readAddresses(json::element value, std::vector<Attribute>& attributes) {
    const auto addresses = asArray(value);
    if (!addresses) return;
    std::uint32_t record = 0;
    for (const json::element item : *addresses) {
        const auto address = asObject(item);
        if (!address) continue;
        for (const auto [key, member] : *address)
            if (auto scalar = scalarOf(member))
                attributes.push_back({fmt::format("address/{}", key), std::move(*scalar), {}, record});
        ++record;
    }
}

void readType(json::object object, ParsedObject& parsed, const Place& place) {
    const auto type = asString(findMember(object, "type"));
    if (!type || type->empty()) {
        parsed.diagnostics.add(Severity::Warning, Code::BadValue,
                               "a city object without type; read as GenericOccupiedSpace", place);
        parsed.feature.className = "GenericOccupiedSpace";
        return;
    }
    parsed.isGroup = *type == "CityObjectGroup";
    parsed.feature.className = model::canonicalClassName(*type);
    const bool isExtension = type->front() == '+';
    if (!isExtension && std::find(kObjectTypes.begin(), kObjectTypes.end(), *type) == kObjectTypes.end())
        parsed.diagnostics.add(Severity::Note, Code::UnknownElement,
                               fmt::format("'{}' is not a type of CityJSON; kept under this name", shortened(*type)),
                               place);
}

}  // namespace

void appendAttribute(std::string_view name, json::element value, std::vector<Attribute>& attributes) {
    appendValue(std::string(name), value, 1, attributes);
}

void appendAttributes(json::object object, std::string_view prefix, std::vector<Attribute>& attributes) {
    for (const auto [key, value] : object) appendAttribute(fmt::format("{}{}", prefix, key), value, attributes);
}

std::string nameOf(std::span<const Attribute> attributes) {
    for (const std::string_view key : {"name", "gml:name"})
        for (const Attribute& attribute : attributes)
            if (attribute.name == key)
                if (const auto* text = std::get_if<std::string>(&attribute.value)) return *text;
    return {};
}

ParsedObject readCityObject(std::string_view id, json::element value, const TextContext& context) {
    ParsedObject parsed;
    parsed.id = id;
    parsed.feature.id = id;
    // Only a sequence gives a line per object; a parsed document has no line information.
    const bool hasLine = context.origin.firstLine > 1;
    parsed.feature.line = hasLine ? context.origin.firstLine : 0;
    const Place place{std::string(context.origin.file), parsed.feature.line, 0, shortened(id)};
    const auto object = asObject(value);
    if (!object) {
        parsed.diagnostics.add(Severity::Warning, Code::BadJson, "a city object that is not a JSON object; kept empty",
                               place);
        parsed.feature.className = "GenericOccupiedSpace";
        return parsed;
    }
    readType(*object, parsed, place);
    parsed.parents = readIds(*object, "parents", parsed, place);
    // CityJSON 1.0 names the children of a group "members".
    parsed.children = readIds(*object, "children", parsed, place);
    if (parsed.isGroup && parsed.children.empty()) parsed.children = readIds(*object, "members", parsed, place);
    if (parsed.isGroup) parsed.childrenRoles = readRoles(*object);
    for (const auto [key, member] : *object) {
        if (key == "attributes") {
            if (const auto attributes = asObject(member))
                appendAttributes(*attributes, {}, parsed.feature.attributes);
            else if (!member.is_null())
                parsed.diagnostics.add(Severity::Warning, Code::BadValue, "'attributes' is not an object; left out",
                                       place);
        } else if (key == "address") {
            readAddresses(member, parsed.feature.attributes);
        } else if (!key.empty() && key.front() == '+') {
            appendAttribute(key, member, parsed.feature.attributes);
        } else if (key == "geometry" && !member.is_null()) {
            if (const auto geometries = asArray(member))
                readGeometries(*geometries, context, parsed);
            else
                parsed.diagnostics.add(Severity::Warning, Code::BadValue, "'geometry' is not an array; left out",
                                       place);
        }
    }
    parsed.feature.name = nameOf(parsed.feature.attributes);
    return parsed;
}

std::vector<std::int32_t> breakCycles(std::span<std::int32_t> parents) {
    std::vector<std::int32_t> broken;
    std::vector<std::int32_t> walkOf(parents.size(), -1);  // the first traversal that reached the node
    for (std::int32_t walk = 0; walk < static_cast<std::int32_t>(parents.size()); ++walk) {
        std::int32_t node = walk;
        while (node >= 0 && walkOf[node] < 0) {
            walkOf[node] = walk;
            node = parents[node];
        }
        if (node < 0 || walkOf[node] != walk) continue;
        std::int32_t lowest = node;
        for (std::int32_t next = parents[node]; next != node; next = parents[next]) lowest = std::min(lowest, next);
        parents[lowest] = -1;
        broken.push_back(lowest);
    }
    std::sort(broken.begin(), broken.end());
    return broken;
}

}  // namespace svt::readers::cityjson

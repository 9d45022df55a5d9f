#include <svt/readers/citygml/citygml_attributes.hpp>

#include <svt/core/text.hpp>
#include <svt/readers/citygml/gml_geometry.hpp>
#include <svt/readers/gml/gml_numbers.hpp>
#include <svt/readers/gml/missing_values.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace svt::readers::citygml {
namespace {

using std::string_view;

enum class ValueKind { Text, Integer, Real, Truth };

// Properties of the CityGML modules that are not text. Codes (class, function, roofType) stay text, even if numeric.
constexpr std::pair<string_view, ValueKind> kKinds[] = {
    {"yearOfConstruction", ValueKind::Integer},
    {"yearOfDemolition", ValueKind::Integer},
    {"storeysAboveGround", ValueKind::Integer},
    {"storeysBelowGround", ValueKind::Integer},
    {"lod", ValueKind::Integer},
    {"numberOfOccupants", ValueKind::Integer},
    {"measuredHeight", ValueKind::Real},
    {"sortKey", ValueKind::Real},
    {"averageHeight", ValueKind::Real},
    {"trunkDiameter", ValueKind::Real},
    {"crownDiameter", ValueKind::Real},
    {"isMovable", ValueKind::Truth},
    {"isStructuralElement", ValueKind::Truth},
};

ValueKind kindOf(string_view name) noexcept {
    for (const auto& [known, kind] : kKinds)
        if (known == name) return kind;
    return ValueKind::Text;
}

std::optional<std::int64_t> parseInteger(string_view text) noexcept {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<double> parseFinite(string_view text) noexcept {
    const std::optional<double> value = gml::parseNumber(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<AttributeValue> parseValue(string_view text, ValueKind kind) {
    if (kind == ValueKind::Integer) {
        if (const auto value = parseInteger(text)) return *value;
    } else if (kind == ValueKind::Real) {
        if (const auto value = parseFinite(text)) return *value;
    } else if (kind == ValueKind::Truth) {
        if (text == "true" || text == "1") return true;
        if (text == "false" || text == "0") return false;
    } else {
        return std::string(text);
    }
    return std::nullopt;
}

bool addValue(std::vector<Attribute>& attributes, std::string name, string_view text, string_view uom, ValueKind kind) {
    const std::optional<AttributeValue> value = parseValue(text, kind);
    if (const auto number = parseFinite(text); number && gml::isMissingValue(name, *number)) return true;
    attributes.push_back({std::move(name), value.value_or(std::string(text)), std::string(unitName(uom))});
    return value.has_value();
}

bool endsWithAny(string_view name) noexcept {
    return name.ends_with("Attribute") || name.ends_with("AttributeSet") || name.ends_with("attribute");
}

// Matches "IntAttribute" and "intAttribute".
ValueKind genericKind(string_view element) noexcept {
    const string_view tail = element.substr(std::min<std::size_t>(1, element.size()));
    if (tail.starts_with("nt")) return ValueKind::Integer;
    if (tail.starts_with("ouble") || tail.starts_with("easure")) return ValueKind::Real;
    return ValueKind::Text;
}

}  // namespace

string_view unitName(string_view uom) noexcept {
    const std::size_t at = uom.find_last_of("#:/");
    // "m/s" is a unit; "urn:...:m" and "http://.../m" are names of a unit.
    if (at == string_view::npos || (uom[at] == '/' && uom.find(':') == string_view::npos)) return uom;
    return uom.substr(at + 1);
}

bool addTextAttribute(std::vector<Attribute>& attributes, string_view name, string_view text, string_view uom) {
    ValueKind kind = kindOf(name);
    // Lists of measures (storeyHeightsAboveGround) have a unit but are not a single number.
    const bool isMeasure = kind == ValueKind::Text && !uom.empty() && parseFinite(text);
    if (isMeasure) kind = ValueKind::Real;
    return addValue(attributes, std::string(name), text, uom, kind);
}

std::string genericName(xml::NameScope& scope, const xml::Element& element) {
    std::string name(withoutBlanks(element.node.attribute("name").value()));
    if (!name.empty()) return name;
    std::string scratch;
    scope.forEachChild(element.node, [&](const xml::Element& child) {
        if (child.localName == "name") name = xml::textOf(child.node, scratch);
    });
    return name;
}

bool addGenericAttribute(std::vector<Attribute>& attributes, xml::NameScope& scope, const xml::Element& element,
                         string_view set) {
    std::string scratch;
    const std::string name = genericName(scope, element);
    std::string path = set.empty() ? name : fmt::format("{}/{}", set, name);

    bool isGood = true;
    if (element.localName.ends_with("Set")) {
        scope.forEachChild(element.node, [&](const xml::Element& member) {
            if (member.localName == "genericAttribute")
                scope.forEachChild(member.node, [&](const xml::Element& attribute) {
                    isGood = addGenericAttribute(attributes, scope, attribute, path) && isGood;
                });
            else if (endsWithAny(member.localName))
                isGood = addGenericAttribute(attributes, scope, member, path) && isGood;
        });
        return isGood;
    }
    scope.forEachChild(element.node, [&](const xml::Element& child) {
        if (child.localName != "value") return;
        isGood = addValue(attributes, path, xml::textOf(child.node, scratch), child.node.attribute("uom").value(),
                          genericKind(element.localName)) &&
                 isGood;
    });
    return isGood;
}

void addStructuredAttributes(std::vector<Attribute>& attributes, xml::NameScope& scope, const xml::Element& element,
                             string_view property) {
    if (xml::firstChildElement(element.node)) {
        scope.forEachChild(element.node, [&](const xml::Element& child) {
            addStructuredAttributes(attributes, scope, child, property);
        });
        return;
    }
    std::string scratch;
    string_view text = xml::textOf(element.node, scratch);
    if (text.empty()) text = gml::attributesOf(scope, element.node).href;
    if (text.empty()) return;
    const string_view part = element.localName;
    const bool isValue = part == "value" || part == property;
    const std::string name = isValue ? std::string(property) : fmt::format("{}/{}", property, part);
    addTextAttribute(attributes, name, text, element.node.attribute("uom").value());
}

}  // namespace svt::readers::citygml

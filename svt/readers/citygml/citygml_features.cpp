#include <svt/readers/citygml/citygml_features.hpp>

#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>
#include <svt/readers/citygml/citygml_attributes.hpp>
#include <svt/readers/citygml/citygml_materials.hpp>
#include <svt/readers/gml/gml_numbers.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::readers::citygml {
namespace {

using gml::ElementAttributes;
using gml::Shape;
using model::Feature;
using model::FeatureIndex;
using std::string_view;
using xml::Element;
using xml::Vocabulary;

template <std::size_t N>
bool isIn(const string_view (&names)[N], string_view name) noexcept {
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

// Types of the CityGML modules that are values of a feature, not features.
constexpr string_view kDataTypes[] = {"Address",          "ExternalReference", "ExternalObject",  "CityObjectRelation",
                                      "Occupancy",        "QualifiedArea",     "QualifiedVolume", "Elevation",
                                      "Height",           "ConstructionEvent", "RoomHeight",      "Role",
                                      "CodeListMetaData", "SensorConnection",  "ImplicitGeometry"};

// Features without geometry that do not describe the building itself.
constexpr string_view kSkippedObjects[] = {"Dynamizer",
                                           "PointCloud",
                                           "Version",
                                           "VersionTransition",
                                           "Transaction",
                                           "CompositeTimeseries",
                                           "GenericTimeseries",
                                           "StandardFileTimeseries",
                                           "TabulatedFileTimeseries"};

// References between features that are not aggregations; kept as attributes.
constexpr string_view kRelations[] = {"parent", "groupParent", "generalizesTo", "relatedTo", "representedFeature"};

// Children of the root and of features that are defined by GML and irrelevant for a volume.
constexpr string_view kSkippedGml[] = {"metaDataProperty", "location", "identifier", "descriptionReference"};

constexpr string_view kNoVolume[] = {"extent",       "pointCloud",         "dynamizer", "multiPoint",
                                     "reliefPoints", "ridgeOrValleyLines", "breaklines"};

bool isUpperCase(string_view name) noexcept { return !name.empty() && name[0] >= 'A' && name[0] <= 'Z'; }

bool isCityGml(Vocabulary vocabulary) noexcept {
    return vocabulary == Vocabulary::Core || vocabulary == Vocabulary::Module || vocabulary == Vocabulary::Generics ||
           vocabulary == Vocabulary::Group;
}

bool isForeign(Vocabulary vocabulary) noexcept {
    return vocabulary == Vocabulary::Other || vocabulary == Vocabulary::None;
}

// Properties whose content bounds no volume: curves, points, extents.
bool hasNoVolume(const Element& property) noexcept {
    const string_view name = property.localName;
    if (name.starts_with("lod"))
        return name.ends_with("Curve") || name.ends_with("TerrainIntersection") || name.ends_with("Point") ||
               name.ends_with("Network");
    return isCityGml(property.vocabulary) && isIn(kNoVolume, name);
}

bool isGenericAttribute(const Element& element) noexcept {
    return element.vocabulary == Vocabulary::Generics &&
           (element.localName.ends_with("Attribute") || element.localName.ends_with("AttributeSet"));
}

// Not recursive: element > property > geometry, as in features.
bool hasGeometry(xml::NameScope& scope, const Element& element) {
    bool found = false;
    scope.forEachChild(element.node, [&](const Element& property) {
        if (found) return;
        scope.forEachChild(property.node, [&](const Element& object) {
            found = found || gml::shapeOf(object) != Shape::None || object.localName == "ImplicitGeometry";
        });
    });
    return found;
}

string_view roleAttribute(pugi::xml_node property) noexcept {
    for (pugi::xml_attribute attribute : property.attributes()) {
        const xml::QualifiedName name = xml::splitName(attribute.name());
        if (name.localName == "role" && name.prefix != "xlink") return withoutBlanks(attribute.value());
    }
    return {};
}

}  // namespace

double lodOfProperty(string_view name) noexcept {
    if (name.size() < 4 || !name.starts_with("lod") || name[3] < '0' || name[3] > '9') return -1;
    return name[3] - '0';
}

FeatureReader::FeatureReader(xml::NameScope& scope, Part& part, std::function<std::uint64_t(pugi::xml_node)> offsetOf)
    : scope_(scope), part_(part), offsetOf_(std::move(offsetOf)), geometryReader_(scope, part, offsetOf_) {}

void FeatureReader::readMember(const Element& member, bool continues) {
    if (member.vocabulary == Vocabulary::Gml) {
        if (member.localName == "name") {
            if (part_.modelName.empty()) part_.modelName = xml::textOf(member.node, scratch_);
            return;
        }
        if (member.localName == "boundedBy") return readEnvelope(member);
        if (isIn(kSkippedGml, member.localName) || member.localName == "description") return;
    }
    if (!xml::firstChildElement(member.node)) {
        const ElementAttributes attributes = gml::attributesOf(scope_, member.node);
        if (attributes.hasHref && !attributes.href.starts_with('#'))
            part_.findings.add(
                Severity::Warning, Code::ExternalReference,
                fmt::format("the member '{}' is in another file, which is not read", attributes.href.substr(0, 200)),
                offsetOf_(member.node));
        return;
    }
    bool isFirst = true;
    scope_.forEachChild(member.node, [&](const Element& object) {
        readTopLevel(object, continues && isFirst);
        isFirst = false;
    });
}

void FeatureReader::readTopLevel(const Element& object, bool continues) {
    const string_view name = object.localName;
    if (name == "Appearance" && object.vocabulary == Vocabulary::Appearance) return readAppearance(object, continues);
    if (isCityGml(object.vocabulary) && isIn(kSkippedObjects, name)) return;
    const bool isData = isCityGml(object.vocabulary) && isIn(kDataTypes, name);
    if (isUpperCase(name) && !isData && (isCityGml(object.vocabulary) || isForeign(object.vocabulary)))
        readFeature(object, model::kNoFeature, continues);
    else
        part_.addUnknown(object.node.name(), offsetOf_(object.node));
}

bool FeatureReader::isFeature(const Element& element) {
    if (!isUpperCase(element.localName)) return false;
    if (isCityGml(element.vocabulary)) return !isIn(kDataTypes, element.localName);
    if (!isForeign(element.vocabulary)) return false;
    return !gml::attributesOf(scope_, element.node).id.empty() || hasGeometry(scope_, element);
}

void FeatureReader::readId(const Element& element, Feature& feature) {
    const ElementAttributes attributes = gml::attributesOf(scope_, element.node);
    feature.id = attributes.id;
    if (attributes.isIdMisspelled)
        part_.findings.add(Severity::Note, Code::MissingId,
                           "'gml_id' or 'id' was found where 'gml:id' is expected; it is taken as the id",
                           offsetOf_(element.node), feature.id);
}

FeatureIndex FeatureReader::readFeature(const Element& element, FeatureIndex parent, bool continues) {
    Feature feature;
    feature.className = model::canonicalClassName(element.localName);
    if (!continues) readId(element, feature);
    feature.parent = parent;
    const auto index = static_cast<FeatureIndex>(part_.features.size());
    if (parent == model::kNoFeature)
        part_.roots.push_back(index);
    else
        part_.features[parent].children.push_back(index);
    part_.features.push_back(std::move(feature));
    part_.featureOffsets.push_back(offsetOf_(element.node));
    if (continues) part_.continuesRoot = true;

    scope_.forEachChild(element.node, [&](const Element& property) { readProperty(index, property); });
    return index;
}

void FeatureReader::readProperty(FeatureIndex feature, const Element& property) {
    if (property.vocabulary == Vocabulary::Gml) return readGmlProperty(feature, property);
    if (hasNoVolume(property)) return;
    if (isGenericAttribute(property)) return readGenericAttribute(feature, property);
    if (!xml::firstChildElement(property.node)) return readPlainProperty(feature, property);

    const std::size_t first = part_.features[feature].attributes.size();
    scope_.forEachChild(property.node, [&](const Element& object) { readObject(feature, property, object); });
    numberRecord(feature, property.localName, first);
}

void FeatureReader::readGenericAttribute(FeatureIndex feature, const Element& element) {
    std::vector<Attribute>& attributes = part_.features[feature].attributes;
    const std::size_t first = attributes.size();
    if (!addGenericAttribute(attributes, scope_, element, {})) reportValue(feature, element);
    if (element.localName.ends_with("Set")) numberRecord(feature, genericName(scope_, element), first);
}

// The attributes of `property` from `first` on are one record: each occurrence of a property is another one.
void FeatureReader::numberRecord(FeatureIndex feature, string_view property, std::size_t first) {
    std::vector<Attribute>& attributes = part_.features[feature].attributes;
    const auto isMember = [&](string_view name) {
        return name.starts_with(property) && (name.size() == property.size() || name[property.size()] == '/');
    };
    std::uint32_t* next = nullptr;
    for (std::size_t n = first; n < attributes.size(); ++n) {
        if (!isMember(attributes[n].name)) continue;
        if (next == nullptr) next = &nextRecords_[{feature, std::string(property)}];
        attributes[n].record = *next;
    }
    if (next != nullptr) ++*next;
}

void FeatureReader::readGmlProperty(FeatureIndex feature, const Element& property) {
    const string_view name = property.localName;
    if (name == "boundedBy") return readEnvelope(property);
    if (isIn(kSkippedGml, name)) return;
    if (name == "name" || name == "description") {
        const string_view text = xml::textOf(property.node, scratch_);
        Feature& owner = part_.features[feature];
        if (name == "name" && owner.name.empty())
            owner.name = text;
        else if (!text.empty())
            owner.attributes.push_back({std::string(name), std::string(text), {}});
        return;
    }
    part_.addUnknown(property.node.name(), offsetOf_(property.node));
}

// A property without child elements: text or a reference.
void FeatureReader::readPlainProperty(FeatureIndex feature, const Element& property) {
    const ElementAttributes attributes = gml::attributesOf(scope_, property.node);
    const string_view text = xml::textOf(property.node, scratch_);
    const string_view name = property.localName;
    auto& owned = part_.features[feature].attributes;
    if (!text.empty()) {
        if (!addTextAttribute(owned, name, text, property.node.attribute("uom").value()))
            reportValue(feature, property);
    } else if (attributes.hasHref) {
        const bool isRelation = isIn(kRelations, name) || property.vocabulary == Vocabulary::Appearance;
        if (lodOfProperty(name) >= 0)
            part_.geometries.push_back(
                {feature, geometryReader_.readReference(attributes.href, property.node), lodOfProperty(name)});
        else if (isRelation)
            owned.push_back({std::string(name), std::string(attributes.href), {}});
        else
            addLink(feature, property, attributes.href, std::string(roleAttribute(property.node)));
    }
}

void FeatureReader::readObject(FeatureIndex feature, const Element& property, const Element& object) {
    const string_view name = object.localName;
    const double lod = lodOfProperty(property.localName);
    if (gml::shapeOf(object) != Shape::None) {
        const NodeIndex node = geometryReader_.read(object);
        if (node != kNone) part_.geometries.push_back({feature, node, lod});
    } else if (name == "ImplicitGeometry") {
        const NodeIndex node = geometryReader_.readImplicit(object);
        if (node != kNone) part_.geometries.push_back({feature, node, lod});
    } else if (object.is(Vocabulary::Appearance, "Appearance")) {
        readAppearance(object, false);
    } else if (isGenericAttribute(object)) {
        readGenericAttribute(feature, object);
    } else if (object.is(Vocabulary::Group, "Role")) {
        readGroupRole(feature, object);
    } else if (isCityGml(object.vocabulary) && isIn(kSkippedObjects, name)) {
        return;
    } else if (property.localName.starts_with("adeOf")) {
        // CityGML 3.0 wraps properties that an ADE adds to a class.
        scope_.forEachChild(object.node, [&](const Element& added) { readProperty(feature, added); });
    } else if (isFeature(object)) {
        const FeatureIndex child = readFeature(object, feature, false);
        addMembership(feature, child, std::string(roleAttribute(property.node)));
    } else if (property.vocabulary == Vocabulary::Gml || object.vocabulary == Vocabulary::Gml) {
        part_.addUnknown(object.node.name(), offsetOf_(object.node));
    } else {
        addStructuredAttributes(part_.features[feature].attributes, scope_, object, property.localName);
    }
}

// CityGML 3.0: groupMember > Role > (role, groupMember).
void FeatureReader::readGroupRole(FeatureIndex feature, const Element& element) {
    std::string role;
    scope_.forEachChild(element.node, [&](const Element& property) {
        if (property.localName == "role") role = xml::textOf(property.node, scratch_);
    });
    scope_.forEachChild(element.node, [&](const Element& property) {
        if (property.localName != "groupMember") return;
        const ElementAttributes attributes = gml::attributesOf(scope_, property.node);
        if (!xml::firstChildElement(property.node)) {
            if (attributes.hasHref) addLink(feature, property, attributes.href, role);
            return;
        }
        scope_.forEachChild(property.node, [&](const Element& member) {
            if (isFeature(member)) addMembership(feature, readFeature(member, feature, false), role);
        });
    });
}

void FeatureReader::readEnvelope(const Element& boundedBy) {
    scope_.forEachChild(boundedBy.node, [&](const Element& envelope) {
        const ElementAttributes attributes = gml::attributesOf(scope_, envelope.node);
        part_.addCrsName(attributes.srsName, attributes.units, offsetOf_(envelope.node));
    });
}

void FeatureReader::readAppearance(const Element& element, bool continues) {
    MaterialRecord record;
    bool hasTheme = false;
    scope_.forEachChild(element.node, [&](const Element& property) {
        if (property.localName != "theme") return;
        record.theme = xml::textOf(property.node, scratch_);
        hasTheme = true;
    });
    record.inheritsTheme = continues && !hasTheme;
    if (!record.inheritsTheme) part_.lastTheme = record.theme;
    scope_.forEachChild(element.node, [&](const Element& property) {
        if (property.localName != "surfaceDataMember" && property.localName != "surfaceData") return;
        const ElementAttributes attributes = gml::attributesOf(scope_, property.node);
        if (!xml::firstChildElement(property.node)) {
            if (!attributes.hasHref) return;
            MaterialRecord reference = record;
            reference.isReference = true;
            reference.id = attributes.href;
            part_.materials.push_back(std::move(reference));
            return;
        }
        scope_.forEachChild(property.node, [&](const Element& data) {
            if (data.localName == "X3DMaterial") readMaterial(data, record);
            if constexpr (textures::kReadsTextures)
                if (data.localName == "ParameterizedTexture" || data.localName == "GeoreferencedTexture")
                    readTexture(scope_, data, {record.theme, record.inheritsTheme, {}, {}, {}, {}}, part_.textures);
        });
    });
}

void FeatureReader::readMaterial(const Element& element, MaterialRecord record) {
    record.id = gml::attributesOf(scope_, element.node).id;
    bool isFront = true;
    std::vector<double> numbers;
    scope_.forEachChild(element.node, [&](const Element& property) {
        const string_view name = property.localName;
        const string_view text = xml::textOf(property.node, scratch_);
        numbers.clear();
        if (name == "name") {
            record.material.name = text;
        } else if (name == "isFront") {
            isFront = text != "false" && text != "0";
        } else if (name == "target") {
            const string_view href = gml::attributesOf(scope_, property.node).href;
            record.targets.emplace_back(text.empty() ? href : text);
        } else if (name == "diffuseColor" || name == "transparency") {
            const bool isColor = name == "diffuseColor";
            const bool isGood = gml::parseNumbers(text, numbers).empty() && numbers.size() == (isColor ? 3u : 1u) &&
                                std::all_of(numbers.begin(), numbers.end(), [](double v) { return v >= 0 && v <= 1; });
            if (!isGood)
                part_.findings.add(Severity::Warning, Code::BadValue,
                                   fmt::format("{} '{}'; expected numbers from 0 to 1", name, text.substr(0, 60)),
                                   offsetOf_(property.node), record.id);
            else if (isColor)
                record.material.diffuse = {static_cast<float>(numbers[0]), static_cast<float>(numbers[1]),
                                           static_cast<float>(numbers[2])};
            else
                record.material.transparency = static_cast<float>(numbers[0]);
        }
    });
    if (isFront) part_.materials.push_back(std::move(record));
}

void FeatureReader::addLink(FeatureIndex feature, const Element& property, string_view href, std::string role) {
    part_.links.push_back({feature, static_cast<std::uint32_t>(part_.hrefs.size()), std::string(property.localName),
                           std::move(role), offsetOf_(property.node)});
    part_.hrefs.emplace_back(href);
}

// An inline member becomes a child of its group; its role would be lost without a membership.
void FeatureReader::addMembership(FeatureIndex group, FeatureIndex member, std::string role) {
    if (!role.empty()) part_.memberships.push_back({group, member, std::move(role)});
}

void FeatureReader::reportValue(FeatureIndex feature, const Element& property) {
    part_.findings.add(Severity::Warning, Code::BadValue,
                       fmt::format("the value of '{}' is not a number; it is kept as text", property.localName),
                       offsetOf_(property.node), part_.features[feature].id);
}

}  // namespace svt::readers::citygml

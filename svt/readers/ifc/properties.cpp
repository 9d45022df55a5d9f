#include <svt/readers/ifc/properties.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace svt::readers::ifc {
namespace {

using std::string_view;

constexpr std::size_t kMaxText = 4096;

// Reads a value, converted to SI from the project unit of its type; false for a value that is not set.
// \param own  factor of the unit of the value itself; empty: that of the project
bool readValue(Value value, const Units& units, std::optional<double> own, Attribute& attribute) {
    if (value.isNothing()) return false;
    const string_view type = value.typeName();
    if (const auto text = value.string()) {
        if (text->empty()) return false;
        attribute.value = text->substr(0, kMaxText);
        return true;
    }
    if (const string_view word = value.enumeration(); !word.empty()) {
        if (word == "U") return false;
        if (word == "T" || word == "F")
            attribute.value = word == "T";
        else
            attribute.value = std::string(word);
        return true;
    }
    const auto number = value.number();
    if (!number) return false;
    if (const auto whole = value.integer(); whole && !type.ends_with("MEASURE") && type != "IFCREAL") {
        attribute.value = *whole;
        return true;
    }
    double factor = 1;
    if (type.ends_with("LENGTHMEASURE")) {
        factor = units.length;
        attribute.unit = "m";
    } else if (type == "IFCAREAMEASURE") {
        factor = units.area;
        attribute.unit = "m2";
    } else if (type == "IFCVOLUMEMEASURE") {
        factor = units.volume;
        attribute.unit = "m3";
    } else if (type == "IFCMASSMEASURE") {
        factor = units.mass;
        attribute.unit = "kg";
    } else if (type == "IFCPLANEANGLEMEASURE" || type == "IFCPOSITIVEPLANEANGLEMEASURE") {
        factor = units.angle;
        attribute.unit = "rad";
    }
    attribute.value = converted(*number, attribute.unit.empty() ? 1 : own.value_or(factor));
    return true;
}

std::string plainText(Value value) {
    if (auto text = value.string()) return std::move(*text);
    return std::string(value.inner().text());
}

// The values of a list as one text.
std::string joined(Value list) {
    std::string text;
    step::ValueCursor cursor(list);
    for (Value item; cursor.next(item);) {
        if (!text.empty()) text += ", ";
        text += plainText(item);
        if (text.size() > kMaxText) break;
    }
    return text;
}

// Rows of a table as one text: "from: to, from: to".
std::string joinedTable(Value defining, Value defined) {
    const std::vector<Value> from = step::itemsOf(defining), to = step::itemsOf(defined);
    std::string text;
    for (std::size_t i = 0; i < std::min(from.size(), to.size()) && text.size() < kMaxText; ++i)
        text += (i == 0 ? "" : ", ") + plainText(from[i]) + ": " + plainText(to[i]);
    return text;
}

}  // namespace

std::uint64_t elementsOf(const Attribute& attribute) noexcept {
    constexpr std::uint64_t kOfEach = 4, kBytesOfPoint = 24;
    const auto* text = std::get_if<std::string>(&attribute.value);
    return kOfEach + (attribute.name.size() + (text != nullptr ? text->size() : 0)) / kBytesOfPoint;
}

Properties::Properties(const IfcFile& file, const Units& units) : file_(file), units_(units) {
    const auto relate = [&](Entity entity, AttributePosition related, AttributePosition relating, Related& map) {
        for (const RecordIndex relation : file.all(entity)) {
            const Fields fields = file.fieldsOf(relation);
            const RecordIndex definition = file.follow(fields[relating]);
            if (definition == kNoRecord) continue;
            for (const RecordIndex object : file.followAll(fields[related])) map[object].push_back(definition);
        }
    };
    relate(Entity::RelDefinesByProperties, at::RelDefinesByProperties::RelatedObjects,
           at::RelDefinesByProperties::RelatingPropertyDefinition, sets_);
    relate(Entity::RelDefinesByType, at::RelDefinesByType::RelatedObjects, at::RelDefinesByType::RelatingType, types_);
    relate(Entity::RelAssociatesMaterial, at::RelAssociatesMaterial::RelatedObjects,
           at::RelAssociatesMaterial::RelatingMaterial, materials_);
    relate(Entity::RelAssociatesClassification, at::RelAssociatesClassification::RelatedObjects,
           at::RelAssociatesClassification::RelatingClassification, classifications_);
}

const Properties::Records& Properties::of(const Related& map, RecordIndex key) {
    static const Records kNone;
    const auto found = map.find(key);
    return found == map.end() ? kNone : found->second;
}

void Properties::replaceOrAdd(std::vector<Attribute>& attributes, Attribute attribute) const {
    ReadGuard& guard = file_.guard();
    if (!guard.takeSteps(attributes.size()) || !guard.takeElements(elementsOf(attribute))) return;
    const auto same = std::find_if(attributes.begin(), attributes.end(),
                                   [&](const Attribute& known) { return known.name == attribute.name; });
    if (same == attributes.end())
        attributes.push_back(std::move(attribute));
    else
        *same = std::move(attribute);
}

void Properties::append(RecordIndex object, std::vector<Attribute>& attributes) const {
    for (const RecordIndex type : of(types_, object)) {
        const Fields fields = file_.fieldsOf(type);
        if (const auto name = fields[at::TypeObject::Name].string(); name && !name->empty())
            replaceOrAdd(attributes, {"type", *name, ""});
        for (const RecordIndex set : file_.followAll(fields[at::TypeObject::HasPropertySets]))
            appendSet(set, attributes);
    }
    for (const RecordIndex set : of(sets_, object)) appendSet(set, attributes);
    for (const RecordIndex material : materialsOf(object)) appendMaterial(material, attributes);
    for (const RecordIndex reference : of(classifications_, object)) {
        const Fields fields = file_.fieldsOf(reference);
        if (file_.entityOf(reference) != Entity::ClassificationReference) continue;
        const std::string code = fields[at::ClassificationReference::Identification].string().value_or(""),
                          name = fields[at::ClassificationReference::Name].string().value_or("");
        const std::string text = code.empty() || name.empty() ? code + name : code + " " + name;
        if (!text.empty()) attributes.push_back({"classification", text, ""});
    }
}

void Properties::appendSet(RecordIndex set, std::vector<Attribute>& attributes) const {
    const Fields fields = file_.fieldsOf(set);
    const std::string name = fields[at::Root::Name].string().value_or("");
    const Entity entity = file_.entityOf(set);
    if (entity == Entity::DoorLiningProperties)
        if (const auto thickness = fields[at::DoorLiningProperties::LiningThickness].number(); thickness > 0)
            replaceOrAdd(attributes, {"liningThickness", converted(*thickness, units_.length), "m"});
    if (entity != Entity::PropertySet && entity != Entity::ElementQuantity) return;
    const Value members = entity == Entity::PropertySet ? fields[at::PropertySet::HasProperties]
                                                        : fields[at::ElementQuantity::Quantities];
    for (const RecordIndex member : file_.followAll(members))
        appendProperty(name.empty() ? std::string() : name + ".", member, attributes);
}

void Properties::appendProperty(const std::string& prefix, RecordIndex property,
                                std::vector<Attribute>& attributes) const {
    ReadGuard::Scope scope(file_.guard());
    if (!scope.enter(property)) return;
    const Fields fields = file_.fieldsOf(property);
    const std::string name = fields[at::Property::Name].string().value_or("");
    if (name.empty()) return;
    const auto unitOf = [&](AttributePosition unit) { return unitFactor(file_, file_.follow(fields[unit])); };
    const auto value = [&](Value given, std::string_view tail = "", std::optional<double> own = {}) {
        Attribute attribute{prefix + name + std::string(tail), std::string(), ""};
        if (readValue(given, units_, own, attribute)) replaceOrAdd(attributes, std::move(attribute));
    };
    const auto text = [&](std::string words) {
        if (!words.empty()) replaceOrAdd(attributes, {prefix + name, std::move(words), ""});
    };
    const auto quantity = [&](AttributePosition given, double factor, const char* unit) {
        const double own = unitOf(at::PhysicalSimpleQuantity::Unit).value_or(factor);
        if (const auto number = fields[given].number())
            replaceOrAdd(attributes, {prefix + name, converted(*number, *unit == '\0' ? factor : own), unit});
    };
    switch (file_.entityOf(property)) {
        case Entity::PropertySingleValue:
            return value(fields[at::PropertySingleValue::NominalValue], "", unitOf(at::PropertySingleValue::Unit));
        case Entity::PropertyEnumeratedValue:
            return text(joined(fields[at::PropertyEnumeratedValue::EnumerationValues]));
        case Entity::PropertyListValue: return text(joined(fields[at::PropertyListValue::ListValues]));
        case Entity::PropertyBoundedValue:
            value(fields[at::PropertyBoundedValue::LowerBoundValue], ".min");
            return value(fields[at::PropertyBoundedValue::UpperBoundValue], ".max");
        case Entity::PropertyTableValue:
            return text(joinedTable(fields[at::PropertyTableValue::DefiningValues],
                                    fields[at::PropertyTableValue::DefinedValues]));
        case Entity::ComplexProperty:
            for (const RecordIndex part : file_.followAll(fields[at::ComplexProperty::HasProperties]))
                appendProperty(prefix + name + ".", part, attributes);
            return;
        case Entity::QuantityLength: return quantity(at::QuantityLength::LengthValue, units_.length, "m");
        case Entity::QuantityArea: return quantity(at::QuantityArea::AreaValue, units_.area, "m2");
        case Entity::QuantityVolume: return quantity(at::QuantityVolume::VolumeValue, units_.volume, "m3");
        case Entity::QuantityWeight: return quantity(at::QuantityWeight::WeightValue, units_.mass, "kg");
        case Entity::QuantityTime: return quantity(at::QuantityTime::TimeValue, units_.time, "s");
        case Entity::QuantityCount: return quantity(at::QuantityCount::CountValue, 1, "");
        default: return;
    }
}

// The materials of a material definition.
std::vector<Properties::MaterialPart> Properties::parts(RecordIndex definition) const {
    ReadGuard::Scope scope(file_.guard());
    if (!scope.enter(definition)) return {};
    const Fields fields = file_.fieldsOf(definition);
    std::vector<RecordIndex> records;
    switch (file_.entityOf(definition)) {
        case Entity::MaterialLayerSetUsage: return parts(file_.follow(fields[at::MaterialLayerSetUsage::ForLayerSet]));
        case Entity::MaterialProfileSetUsage:
            return parts(file_.follow(fields[at::MaterialProfileSetUsage::ForProfileSet]));
        case Entity::MaterialLayerSet: records = file_.followAll(fields[at::MaterialLayerSet::MaterialLayers]); break;
        case Entity::MaterialList: records = file_.followAll(fields[at::MaterialList::Materials]); break;
        case Entity::MaterialConstituentSet:
            records = file_.followAll(fields[at::MaterialConstituentSet::MaterialConstituents]);
            break;
        case Entity::MaterialProfileSet:
            records = file_.followAll(fields[at::MaterialProfileSet::MaterialProfiles]);
            break;
        default: records = {definition};
    }
    std::vector<MaterialPart> result;
    for (const RecordIndex record : records) result.push_back(part(record));
    return result;
}

Properties::MaterialPart Properties::part(RecordIndex record) const {
    const Fields fields = file_.fieldsOf(record);
    switch (file_.entityOf(record)) {
        case Entity::MaterialLayer:
        case Entity::MaterialLayerWithOffsets:
            return {file_.follow(fields[at::MaterialLayer::Material]),
                    file_.metres(fields[at::MaterialLayer::LayerThickness])};
        case Entity::MaterialConstituent: return {file_.follow(fields[at::MaterialConstituent::Material]), {}};
        case Entity::MaterialProfile: return {file_.follow(fields[at::MaterialProfile::Material]), {}};
        default: return {record, {}};
    }
}

void Properties::appendMaterial(RecordIndex definition, std::vector<Attribute>& attributes) const {
    std::string names, layers;
    for (const MaterialPart& part : parts(definition)) {
        if (file_.entityOf(part.material) != Entity::Material) continue;
        const std::string name = file_.fieldsOf(part.material)[at::Material::Name].string().value_or("");
        if (name.empty()) continue;
        // Longer text is cut off below.
        if (names.size() <= kMaxText && ("; " + names + "; ").find("; " + name + "; ") == std::string::npos)
            names += (names.empty() ? "" : "; ") + name;
        if (part.thickness && layers.size() <= kMaxText)
            layers += fmt::format("{}{} {:.6g} m", layers.empty() ? "" : "; ", name, *part.thickness);
    }
    if (!names.empty()) attributes.push_back({"material", names.substr(0, kMaxText), ""});
    if (!layers.empty()) attributes.push_back({"materialLayers", layers.substr(0, kMaxText), ""});
}

const std::vector<RecordIndex>& Properties::materialsOf(RecordIndex object) const {
    const Records* materials = &of(materials_, object);
    for (const RecordIndex type : of(types_, object))
        if (materials->empty()) materials = &of(materials_, type);
    return *materials;
}

RecordIndex Properties::mainMaterial(RecordIndex object) const {
    double thickest = -1;
    RecordIndex best = kNoRecord;
    for (const RecordIndex definition : materialsOf(object))
        for (const MaterialPart& part : parts(definition))
            if (part.thickness.value_or(0) > thickest) {
                thickest = part.thickness.value_or(0);
                best = part.material;
            }
    return best;
}

RecordIndex Properties::constituent(RecordIndex object, const std::string& name) const {
    for (const RecordIndex set : materialsOf(object)) {
        if (file_.entityOf(set) != Entity::MaterialConstituentSet) continue;
        for (const RecordIndex record : file_.followAll(set, at::MaterialConstituentSet::MaterialConstituents)) {
            const Fields fields = file_.fieldsOf(record);
            if (fields[at::MaterialConstituent::Name].string().value_or("") == name)
                return file_.follow(fields[at::MaterialConstituent::Material]);
        }
    }
    return kNoRecord;
}

}  // namespace svt::readers::ifc

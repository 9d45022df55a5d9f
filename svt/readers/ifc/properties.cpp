#include <svt/readers/ifc/properties.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::readers::ifc {
namespace {

using std::string_view;

constexpr std::size_t kMaxText = 4096;

bool endsWith(string_view text, string_view tail) noexcept { return text.ends_with(tail); }

// A value with the unit that its type has in the project, taken to SI; nothing for what is not set.
bool readValue(Value value, const Units& units, Attribute& attribute) {
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
    if (const auto whole = value.integer(); whole && !endsWith(type, "MEASURE") && type != "IFCREAL") {
        attribute.value = *whole;
        return true;
    }
    double factor = 1;
    if (endsWith(type, "LENGTHMEASURE")) {
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
    attribute.value = *number * factor;
    return true;
}

std::string textOf(Value value) {
    if (auto text = value.string()) return std::move(*text);
    return std::string(value.inner().text());
}

// Texts of the values of a list, joined.
std::string joined(Value list) {
    std::string text;
    step::ValueCursor cursor(list);
    for (Value item; cursor.next(item);) {
        if (!text.empty()) text += ", ";
        text += textOf(item);
        if (text.size() > kMaxText) break;
    }
    return text;
}

}  // namespace

std::uint64_t elementsOf(const Attribute& attribute) noexcept {
    constexpr std::uint64_t kOfEach = 4, kBytesOfPoint = 24;
    const auto* text = std::get_if<std::string>(&attribute.value);
    return kOfEach + (attribute.name.size() + (text != nullptr ? text->size() : 0)) / kBytesOfPoint;
}

Properties::Properties(const IfcFile& file, const Units& units) : file_(file), units_(units) {
    const auto relate = [&](const Fields& fields, std::unordered_map<RecordIndex, Records>& map) {
        const RecordIndex relating = file.follow(fields[5]);
        if (relating == kNoRecord) return;
        for (const RecordIndex object : file.followAll(fields[4])) map[object].push_back(relating);
    };
    for (RecordIndex i = 0; i < file.step().records().size(); ++i) switch (file.entityOf(i)) {
            case Entity::RelDefinesByProperties: relate(file.fieldsOf(i), sets_); break;
            case Entity::RelDefinesByType: relate(file.fieldsOf(i), types_); break;
            case Entity::RelAssociatesMaterial: relate(file.fieldsOf(i), materials_); break;
            case Entity::RelAssociatesClassification: relate(file.fieldsOf(i), classifications_); break;
            default: break;
        }
}

const Properties::Records& Properties::of(const std::unordered_map<RecordIndex, Records>& map, RecordIndex key) {
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
    const Records* materials = &of(materials_, object);
    for (const RecordIndex type : of(types_, object)) {
        const Fields fields = file_.fieldsOf(type);
        if (const auto name = fields[2].string(); name && !name->empty()) replaceOrAdd(attributes, {"type", *name, ""});
        for (const RecordIndex set : file_.followAll(fields[5])) appendSet(set, attributes);
        if (materials->empty()) materials = &of(materials_, type);
    }
    for (const RecordIndex set : of(sets_, object)) appendSet(set, attributes);
    for (const RecordIndex material : *materials) appendMaterial(material, attributes);
    for (const RecordIndex reference : of(classifications_, object)) {
        const Fields fields = file_.fieldsOf(reference);
        if (file_.entityOf(reference) != Entity::ClassificationReference) continue;
        const std::string code = fields[1].string().value_or(""), name = fields[2].string().value_or("");
        const std::string text = code.empty() || name.empty() ? code + name : code + " " + name;
        if (!text.empty()) attributes.push_back({"classification", text, ""});
    }
}

void Properties::appendSet(RecordIndex set, std::vector<Attribute>& attributes) const {
    const Fields fields = file_.fieldsOf(set);
    const std::string name = fields[2].string().value_or("");
    const Entity entity = file_.entityOf(set);
    if (entity != Entity::PropertySet && entity != Entity::ElementQuantity) return;
    const Value members = entity == Entity::PropertySet ? fields[4] : fields[5];
    for (const RecordIndex member : file_.followAll(members))
        appendProperty(name.empty() ? std::string() : name + ".", member, attributes);
}

void Properties::appendProperty(const std::string& prefix, RecordIndex property,
                                std::vector<Attribute>& attributes) const {
    ReadGuard::Scope scope(file_.guard());
    if (!scope.enter(property)) return;
    const Fields fields = file_.fieldsOf(property);
    Attribute attribute{prefix + fields[0].string().value_or(""), std::string(), ""};
    if (attribute.name.size() == prefix.size()) return;
    const auto quantity = [&](double factor, std::string unit) {
        const auto number = fields[3].number();
        if (!number) return;
        attribute.value = *number * factor;
        attribute.unit = std::move(unit);
        replaceOrAdd(attributes, std::move(attribute));
    };
    switch (file_.entityOf(property)) {
        case Entity::PropertySingleValue:
            if (readValue(fields[2], units_, attribute)) replaceOrAdd(attributes, std::move(attribute));
            break;
        case Entity::PropertyEnumeratedValue:
        case Entity::PropertyListValue:
            if (std::string text = joined(fields[2]); !text.empty()) {
                attribute.value = std::move(text);
                replaceOrAdd(attributes, std::move(attribute));
            }
            break;
        case Entity::PropertyBoundedValue:
            for (const auto& [number, word] : {std::pair{std::size_t{3}, ".min"}, std::pair{std::size_t{2}, ".max"}}) {
                Attribute bound{attribute.name + word, std::string(), ""};
                if (readValue(fields[number], units_, bound)) replaceOrAdd(attributes, std::move(bound));
            }
            break;
        case Entity::PropertyTableValue: {
            const std::vector<Value> from = step::itemsOf(fields[2]), to = step::itemsOf(fields[3]);
            std::string text;
            for (std::size_t i = 0; i < std::min(from.size(), to.size()) && text.size() < kMaxText; ++i)
                text += (i == 0 ? "" : ", ") + textOf(from[i]) + ": " + textOf(to[i]);
            if (!text.empty()) {
                attribute.value = std::move(text);
                replaceOrAdd(attributes, std::move(attribute));
            }
            break;
        }
        case Entity::ComplexProperty:
            for (const RecordIndex part : file_.followAll(fields[3]))
                appendProperty(attribute.name + ".", part, attributes);
            break;
        case Entity::QuantityLength: quantity(units_.length, "m"); break;
        case Entity::QuantityArea: quantity(units_.area, "m2"); break;
        case Entity::QuantityVolume: quantity(units_.volume, "m3"); break;
        case Entity::QuantityWeight: quantity(units_.mass, "kg"); break;
        case Entity::QuantityTime: quantity(units_.time, "s"); break;
        case Entity::QuantityCount: quantity(1, ""); break;
        default: break;
    }
}

// The materials, or layers with their materials, that a material definition is made of.
Properties::Records Properties::layersOf(RecordIndex material) const {
    ReadGuard::Scope scope(file_.guard());
    if (!scope.enter(material)) return {};
    const Fields fields = file_.fieldsOf(material);
    switch (file_.entityOf(material)) {
        case Entity::MaterialLayerSetUsage:
        case Entity::MaterialProfileSetUsage: return layersOf(file_.follow(fields[0]));
        case Entity::MaterialLayerSet:
        case Entity::MaterialList: return file_.followAll(fields[0]);
        case Entity::MaterialConstituentSet:
        case Entity::MaterialProfileSet: return file_.followAll(fields[2]);
        default: return {material};
    }
}

void Properties::appendMaterial(RecordIndex material, std::vector<Attribute>& attributes) const {
    std::string names, layers;
    for (const RecordIndex part : layersOf(material)) {
        const Fields fields = file_.fieldsOf(part);
        const Entity entity = file_.entityOf(part);
        const bool isLayer = entity == Entity::MaterialLayer || entity == Entity::MaterialLayerWithOffsets;
        const bool isPart = entity == Entity::MaterialConstituent || entity == Entity::MaterialProfile;
        const RecordIndex of = isLayer ? file_.follow(fields[0]) : isPart ? file_.follow(fields[2]) : part;
        if (file_.entityOf(of) != Entity::Material) continue;
        const std::string name = file_.fieldsOf(of)[0].string().value_or("");
        if (name.empty()) continue;
        // What is longer is cut off below.
        if (names.size() <= kMaxText && ("; " + names + "; ").find("; " + name + "; ") == std::string::npos)
            names += (names.empty() ? "" : "; ") + name;
        if (isLayer && layers.size() <= kMaxText)
            layers += fmt::format("{}{} {:.6g} m", layers.empty() ? "" : "; ", name, file_.metres(fields[1]));
    }
    if (!names.empty()) attributes.push_back({"material", names.substr(0, kMaxText), ""});
    if (!layers.empty()) attributes.push_back({"materialLayers", layers.substr(0, kMaxText), ""});
}

const std::vector<RecordIndex>& Properties::materialsOf(RecordIndex object) const {
    const Records* materials = &of(materials_, object);
    if (materials->empty())
        for (const RecordIndex type : of(types_, object)) materials = &of(materials_, type);
    return *materials;
}

RecordIndex Properties::materialOf(RecordIndex object) const {
    double thickest = -1;
    RecordIndex best = kNoRecord;
    for (const RecordIndex material : materialsOf(object))
        for (const RecordIndex part : layersOf(material)) {
            const Fields fields = file_.fieldsOf(part);
            const Entity entity = file_.entityOf(part);
            const bool isLayer = entity == Entity::MaterialLayer || entity == Entity::MaterialLayerWithOffsets;
            const bool isPart = entity == Entity::MaterialConstituent || entity == Entity::MaterialProfile;
            const double thickness = isLayer ? file_.metres(fields[1]) : 0;
            if (thickness <= thickest) continue;
            thickest = thickness;
            best = isLayer ? file_.follow(fields[0]) : isPart ? file_.follow(fields[2]) : part;
        }
    return best;
}

}  // namespace svt::readers::ifc

#include <svt/fields/codec/field_json.hpp>

#include <svt/core/names.hpp>
#include <svt/fields/check_field.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

namespace svt::fields {
namespace {

using FieldJson = nlohmann::ordered_json;

Error wrongJson(std::string message) { return Error(Code::BadField, "fields.json: " + std::move(message)); }

// Reads the members of one object; the first that is wrong is remembered.
class MemberReader {
public:
    explicit MemberReader(const FieldJson& object) : object_(object) {}

    [[nodiscard]] const FieldJson* find(const char* key) const {
        const auto found = object_.find(key);
        return found == object_.end() || found->is_null() ? nullptr : &*found;
    }
    [[nodiscard]] std::string text(const char* key, bool isRequired) {
        const FieldJson* value = find(key);
        if (value == nullptr) {
            if (isRequired) fail(key, "is missing");
            return {};
        }
        if (!value->is_string()) {
            fail(key, "is not a string");
            return {};
        }
        return value->get<std::string>();
    }
    [[nodiscard]] double number(const char* key, double otherwise) {
        const FieldJson* value = find(key);
        if (value == nullptr) return otherwise;
        if (value->is_number()) return value->get<double>();
        fail(key, "is not a number");
        return otherwise;
    }
    [[nodiscard]] std::int32_t integer(const char* key, std::int32_t otherwise) {
        const FieldJson* value = find(key);
        return value == nullptr ? otherwise : integerOf(*value, key);
    }
    [[nodiscard]] std::int32_t integerOf(const FieldJson& value, const char* key) {
        // Also for integers beyond 32 bits, as a double rounds them.
        const double number = value.is_number_integer() ? value.get<double>() : -1e18;
        if (std::abs(number) <= 2147483647.0) return static_cast<std::int32_t>(number);
        fail(key, "is not an integer of 32 bits");
        return 0;
    }
    [[nodiscard]] std::vector<double> numbers(const FieldJson& value, const char* key, std::size_t most) {
        std::vector<double> list;
        if (!value.is_array() || value.size() > most) {
            fail(key, "is not a list of numbers, or too long");
            return list;
        }
        for (const FieldJson& one : value) {
            if (!one.is_number()) {
                fail(key, "holds something that is not a number");
                return list;
            }
            list.push_back(one.get<double>());
        }
        return list;
    }
    [[nodiscard]] Vec3d vector(const char* key, Vec3d otherwise) {
        const FieldJson* value = find(key);
        if (value == nullptr) return otherwise;
        const std::vector<double> list = numbers(*value, key, 3);
        if (list.size() == 3) return {list[0], list[1], list[2]};
        fail(key, "is not three numbers");
        return otherwise;
    }
    void fail(const char* key, const char* why) {
        if (problem_.empty()) problem_ = fmt::format("'{}' {}", key, why);
    }
    [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

private:
    const FieldJson& object_;
    std::string problem_;
};

void readLattice(MemberReader& reader, Lattice& lattice) {
    const FieldJson* object = reader.find("lattice");
    if (object == nullptr || !object->is_object()) return reader.fail("lattice", "is missing or not an object");
    MemberReader of(*object);
    lattice.first = of.vector("first", {});
    lattice.step = of.vector("step", {1, 1, 1});
    const FieldJson* size = of.find("size");
    if (size == nullptr || !size->is_array() || size->size() != 3)
        return reader.fail("lattice", "has no size of three integers");
    for (int axis = 0; axis < 3; ++axis) lattice.size[axis] = of.integerOf((*size)[std::size_t(axis)], "size");
    if (const FieldJson* axes = of.find("axes")) {
        if (!axes->is_array() || axes->size() != 3) return reader.fail("lattice", "has axes that are not three lists");
        for (std::size_t axis = 0; axis < 3; ++axis)
            lattice.positions[axis] = of.numbers((*axes)[axis], "axes", std::size_t(kMaxNodes));
    }
    if (!of.problem().empty()) reader.fail("lattice", "has a member that is not valid");
}

void readPoints(MemberReader& reader, std::vector<FieldPoint>& points) {
    const FieldJson* list = reader.find("points");
    if (list == nullptr) return;
    if (!list->is_array() || list->size() > kMaxPoints) return reader.fail("points", "is not a list, or too long");
    for (const FieldJson& one : *list) {
        if (!one.is_object()) return reader.fail("points", "holds something that is not an object");
        MemberReader of(one);
        points.push_back({of.text("id", true), of.vector("at", {std::nan(""), 0, 0})});
        if (!of.problem().empty()) return reader.fail("points", "has a point without id or place");
    }
}

void readCode(MemberReader& reader, StoredField& field) {
    const FieldJson* object = reader.find("code");
    if (object == nullptr || !object->is_object()) return reader.fail("code", "is missing or not an object");
    MemberReader of(*object);
    const std::string type = of.text("type", true);
    field.code.isFloat = type == "f32";
    if (type != "f32" && type != "u16") return reader.fail("code", "has a type other than u16 and f32");
    if (field.code.isFloat) return;
    field.code.scale = of.number("scale", 0);
    field.code.offset = of.number("offset", 0);
    const double most = field.code.offset + field.code.scale * 65534;
    constexpr double kMost = std::numeric_limits<float>::max();
    if (!of.problem().empty() || !(field.code.scale > 0) || !(std::abs(field.code.offset) < kMost) ||
        !(std::abs(most) < kMost))
        return reader.fail("code",
                           "has a scale that is not above 0, or an offset or scale that is not a number in range");
    field.head.precision = field.code.scale;
}

void readRange(MemberReader& reader, StoredField& field) {
    const FieldJson* value = reader.find("range");
    if (value == nullptr) return;
    const std::vector<double> range = reader.numbers(*value, "range", 2);
    constexpr double kMost = std::numeric_limits<float>::max();
    if (range.size() == 2 && range[0] >= -kMost && range[0] <= range[1] && range[1] <= kMost)
        field.range.emplace(static_cast<float>(range[0]), static_cast<float>(range[1]));
    else
        reader.fail("range", "is not two ascending numbers");
}

// Most levels that a lattice can have; a file with more is damaged.
std::int32_t mostLevels(const Lattice& lattice) noexcept {
    std::int32_t levels = 1;
    while (levels < 32) {
        const Vec3i count = blockCount(lattice, levels - 1);
        if (count.x <= 1 && count.y <= 1 && count.z <= 1) break;
        ++levels;
    }
    return levels;
}

Result<StoredField> readOne(const FieldJson& object) {
    if (!object.is_object()) return wrongJson("a field is not an object");
    MemberReader reader(object);
    StoredField field;
    FieldHead& head = field.head;
    head.name = reader.text("name", true);
    const auto wrong = [&](std::string_view why) {
        return wrongJson(fmt::format("field '{}': {}", head.name.substr(0, kMaxNameBytes), why));
    };
    const auto kind = fromName<FieldKind>(reader.text("kind", true));
    if (!kind) return wrong("'kind' is not grid, label or points");
    head.kind = *kind;
    head.quantity = reader.text("quantity", false);
    head.unit = reader.text("unit", true);
    head.components = reader.integer("components", 1);
    if (reader.find("medium") != nullptr) head.medium = reader.text("medium", true);
    if (head.kind == FieldKind::Grid) readLattice(reader, head.lattice);
    readPoints(reader, head.points);
    if (const FieldJson* times = reader.find("times")) head.times = reader.numbers(*times, "times", kMaxTimes);
    if (reader.find("epoch") != nullptr) head.epoch = reader.text("epoch", true);
    head.by = reader.text("by", false);
    if (const FieldJson* parameters = reader.find("parameters"))
        head.parameters = parameters->dump(-1, ' ', false, FieldJson::error_handler_t::replace);
    readCode(reader, field);
    readRange(reader, field);
    field.code.levels = reader.integer("levels", 1);
    if (!reader.problem().empty()) return wrong(reader.problem());
    if (auto checked = checkHead(head); !checked) return wrongJson(checked.error().message());
    if (field.code.levels < 1 || field.code.levels > (head.kind == FieldKind::Grid ? mostLevels(head.lattice) : 1))
        return wrong(fmt::format("it has {} levels, which its lattice cannot have", field.code.levels));
    return field;
}

template <class Vector>
FieldJson listOf(const Vector& vector) {
    return {vector.x, vector.y, vector.z};
}

FieldJson headJson(const StoredField& field) {
    const FieldHead& head = field.head;
    FieldJson json;
    json["name"] = head.name;
    json["kind"] = nameOf(head.kind);
    if (!head.quantity.empty()) json["quantity"] = head.quantity;
    json["unit"] = head.unit;
    json["components"] = head.components;
    json["medium"] = head.medium;
    if (head.kind == FieldKind::Grid) {
        FieldJson& lattice = json["lattice"];
        lattice["first"] = listOf(head.lattice.first);
        lattice["step"] = listOf(head.lattice.step);
        lattice["size"] = listOf(head.lattice.size);
        if (!head.lattice.positions[0].empty()) lattice["axes"] = head.lattice.positions;
    }
    if (head.kind == FieldKind::Points) {
        FieldJson& points = json["points"] = FieldJson::array();
        for (const FieldPoint& point : head.points) points.push_back({{"id", point.id}, {"at", listOf(point.at)}});
    }
    json["times"] = head.times;
    if (head.epoch) json["epoch"] = *head.epoch;
    FieldJson& code = json["code"];
    code["type"] = field.code.isFloat ? "f32" : "u16";
    if (!field.code.isFloat) {
        code["scale"] = field.code.scale;
        code["offset"] = field.code.offset;
    }
    if (head.kind == FieldKind::Grid) json["levels"] = field.code.levels;
    json["range"] = nullptr;
    if (field.range) json["range"] = {double{field.range->first}, double{field.range->second}};
    if (!head.by.empty()) json["by"] = head.by;
    if (!head.parameters.empty()) json["parameters"] = FieldJson::parse(head.parameters, nullptr, false);
    return json;
}

}  // namespace

Result<std::vector<StoredField>> readFieldsJson(std::string_view text) {
    if (text.size() > kMaxFieldsJson)
        return wrongJson(fmt::format("it has {} bytes, {} are possible", text.size(), kMaxFieldsJson));
    constexpr int kMaxDepth = 64;
    bool isDeep = false;
    const auto guard = [&](int depth, FieldJson::parse_event_t, FieldJson&) {
        isDeep = isDeep || depth > kMaxDepth;
        return !isDeep;
    };
    const FieldJson json = FieldJson::parse(text, guard, false);
    if (isDeep) return wrongJson(fmt::format("its objects are nested deeper than {}", kMaxDepth));
    if (!json.is_object()) return wrongJson("it is not a JSON object");
    const auto list = json.find("fields");
    if (list == json.end() || !list->is_array()) return wrongJson("the list 'fields' is missing");
    if (list->size() > kMaxFields)
        return wrongJson(fmt::format("it has {} fields, {} are possible", list->size(), kMaxFields));
    std::vector<StoredField> fields;
    std::unordered_set<std::string> names;
    for (const FieldJson& one : *list) {
        SVT_TRY(field, readOne(one));
        if (!names.insert(field->head.name).second)
            return wrongJson(fmt::format("two fields have the name '{}'", field->head.name));
        fields.push_back(std::move(*field));
    }
    return fields;
}

Result<std::string> writeFieldsJson(std::span<const StoredField> fields) {
    std::string text = "{\"fields\": [";
    for (std::size_t f = 0; f < fields.size(); ++f)
        text += (f == 0 ? "\n" : ",\n") + headJson(fields[f]).dump(-1, ' ', false, FieldJson::error_handler_t::replace);
    text += "\n]}\n";
    if (text.size() > kMaxFieldsJson)
        return wrongJson(fmt::format("it would have {} bytes, {} are possible; store fewer points or times",
                                     text.size(), kMaxFieldsJson));
    return text;
}

}  // namespace svt::fields

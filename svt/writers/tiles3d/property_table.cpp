#include <svt/writers/tiles3d/property_table.hpp>

#include <svt/core/check.hpp>
#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/tiles3d/meshopt.hpp>

#include <algorithm>
#include <map>

namespace svt::writers {
namespace {

// A property of a class, which all rows have.
GltfBuffer::Json propertyOf(std::string_view description, const char* type) {
    GltfBuffer::Json property = GltfBuffer::Json::object();
    if (!description.empty()) property["description"] = description;
    property["type"] = type;
    property["required"] = true;
    return property;
}

}  // namespace

std::size_t GltfBuffer::add(std::span<const std::byte> bytes, int stride, int target) {
    bytes_.resize((bytes_.size() + 7) / 8 * 8, '\0');
    Json view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}};
    if (stride != 0) view["byteStride"] = stride;
    if (target != 0) view["target"] = target;
    bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    views_.push_back(std::move(view));
    return views_.size() - 1;
}

std::size_t GltfBuffer::addVertices(std::span<const std::byte> bytes, std::size_t each, int target) {
    if (!isCompressed_) return add(bytes, static_cast<int>(each), target);
    const std::size_t view =
        addCompressed(compressVertices(bytes, each), "ATTRIBUTES", bytes.size() / each, each, target);
    views_[view]["byteStride"] = each;
    return view;
}

std::size_t GltfBuffer::addIndices(std::span<const std::uint32_t> indices, std::size_t each, int target) {
    if (!isCompressed_ && each == 2) {
        const std::vector<std::uint16_t> small(indices.begin(), indices.end());
        return add(std::as_bytes(std::span(small)), 0, target);
    }
    if (!isCompressed_) return add(std::as_bytes(indices), 0, target);
    return addCompressed(compressIndices(indices), "INDICES", indices.size(), each, target);
}

std::size_t GltfBuffer::addCompressed(const std::string& packed, const char* mode, std::size_t count, std::size_t each,
                                      int target) {
    const std::size_t view = add(std::as_bytes(std::span(packed)), 0, target);
    Json own{{"buffer", 0}, {"byteOffset", views_[view]["byteOffset"]}, {"byteLength", packed.size()}};
    own["byteStride"] = each;
    own["count"] = count;
    own["mode"] = mode;
    views_[view]["buffer"] = 1;
    views_[view]["byteOffset"] = decoded_;
    views_[view]["byteLength"] = count * each;
    views_[view]["extensions"] = {{"EXT_meshopt_compression", std::move(own)}};
    decoded_ += (count * each + 7) / 8 * 8;
    return view;
}

std::string attributesText(const volume::Label& label) {
    GltfBuffer::Json texts = GltfBuffer::Json::object();
    for (const AttributeList& list : attributeLists(label.attributes)) {
        GltfBuffer::Json& value = texts[std::string(list.name)];
        if (list.isSingle())
            value = toText(list.items.front().attribute->value);
        else
            value = GltfBuffer::Json::parse(toJsonText(list), nullptr, false);
    }
    if (texts.empty()) return {};
    return texts.dump(-1, ' ', false, GltfBuffer::Json::error_handler_t::replace);
}

void PropertyTable::strings(const char* name, std::string_view description, const std::vector<std::string>& values) {
    SVT_CHECK(values.size() == rows_);
    std::string text;
    std::vector<std::uint32_t> offsets{0};
    for (const std::string& value : values) {
        text += validText(value);
        offsets.push_back(static_cast<std::uint32_t>(text.size()));
    }
    // A buffer view has a byte at least.
    if (text.empty()) text = " ";
    class_[name] = propertyOf(description, "STRING");
    const std::size_t view = buffer_.add(std::as_bytes(std::span(text)));
    table_[name] = {{"values", view}};
    addOffsets(offsets, table_[name]);
}

void PropertyTable::namesBesideIds(const std::vector<std::string>& names, const std::vector<std::string>& ids) {
    SVT_CHECK(names.size() == ids.size());
    for (std::size_t n = 0; n < names.size(); ++n)
        if (!names[n].empty() && names[n] != ids[n]) return strings("name", "", names);
}

void PropertyTable::names(const char* name, std::string_view description, const std::vector<std::string>& values) {
    SVT_CHECK(values.size() == rows_);
    std::map<std::string, std::uint32_t> numberOf;
    std::vector<std::uint32_t> numbers;
    Json choices = Json::array();
    for (const std::string& value : values) {
        const auto [at, isNew] = numberOf.try_emplace(validText(value), static_cast<std::uint32_t>(numberOf.size()));
        if (isNew) choices.push_back({{"name", at->first}, {"value", at->second}});
        numbers.push_back(at->second);
    }
    const auto [view, type] = addSmall(numbers);
    enums_[name] = {{"valueType", type}, {"values", std::move(choices)}};
    class_[name] = propertyOf(description, "ENUM");
    class_[name]["enumType"] = name;
    table_[name] = {{"values", view}};
}

std::pair<std::size_t, const char*> PropertyTable::addSmall(const std::vector<std::uint32_t>& values) {
    const std::uint32_t most = values.empty() ? 0 : *std::max_element(values.begin(), values.end());
    if (most > 0xFFFF) return {buffer_.add(std::as_bytes(std::span(values))), "UINT32"};
    if (most > 0xFF) {
        const std::vector<std::uint16_t> small(values.begin(), values.end());
        return {buffer_.add(std::as_bytes(std::span(small))), "UINT16"};
    }
    const std::vector<std::uint8_t> small(values.begin(), values.end());
    return {buffer_.add(std::as_bytes(std::span(small))), "UINT8"};
}

void PropertyTable::attributes(const std::vector<std::string>& values) {
    strings("attributes", "JSON; empty: none", values);
    class_["attributes"]["required"] = false;
    class_["attributes"]["noData"] = "";
    class_["attributes"]["default"] = "{}";
}

void PropertyTable::addOffsets(const std::vector<std::uint32_t>& offsets, Json& column) {
    const bool isLong = offsets.back() > 0xFFFF;
    column["stringOffsets"] = buffer_.addIndices(offsets, isLong ? 4 : 2, 0);
    if (!isLong) column["stringOffsetType"] = "UINT16";
}

void PropertyTable::numbers(const char* name, std::string_view description, const std::vector<double>& values) {
    SVT_CHECK(values.size() == rows_);
    const std::vector<float> floats(values.begin(), values.end());
    class_[name] = propertyOf(description, "SCALAR");
    class_[name]["componentType"] = "FLOAT32";
    table_[name] = {{"values", buffer_.add(std::as_bytes(std::span(floats)))}};
}
void PropertyTable::knownNumbers(const char* name, std::string_view description, const std::vector<double>& values) {
    numbers(name, description, values);
    class_[name]["required"] = false;
    class_[name]["noData"] = 0.0;
}

PropertyTable::Json PropertyTable::extension(const char* name) const {
    Json schema{{"id", "svt"}};
    if (!enums_.empty()) schema["enums"] = enums_;
    schema["classes"][name]["properties"] = class_;
    Json table{{"class", name}, {"count", rows_}, {"properties", table_}};
    return {{"schema", std::move(schema)}, {"propertyTables", Json::array({std::move(table)})}};
}

}  // namespace svt::writers

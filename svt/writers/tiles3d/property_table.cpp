#include <svt/writers/tiles3d/property_table.hpp>

#include <svt/core/check.hpp>
#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/tiles3d/meshopt.hpp>

#include <algorithm>
#include <map>

namespace svt::writers {
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
    const std::size_t view =
        addCompressed(compressVertices(bytes, each), "ATTRIBUTES", bytes.size() / each, each, target);
    views_[view]["byteStride"] = each;
    return view;
}

std::size_t GltfBuffer::addIndices(std::span<const std::uint32_t> indices, std::size_t each, int target) {
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
    class_[name] = {{"description", description}, {"type", "STRING"}, {"required", true}};
    const std::size_t view = buffer_.add(std::as_bytes(std::span(text)));
    table_[name] = {{"values", view}};
    addOffsets(offsets, table_[name]);
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
    class_[name] = {{"description", description}, {"type", "ENUM"}, {"enumType", name}, {"required", true}};
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
    strings("attributes", "attributes of the feature as JSON; none: an empty text, which stands for {}", values);
    class_["attributes"]["required"] = false;
    class_["attributes"]["noData"] = "";
    class_["attributes"]["default"] = "{}";
}

void PropertyTable::addOffsets(const std::vector<std::uint32_t>& offsets, Json& column) {
    if (offsets.back() > 0xFFFF) {
        column["stringOffsets"] = buffer_.add(std::as_bytes(std::span(offsets)));
        return;
    }
    const std::vector<std::uint16_t> small(offsets.begin(), offsets.end());
    column["stringOffsets"] = buffer_.add(std::as_bytes(std::span(small)));
    column["stringOffsetType"] = "UINT16";
}

template <class T>
void PropertyTable::column(const char* name, std::string_view description, const char* componentType,
                           const std::vector<T>& values) {
    SVT_CHECK(values.size() == rows_);
    class_[name] = {
        {"description", description}, {"type", "SCALAR"}, {"componentType", componentType}, {"required", true}};
    table_[name] = {{"values", buffer_.add(std::as_bytes(std::span(values)))}};
}

void PropertyTable::numbers(const char* name, std::string_view description, const std::vector<double>& values) {
    column(name, description, "FLOAT64", values);
}
void PropertyTable::knownNumbers(const char* name, std::string_view description, const std::vector<double>& values) {
    numbers(name, description, values);
    class_[name]["required"] = false;
    class_[name]["noData"] = 0.0;
}
void PropertyTable::numbers(const char* name, std::string_view description, const std::vector<std::uint32_t>& values) {
    SVT_CHECK(values.size() == rows_);
    const auto [view, type] = addSmall(values);
    class_[name] = {{"description", description}, {"type", "SCALAR"}, {"componentType", type}, {"required", true}};
    table_[name] = {{"values", view}};
}

PropertyTable::Json PropertyTable::extension(const char* name, std::string_view description) const {
    Json schema{{"id", "svt"}};
    if (!enums_.empty()) schema["enums"] = enums_;
    schema["classes"][name] = {{"name", name}, {"description", description}, {"properties", class_}};
    Json table{{"name", name}, {"class", name}, {"count", rows_}, {"properties", table_}};
    return {{"schema", std::move(schema)}, {"propertyTables", Json::array({std::move(table)})}};
}

}  // namespace svt::writers

#include <svt/core/file.hpp>
#include <svt/volume_readers/table/label_tables.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>

namespace svt::volume_readers {
namespace {

using TableJson = nlohmann::json;

constexpr std::uint64_t kMaxTableBytes = std::uint64_t{256} << 20;
constexpr std::uint64_t kMaxValue = 0xFFFFFFFFu;

Error badTable(std::size_t number, std::string_view what) {
    return Error(Code::BadJson, fmt::format("entry {} of 'labels' {}", number, what));
}

bool readValue(const TableJson& value, ToldLabel& label) {
    const auto isNumber = [](const TableJson& v) {
        return v.is_number_unsigned() && v.get<std::uint64_t>() <= kMaxValue;
    };
    if (isNumber(value)) {
        label.first = value.get<std::uint32_t>();
        return label.first > 0;
    }
    if (!value.is_array() || value.size() != 2 || !isNumber(value[0]) || !isNumber(value[1])) return false;
    const auto first = value[0].get<std::uint64_t>(), last = value[1].get<std::uint64_t>();
    if (first == 0 || last < first || last == kMaxValue) return false;
    label.first = static_cast<std::uint32_t>(first);
    label.count = static_cast<std::uint32_t>(last - first + 1);
    return true;
}

bool readColor(const TableJson& value, ToldLabel& label) {
    label.hasColor = true;
    if (value.is_array() && value.size() == 3) {
        for (int axis = 0; axis < 3; ++axis) {
            const TableJson& channel = value[static_cast<std::size_t>(axis)];
            if (!channel.is_number()) return false;
            label.color[axis] = channel.get<float>();
            if (!(label.color[axis] >= 0 && label.color[axis] <= 1)) return false;
        }
        return true;
    }
    if (!value.is_string()) return false;
    const auto& text = value.get_ref<const std::string&>();
    std::uint32_t code = 0;
    if (text.size() != 7 || text[0] != '#' ||
        std::from_chars(text.data() + 1, text.data() + 7, code, 16).ptr != text.data() + 7)
        return false;
    label.color = {float(code >> 16 & 255) / 255, float(code >> 8 & 255) / 255, float(code & 255) / 255};
    return true;
}

bool readAttributes(const TableJson& object, std::vector<Attribute>& attributes) {
    if (!object.is_object()) return false;
    for (const auto& [name, value] : object.items()) {
        Attribute& attribute = attributes.emplace_back();
        attribute.name = name;
        if (value.is_string())
            attribute.value = value.get<std::string>();
        else if (value.is_boolean())
            attribute.value = value.get<bool>();
        else if (value.is_number_integer())
            attribute.value = value.get<std::int64_t>();
        else if (value.is_number_float())
            attribute.value = value.get<double>();
        else
            return false;
    }
    return true;
}

Result<void> readEntry(const TableJson& entry, std::size_t number, UserTable& table) {
    if (!entry.is_object()) return badTable(number, "is not an object");
    ToldLabel label;
    label.count = 0;
    std::vector<Attribute> attributes;
    float opacity = 1;
    const auto text = [&](const char* key, std::string& to) {
        const auto found = entry.find(key);
        if (found == entry.end()) return true;
        if (!found->is_string()) return false;
        to = found->get<std::string>();
        return true;
    };
    for (const auto& [key, to] : {std::pair<const char*, std::string*>{"id", &label.id},
                                  {"class", &label.className},
                                  {"name", &label.name},
                                  {"parent", &label.parent}})
        if (!text(key, *to)) return badTable(number, fmt::format("has a '{}' that is not a string", key));
    if (const auto value = entry.find("value"); value != entry.end()) {
        label.count = 1;
        if (!readValue(*value, label))
            return badTable(number,
                            "has a 'value' that is not a whole number from 1 on or a range [first, last] of them");
    } else if (label.id.empty()) {
        return badTable(number, "has neither 'value' nor 'id'");
    }
    if (const auto color = entry.find("color"); color != entry.end() && !readColor(*color, label))
        return badTable(number, "has a 'color' that is neither \"#rrggbb\" nor three numbers from 0 to 1");
    if (const auto found = entry.find("opacity"); found != entry.end()) {
        opacity = found->is_number() ? found->get<float>() : -1;
        if (!(opacity >= 0 && opacity <= 1))
            return badTable(number, "has an 'opacity' that is not a number from 0 to 1");
    }
    if (const auto found = entry.find("attributes"); found != entry.end() && !readAttributes(*found, attributes))
        return badTable(number, "has 'attributes' that are not an object of strings, numbers, true and false");
    if (label.id.empty()) label.id = fmt::format("label-{}", label.first);
    table.told.push_back(std::move(label));
    table.attributes.push_back(std::move(attributes));
    table.opacities.push_back(opacity);
    return {};
}

}  // namespace

Result<UserTable> parseUserTable(std::string_view text) {
    if (text.size() > kMaxTableBytes)
        return Error(Code::InputTooBig,
                     fmt::format("a table of {} bytes; {} are possible", text.size(), kMaxTableBytes));
    UserTable table;
    TableJson root;
    try {
        root = TableJson::parse(text.begin(), text.end(),
                                [](int depth, TableJson::parse_event_t, TableJson&) { return depth <= 16; });
    } catch (const TableJson::exception& exception) {
        return Error(Code::BadJson, fmt::format("the table of labels is not valid JSON: {}", exception.what()));
    }
    const auto labels = root.is_object() ? root.find("labels") : root.end();
    if (!root.is_object() || labels == root.end() || !labels->is_array())
        return Error(Code::BadJson, "the table of labels has no list 'labels'");
    if (!labels->empty() && (*labels)[0].is_object() && (*labels)[0].contains("subtreeEnd")) {
        table.labelsJson = text;
        return table;
    }
    for (std::size_t number = 0; number < labels->size(); ++number) SVT_DO(readEntry((*labels)[number], number, table));
    return table;
}

Result<UserTable> readUserTable(const std::filesystem::path& path) {
    const Place place{path.string(), 0, 0, {}};
    SVT_TRY(file, FileBytes::read(path));
    auto table = parseUserTable(file->text());
    if (!table) return Error(table.error().code(), table.error().message(), place);
    return table;
}

}  // namespace svt::volume_readers

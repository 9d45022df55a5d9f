#include <svt/core/attribute.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace svt {
namespace {

void appendQuoted(std::string& out, std::string_view text) {
    out += '"';
    while (!text.empty()) {
        const auto [code, size] = firstCharacter(text);
        if (size == 0)
            out += "\xEF\xBF\xBD";
        else if (code == U'"' || code == U'\\')
            out.append({'\\', text[0]});
        else if (code < 0x20)
            out += fmt::format("\\u{:04x}", static_cast<unsigned>(code));
        else
            out += text.substr(0, static_cast<std::size_t>(size));
        text.remove_prefix(static_cast<std::size_t>(std::max<int>(size, 1)));
    }
    out += '"';
}

void appendJson(std::string& out, const Attribute* attribute) {
    const AttributeValue* value = attribute == nullptr ? nullptr : &attribute->value;
    const auto* real = value == nullptr ? nullptr : std::get_if<double>(value);
    if (value == nullptr || (real != nullptr && !std::isfinite(*real)))
        out += "null";
    else if (const auto* text = std::get_if<std::string>(value))
        appendQuoted(out, *text);
    else
        out += toText(*value);
}

// Calls use(path) for each path above `name`, and for `name` itself.
template <class Use>
void forEachPath(std::string_view name, const Use& use) {
    for (std::size_t at = name.find('/'); at != std::string_view::npos; at = name.find('/', at + 1))
        use(name.substr(0, at));
    use(name);
}

// The number of records of each property that has several.
std::map<std::string_view, std::uint32_t> recordCounts(std::span<const Attribute> attributes) {
    std::map<std::string_view, std::uint32_t> counts;
    for (const Attribute& attribute : attributes) {
        if (attribute.record == 0) continue;
        const std::string_view name = attribute.name;
        const std::size_t slash = name.rfind('/');
        std::uint32_t& count = counts[slash == std::string_view::npos ? name : name.substr(0, slash)];
        count = std::max(count, attribute.record + 1);
    }
    return counts;
}

// Adds items without a value for records that lack one.
void fillGaps(AttributeList& list, std::uint32_t count, std::size_t& mostGaps) {
    std::vector<AttributeList::Item> items;
    std::uint32_t record = 0;
    std::size_t gaps = 0;
    const auto fillTo = [&](std::uint32_t end) {
        for (; record < end && gaps <= mostGaps; ++record, ++gaps) items.push_back({nullptr, record});
    };
    for (const AttributeList::Item& item : list.items) {
        fillTo(item.record);
        items.push_back(item);
        record = item.record + 1;
    }
    fillTo(count);
    if (gaps > mostGaps) return;
    mostGaps -= gaps;
    list.items = std::move(items);
}

}  // namespace

std::string toText(const AttributeValue& value) {
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *integer);
    if (const auto* real = std::get_if<double>(&value)) return fmt::format("{}", *real);
    return std::get<bool>(value) ? "true" : "false";
}

std::vector<AttributeList> attributeLists(std::span<const Attribute> attributes) {
    std::vector<AttributeList> lists;
    std::map<std::string_view, std::size_t> placeOf;
    for (const Attribute& attribute : attributes) {
        const auto [place, isNew] = placeOf.emplace(attribute.name, lists.size());
        if (isNew) lists.push_back({attribute.name, {}});
        lists[place->second].items.push_back({&attribute, attribute.record});
    }
    const std::map<std::string_view, std::uint32_t> counts = recordCounts(attributes);
    if (counts.empty()) return lists;
    std::size_t mostGaps = kMostGaps;
    for (AttributeList& list : lists) {
        std::stable_sort(list.items.begin(), list.items.end(),
                         [](const auto& a, const auto& b) { return a.record < b.record; });
        std::uint32_t count = 0;
        forEachPath(list.name, [&](std::string_view path) {
            if (const auto known = counts.find(path); known != counts.end()) count = std::max(count, known->second);
        });
        if (count > 0) fillGaps(list, count, mostGaps);
    }
    return lists;
}

std::string toJsonText(const AttributeList& list) {
    const auto& items = list.items;
    const bool hasRecords = items.front().record != items.back().record;
    std::string out = "[";
    for (std::size_t begin = 0, end = 0; begin < items.size(); begin = end) {
        end = begin + 1;
        while (hasRecords && end < items.size() && items[end].record == items[begin].record) ++end;
        if (begin > 0) out += ',';
        if (end - begin > 1) out += '[';
        for (std::size_t n = begin; n < end; ++n) {
            if (n > begin) out += ',';
            appendJson(out, items[n].attribute);
        }
        if (end - begin > 1) out += ']';
    }
    return out + ']';
}

std::string toText(const AttributeList& list) {
    return list.isSingle() ? toText(list.items.front().attribute->value) : toJsonText(list);
}

}  // namespace svt

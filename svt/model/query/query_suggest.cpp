#include <svt/core/edit_distance.hpp>
#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>
#include <svt/model/query.hpp>
#include <svt/model/query/query_node.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

namespace svt::model {
namespace {

using query::Node;
using Rows = std::span<const QueryRow>;
using Names = std::set<std::string_view>;

// A misspelled name is short; comparing a long one with all ids would be slow.
constexpr std::size_t kMaxNameBytes = 100;
constexpr std::size_t kMaxListed = 8;

/// The nearest of `names`, else the shortest that contains `wanted`, else empty. Ties: the first alphabetically.
std::string_view nearest(std::string_view wanted, const Names& names) {
    if (wanted.empty() || wanted.size() > kMaxNameBytes) return {};
    std::size_t limit = std::max<std::size_t>(1, wanted.size() / 3);
    std::string_view best;
    for (const std::string_view name : names) {
        const std::size_t steps = editDistance(wanted, name, limit);
        if (steps > limit || (!best.empty() && steps == limit)) continue;
        best = name;
        limit = steps;
    }
    if (!best.empty()) return best;
    for (const std::string_view name : names)
        if (query::containsWord(name, wanted) && (best.empty() || name.size() < best.size())) best = name;
    return best;
}

/// "no class 'BuildingRom'; did you mean 'BuildingRoom'?", or a list of the names if none is near and there are few.
std::string describe(std::string_view what, std::string_view wanted, const Names& names, std::string_view plural) {
    std::string text = fmt::format("no {} '{}'", what, wanted);
    if (const std::string_view name = nearest(wanted, names); !name.empty())
        return fmt::format("{}; did you mean '{}'?", text, name);
    if (names.empty()) return fmt::format("{}; there are no {}", text, plural);
    if (names.size() > kMaxListed) return text;
    std::string list;
    for (const std::string_view name : names) list += fmt::format("{}'{}'", list.empty() ? "" : ", ", name);
    return fmt::format("{}; there {} {}", text, names.size() == 1 ? "is only" : "are", list);
}

std::string unknownClass(const Node& node, Rows rows) {
    std::set<std::string> owned;
    for (const QueryRow& row : rows) owned.insert(canonicalClassName(row.className));
    // Classes of the source are suggested only if the query names one.
    if (lowerAscii(node.value.substr(0, 3)) == "ifc")
        for (const QueryRow& row : rows)
            if (const std::string_view source = query::sourceClass(row); !source.empty()) {
                owned.emplace(source);
                for (const std::string_view tail : {"StandardCase", "ElementedCase"})
                    if (source.ends_with(tail)) owned.emplace(source.substr(0, source.size() - tail.size()));
            }
    Names names(owned.begin(), owned.end());
    for (const std::string_view name : names)
        if (equalsIgnoringCase(name, node.value)) return {};
    return describe("class", node.value, names, "classes");
}

/// Ids and names of the rows that satisfy `isAsked`.
template <class Condition>
std::string unknownIdOrName(std::string_view what, std::string_view plural, bool withIds, bool withNames,
                            const Node& node, Rows rows, const Condition& isAsked) {
    Names names;
    for (const QueryRow& row : rows) {
        if (!isAsked(row)) continue;
        if (withIds) names.insert(row.id);
        if (withNames && !row.name.empty()) names.insert(row.name);
    }
    return names.contains(node.value) ? std::string() : describe(what, node.value, names, plural);
}

std::string unknownAttribute(const Node& node, Rows rows) {
    Names names, values;
    bool hasNumbers = false;
    std::vector<std::string> owned;
    for (const QueryRow& row : rows)
        for (const Attribute& attribute : row.attributes) {
            names.insert(attribute.name);
            if (!equalsIgnoringCase(attribute.name, node.name)) continue;
            const auto* text = std::get_if<std::string>(&attribute.value);
            if (text != nullptr) values.insert(*text);
            hasNumbers = hasNumbers || text == nullptr;
        }
    const bool isKnown = hasNumbers || !values.empty();
    if (!isKnown) {
        for (const std::string_view key : {"class", "id", "name", "storey", "volume", "voxels"}) names.insert(key);
        return describe("attribute", node.name, names, "attributes");
    }
    const bool isEquality = node.op == Node::Op::Equal || node.op == Node::Op::NotEqual;
    if (!isEquality || hasNumbers || values.contains(node.value)) return {};
    double number = 0;
    const auto parsed = std::from_chars(node.value.data(), node.value.data() + node.value.size(), number);
    if (parsed.ec == std::errc() && parsed.ptr == node.value.data() + node.value.size()) return {};
    return describe(node.name, node.value, values, "values");
}

std::string unknownIn(const Node& node, Rows rows) {
    const auto any = [](const QueryRow&) { return true; };
    switch (node.kind) {
        case Node::Kind::And:
        case Node::Kind::Or:
        case Node::Kind::Not:
            for (const Node& child : node.children)
                if (std::string text = unknownIn(child, rows); !text.empty()) return text;
            return {};
        case Node::Kind::Under:
            return unknownIdOrName("feature with the id or name", "features", true, true, node, rows, any);
        case Node::Kind::Compare: break;
        default: return {};
    }
    if (node.key == Node::Key::Attribute) return unknownAttribute(node, rows);
    if (node.op != Node::Op::Equal && node.op != Node::Op::NotEqual) return {};
    switch (node.key) {
        case Node::Key::Class: return unknownClass(node, rows);
        case Node::Key::Id: return unknownIdOrName("id", "ids", true, false, node, rows, any);
        case Node::Key::Name: return unknownIdOrName("name", "names", false, true, node, rows, any);
        case Node::Key::Storey: return unknownIdOrName("storey", "storeys", true, true, node, rows, query::isStorey);
        default: return {};
    }
}

}  // namespace

std::string Query::unknownValue(std::span<const QueryRow> rows) const { return unknownIn(*root_, rows); }

}  // namespace svt::model

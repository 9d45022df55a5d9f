#include <svt/core/text.hpp>
#include <svt/model/query.hpp>

#include <svt/model/classes.hpp>
#include <svt/model/query/query_node.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>

namespace svt::model {

using query::Node;

namespace {

using Kind = Node::Kind;
using Key = Node::Key;
using Op = Node::Op;
using Rows = std::span<const QueryRow>;
using Mask = std::vector<char>;  ///< per row: 1 if it matches

constexpr std::size_t kMaxSearchedBytes = 4096;

template <class T>
bool parses(std::string_view text, T& value) noexcept {
    // from_chars also accepts "inf" and "nan", which are names rather than numbers here.
    const bool looksNumeric = !text.empty() && (text[0] == '-' || text[0] == '.' || isDigit(text[0]));
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    return looksNumeric && parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
}

template <class T>
bool holds(Op op, const T& left, const T& right) {
    switch (op) {
        case Op::Equal: return left == right;
        case Op::NotEqual: return left != right;
        case Op::Less: return left < right;
        case Op::LessEqual: return left <= right;
        case Op::Greater: return left > right;
        case Op::GreaterEqual: return left >= right;
        default: return false;
    }
}

bool isFound(const Node& node, std::string_view text) {
    return node.pattern->isFoundIn(text.substr(0, kMaxSearchedBytes)) == (node.op == Op::Found);
}

bool textHolds(const Node& node, std::string_view text) {
    return node.pattern ? isFound(node, text) : holds(node.op, text, std::string_view(node.value));
}

bool numberHolds(const Node& node, double number) {
    double value = 0;
    return parses(node.value, value) && holds(node.op, number, value);
}

bool attributeHolds(const Node& node, const AttributeValue& attribute) {
    const auto* known = std::get_if<std::string>(&attribute);
    const std::string made = known == nullptr ? toText(attribute) : std::string();
    const std::string_view text = known == nullptr ? made : *known;
    if (node.pattern) return isFound(node, text);
    // Integers first: doubles lose digits of large numbers.
    std::int64_t leftInteger = 0, rightInteger = 0;
    if (parses(text, leftInteger) && parses(node.value, rightInteger)) return holds(node.op, leftInteger, rightInteger);
    double left = 0, right = 0;
    if (parses(text, left) && parses(node.value, right)) return holds(node.op, left, right);
    if (std::holds_alternative<bool>(attribute) && equalsIgnoringCase(text, node.value)) return holds(node.op, 0, 0);
    return holds(node.op, text, std::string_view(node.value));
}

bool anyAttributeHolds(const Node& node, const QueryRow& row) {
    return std::any_of(row.attributes.begin(), row.attributes.end(), [&](const Attribute& attribute) {
        return equalsIgnoringCase(attribute.name, node.name) && attributeHolds(node, attribute.value);
    });
}

// IfcWall also matches IfcWallStandardCase, a wall of a simple shape.
bool isSourceClass(std::string_view source, std::string_view wanted) {
    if (source.size() < wanted.size() || !equalsIgnoringCase(source.substr(0, wanted.size()), wanted)) return false;
    const std::string_view rest = source.substr(wanted.size());
    return !source.empty() && (rest.empty() || rest == "StandardCase" || rest == "ElementedCase");
}

// A row with two class names matches by either: class=IfcWall and class=BuildingConstructiveElement both select it.
bool classHolds(const Node& node, const QueryRow& row) {
    const std::string name = canonicalClassName(row.className);
    const std::string_view source = query::sourceClass(row);
    if (node.pattern) {
        const bool isPositive = node.op == Op::Found;
        const bool first = isFound(node, name);
        return source.empty() ? first : isPositive ? first || isFound(node, source) : first && isFound(node, source);
    }
    const bool isSame = equalsIgnoringCase(name, node.value) || isSourceClass(source, node.value);
    return isSame == (node.op == Op::Equal);
}

/// Descendants of each row: by the tree and by group membership.
struct Descendants {
    std::vector<std::uint32_t> begins, rows;  ///< below row i: rows[begins[i]] .. rows[begins[i + 1]]

    explicit Descendants(Rows all) : begins(all.size() + 1, 0) {
        const auto forEachAbove = [&](std::size_t i, const auto& visit) {
            if (all[i].parent < all.size()) visit(all[i].parent);
            for (const std::uint32_t group : all[i].groups)
                if (group < all.size()) visit(group);
        };
        for (std::size_t i = 0; i < all.size(); ++i) forEachAbove(i, [&](std::uint32_t above) { ++begins[above + 1]; });
        for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
        rows.resize(begins.back());
        std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
        for (std::size_t i = 0; i < all.size(); ++i)
            forEachAbove(i, [&](std::uint32_t above) { rows[next[above]++] = static_cast<std::uint32_t>(i); });
    }

    /// All rows reachable downwards from the rows where `isStart`; start rows are included only if reached.
    [[nodiscard]] Mask reachedFrom(const Mask& isStart) const {
        Mask isReached(isStart.size(), 0);
        std::vector<std::uint32_t> stack;
        for (std::size_t i = 0; i < isStart.size(); ++i)
            if (isStart[i]) stack.push_back(static_cast<std::uint32_t>(i));
        while (!stack.empty()) {
            const std::uint32_t above = stack.back();
            stack.pop_back();
            for (std::uint32_t k = begins[above]; k < begins[above + 1]; ++k) {
                if (isReached[rows[k]]) continue;
                isReached[rows[k]] = 1;
                if (!isStart[rows[k]]) stack.push_back(rows[k]);
            }
        }
        return isReached;
    }
};

/// The rows in `among` that match; other rows do not match.
template <class Condition>
Mask rowsWhere(Rows rows, const Mask& among, const Condition& condition) {
    Mask mask = among;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (among[i]) mask[i] = condition(rows[i]) ? 1 : 0;
    return mask;
}

template <class Condition>
Mask rowsWhere(Rows rows, const Condition& condition) {
    return rowsWhere(rows, Mask(rows.size(), 1), condition);
}

/// Values of several terms of one kind, so that a row is compared with all of them at once.
class Values {
public:
    template <class Wanted>
    Values(const std::vector<Node>& terms, const Wanted& wanted) {
        for (const Node& term : terms)
            if (wanted(term)) values_.emplace_back(term.value);
        std::sort(values_.begin(), values_.end());
    }
    [[nodiscard]] bool isEmpty() const { return values_.empty(); }
    [[nodiscard]] bool contain(std::string_view value) const {
        return std::binary_search(values_.begin(), values_.end(), value);
    }

private:
    std::vector<std::string_view> values_;
};

bool isUnder(const Node& node) { return node.kind == Kind::Under; }
bool isOfId(const Node& node) {
    return node.kind == Kind::Compare && node.key == Key::Id && node.op == Op::Equal && !node.pattern;
}

template <class IsStart>
Mask selectBelow(Rows rows, const IsStart& isStart) {
    const Mask starts = rowsWhere(
        rows, [&](const QueryRow& row) { return isStart(row.id) || (!row.name.empty() && isStart(row.name)); });
    Mask mask = Descendants(rows).reachedFrom(starts);
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] |= starts[i];
    return mask;
}

Mask selectUnder(const Node& node, Rows rows) {
    return selectBelow(rows, [&](std::string_view name) { return name == node.value; });
}

/// Used for != and !~ too: a row in two storeys matches if one of them differs.
Mask selectStorey(const Node& node, Rows rows) {
    const Mask starts = rowsWhere(rows, [&](const QueryRow& row) {
        if (!query::isStorey(row)) return false;
        const bool hasName = !row.name.empty();
        const bool isWanted = node.op == Op::Equal || node.op == Op::Found;
        const auto matches = [&](std::string_view text) {
            return node.pattern ? node.pattern->isFoundIn(text.substr(0, kMaxSearchedBytes)) : text == node.value;
        };
        return (matches(row.id) || (hasName && matches(row.name))) == isWanted;
    });
    return Descendants(rows).reachedFrom(starts);
}

Mask selectCompare(const Node& node, Rows rows, const Mask& among) {
    switch (node.key) {
        case Key::Class: return rowsWhere(rows, among, [&](const QueryRow& row) { return classHolds(node, row); });
        case Key::Id: return rowsWhere(rows, among, [&](const QueryRow& row) { return textHolds(node, row.id); });
        case Key::Name:
            return rowsWhere(rows, among,
                             [&](const QueryRow& row) { return !row.name.empty() && textHolds(node, row.name); });
        case Key::Storey: return selectStorey(node, rows);
        case Key::Volume:
            return rowsWhere(rows, among,
                             [&](const QueryRow& row) { return row.volume && numberHolds(node, *row.volume); });
        case Key::Voxels:
            return rowsWhere(rows, among,
                             [&](const QueryRow& row) { return numberHolds(node, static_cast<double>(row.voxels)); });
        case Key::Attribute:
            return rowsWhere(rows, among, [&](const QueryRow& row) { return anyAttributeHolds(node, row); });
    }
    return Mask(rows.size(), 0);
}

/// The rows that match, of those in `among`; others may match or not.
Mask evaluate(const Node& node, Rows rows, const Mask& among);

/// Thousands of ids take one search per row, instead of one pass over the rows per id.
Mask selectAny(const std::vector<Node>& terms, Rows rows, const Mask& among) {
    const Values ids(terms, isOfId), above(terms, isUnder);
    Mask mask(rows.size(), 0);
    const auto add = [&](const Mask& other) {
        for (std::size_t i = 0; i < mask.size(); ++i) mask[i] |= other[i];
    };
    if (!ids.isEmpty()) add(rowsWhere(rows, [&](const QueryRow& row) { return ids.contain(row.id); }));
    if (!above.isEmpty()) add(selectBelow(rows, [&](std::string_view name) { return above.contain(name); }));
    for (const Node& term : terms)
        if (!isOfId(term) && !isUnder(term)) add(evaluate(term, rows, among));
    return mask;
}

/// The parser limits the depth of nodes.
Mask evaluate(const Node& node, Rows rows, const Mask& among) {
    switch (node.kind) {
        case Kind::All: return Mask(rows.size(), 1);
        case Kind::None: return Mask(rows.size(), 0);
        case Kind::Under: return selectUnder(node, rows);
        case Kind::Compare: return selectCompare(node, rows, among);
        case Kind::Not: {
            Mask mask = evaluate(node.children.front(), rows, among);
            for (char& matches : mask) matches ^= 1;
            return mask;
        }
        case Kind::Or: return selectAny(node.children, rows, among);
        case Kind::And: {
            Mask mask = among;
            for (const Node& child : node.children) {
                const Mask other = evaluate(child, rows, mask);
                for (std::size_t i = 0; i < mask.size(); ++i) mask[i] &= other[i];
            }
            return mask;
        }
    }
    return Mask(rows.size(), 0);
}

}  // namespace

namespace query {

std::string_view sourceClass(const QueryRow& row) noexcept {
    for (const Attribute& attribute : row.attributes)
        if (attribute.name == "ifcType")
            if (const auto* type = std::get_if<std::string>(&attribute.value)) return *type;
    return {};
}

bool containsWord(std::string_view text, std::string_view word) noexcept {
    return std::search(text.begin(), text.end(), word.begin(), word.end(),
                       [](char x, char y) { return lowerAscii(x) == lowerAscii(y); }) != text.end();
}

bool isStorey(const QueryRow& row) {
    const std::string className = canonicalClassName(row.className);
    if (className == "Storey") return true;
    if (className != "CityObjectGroup") return false;
    return std::any_of(row.attributes.begin(), row.attributes.end(), [](const Attribute& attribute) {
        const bool says = equalsIgnoringCase(attribute.name, "function") ||
                          equalsIgnoringCase(attribute.name, "class") || equalsIgnoringCase(attribute.name, "usage");
        const auto* text = std::get_if<std::string>(&attribute.value);
        return says && text != nullptr &&
               (containsWord(*text, "storey") || containsWord(*text, "geschoss") ||
                containsWord(*text, "gescho\u00df"));
    });
}

}  // namespace query

Result<Query> Query::parse(std::string_view text) {
    SVT_TRY(root, query::parse(text));
    return Query(std::string(text), std::make_shared<const Node>(std::move(*root)));
}

std::vector<std::uint32_t> Query::select(std::span<const QueryRow> rows) const {
    const Mask mask = evaluate(*root_, rows, Mask(rows.size(), 1));
    std::vector<std::uint32_t> selected;
    for (std::size_t i = 0; i < mask.size(); ++i)
        if (mask[i]) selected.push_back(static_cast<std::uint32_t>(i));
    return selected;
}

Result<QueryValue> parseQueryValue(std::string_view text, std::string_view form) {
    const std::size_t colon = text.rfind(':');
    const auto value =
        colon == std::string_view::npos ? std::nullopt : parseNumber(withoutBlanks(text.substr(colon + 1)));
    if (!value || colon == 0) return Error(Code::BadArgument, fmt::format("'{}' is not {}", text, form));
    SVT_DO(Query::parse(text.substr(0, colon)));
    return QueryValue{std::string(text.substr(0, colon)), *value};
}

}  // namespace svt::model

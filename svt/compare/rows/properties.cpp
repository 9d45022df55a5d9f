#include <svt/compare/rows/properties.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>
#include <variant>

namespace svt::compare {
namespace {

// Other programs round numbers to 32 bits.
bool areRounded(const AttributeList& a, const AttributeList& b) {
    if (!a.isSingle() || !b.isSingle()) return false;
    const auto* p = std::get_if<double>(&a.items.front().attribute->value);
    const auto* q = std::get_if<double>(&b.items.front().attribute->value);
    return p != nullptr && q != nullptr && std::abs(*p - *q) <= 0x1p-23 * std::max(std::abs(*p), std::abs(*q));
}

bool areEqual(const AttributeList& a, const AttributeList& b) {
    const auto unitOf = [](const AttributeList& list) {
        const Attribute* first = list.items.front().attribute;
        return first != nullptr ? std::string_view(first->unit) : std::string_view();
    };
    return unitOf(a) == unitOf(b) && (toText(a) == toText(b) || areRounded(a, b));
}

std::vector<AttributeChange> changesOf(const std::vector<Attribute>& was, const std::vector<Attribute>& is) {
    std::vector<AttributeChange> changes;
    if (was == is) return changes;
    std::map<std::string_view, std::pair<std::optional<AttributeList>, std::optional<AttributeList>>> byName;
    for (AttributeList& list : attributeLists(was)) byName[list.name].first = std::move(list);
    for (AttributeList& list : attributeLists(is)) byName[list.name].second = std::move(list);
    for (auto& [name, lists] : byName)
        if (!lists.first || !lists.second || !areEqual(*lists.first, *lists.second))
            changes.push_back({std::string(name), std::move(lists.first), std::move(lists.second)});
    return changes;
}

// The text of an attribute with one value; null for other values.
const std::string* singleText(const std::optional<AttributeList>& list) {
    return list && list->isSingle() ? std::get_if<std::string>(&list->items.front().attribute->value) : nullptr;
}

}  // namespace

std::uint32_t FeatureIds::find(std::string_view id) {
    if (!isFilled_)
        for (std::uint32_t l = 0; l < table_.labels.size(); ++l)
            if (const auto [at, isNew] = labels_.try_emplace(table_.labels[l].id, l); !isNew)
                at->second = volume::kNoLabel;
    isFilled_ = true;
    const auto at = labels_.find(id);
    return at == labels_.end() ? volume::kNoLabel : at->second;
}

void compareProperties(const volume::SemanticVolume& was, const volume::SemanticVolume& is, const FeaturePairs& pairs,
                       const std::vector<std::uint32_t>& wasStoreys, const std::vector<std::uint32_t>& isStoreys,
                       FeatureIds& wasIds, FeatureIds& isIds, ComparisonRow& row) {
    if (row.was.size() != 1 || row.is.size() != 1) return;
    const volume::Label &a = was.labels.labels[row.was[0]], &b = is.labels.labels[row.is[0]];
    row.hasOtherId = a.id != b.id;
    row.hasOtherClass = a.className != b.className;
    row.hasOtherName = a.name != b.name;
    const std::uint32_t before = wasStoreys[row.was[0]], after = isStoreys[row.is[0]];
    const std::uint32_t expected = before == volume::kNoLabel ? volume::kNoLabel : pairs.isOfWas[before];
    row.hasOtherStorey = expected != after || (before == volume::kNoLabel) != (after == volume::kNoLabel);
    row.attributes = changesOf(a.attributes, b.attributes);
    std::erase_if(row.attributes, [&](const AttributeChange& change) {
        const std::string *oldText = singleText(change.was), *newText = singleText(change.is);
        if (oldText == nullptr || newText == nullptr) return false;
        const std::uint32_t old = wasIds.find(*oldText), now = isIds.find(*newText);
        return old != volume::kNoLabel && now != volume::kNoLabel && pairs.isOfWas[old] == now;
    });
}

}  // namespace svt::compare

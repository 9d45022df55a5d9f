#include <svt/compare/rows/properties.hpp>

#include <map>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>

namespace svt::compare {
namespace {

using Key = std::tuple<std::string_view, std::string_view>;

// The features without a partner by a key; kNoLabel where several have the key.
template <class KeyOf>
std::map<Key, std::uint32_t> openGroups(const volume::SemanticVolume& volume, const std::vector<char>& hasGeometry,
                                        const std::vector<std::uint32_t>& partners, const KeyOf& keyOf) {
    std::map<Key, std::uint32_t> found;
    const auto& labels = volume.labels.labels;
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        if (hasGeometry[l] != 0 || partners[l] != volume::kNoLabel) continue;
        if (const auto [at, isNew] = found.try_emplace(keyOf(labels[l]), l); !isNew) at->second = volume::kNoLabel;
    }
    return found;
}

bool areEqual(const AttributeList& a, const AttributeList& b) {
    const auto unitOf = [](const AttributeList& list) {
        const Attribute* first = list.items.front().attribute;
        return first != nullptr ? std::string_view(first->unit) : std::string_view();
    };
    return toText(a) == toText(b) && unitOf(a) == unitOf(b);
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

void matchGroups(const volume::SemanticVolume& was, const volume::SemanticVolume& is,
                 const std::vector<char>& hasGeometryOfWas, const std::vector<char>& hasGeometryOfIs,
                 FeaturePairs& pairs) {
    const auto pairBy = [&](const auto& keyOf) {
        const auto before = openGroups(was, hasGeometryOfWas, pairs.isOfWas, keyOf);
        const auto after = openGroups(is, hasGeometryOfIs, pairs.wasOfIs, keyOf);
        for (const auto& [key, old] : before) {
            const auto at = after.find(key);
            if (old == volume::kNoLabel || at == after.end() || at->second == volume::kNoLabel) continue;
            pairs.isOfWas[old] = at->second;
            pairs.wasOfIs[at->second] = old;
        }
    };
    pairBy([](const volume::Label& label) { return Key(label.className, label.id); });
    pairBy([](const volume::Label& label) { return Key(label.className, label.name); });
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
        const std::string *before = singleText(change.was), *after = singleText(change.is);
        if (before == nullptr || after == nullptr) return false;
        const std::uint32_t old = wasIds.find(*before), now = isIds.find(*after);
        return old != volume::kNoLabel && now != volume::kNoLabel && pairs.isOfWas[old] == now;
    });
}

}  // namespace svt::compare

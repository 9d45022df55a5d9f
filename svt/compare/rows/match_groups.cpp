#include <svt/compare/rows/match_groups.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace svt::compare {
namespace {

constexpr int kMostRounds = 64;  // each pairs at least one more feature

using GroupKey = std::tuple<std::string_view, std::string_view, std::uint32_t>;

// One state, and the partners of its features.
struct GroupSide {
    const std::vector<volume::Label>& labels;
    const std::vector<char>& hasGeometry;
    std::vector<std::uint32_t>& partners;

    [[nodiscard]] bool isOpen(std::uint32_t l) const { return hasGeometry[l] == 0 && partners[l] == volume::kNoLabel; }
};

class GroupMatcher {
public:
    GroupMatcher(const GroupSide& was, const GroupSide& is) : was_(was), is_(is) {}

    std::size_t run(MatchBy by) {
        const auto byId = [](const volume::Label& label) { return GroupKey(label.className, label.id, 0); };
        const auto byName = [](const volume::Label& label) { return GroupKey(label.className, label.name, 0); };
        pairUnique([&](const GroupSide& side, std::uint32_t l) { return std::optional(byId(side.labels[l])); });
        if (by == MatchBy::Id) return 0;
        const auto pairOnce = [&] {
            std::size_t found = pairByMembers();
            found += pairUnique([&](const GroupSide& side, std::uint32_t l) { return keyWithParent(side, l); });
            found += pairUnique(
                [&](const GroupSide& side, std::uint32_t l) { return std::optional(byName(side.labels[l])); });
            return found;
        };
        for (int round = 0; round < kMostRounds && pairOnce() > 0; ++round) {
        }
        pairEqual();
        return countAmbiguous(byName);
    }

private:
    void pair(std::uint32_t was, std::uint32_t is) {
        was_.partners[was] = is;
        is_.partners[is] = was;
    }

    // The old parent as a part of the key, for both states; nothing if the parent has no partner.
    [[nodiscard]] std::optional<std::uint32_t> pairedParent(const GroupSide& side, std::uint32_t l) const {
        const std::uint32_t parent = side.labels[l].parent;
        if (parent == volume::kNoLabel) return volume::kNoLabel;
        const std::uint32_t partner = side.partners[parent];
        if (partner == volume::kNoLabel) return std::nullopt;
        return &side == &was_ ? parent : partner;
    }
    [[nodiscard]] std::optional<GroupKey> keyWithParent(const GroupSide& side, std::uint32_t l) const {
        const auto parent = pairedParent(side, l);
        if (!parent) return std::nullopt;
        return GroupKey(side.labels[l].className, side.labels[l].name, *parent);
    }

    // Pairs the open features whose key is unique in both states. Returns the number of pairs.
    template <class KeyOf>
    std::size_t pairUnique(const KeyOf& keyOf) {
        const auto uniqueOf = [&](const GroupSide& side) {
            std::map<GroupKey, std::uint32_t> found;
            for (std::uint32_t l = 0; l < side.labels.size(); ++l) {
                if (!side.isOpen(l)) continue;
                const std::optional<GroupKey> key = keyOf(side, l);
                if (!key) continue;
                if (const auto [at, isNew] = found.try_emplace(*key, l); !isNew) at->second = volume::kNoLabel;
            }
            return found;
        };
        const auto before = uniqueOf(was_), after = uniqueOf(is_);
        std::size_t count = 0;
        for (const auto& [key, old] : before) {
            const auto at = after.find(key);
            if (old == volume::kNoLabel || at == after.end() || at->second == volume::kNoLabel) continue;
            pair(old, at->second);
            ++count;
        }
        return count;
    }

    // Calls use(above) for the parent and the groups of a feature that are open.
    template <class Use>
    static void forEachOpenAbove(const GroupSide& side, std::uint32_t l, const Use& use) {
        const volume::Label& label = side.labels[l];
        if (label.parent != volume::kNoLabel && side.isOpen(label.parent)) use(label.parent);
        for (const std::uint32_t group : label.groups)
            if (group != label.parent && group < side.labels.size() && side.isOpen(group)) use(group);
    }

    std::size_t pairByMembers() {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> common;
        std::vector<std::size_t> ofWas(was_.labels.size(), 0), ofIs(is_.labels.size(), 0);
        for (std::uint32_t l = 0; l < was_.labels.size(); ++l) {
            const std::uint32_t partner = was_.partners[l];
            if (partner == volume::kNoLabel) continue;
            forEachOpenAbove(was_, l, [&](std::uint32_t above) { ++ofWas[above]; });
            forEachOpenAbove(is_, partner, [&](std::uint32_t above) { ++ofIs[above]; });
            forEachOpenAbove(was_, l, [&](std::uint32_t old) {
                forEachOpenAbove(is_, partner, [&](std::uint32_t now) { ++common[{old, now}]; });
            });
        }
        std::vector<std::pair<std::uint32_t, std::uint32_t>> candidates;
        for (const auto& [groups, members] : common) {
            const auto [old, now] = groups;
            if (was_.labels[old].className == is_.labels[now].className && 2 * members > ofWas[old] &&
                2 * members > ofIs[now])
                candidates.push_back(groups);
        }
        // Among groups with the same members, names decide.
        return pairSingle(candidates, true) + pairSingle(candidates, false);
    }

    // Pairs the open candidates that are the only one of both features. \param isNamed  only those with one name
    std::size_t pairSingle(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& candidates, bool isNamed) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> open;
        std::map<std::uint32_t, std::size_t> ofWas, ofIs;
        for (const auto& [old, now] : candidates) {
            if (!was_.isOpen(old) || !is_.isOpen(now)) continue;
            if (isNamed && was_.labels[old].name != is_.labels[now].name) continue;
            open.emplace_back(old, now);
            ++ofWas[old];
            ++ofIs[now];
        }
        std::size_t count = 0;
        for (const auto& [old, now] : open) {
            if (ofWas[old] != 1 || ofIs[now] != 1) continue;
            pair(old, now);
            ++count;
        }
        return count;
    }

    // All attributes as one text.
    static std::string textOf(const std::vector<Attribute>& attributes) {
        std::string text;
        for (const AttributeList& list : attributeLists(attributes)) {
            const std::string value = toText(list);
            text += fmt::format("{}:{}={}:{};", list.name.size(), list.name, value.size(), value);
        }
        return text;
    }

    // Whichever of them are paired, no difference is lost or invented.
    void pairEqual() {
        using Lists = std::map<std::pair<GroupKey, std::string>, std::vector<std::uint32_t>>;
        const auto listsOf = [&](const GroupSide& side) {
            std::vector<char> hasMembers(side.labels.size(), 0);
            for (const volume::Label& label : side.labels) {
                if (label.parent != volume::kNoLabel) hasMembers[label.parent] = 1;
                for (const std::uint32_t group : label.groups)
                    if (group < side.labels.size()) hasMembers[group] = 1;
            }
            Lists lists;
            for (std::uint32_t l = 0; l < side.labels.size(); ++l) {
                if (!side.isOpen(l) || hasMembers[l] != 0) continue;
                if (const auto key = keyWithParent(side, l))
                    lists[{*key, textOf(side.labels[l].attributes)}].push_back(l);
            }
            return lists;
        };
        const Lists before = listsOf(was_), after = listsOf(is_);
        for (const auto& [key, old] : before) {
            const auto at = after.find(key);
            if (at == after.end()) continue;
            for (std::size_t n = 0; n < std::min(old.size(), at->second.size()); ++n) pair(old[n], at->second[n]);
        }
    }

    template <class KeyOf>
    [[nodiscard]] std::size_t countAmbiguous(const KeyOf& keyOf) const {
        std::map<GroupKey, std::pair<std::size_t, std::size_t>> open;
        for (std::uint32_t l = 0; l < was_.labels.size(); ++l)
            if (was_.isOpen(l)) ++open[keyOf(was_.labels[l])].first;
        for (std::uint32_t l = 0; l < is_.labels.size(); ++l)
            if (is_.isOpen(l)) ++open[keyOf(is_.labels[l])].second;
        std::size_t count = 0;
        for (const auto& [key, counts] : open)
            if (counts.first > 0 && counts.second > 0) count += counts.first + counts.second;
        return count;
    }

    GroupSide was_, is_;
};

}  // namespace

std::size_t matchGroups(const volume::SemanticVolume& was, const volume::SemanticVolume& is, MatchBy by,
                        const std::vector<char>& hasGeometryOfWas, const std::vector<char>& hasGeometryOfIs,
                        FeaturePairs& pairs) {
    return GroupMatcher({was.labels.labels, hasGeometryOfWas, pairs.isOfWas},
                        {is.labels.labels, hasGeometryOfIs, pairs.wasOfIs})
        .run(by);
}

}  // namespace svt::compare

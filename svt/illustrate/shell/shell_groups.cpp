#include <svt/illustrate/shell_groups.hpp>

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/selection.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::illustrate {
namespace {

using volume::kNoLabel;
using Holders = std::array<std::uint32_t, kNames<ShellLevel>.size()>;

constexpr std::array<std::string_view, kNames<ShellLevel>.size()> kPlurals{"components", "rooms", "units", "storeys",
                                                                           "buildings"};
constexpr std::size_t kComponent = 0, kRoom = 1, kUnit = 2, kStorey = 3, kBuilding = 4,
                      kLevels = kNames<ShellLevel>.size();

// Level of a feature that can hold others; kComponent for all others.
std::size_t levelOf(const model::QueryRow& row, std::span<const model::QueryRow> rows) {
    switch (model::classRank(row.className)) {
        case model::ClassRank::Room: return kRoom;
        case model::ClassRank::Unit: return kUnit;
        case model::ClassRank::Storey: return kStorey;
        case model::ClassRank::Building: {
            const bool isPart = row.className == "BuildingPart" && row.parent < rows.size() &&
                                model::classRank(rows[row.parent].className) == model::ClassRank::Building;
            return isPart ? kUnit : kBuilding;
        }
        default: return model::query::isStorey(row) ? kStorey : kComponent;
    }
}

std::size_t lowest(const Holders& holders) {
    std::size_t level = kRoom;
    while (level < kLevels && holders[level] == kNoLabel) ++level;
    return level;
}

// Finds the holders of each feature by tree and groups. Depth first, parent before groups; cycles are cut where they
// close.
class TreeHolders {
public:
    explicit TreeHolders(std::span<const model::QueryRow> rows)
        : rows_(rows), holders_(rows.size()), state_(rows.size(), State::New) {}

    std::vector<Holders> find() {
        for (std::uint32_t l = 0; l < rows_.size(); ++l) visit(l);
        return std::move(holders_);
    }

private:
    enum class State : std::uint8_t { New, Open, Done };

    // A feature above `l` in the hierarchy: number 0 is the parent, the groups follow.
    [[nodiscard]] std::uint32_t above(std::uint32_t l, std::size_t number) const {
        return number == 0 ? rows_[l].parent : rows_[l].groups[number - 1];
    }

    void visit(std::uint32_t start) {
        if (state_[start] != State::New) return;
        stack_.assign(1, {start, 0});
        state_[start] = State::Open;
        while (!stack_.empty()) {
            auto& [l, next] = stack_.back();
            if (next <= rows_[l].groups.size()) {
                const std::uint32_t a = above(l, next++);
                if (a < rows_.size() && state_[a] == State::New) {
                    state_[a] = State::Open;
                    stack_.emplace_back(a, 0);
                }
                continue;
            }
            close(l);
            stack_.pop_back();
        }
    }

    void close(std::uint32_t l) {
        Holders& holders = holders_[l];
        holders.fill(kNoLabel);
        holders[kComponent] = l;
        const std::size_t own = levelOf(rows_[l], rows_);
        if (own != kComponent) holders[own] = l;
        for (std::size_t number = 0; number <= rows_[l].groups.size(); ++number) {
            const std::uint32_t a = above(l, number);
            if (a >= rows_.size() || state_[a] != State::Done) continue;
            for (std::size_t level = std::max(own, kRoom); level < kLevels; ++level)
                if (holders[level] == kNoLabel) holders[level] = holders_[a][level];
            // If buildings are nested, the outermost counts.
            if (own == kBuilding && holders_[a][kBuilding] != kNoLabel) holders[kBuilding] = holders_[a][kBuilding];
        }
        // Holders of the lowest holder contain this one, too.
        const std::size_t low = lowest(holders);
        if (low < kLevels && holders[low] != l && state_[holders[low]] == State::Done)
            for (std::size_t level = low + 1; level < kLevels; ++level)
                if (const std::uint32_t h = holders_[holders[low]][level]; h != kNoLabel) holders[level] = h;
        state_[l] = State::Done;
    }

    std::span<const model::QueryRow> rows_;
    std::vector<Holders> holders_;
    std::vector<State> state_;
    std::vector<std::pair<std::uint32_t, std::size_t>> stack_;
};

// The lowest holder above kComponent that all `spaces` share, as a level; kLevels where there is none.
std::size_t sharedLevel(std::span<const std::uint32_t> spaces, const std::vector<Holders>& holders) {
    for (std::size_t level = kRoom; level < kLevels; ++level) {
        const std::uint32_t first = holders[spaces.front()][level];
        if (first != kNoLabel && std::all_of(spaces.begin(), spaces.end(),
                                             [&](std::uint32_t space) { return holders[space][level] == first; }))
            return level;
    }
    return kLevels;
}

// Holders of a component that touches `spaces`.
Holders lowered(Holders own, std::span<const std::uint32_t> spaces, const std::vector<Holders>& holders) {
    const std::size_t low = lowest(own), shared = sharedLevel(spaces, holders);
    if (shared >= low) return own;
    const Holders& found = holders[holders[spaces.front()][shared]];
    if (low < kLevels && found[low] != own[low]) return own;
    for (std::size_t level = shared; level < low; ++level) own[level] = found[level];
    for (std::size_t level = low; level < kLevels; ++level)
        if (own[level] == kNoLabel) own[level] = found[level];
    return own;
}

}  // namespace

ShellHierarchy ShellHierarchy::ofVolume(const volume::SemanticVolume& volume, int threads) {
    const std::vector<model::QueryRow> rows = analyze::queryRows(volume.labels);
    const auto count = static_cast<std::uint32_t>(rows.size());
    ShellHierarchy hierarchy;
    const std::vector<Holders> byTree = TreeHolders(rows).find();

    // A component includes all below it that is not in a room.
    hierarchy.component_.resize(count);
    std::vector<bool> isComponent(count);
    for (std::uint32_t l = 0; l < count; ++l) {
        const std::uint32_t parent = rows[l].parent;
        isComponent[l] = levelOf(rows[l], rows) == kComponent && byTree[l][kRoom] == kNoLabel;
        const bool isPart = isComponent[l] && parent < l && isComponent[parent];
        hierarchy.component_[l] = isPart ? hierarchy.component_[parent] : l;
        hierarchy.hasVoxels_.push_back(volume.labels.labels[l].voxels > 0);
    }

    std::vector<std::vector<std::uint32_t>> touched(count);
    const auto touch = [&](std::uint32_t a, std::uint32_t b) {
        if (!isComponent[a] || isComponent[b]) return;
        const std::size_t low = lowest(byTree[b]);
        if (low < kBuilding) touched[hierarchy.component_[a]].push_back(byTree[b][low]);
    };
    for (const analyze::Contact& contact : analyze::findContacts(volume.columns, volume.grid, volume.labels, threads)) {
        if (contact.b == kNoLabel) continue;
        touch(contact.a, contact.b);
        touch(contact.b, contact.a);
    }

    hierarchy.holders_ = byTree;
    for (std::uint32_t l = 0; l < count; ++l) {
        if (!isComponent[l]) continue;
        const std::uint32_t component = hierarchy.component_[l];
        Holders& holders = hierarchy.holders_[l];
        if (component != l)
            holders = hierarchy.holders_[component];
        else if (!touched[l].empty())
            holders = lowered(holders, touched[l], byTree);
        holders[kComponent] = l;
    }
    return hierarchy;
}

std::vector<std::uint32_t> ShellHierarchy::groups(ShellLevel level) const {
    std::vector<std::uint32_t> groups(holders_.size());
    for (std::size_t l = 0; l < groups.size(); ++l) {
        auto at = static_cast<std::size_t>(level);
        while (at > kComponent && holders_[l][at] == kNoLabel) --at;
        groups[l] = level != ShellLevel::Component && at == kComponent ? component_[l] : holders_[l][at];
    }
    return groups;
}

std::vector<ShellStep> ShellHierarchy::steps() const {
    std::vector<ShellStep> steps;
    std::vector<bool> isSeen;
    for (const auto& [level, name] : kNames<ShellLevel>) {
        ShellStep step{level, 0, 0};
        const std::vector<std::uint32_t> group = groups(level);
        isSeen.assign(group.size(), false);
        for (std::size_t l = 0; l < group.size(); ++l) {
            if (!hasVoxels_[l] || isSeen[group[l]]) continue;
            isSeen[group[l]] = true;
            ++step.groups;
            step.features += holders_[l][static_cast<std::size_t>(level)] == group[l] ? 1 : 0;
        }
        if (step.features != 0 || level == ShellLevel::Component) steps.push_back(step);
    }
    return steps;
}

std::vector<ShellStep> shellLevels(const volume::SemanticVolume& volume) {
    return ShellHierarchy::ofVolume(volume).steps();
}

Result<std::vector<std::uint32_t>> groupLabels(const volume::SemanticVolume& volume, ShellLevel level, int threads) {
    const ShellHierarchy hierarchy = ShellHierarchy::ofVolume(volume, threads);
    std::string known;
    for (const ShellStep& step : hierarchy.steps()) {
        if (step.level == level) return hierarchy.groups(level);
        known += fmt::format("{}{}", known.empty() ? "" : ", ", nameOf(step.level));
    }
    return Error(Code::NothingSelected, fmt::format("the model has no {} with voxels; its levels are: {}",
                                                    kPlurals[static_cast<std::size_t>(level)], known));
}

}  // namespace svt::illustrate

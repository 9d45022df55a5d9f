#include <svt/analyze/extents.hpp>

#include <svt/model/classes.hpp>

#include <algorithm>

namespace svt::analyze {
namespace {

using model::ClassRank;
using volume::Filling;
using volume::kNoLabel;

}  // namespace

Extents::Extents(const volume::LabelTable& table)
    : labels_(table.labels),
      firstMember_(table.labels.size() + 1, 0),
      ends_(table.labels.size()),
      kinds_(table.labels.size(), Kind::Unknown),
      reached_(table.labels.size(), 0) {
    for (const volume::Label& label : labels_)
        for (const std::uint32_t group : label.groups) ++firstMember_[group + 1];
    for (std::size_t l = 0; l < labels_.size(); ++l) firstMember_[l + 1] += firstMember_[l];
    members_.resize(firstMember_.back());
    std::vector<std::uint32_t> next(firstMember_.begin(), firstMember_.end() - 1);
    const auto count = static_cast<std::uint32_t>(labels_.size());
    for (std::uint32_t l = 0; l < count; ++l) ends_[l] = std::clamp(labels_[l].subtreeEnd, l + 1, count);
    for (std::uint32_t l = 0; l < labels_.size(); ++l)
        for (const std::uint32_t group : labels_[l].groups) members_[next[group]++] = l;
}

bool Extents::hasParts(std::uint32_t label) const {
    return ends_[label] > label + 1 || firstMember_[label] < firstMember_[label + 1];
}

// Found once per label, because classes are texts.
Extents::Kind Extents::kindOf(std::uint32_t label) const {
    Kind& kind = kinds_[label];
    if (kind != Kind::Unknown) return kind;
    const std::string& name = labels_[label].className;
    const ClassRank rank = model::classRank(name);
    const bool isSpace = rank == ClassRank::Room || rank == ClassRank::Unit || rank == ClassRank::Other;
    return kind = model::isBoundarySurface(name) ? Kind::Surface : isSpace ? Kind::Space : Kind::Material;
}

Extents::Reach Extents::reachOf(std::uint32_t root) const {
    return kindOf(root) == Kind::Space ? Reach::Space : Reach::All;
}

Extents::Reach Extents::reachOf(Reach above, std::uint32_t part) const {
    if (above == Reach::All) return Reach::All;
    if (above != Reach::Sheets && kindOf(part) != Kind::Surface) return reachOf(part);
    const Filling filling = labels_[part].filling;
    return filling == Filling::Surface || filling == Filling::None ? Reach::Sheets : Reach::None;
}

// Calls use(label) once for each label of the extent, until it returns false. \return whether it never did
template <class Visit>
bool Extents::visit(std::uint32_t root, const Visit& use) const {
    struct Step {
        std::uint32_t label;
        Reach reach;
    };
    const std::uint64_t number = 4 * ++visits_;
    std::vector<Step> open;
    // A label that is entered again with a greater reach is walked again, but not used again.
    const auto enter = [&](std::uint32_t label, Reach reach) -> bool {
        const std::uint64_t stamp = number + static_cast<std::uint64_t>(reach);
        if (reach == Reach::None || reached_[label] >= stamp) return true;
        const bool isNew = reached_[label] < number;
        reached_[label] = stamp;
        if (hasParts(label)) open.push_back({label, reach});
        return !isNew || use(label);
    };
    if (!enter(root, reachOf(root))) return false;
    while (!open.empty()) {
        const auto [label, reach] = open.back();
        open.pop_back();
        for (std::uint32_t child = label + 1; child < ends_[label]; child = ends_[child])
            if (!enter(child, reachOf(reach, child))) return false;
        for (std::uint32_t m = firstMember_[label]; m < firstMember_[label + 1]; ++m)
            if (!enter(members_[m], reachOf(reach, members_[m]))) return false;
    }
    return true;
}

std::vector<std::uint32_t> Extents::of(std::uint32_t label) const {
    std::vector<std::uint32_t> found;
    (void)visit(label, [&](std::uint32_t part) {
        found.push_back(part);
        return true;
    });
    std::sort(found.begin(), found.end());
    return found;
}

Measure Extents::total(std::uint32_t label, std::span<const Measure> own) const {
    Measure total;
    (void)visit(label, [&](std::uint32_t part) {
        total.add(own[part]);
        return true;
    });
    return total;
}

std::vector<std::uint32_t> Extents::of(std::span<const std::uint32_t> labels) const {
    std::vector<std::uint32_t> all;
    for (const std::uint32_t label : labels) {
        const std::vector<std::uint32_t> one = of(label);
        all.insert(all.end(), one.begin(), one.end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

bool Extents::standsForParts(std::uint32_t label) const {
    if (!hasParts(label)) return false;
    // A window stands for its panes.
    std::uint32_t part = label + 1;
    while (part < ends_[label] && model::isPhase(labels_[part].className)) ++part;
    if (part > label + 1 && part == ends_[label]) return true;
    return labels_[label].count == 0 || model::classRank(labels_[label].className) >= ClassRank::Unit;
}

// Calls use(label, isWhole) for each selected label; whole: it stands for its extent.
template <class Use>
void Extents::forEachWhole(std::span<const std::uint32_t> selected, const Use& use) const {
    std::vector<char> isSelected(labels_.size(), 0);
    for (const std::uint32_t label : selected) isSelected[label] = 1;
    for (const std::uint32_t label : selected) {
        const auto isFree = [&](std::uint32_t part) { return part == label || isSelected[part] == 0; };
        use(label, standsForParts(label) && visit(label, isFree));
    }
}

std::vector<std::vector<std::uint32_t>> Extents::wholes(std::span<const std::uint32_t> selected) const {
    std::vector<std::vector<std::uint32_t>> wholes;
    wholes.reserve(selected.size());
    forEachWhole(selected, [&](std::uint32_t label, bool isWhole) {
        wholes.push_back(isWhole ? of(label) : std::vector<std::uint32_t>{label});
    });
    return wholes;
}

std::vector<std::uint32_t> Extents::withParts(std::span<const std::uint32_t> selected) const {
    std::vector<std::uint32_t> all(selected.begin(), selected.end());
    forEachWhole(selected, [&](std::uint32_t label, bool isWhole) {
        if (!isWhole) return;
        const std::vector<std::uint32_t> extent = of(label);
        all.insert(all.end(), extent.begin(), extent.end());
    });
    if (all.size() == selected.size()) return all;
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

NeighborFinder::NeighborFinder(std::span<const Contact> contacts, std::size_t labelCount)
    : contacts_(contacts), firstContact_(labelCount + 1, 0), area_(labelCount + 1, 0), isInside_(labelCount, 0) {
    const auto forEachEnd = [&](const auto& use) {
        for (std::uint32_t c = 0; c < contacts.size(); ++c) {
            use(contacts[c].a, c);
            if (contacts[c].b != kNoLabel) use(contacts[c].b, c);
        }
    };
    forEachEnd([&](std::uint32_t label, std::uint32_t) { ++firstContact_[label + 1]; });
    for (std::size_t l = 0; l < labelCount; ++l) firstContact_[l + 1] += firstContact_[l];
    contactsOf_.resize(firstContact_.back());
    std::vector<std::uint32_t> next(firstContact_.begin(), firstContact_.end() - 1);
    forEachEnd([&](std::uint32_t label, std::uint32_t c) { contactsOf_[next[label]++] = c; });
}

std::vector<Neighbor> NeighborFinder::of(std::span<const std::uint32_t> extent) const {
    const std::size_t background = isInside_.size();
    for (const std::uint32_t label : extent) isInside_[label] = 1;
    std::vector<Neighbor> neighbors;
    for (const std::uint32_t label : extent)
        for (std::uint32_t at = firstContact_[label]; at < firstContact_[label + 1]; ++at) {
            const Contact& contact = contacts_[contactsOf_[at]];
            const std::uint32_t other = contact.a == label ? contact.b : contact.a;
            if (other != kNoLabel && isInside_[other] != 0) continue;
            double& area = area_[other == kNoLabel ? background : other];
            if (area == 0) neighbors.push_back({other, 0});
            area += contact.area;
        }
    for (Neighbor& neighbor : neighbors) {
        double& area = area_[neighbor.label == kNoLabel ? background : neighbor.label];
        neighbor.area = area;
        area = 0;
    }
    for (const std::uint32_t label : extent) isInside_[label] = 0;
    std::sort(neighbors.begin(), neighbors.end(), [](const Neighbor& a, const Neighbor& b) {
        return a.area != b.area ? a.area > b.area : a.label < b.label;
    });
    return neighbors;
}

std::vector<FeatureMeasure> measureFeatures(const Extents& extents, std::span<const std::uint32_t> selected,
                                            std::span<const Measure> own, std::span<const Contact> contacts) {
    const NeighborFinder neighbors(contacts, own.size());
    std::vector<FeatureMeasure> measures;
    measures.reserve(selected.size());
    for (const std::uint32_t label : selected) {
        FeatureMeasure& measure = measures.emplace_back();
        measure.label = label;
        measure.own = own[label];
        measure.total = extents.total(label, own);
        if (contacts.empty()) continue;
        const std::vector<std::uint32_t> extent = extents.of(label);
        if (extent.size() == 1) {
            measure.total = measure.own;
            continue;
        }
        for (const Neighbor& neighbor : neighbors.of(extent)) {
            measure.total.area += neighbor.area;
            if (neighbor.label == kNoLabel) measure.total.outsideArea += neighbor.area;
        }
    }
    return measures;
}

}  // namespace svt::analyze

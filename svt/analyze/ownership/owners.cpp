#include <svt/analyze/owners.hpp>

#include <svt/analyze/extents.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/analyze/selection.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <map>
#include <numeric>

namespace svt::analyze {
namespace {

using volume::kNoLabel;

// Entry per label: whether it is a space, or a sheet that bounds one, which lies inside of it. Surfaces that stand for
// material are walls.
std::vector<bool> findSpaces(const std::vector<volume::Label>& labels) {
    std::vector<bool> isSpace(labels.size());
    for (std::size_t l = 0; l < labels.size(); ++l) {
        const std::uint32_t parent = labels[l].parent;
        isSpace[l] = model::isSpace(labels[l].className) ||
                     (parent < l && isSpace[parent] && model::isBoundarySurface(labels[l].className) &&
                      labels[l].filling != volume::Filling::Body);
    }
    return isSpace;
}

void addShare(std::vector<OwnerShare>& shares, const OwnerShare& share) {
    const auto at = std::lower_bound(shares.begin(), shares.end(), share.owner,
                                     [](const OwnerShare& known, std::uint32_t owner) { return known.owner < owner; });
    if (at == shares.end() || at->owner != share.owner)
        shares.insert(at, share);
    else {
        at->area += share.area;
        at->volume += share.volume;
    }
}

double unownedOf(const std::vector<OwnerFraction>& owners) noexcept {
    double rest = 1;
    for (const OwnerFraction& owner : owners) rest -= owner.fraction;
    return rest > 1e-9 ? rest : 0;
}

// Entry per label: the holder whose extent has it; kNoLabel: none or several.
std::vector<std::uint32_t> holdersOf(const std::vector<std::uint32_t>& holders, const Extents& extents,
                                     std::size_t count) {
    std::vector<std::uint32_t> holderOf(count, kNoLabel);
    std::vector<char> isKnown(count, 0);
    for (const std::uint32_t holder : holders)
        for (const std::uint32_t part : extents.of(holder)) {
            holderOf[part] = isKnown[part] != 0 ? kNoLabel : holder;
            isKnown[part] = 1;
        }
    return holderOf;
}

class Divider {
public:
    Divider(const volume::SemanticVolume& volume, const OwnerTable& table)
        : labels_(volume.labels.labels),
          table_(table),
          volumes_(ownVolumes(volume.labels, volume.grid)),
          isSpace_(findSpaces(labels_)),
          shares_(labels_.size()),
          hasOneSetOfOwners_(labels_.size(), true),
          firstTouched_(labels_.size(), kNoLabel) {}

    Ownership run(const volume::LabelTable& labels, const std::vector<Contact>& contacts) {
        for (const Contact& contact : contacts) {
            if (contact.b == kNoLabel) continue;
            if (isComponent(contact.a) && !isComponent(contact.b))
                touch(contact.a, contact.b, contact.area);
            else if (isComponent(contact.b) && !isComponent(contact.a))
                touch(contact.b, contact.a, contact.area);
        }
        result_.owners.resize(table_.names.size());
        for (std::uint32_t l = 0; l < labels_.size(); ++l) {
            result_.all += volumes_[l];
            if (isComponent(l))
                divide(l);
            else
                giveToOwners(l);
        }
        addFeatures();
        addCommon(labels);
        return std::move(result_);
    }

private:
    [[nodiscard]] bool isOwned(std::uint32_t l) const { return !table_.ofLabel[l].empty(); }
    [[nodiscard]] bool isComponent(std::uint32_t l) const { return !isOwned(l) && !isSpace_[l]; }

    void touch(std::uint32_t component, std::uint32_t space, double area) {
        const std::vector<OwnerFraction>& owners = table_.ofLabel[space];
        for (const auto& [owner, fraction] : owners) addShare(shares_[component], {owner, area * fraction, 0});
        if (const double rest = unownedOf(owners); rest > 0) addShare(shares_[component], {kNoOwner, area * rest, 0});
        std::uint32_t& first = firstTouched_[component];
        if (first == kNoLabel) first = space;
        if (table_.ofLabel[first] != owners) hasOneSetOfOwners_[component] = false;
    }

    void giveToOwners(std::uint32_t l) {
        for (const auto& [owner, fraction] : table_.ofLabel[l]) result_.owners[owner].own += volumes_[l] * fraction;
        result_.unownedSpaces += volumes_[l] * unownedOf(table_.ofLabel[l]);
    }

    void divide(std::uint32_t l) {
        std::vector<OwnerShare>& shares = shares_[l];
        double area = 0;
        for (const OwnerShare& share : shares) area += share.area;
        if (!(area > 0)) {
            result_.untouched += volumes_[l];
            return;
        }
        for (OwnerShare& share : shares) {
            share.volume = volumes_[l] * share.area / area;
            if (share.owner == kNoOwner) {
                result_.unowned += share.volume;
                continue;
            }
            OwnerTotal& total = result_.owners[share.owner];
            (hasOneSetOfOwners_[l] ? total.alone : total.shared) += share.volume;
        }
        for (const OwnerShare& share : shares)
            for (const OwnerShare& other : shares)
                if (share.owner != kNoOwner && other.owner != share.owner)
                    addShare(result_.owners[share.owner].with, {other.owner, share.area, share.volume});
        result_.components.push_back({l, std::move(shares)});
    }

    void addFeatures() {
        std::vector<std::uint32_t> featuresOf(labels_.size(), 0);
        for (const OwnedFeature& feature : table_.features)
            for (const std::uint32_t part : feature.parts) ++featuresOf[part];
        for (const OwnedFeature& feature : table_.features) {
            double& sum = result_.ofFeature.emplace_back(0);
            for (const std::uint32_t part : feature.parts) sum += volumes_[part] / featuresOf[part];
        }
        for (const std::uint32_t l : table_.shared) result_.shared += volumes_[l];
    }

    // Adds everything that is not in the table, by building and storey.
    void addCommon(const volume::LabelTable& labels) {
        const std::vector<model::QueryRow> rows = queryRows(labels);
        std::vector<std::uint32_t> buildings, storeys;
        for (std::uint32_t l = 0; l < labels_.size(); ++l) {
            const auto isBuilding = [&](std::uint32_t of) {
                return model::classRank(labels_[of].className) == model::ClassRank::Building;
            };
            const std::uint32_t parent = labels_[l].parent;
            if (isBuilding(l) && (parent == kNoLabel || !isBuilding(parent))) buildings.push_back(l);
            if (model::query::isStorey(rows[l])) storeys.push_back(l);
        }
        const Extents extents(labels);
        const auto buildingOf = holdersOf(buildings, extents, labels_.size());
        const auto storeyOf = holdersOf(storeys, extents, labels_.size());
        std::map<std::pair<std::uint32_t, std::uint32_t>, CommonProperty> common;
        for (std::uint32_t l = 0; l < labels_.size(); ++l) {
            if (isOwned(l) || !(volumes_[l] > 0)) continue;
            CommonProperty& to = common[{buildingOf[l], storeyOf[l]}];
            (isSpace_[l] ? to.spaces : to.components) += volumes_[l];
        }
        for (auto& [place, property] : common) {
            property.building = place.first;
            property.storey = place.second;
            result_.common.push_back(property);
        }
    }

    const std::vector<volume::Label>& labels_;
    const OwnerTable& table_;
    std::vector<double> volumes_;
    std::vector<bool> isSpace_;
    std::vector<std::vector<OwnerShare>> shares_;  // by component
    std::vector<bool> hasOneSetOfOwners_;          // by component: all spaces that it touches have the same owners
    std::vector<std::uint32_t> firstTouched_;      // by component: a space that it touches
    Ownership result_;
};

}  // namespace

Ownership divideByOwners(const volume::SemanticVolume& volume, const std::vector<Contact>& contacts,
                         const OwnerTable& table) {
    return Divider(volume, table).run(volume.labels, contacts);
}

}  // namespace svt::analyze

#include <svt/quantities/quantities.hpp>

#include <svt/model/classes.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace svt::quantities {
namespace {

using Known = std::optional<double>;

// The sum of a figure; unknown if one is unknown.
Known sumOf(const std::vector<const ObjectQuantities*>& objects, Known ObjectQuantities::*figure) {
    Known sum = 0.0;
    for (const ObjectQuantities* object : objects) {
        if (!(object->*figure)) return {};
        *sum += *(object->*figure);
    }
    return sum;
}

ObjectQuantities whole(std::uint32_t root, const std::vector<const ObjectQuantities*>& objects) {
    if (objects.size() == 1) {
        ObjectQuantities only = *objects.front();
        only.label = root;
        return only;
    }
    ObjectQuantities sum;
    sum.label = root;
    for (const ObjectQuantities* object : objects) {
        sum.parts.insert(sum.parts.end(), object->parts.begin(), object->parts.end());
        sum.trust = std::max(sum.trust, object->trust);
    }
    std::sort(sum.parts.begin(), sum.parts.end());
    for (Known ObjectQuantities::*figure :
         {&ObjectQuantities::netVolume, &ObjectQuantities::grossVolume, &ObjectQuantities::grossBound,
          &ObjectQuantities::sideArea, &ObjectQuantities::topArea, &ObjectQuantities::bottomArea,
          &ObjectQuantities::outerArea, &ObjectQuantities::openingArea})
        sum.*figure = sumOf(objects, figure);
    if (sum.netVolume) sum.bound = sumOf(objects, &ObjectQuantities::bound);
    if (!sum.netVolume) sum.trust = Trust::Unknown;
    if (sum.openingArea) {
        sum.openings = 0;
        for (const ObjectQuantities* object : objects) *sum.openings += object->openings.value_or(0);
    }
    return sum;
}

}  // namespace

std::vector<ObjectQuantities> buildingQuantities(const volume::SemanticVolume& volume,
                                                 std::span<const ObjectQuantities> objects) {
    const auto& labels = volume.labels.labels;
    std::vector<std::uint32_t> rootOf(labels.size());
    for (std::uint32_t l = 0; l < labels.size(); ++l) rootOf[l] = labels[l].parent < l ? rootOf[labels[l].parent] : l;
    enum Kind : std::size_t { kBody, kComponent, kSheet, kKinds };
    std::map<std::uint32_t, std::array<std::vector<const ObjectQuantities*>, kKinds>> byRoot;
    for (const ObjectQuantities& object : objects) {
        const std::uint32_t root = rootOf[object.label];
        if (model::classRank(labels[root].className) != model::ClassRank::Building) continue;
        const volume::Label& label = labels[object.label];
        const bool isBody = model::classRank(label.className) == model::ClassRank::Building;
        if (isBody)
            byRoot[root][kBody].push_back(&object);
        else if (isComponent(label))
            byRoot[root][kComponent].push_back(&object);
        else if (isBoundarySheet(label))
            byRoot[root][kSheet].push_back(&object);
    }
    std::vector<ObjectQuantities> buildings;
    for (const auto& [root, kinds] : byRoot)
        for (const auto& kind : kinds) {
            if (kind.empty()) continue;
            buildings.push_back(whole(root, kind));
            break;
        }
    return buildings;
}

}  // namespace svt::quantities

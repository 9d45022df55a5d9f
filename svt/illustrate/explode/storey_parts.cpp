#include <svt/illustrate/explode/storey_parts.hpp>

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/drawing/building_levels.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace svt::illustrate {
namespace {

constexpr double kWhole = 0.85;       // share of a label's height in one storey for which it moves as a whole
constexpr double kSlab = 0.3;         // metres below a floor: thickness of the slab if there is no ceiling
constexpr double kLeastStorey = 1.5;  // metres; lower levels are landings
constexpr std::int32_t kAbove = std::numeric_limits<std::int32_t>::max();

bool isRoom(const volume::Label& label) {
    return model::isSpace(label.className) && model::classRank(label.className) == model::ClassRank::Room;
}

// A storey of a building, and the samples of its rooms or, without rooms, of all its labels.
struct Storey {
    std::uint32_t label = volume::kNoLabel;
    double floor = 0;                           // sample of the lowest of most of it
    std::int32_t ceiling = -1;                  // above the rooms of most of it; -1: no rooms
    std::map<std::int32_t, double> lows, tops;  // weight by sample
};

std::int32_t heaviest(const std::map<std::int32_t, double>& weights) {
    return std::max_element(weights.begin(), weights.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
}

// The storeys of one building, the lowest first, and where labels without storey are cut: entry n below storey n + 1.
struct Building {
    std::vector<Storey> storeys;
    std::vector<std::int32_t> cuts;
};

class PartFinder {
public:
    explicit PartFinder(const volume::SemanticVolume& volume)
        : volume_(volume),
          labels_(volume.labels.labels),
          boxes_(analyze::labelBoxes(volume.columns, volume.labels)),
          storeyOf_(drawing::storeysOfLabels(volume.labels)) {}

    StoreyParts find() {
        findBuildings();
        StoreyParts parts;
        parts.ofLabel.assign(labels_.size(), {{kAbove, 0}});
        for (const auto& [root, building] : buildings_)
            parts.highest = std::max(parts.highest, static_cast<int>(building.storeys.size()) - 1);
        for (std::uint32_t l = 0; l < labels_.size(); ++l)
            if (!boxes_[l].isEmpty()) parts.ofLabel[l] = partsOf(l);
        return parts;
    }

private:
    void addTo(Storey& storey, std::uint32_t label) const {
        const auto weight = static_cast<double>(labels_[label].voxels);
        storey.lows[boxes_[label].min.z] += weight;
        storey.tops[boxes_[label].max.z + 1] += weight;
    }

    void findBuildings() {
        std::map<std::uint32_t, Storey> storeys;
        for (const bool onlyRooms : {true, false})
            for (std::uint32_t l = 0; l < labels_.size(); ++l) {
                const std::uint32_t at = storeyOf_[l];
                if (at == volume::kNoLabel || boxes_[l].isEmpty() || l == at || isRoom(labels_[l]) != onlyRooms)
                    continue;
                Storey& storey = storeys[at];
                storey.label = at;
                if (onlyRooms || storey.ceiling < 0) addTo(storey, l);
                if (onlyRooms) storey.ceiling = 0;
            }
        for (auto& [label, storey] : storeys) {
            storey.floor = heaviest(storey.lows);
            if (storey.ceiling == 0) storey.ceiling = heaviest(storey.tops);
            buildings_[labels_[label].parent].storeys.push_back(std::move(storey));
        }
        if (buildings_.empty()) findLevelsInstead();
        for (auto& [root, building] : buildings_) cut(building);
    }

    // Where the model names no storeys: one building with the levels of all.
    void findLevelsInstead() {
        const double spacing = volume_.grid.spacing().z;
        Building building;
        for (const drawing::BuildingLevel& level : drawing::findLevels(volume_)) {
            Storey& storey = building.storeys.emplace_back();
            storey.floor = level.floor / spacing;
        }
        for (std::uint32_t l = 0; l < labels_.size(); ++l) {
            if (boxes_[l].isEmpty() || !isRoom(labels_[l])) continue;
            for (std::size_t n = building.storeys.size(); n-- > 0;) {
                if (boxes_[l].min.z + 1 < building.storeys[n].floor) continue;
                building.storeys[n].tops[boxes_[l].max.z + 1] += static_cast<double>(labels_[l].voxels);
                break;
            }
        }
        for (Storey& storey : building.storeys)
            if (!storey.tops.empty()) storey.ceiling = heaviest(storey.tops);
        if (building.storeys.size() > 1) buildings_[volume::kNoLabel] = std::move(building);
    }

    void cut(Building& building) const {
        auto& storeys = building.storeys;
        std::stable_sort(storeys.begin(), storeys.end(),
                         [](const Storey& a, const Storey& b) { return a.floor < b.floor; });
        const double spacing = volume_.grid.spacing().z;
        for (std::size_t n = 1; n < storeys.size(); ++n) {
            const double floor = storeys[n].floor, least = storeys[n - 1].floor + kLeastStorey / spacing;
            const bool hasCeiling = storeys[n - 1].ceiling > least && storeys[n - 1].ceiling <= floor;
            building.cuts.push_back(hasCeiling ? storeys[n - 1].ceiling
                                               : static_cast<std::int32_t>(std::lround(floor - kSlab / spacing)));
        }
    }

    // The building that a label is in: the nearest above it that has storeys.
    [[nodiscard]] const Building* buildingOf(std::uint32_t label) const {
        for (std::uint32_t at = label, n = 0; n < kMostAbove; ++n) {
            if (const auto found = buildings_.find(at); found != buildings_.end()) return &found->second;
            if (at >= labels_.size()) return nullptr;
            at = labels_[at].parent;
        }
        return nullptr;
    }

    [[nodiscard]] std::vector<StoreyPart> partsOf(std::uint32_t label) const {
        const std::uint32_t storey = storeyOf_[label];
        const Building* building = buildingOf(storey == volume::kNoLabel ? label : labels_[storey].parent);
        if (building == nullptr) return {{kAbove, 0}};
        for (std::size_t n = 0; n < building->storeys.size(); ++n)
            if (storey != volume::kNoLabel && building->storeys[n].label == storey)
                return {{kAbove, static_cast<int>(n)}};
        std::vector<StoreyPart> parts;
        const std::int32_t low = boxes_[label].min.z, high = boxes_[label].max.z + 1;
        std::int32_t from = low;
        for (int n = 0; n <= static_cast<int>(building->cuts.size()); ++n) {
            const bool isLast = n == static_cast<int>(building->cuts.size());
            const std::int32_t to = isLast ? kAbove : building->cuts[static_cast<std::size_t>(n)];
            const std::int32_t inside = std::min(to, high) - from;
            if (inside >= kWhole * (high - low)) return {{kAbove, n}};
            if (to > from) parts.push_back({to, n});
            from = std::max(from, to);
            if (from >= high) break;
        }
        parts.back().end = kAbove;
        return parts;
    }

    static constexpr std::size_t kMostAbove = 64;  // hostile models: parents without end
    const volume::SemanticVolume& volume_;
    const std::vector<volume::Label>& labels_;
    std::vector<analyze::SampleBox> boxes_;
    std::vector<std::uint32_t> storeyOf_;          // label of a storey, or kNoLabel
    std::map<std::uint32_t, Building> buildings_;  // by the label above the storeys
};

}  // namespace

StoreyParts findStoreyParts(const volume::SemanticVolume& volume) { return PartFinder(volume).find(); }

}  // namespace svt::illustrate

#include <svt/analyze/legal_units.hpp>

#include <svt/analyze/extents.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/analyze/solid_overlaps.hpp>
#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace svt::analyze {
namespace {

using model::ClassRank;
using volume::kNoLabel;
using volume::Label;

constexpr std::uint64_t kLeastGapVoxels = 27;

bool isUnit(const Label& label) noexcept { return model::classRank(label.className) == ClassRank::Unit; }
bool isDoor(const Label& label) noexcept { return label.className == "Door" || label.className == "DoorSurface"; }

// Largest face of the box that two boxes have in common, m2.
double largestFace(const SampleBox& a, const SampleBox& b, const volume::Grid& grid) {
    std::array<double, 3> side{};
    for (int axis = 0; axis < 3; ++axis) {
        const int low = std::max(a.min[axis], b.min[axis]), high = std::min(a.max[axis], b.max[axis]);
        side[std::size_t(axis)] = std::max(0, high - low + 1) * grid.spacing()[axis];
    }
    std::sort(side.begin(), side.end());
    return side[1] * side[2];
}

class UnitChecker {
public:
    UnitChecker(const volume::SemanticVolume& volume, std::span<const Contact> contacts,
                const LegalUnitOptions& options)
        : volume_(volume),
          labels_(volume.labels.labels),
          options_(options),
          extents_(volume.labels),
          neighbors_(contacts, labels_.size()),
          boxes_(labelBoxes(volume.columns, volume.labels)),
          unitsOf_(labels_.size()),
          isCommon_(labels_.size(), 0),
          labelOf_(volume.labels.labelOfScalar()) {}

    LegalUnits run() {
        findUnits();
        if (found_.units.empty()) return {};
        findOverlaps();
        findGaps();
        findAccess();
        return std::move(found_);
    }

private:
    void findUnits() {
        std::vector<std::uint32_t> common;
        for (std::uint32_t l = 0; l < labels_.size(); ++l) {
            if (!isUnit(labels_[l])) continue;
            found_.units.push_back({l, isCommonUnit(labels_[l]), UnitAccess::Unknown});
            extentOf_[l] = extents_.of(l);
            for (const std::uint32_t part : extentOf_[l]) unitsOf_[part].push_back(l);
            if (found_.units.back().isCommon) common.push_back(l);
        }
        for (std::uint32_t l = 0; l < labels_.size(); ++l)
            if (unitsOf_[l].empty() && model::classRank(labels_[l].className) == ClassRank::Room) common.push_back(l);
        for (const std::uint32_t part : extents_.of(common)) isCommon_[part] = 1;
    }

    void findOverlaps() {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<UnitOverlap, 2>> byUnits;  // of solids, of rooms
        const auto isSpace = [&](std::uint32_t l) { return model::isSpace(labels_[l].className); };
        for (const SolidOverlap& overlap : solidOverlaps(volume_).pairs) {
            if (!isSpace(overlap.a) || !isSpace(overlap.b) || haveCommonUnit(overlap.a, overlap.b)) continue;
            for (const std::uint32_t one : unitsOf_[overlap.a])
                for (const std::uint32_t other : unitsOf_[overlap.b]) {
                    if (one == other || isWithin(one, other) || isWithin(other, one)) continue;
                    const bool areUnits = overlap.a == one && overlap.b == other;
                    const auto [a, b] = std::minmax(one, other);
                    UnitOverlap& sum = byUnits[{a, b}][areUnits ? 0 : 1];
                    sum.a = a;
                    sum.b = b;
                    sum.volume += overlap.volume;
                    sum.bound += overlap.bound;
                }
        }
        for (const auto& [units, sums] : byUnits) {
            const bool haveSolids = solidVolumeOf(labels_[units.first]) && solidVolumeOf(labels_[units.second]);
            const UnitOverlap& overlap = sums[haveSolids ? 0 : 1];
            const double least = options_.depth * largestFace(boxOf(units.first), boxOf(units.second), volume_.grid);
            if (overlap.volume > std::max(least, 1e-6)) found_.overlaps.push_back(overlap);
        }
    }

    // A room may overlap with the unit around it, and rooms may belong to both units.
    [[nodiscard]] bool haveCommonUnit(std::uint32_t a, std::uint32_t b) const {
        return std::any_of(unitsOf_[a].begin(), unitsOf_[a].end(), [&](std::uint32_t unit) {
            return std::binary_search(unitsOf_[b].begin(), unitsOf_[b].end(), unit);
        });
    }

    [[nodiscard]] bool isWithin(std::uint32_t part, std::uint32_t unit) const {
        const std::vector<std::uint32_t>& extent = extentOf_.at(unit);
        return std::binary_search(extent.begin(), extent.end(), part);
    }

    [[nodiscard]] SampleBox boxOf(std::uint32_t unit) const {
        SampleBox box;
        for (const std::uint32_t part : extentOf_.at(unit)) box.add(boxes_[part]);
        return box;
    }

    // The own voxels of a storey are those that nothing else claims.
    void findGaps() {
        for (std::uint32_t l = 0; l < labels_.size(); ++l) {
            if (model::classRank(labels_[l].className) != ClassRank::Storey) continue;
            if (labels_[l].voxels < kLeastGapVoxels || labels_[l].filling == volume::Filling::Surface) continue;
            const std::vector<std::uint32_t> extent = extents_.of(l);
            if (std::none_of(extent.begin(), extent.end(), [&](std::uint32_t part) { return isUnit(labels_[part]); }))
                continue;
            found_.gaps.push_back(
                {l, labels_[l].voxels, double(labels_[l].voxels) * volume_.grid.voxelVolume(), boxes_[l]});
        }
    }

    void findAccess() {
        const bool hasCommon = std::find(isCommon_.begin(), isCommon_.end(), 1) != isCommon_.end();
        const bool hasDoors = std::any_of(labels_.begin(), labels_.end(),
                                          [](const Label& label) { return isDoor(label) && label.voxels > 0; });
        for (LegalUnit& unit : found_.units) {
            if (unit.isCommon)
                unit.access = UnitAccess::Common;
            else if (hasCommon)
                unit.access = accessOf(unit.label, hasDoors);
        }
    }

    [[nodiscard]] UnitAccess accessOf(std::uint32_t unit, bool hasDoors) {
        const std::vector<std::uint32_t>& extent = extentOf_.at(unit);
        std::set<std::uint32_t> doors;
        for (const std::uint32_t part : extent)
            if (isDoor(labels_[part])) doors.insert(part);
        for (const Neighbor& neighbor : neighbors_.of(extent)) {
            if (neighbor.label == kNoLabel) continue;
            if (isCommon_[neighbor.label] != 0) return UnitAccess::Common;
            if (isDoor(labels_[neighbor.label])) doors.insert(neighbor.label);
        }
        for (std::uint32_t l = 0; l < labels_.size(); ++l)
            if (isDoor(labels_[l]) && labels_[l].filling != volume::Filling::Surface && doors.count(l) == 0 &&
                reaches(l, extent))
                doors.insert(l);
        bool isOutside = false;
        std::vector<std::uint32_t> open(doors.begin(), doors.end());
        while (!open.empty()) {
            const std::uint32_t door = open.back();
            open.pop_back();
            for (const std::uint32_t beyond : aroundDoor(door)) {
                if (beyond == kNoLabel)
                    isOutside = true;
                else if (isCommon_[beyond] != 0)
                    return UnitAccess::Common;
                else if (isDoor(labels_[beyond]) && doors.insert(beyond).second)
                    open.push_back(beyond);
            }
        }
        if (isOutside) return UnitAccess::Outside;
        return hasDoors ? UnitAccess::None : UnitAccess::Unknown;
    }

    [[nodiscard]] bool reaches(std::uint32_t door, const std::vector<std::uint32_t>& extent) {
        const std::set<std::uint32_t>& around = aroundDoor(door);
        return std::any_of(around.begin(), around.end(), [&](std::uint32_t label) {
            return label != kNoLabel && std::binary_search(extent.begin(), extent.end(), label);
        });
    }

    // Labels that touch a door, and those in front of its leaf and behind it; kNoLabel: outside.
    const std::set<std::uint32_t>& aroundDoor(std::uint32_t door) {
        const auto [known, isNew] = aroundDoor_.try_emplace(door);
        std::set<std::uint32_t>& around = known->second;
        if (!isNew) return around;
        for (const Neighbor& neighbor : neighbors_.of(std::vector<std::uint32_t>{door}))
            if (neighbor.label != kNoLabel) around.insert(neighbor.label);
        const SampleBox& box = boxes_[door];
        const Vec3d spacing = volume_.grid.spacing();
        const auto side = [&](int axis) { return (box.max[axis] - box.min[axis] + 1) * spacing[axis]; };
        const int across = side(0) < side(1) ? 0 : 1;
        // A door that is turned against the grid has no thin side.
        if (box.isEmpty() || side(across) > 0.5 * side(1 - across)) return around;
        // A line through the middle of the leaf, across it.
        const auto steps = static_cast<std::int32_t>(std::ceil(options_.doorReach / spacing[across]));
        Vec3i sample{(box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2, (box.min.z + box.max.z) / 2};
        const std::int32_t first = box.min[across] - steps, last = box.max[across] + steps;
        for (sample[across] = first; sample[across] <= last; ++sample[across]) {
            const std::uint32_t label = labelAt(sample);
            if (label != kNoLabel || sample[across] == first || sample[across] == last) around.insert(label);
        }
        return around;
    }

    [[nodiscard]] std::uint32_t labelAt(Vec3i sample) {
        const Vec3i n = volume_.grid.dimension();
        for (int axis = 0; axis < 3; ++axis)
            if (sample[axis] < 0 || sample[axis] >= n[axis]) return kNoLabel;
        return labelOf_[volume_.columns.scalarAt(sample.x, sample.y, sample.z)];
    }

    const volume::SemanticVolume& volume_;
    const std::vector<Label>& labels_;
    const LegalUnitOptions options_;
    const Extents extents_;
    const NeighborFinder neighbors_;
    const std::vector<SampleBox> boxes_;
    std::vector<std::vector<std::uint32_t>> unitsOf_;  // by label
    std::map<std::uint32_t, std::vector<std::uint32_t>> extentOf_;
    std::vector<char> isCommon_;  // by label: part of a common part
    std::map<std::uint32_t, std::set<std::uint32_t>> aroundDoor_;
    std::vector<std::uint32_t> labelOf_;  // by scalar
    LegalUnits found_;
};

}  // namespace

bool isCommonUnit(const volume::Label& label) {
    const auto holds = [](std::string_view text) {
        const std::string lower = lowerAscii(text);
        constexpr std::string_view kWords[] = {"common", "shared", "gemeinschaft", "allgemein", "circulation"};
        return std::any_of(std::begin(kWords), std::end(kWords),
                           [&](std::string_view word) { return lower.find(word) != std::string::npos; });
    };
    const auto isUse = [&](const Attribute& attribute) {
        constexpr std::string_view kNames[] = {"function", "class", "usage"};
        return std::any_of(std::begin(kNames), std::end(kNames),
                           [&](std::string_view name) { return equalsIgnoringCase(attribute.name, name); }) &&
               holds(toText(attribute.value));
    };
    return holds(label.name) || std::any_of(label.attributes.begin(), label.attributes.end(), isUse);
}

LegalUnits checkLegalUnits(const volume::SemanticVolume& volume, std::span<const Contact> contacts,
                           const LegalUnitOptions& options) {
    return UnitChecker(volume, contacts, options).run();
}

}  // namespace svt::analyze

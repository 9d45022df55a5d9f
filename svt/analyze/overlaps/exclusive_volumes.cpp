#include <svt/analyze/exclusive_volumes.hpp>

#include <svt/analyze/overlaps/common_volume_of_all.hpp>
#include <svt/analyze/overlaps/convex_cells.hpp>
#include <svt/analyze/overlaps/exclusive_parts.hpp>
#include <svt/analyze/overlaps/solid_clips.hpp>
#include <svt/analyze/solid_overlaps.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_set>

namespace svt::analyze {
namespace {

// The volume of a closed mesh by its triangles, m3.
double meshVolume(const MeshSolid& solid, const volume::VectorParts& parts) {
    const Vec3d corner = solid.box.min;
    double sum = 0;
    for (const auto& triangle : solid.triangles) {
        const Vec3d a = parts.position(triangle.corners[0], {}) - corner;
        const Vec3d b = parts.position(triangle.corners[1], {}) - corner;
        const Vec3d c = parts.position(triangle.corners[2], {}) - corner;
        sum += dot(a, cross(b, c));
    }
    return sum / 6;
}

// The triangles of a closed mesh, as corners.
std::vector<std::array<Vec3d, 3>> meshCorners(const MeshSolid& solid, const volume::VectorParts& parts) {
    std::vector<std::array<Vec3d, 3>> corners;
    corners.reserve(solid.triangles.size());
    for (const auto& triangle : solid.triangles)
        corners.push_back({parts.position(triangle.corners[0], {}), parts.position(triangle.corners[1], {}),
                           parts.position(triangle.corners[2], {})});
    return corners;
}

class ExclusiveVolumes {
public:
    ExclusiveVolumes(const volume::SemanticVolume& volume, std::uint64_t work)
        : volume_(volume), solids_(meshSolids(volume)), work_(work), solidOf_(volume.labels.labels.size(), kNone) {
        for (std::size_t s = 0; s < solids_.size(); ++s) solidOf_[solids_[s].label] = s;
    }

    std::vector<Measure> run() {
        std::vector<Measure> measures = ownMeasures(volume_.labels, volume_.grid);
        const std::vector<char> isExact = findWinners();
        for (std::size_t s = 0; s < solids_.size(); ++s) {
            if (isExact[s] == 0) continue;
            const auto volume = exclusiveVolume(s);
            if (!volume) continue;
            if (bodiesOf_[s].empty())
                setVolume(measures[solids_[s].label], std::max(0.0, *volume), false);
            else
                divide(std::max(0.0, *volume), s, measures);
        }
        return measures;
    }

    ExclusiveParts partsIn(std::span<const std::uint32_t> labels, const volume::SemanticVolume& others) {
        ExclusiveParts parts;
        parts.all.assign(solidOf_.size(), std::numeric_limits<double>::quiet_NaN());
        const std::vector<char> isExact = findWinners();
        const std::vector<MeshSolid> otherSolids = meshSolids(others);
        for (const std::uint32_t label : labels) {
            const std::size_t s = solidOf_[label];
            if (s == kNone || isExact[s] == 0 || !bodiesOf_[s].empty()) continue;
            const auto all = exclusiveVolume(s);
            std::vector<std::pair<std::uint32_t, BoundedVolume>> found;
            bool isComplete = all.has_value();
            for (const MeshSolid& other : otherSolids) {
                if (!isComplete) break;
                if (commonBox(solids_[s].box, other.box).isEmpty()) continue;
                const auto part = partIn(s, other, others.vectors);
                isComplete = part.has_value();
                if (part) found.emplace_back(other.label, *part);
            }
            if (!isComplete) continue;
            parts.all[label] = std::max(0.0, *all);
            for (const auto& [other, part] : found) parts.shared[{label, other}] = part;
        }
        return parts;
    }

private:
    // Finds the solids that have space of each solid. \return by solid: whether its own volume is exact
    std::vector<char> findWinners() {
        winners_.resize(solids_.size());
        bodiesOf_.resize(solids_.size());
        if (solids_.empty()) return {};
        const SolidOverlaps overlaps = solidOverlaps(volume_, {.work = work_});
        if (!overlaps.isComplete) return std::vector<char>(solids_.size(), 0);
        std::vector<char> isExact(solids_.size(), 1);
        for (const SolidOverlap& pair : overlaps.pairs) {
            if (solidOf_[pair.b] == kNone) continue;
            if (!pair.isExact) isExact[solidOf_[pair.b]] = 0;
            if (solidOf_[pair.a] == kNone) continue;
            winners_[solidOf_[pair.b]].push_back(solidOf_[pair.a]);
            pairs_.insert(keyOf(pair.a, pair.b));
        }
        findBodies(isExact);
        return isExact;
    }

    // The own volume of a solid in a solid of another volume.
    std::optional<BoundedVolume> partIn(std::size_t solid, const MeshSolid& other, const volume::VectorParts& parts) {
        isComplete_ = true;
        claims_ = {solid};
        clip_ = &other;
        clipParts_ = &parts;
        const Box3d box = commonBox(solids_[solid].box, other.box);
        bound_ = 0;
        const double whole = commonOfClaims(box);
        const double lost = whole > 0 && !winners_[solid].empty() ? lostVolume(winners_[solid], box) : 0;
        clip_ = nullptr;
        if (!isComplete_) return std::nullopt;
        return BoundedVolume{std::max(0.0, whole - lost), bound_};
    }

    static constexpr std::size_t kNone = ~std::size_t{0};

    static std::uint64_t keyOf(std::uint32_t a, std::uint32_t b) {
        return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    }

    static void setVolume(Measure& measure, double volume, bool isCounted) {
        measure.volume = volume;
        measure.countedVolume = isCounted ? volume : 0;
    }

    // The material between hull and rooms belongs to the surfaces around it, those of rooms as well. With several hulls,
    // it stays counted.
    void findBodies(std::vector<char>& isExact) {
        const auto& labels = volume_.labels.labels;
        for (std::uint32_t l = 0; l < labels.size(); ++l) {
            if (labels[l].filling != volume::Filling::Body) continue;
            std::vector<std::size_t> hulls;
            for (std::uint32_t above = labels[l].parent; above != volume::kNoLabel; above = labels[above].parent)
                if (solidOf_[above] != kNone && !model::isSpace(labels[above].className))
                    hulls.push_back(solidOf_[above]);
            if (hulls.size() == 1) bodiesOf_[hulls.front()].push_back(l);
            if (hulls.size() > 1)
                for (const std::size_t hull : hulls) isExact[hull] = 0;
        }
    }

    // Divides the volume that a hull has beside its rooms among the hull and its bodies, in proportion to their voxels.
    void divide(double volume, std::size_t hull, std::vector<Measure>& measures) const {
        std::vector<std::uint32_t> claimants = bodiesOf_[hull];
        claimants.push_back(solids_[hull].label);
        double voxels = 0;
        for (const std::uint32_t label : claimants) voxels += double(measures[label].voxels);
        if (voxels == 0) return setVolume(measures[claimants.back()], volume, false);
        for (const std::uint32_t label : claimants)
            setVolume(measures[label], volume * double(measures[label].voxels) / voxels, true);
    }

    // Whether a place may belong to three solids: two that have space of this one overlap.
    [[nodiscard]] bool hasSharedPlaces(std::size_t solid) const {
        const auto& winners = winners_[solid];
        for (std::size_t n = 0; n < winners.size(); ++n)
            for (std::size_t m = n + 1; m < winners.size(); ++m)
                if (pairs_.contains(keyOf(solids_[winners[n]].label, solids_[winners[m]].label))) return true;
        return false;
    }

    // The cells of a solid, found once; null if it cannot be divided.
    const std::vector<ConvexCell>* cellsOf(std::size_t solid) {
        constexpr std::size_t kMostFaces = 256;  // of meshes that are divided
        const auto [at, isNew] = cells_.try_emplace(solid);
        if (isNew && solids_[solid].triangles.size() <= kMostFaces)
            at->second = convexCells(meshCorners(solids_[solid], volume_.vectors),
                                     meshVolume(solids_[solid], volume_.vectors), work_);
        return at->second ? &*at->second : nullptr;
    }

    // The volume of the places of a solid that other labels have, from convex cells.
    std::optional<double> lostInCells(std::size_t solid) {
        const std::vector<ConvexCell>* own = cellsOf(solid);
        if (own == nullptr) return std::nullopt;
        std::vector<const std::vector<ConvexCell>*> others;
        for (const std::size_t winner : winners_[solid]) {
            others.push_back(cellsOf(winner));
            if (others.back() == nullptr) return std::nullopt;
        }
        return volumeWithin(*own, others, work_);
    }

    // The volume of a mesh, less that of its places in other labels: by cells where three solids meet, else by inclusion
    // and exclusion.
    std::optional<double> exclusiveVolume(std::size_t solid) {
        if (hasSharedPlaces(solid))
            if (const auto lost = lostInCells(solid)) return meshVolume(solids_[solid], volume_.vectors) - *lost;
        isComplete_ = true;
        claims_ = {solid};
        const double lost = winners_[solid].empty() ? 0 : lostVolume(winners_[solid], solids_[solid].box);
        if (!isComplete_) return std::nullopt;
        return meshVolume(solids_[solid], volume_.vectors) - lost;
    }

    // The volume of the places that all of claims_ have in common with at least one of `others`.
    double lostVolume(std::span<const std::size_t> others, const Box3d& box) {
        double lost = 0;
        for (std::size_t n = 0; n < others.size() && isComplete_; ++n) {
            const Box3d common = commonBox(box, solids_[others[n]].box);
            if (common.isEmpty()) continue;
            claims_.push_back(others[n]);
            const double volume = commonOfClaims(common);
            if (volume > 0) {
                std::vector<std::size_t> next;
                for (const std::size_t other : others.subspan(n + 1))
                    if (pairs_.contains(keyOf(solids_[others[n]].label, solids_[other].label))) next.push_back(other);
                lost += volume - (next.empty() ? 0 : lostVolume(next, common));
            }
            claims_.pop_back();
        }
        return lost;
    }

    // The volume that all of claims_ have in common in a box; 0 below the rounding of the meshes.
    double commonOfClaims(const Box3d& box) {
        std::vector<SolidClip> clips;
        std::vector<const std::vector<plane::RoofTriangle>*> roofs;
        double lowest = box.min.z, area = 0;
        isComplete_ = isComplete_ && claims_.size() <= kMostClaims;
        for (const std::size_t claim : claims_) {
            const std::uint64_t steps = solids_[claim].triangles.size();
            isComplete_ = isComplete_ && steps <= work_;
            if (!isComplete_) return 0;
            work_ -= steps;
            clips.push_back(clipSolid(solids_[claim], volume_.vectors, box));
            lowest = std::min(lowest, clips.back().lowest);
            area += clips.back().area;
        }
        double unit = volume_.vectors.unit;
        if (clip_ != nullptr) {
            const std::uint64_t steps = clip_->triangles.size();
            isComplete_ = isComplete_ && steps <= work_;
            if (!isComplete_) return 0;
            work_ -= steps;
            clips.push_back(clipSolid(*clip_, *clipParts_, box));
            lowest = std::min(lowest, clips.back().lowest);
            area += clips.back().area;
            unit = std::max(unit, clipParts_->unit);
        }
        for (const SolidClip& clip : clips) roofs.push_back(&clip.roofs);
        // First the mesh with the fewest triangles, so that others are clipped to few.
        std::sort(roofs.begin(), roofs.end(), [](const auto* a, const auto* b) { return a->size() < b->size(); });
        std::optional<double> volume;
        if (roofs.size() == 2 && plane::comparisons(*roofs[0], *roofs[1]) <= work_) {
            work_ -= plane::comparisons(*roofs[0], *roofs[1]);
            volume = plane::commonVolume(*roofs[0], *roofs[1], lowest);
        } else if (roofs.size() > 2) {
            volume = commonVolumeOfAll(roofs, lowest, work_);
        }
        if (!volume) isComplete_ = false;
        const double bound = area * unit;
        bound_ += bound;
        return volume.value_or(0) > bound ? *volume : 0;
    }

    const volume::SemanticVolume& volume_;
    std::vector<MeshSolid> solids_;
    std::uint64_t work_;
    std::vector<std::size_t> solidOf_;                                     // by label
    std::vector<std::vector<std::size_t>> winners_;                        // by solid: those that have space of it
    std::unordered_set<std::uint64_t> pairs_;                              // of labels whose solids overlap
    std::vector<std::vector<std::uint32_t>> bodiesOf_;                     // by solid: labels of its material
    std::map<std::size_t, std::optional<std::vector<ConvexCell>>> cells_;  // by solid
    std::vector<std::size_t> claims_;
    bool isComplete_ = true;
    const MeshSolid* clip_ = nullptr;                 // joins claims_, if any
    const volume::VectorParts* clipParts_ = nullptr;  // has its triangles
    double bound_ = 0;                                // m3: sum of the rounding of commonOfClaims()
};

}  // namespace

volume::SemanticVolume keepLabels(const volume::SemanticVolume& volume, const std::vector<char>& isKept) {
    volume::SemanticVolume kept;
    kept.grid = volume.grid;
    kept.labels.labels = volume.labels.labels;
    auto& labels = kept.labels.labels;
    for (std::size_t l = 0; l < labels.size(); ++l)
        if (isKept[l] == 0) {
            labels[l].filling = volume::Filling::None;
            labels[l].voxels = labels[l].thinVoxels = 0;
            labels[l].count = 0;
            labels[l].volume = 0;
        }
    for (const volume::Overlap& overlap : volume.labels.overlaps) {
        if (isKept[overlap.b] == 0) continue;
        if (isKept[overlap.a] != 0)
            kept.labels.overlaps.push_back(overlap);
        else
            labels[overlap.b].voxels += overlap.voxels;
    }
    kept.vectors.unit = volume.vectors.unit;
    kept.vectors.points = volume.vectors.points;
    for (const auto& triangle : volume.vectors.triangles)
        if (isKept[triangle.label] != 0) kept.vectors.triangles.push_back(triangle);
    return kept;
}

std::vector<Measure> exclusiveMeasures(const volume::SemanticVolume& volume, std::uint64_t work) {
    return ExclusiveVolumes(volume, work).run();
}

ExclusiveParts exclusiveParts(const volume::SemanticVolume& volume, std::span<const std::uint32_t> labels,
                              const volume::SemanticVolume& others, std::uint64_t work) {
    return ExclusiveVolumes(volume, work).partsIn(labels, others);
}

std::vector<std::uint32_t> finestFeatures(const Extents& extents, std::span<const std::uint32_t> features,
                                          std::size_t labelCount) {
    std::vector<std::uint32_t> sizes, order(features.size()), featureOf(labelCount, volume::kNoLabel);
    sizes.reserve(features.size());
    for (const std::uint32_t label : features) sizes.push_back(static_cast<std::uint32_t>(extents.of(label).size()));
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return sizes[a] > sizes[b]; });
    for (const std::uint32_t n : order)
        for (const std::uint32_t part : extents.of(features[n])) featureOf[part] = features[n];
    for (const std::uint32_t label : features) featureOf[label] = label;
    return featureOf;
}

}  // namespace svt::analyze

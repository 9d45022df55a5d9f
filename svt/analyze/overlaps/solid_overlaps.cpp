#include <svt/analyze/solid_overlaps.hpp>

#include <svt/analyze/overlaps/common_volume.hpp>
#include <svt/core/vec.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

namespace svt::analyze {
namespace {

using Triangle = volume::VectorParts::Triangle;

// A label with a closed mesh.
struct Solid {
    std::uint32_t label = 0;
    std::span<const Triangle> triangles;
    Box3d box;  // metres from the grid's lower corner, along world axes
};

bool isAncestor(const volume::LabelTable& table, std::uint32_t ancestor, std::uint32_t label) {
    return ancestor < label && label < table.labels[ancestor].subtreeEnd;
}

bool isMember(const volume::LabelTable& table, std::uint32_t group, std::uint32_t label) {
    for (; label != volume::kNoLabel; label = table.labels[label].parent) {
        const auto& groups = table.labels[label].groups;
        if (std::binary_search(groups.begin(), groups.end(), group)) return true;
    }
    return false;
}

bool hasClosedMesh(volume::Filling filling) noexcept {
    return filling >= volume::Filling::Solid && filling <= volume::Filling::Capped;
}

std::array<Vec3d, 3> cornersOf(const Triangle& triangle, const volume::VectorParts& parts) {
    return {parts.position(triangle.corners[0], {}), parts.position(triangle.corners[1], {}),
            parts.position(triangle.corners[2], {})};
}

Box3d boxOf(const std::array<Vec3d, 3>& corners) {
    Box3d box;
    for (const Vec3d& corner : corners) box.add(corner);
    return box;
}

std::vector<Solid> solidsOf(const volume::SemanticVolume& volume) {
    std::vector<Solid> solids;
    const std::span<const Triangle> all = volume.vectors.triangles;
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
        while (end < all.size() && all[end].label == all[begin].label) ++end;
        Solid solid{all[begin].label, all.subspan(begin, end - begin), {}};
        if (!hasClosedMesh(volume.labels.labels[solid.label].filling)) continue;
        for (const Triangle& triangle : solid.triangles) solid.box.add(boxOf(cornersOf(triangle, volume.vectors)));
        solids.push_back(solid);
    }
    return solids;
}

// The box that two boxes share; empty where they have no volume in common.
Box3d commonBox(const Box3d& a, const Box3d& b) {
    const Box3d box{{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y), std::max(a.min.z, b.min.z)},
                    {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y), std::min(a.max.z, b.max.z)}};
    const bool hasVolume = box.min.x < box.max.x && box.min.y < box.max.y && box.min.z < box.max.z;
    return hasVolume ? box : Box3d{};
}

// The part of a solid in a box.
struct Clip {
    std::vector<RoofTriangle> roofs;  // above, in and below the box, in order of minX
    double area = 0;                  // m2 in the box, at most
    double lowest = kInfinity;
};

Clip clip(const Solid& solid, const volume::VectorParts& parts, const Box3d& box) {
    Clip clip;
    // The rounding of corners may move each side of the box. No plane cuts more out of it.
    const Vec3d size = box.size() + Vec3d{1, 1, 1} * (2 * parts.unit);
    const double largest = length(Vec3d{size.x * size.y, size.y * size.z, size.z * size.x});
    for (const Triangle& triangle : solid.triangles) {
        const std::array<Vec3d, 3> corners = cornersOf(triangle, parts);
        const Box3d of = boxOf(corners);
        if (of.max.x < box.min.x || of.min.x > box.max.x || of.max.y < box.min.y || of.min.y > box.max.y) continue;
        RoofTriangle roof;
        if (makeRoofTriangle(corners, roof)) clip.roofs.push_back(roof);
        clip.lowest = std::min(clip.lowest, of.min.z);
        if (of.max.z < box.min.z || of.min.z > box.max.z) continue;
        clip.area += std::min(0.5 * length(cross(corners[1] - corners[0], corners[2] - corners[0])), largest);
    }
    std::sort(clip.roofs.begin(), clip.roofs.end(), [](const RoofTriangle& s, const RoofTriangle& t) {
        return std::tie(s.minX, s.minY, s.maxX, s.maxY) < std::tie(t.minX, t.minY, t.maxX, t.maxY);
    });
    return clip;
}

class OverlapFinder {
public:
    OverlapFinder(const volume::SemanticVolume& volume, std::uint64_t work)
        : volume_(volume), labels_(volume.labels.labels), work_(work), solids_(solidsOf(volume)) {}

    SolidOverlaps run() {
        for (const volume::Overlap& overlap : volume_.labels.overlaps) {
            SolidOverlap& found = found_[{overlap.a, overlap.b}];
            found = {overlap.a, overlap.b, overlap.voxels,  double(overlap.voxels) * volume_.grid.voxelVolume(),
                     kInfinity, false,     overlap.isNested};
        }
        compareAll();
        SolidOverlaps overlaps;
        for (const auto& [pair, overlap] : found_)
            if (overlap.voxels > 0 || overlap.volume > overlap.bound) overlaps.pairs.push_back(overlap);
        const auto all = std::ranges::count_if(labels_, [](const volume::Label& label) {
            return hasClosedMesh(label.filling) || label.filling == volume::Filling::Winding;
        });
        overlaps.withoutMesh = static_cast<std::size_t>(all) - solids_.size();
        overlaps.isComplete = isComplete_;
        return overlaps;
    }

private:
    // Takes steps of the work; false if fewer are left.
    bool take(std::uint64_t steps) {
        if (steps > work_) {
            isComplete_ = false;
            return false;
        }
        work_ -= steps;
        return true;
    }

    // All pairs whose boxes share volume: a sweep along x.
    void compareAll() {
        std::sort(solids_.begin(), solids_.end(), [](const Solid& s, const Solid& t) {
            return std::tie(s.box.min.x, s.label) < std::tie(t.box.min.x, t.label);
        });
        std::vector<const Solid*> open;
        for (const Solid& solid : solids_) {
            std::erase_if(open, [&](const Solid* other) { return other->box.max.x <= solid.box.min.x; });
            if (!take(open.size())) return;
            for (const Solid* other : open)
                if (const Box3d box = commonBox(solid.box, other->box); !box.isEmpty()) compare(solid, *other, box);
            open.push_back(&solid);
        }
    }

    void compare(const Solid& s, const Solid& t, const Box3d& box) {
        if (!take(s.triangles.size() + t.triangles.size())) return;
        const Clip ofS = clip(s, volume_.vectors, box), ofT = clip(t, volume_.vectors, box);
        if (!take(comparisons(ofS.roofs, ofT.roofs))) return;
        const auto [a, b] = inOrder(s.label, t.label);
        SolidOverlap overlap{a, b};
        const double lowest = std::min(ofS.lowest, ofT.lowest);
        overlap.volume = std::max(0.0, commonVolume(ofS.roofs, ofT.roofs, lowest));
        // Each face lies within the rounding of its corners. The sum of prisms rounds, too, also where no face is in
        // the box.
        constexpr double kRoundingOfSum = 1e-9;
        const Vec3d size = box.size();
        overlap.bound = (ofS.area + ofT.area) * volume_.vectors.unit +
                        kRoundingOfSum * size.x * size.y * std::max(0.0, box.max.z - std::min(lowest, box.min.z));
        overlap.isExact = true;
        overlap.isNested = areNested(volume_.labels, a, b);
        if (const auto known = found_.find({a, b}); known != found_.end()) overlap.voxels = known->second.voxels;
        if (overlap.voxels > 0 || overlap.volume > overlap.bound) found_[{a, b}] = overlap;
    }

    // First the label that gets the space that both claim, by the rule of the voxelizer.
    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> inOrder(std::uint32_t a, std::uint32_t b) const {
        const auto key = [&](std::uint32_t l) {
            const volume::Label& label = labels_[l];
            return std::tuple(model::classRank(label.className), label.volume, std::string_view(label.id), l);
        };
        if (found_.contains({a, b}) || found_.contains({b, a}))
            return found_.contains({a, b}) ? std::pair(a, b) : std::pair(b, a);
        return key(a) < key(b) ? std::pair(a, b) : std::pair(b, a);
    }

    const volume::SemanticVolume& volume_;
    const std::vector<volume::Label>& labels_;
    std::uint64_t work_;
    bool isComplete_ = true;
    std::vector<Solid> solids_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, SolidOverlap> found_;
};

}  // namespace

bool areNested(const volume::LabelTable& table, std::uint32_t a, std::uint32_t b) {
    return isAncestor(table, a, b) || isAncestor(table, b, a) || isMember(table, a, b) || isMember(table, b, a);
}

SolidOverlaps solidOverlaps(const volume::SemanticVolume& volume, const SolidOverlapOptions& options) {
    return OverlapFinder(volume, options.work).run();
}

}  // namespace svt::analyze

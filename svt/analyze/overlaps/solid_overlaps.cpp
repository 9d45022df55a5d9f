#include <svt/analyze/solid_overlaps.hpp>

#include <svt/analyze/overlaps/solid_clips.hpp>
#include <svt/core/vec.hpp>
#include <svt/model/classes.hpp>
#include <svt/plane/common_volume.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

namespace svt::analyze {
namespace {

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

class OverlapFinder {
public:
    OverlapFinder(const volume::SemanticVolume& volume, std::uint64_t work)
        : volume_(volume), labels_(volume.labels.labels), work_(work), solids_(meshSolids(volume)) {}

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
            return volume::hasClosedMesh(label.filling) || label.filling == volume::Filling::Winding;
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
        std::sort(solids_.begin(), solids_.end(), [](const MeshSolid& s, const MeshSolid& t) {
            return std::tie(s.box.min.x, s.label) < std::tie(t.box.min.x, t.label);
        });
        std::vector<const MeshSolid*> open;
        for (const MeshSolid& solid : solids_) {
            std::erase_if(open, [&](const MeshSolid* other) { return other->box.max.x <= solid.box.min.x; });
            if (!take(open.size())) return;
            for (const MeshSolid* other : open)
                if (const Box3d box = commonBox(solid.box, other->box); !box.isEmpty()) compare(solid, *other, box);
            open.push_back(&solid);
        }
    }

    void compare(const MeshSolid& s, const MeshSolid& t, const Box3d& box) {
        if (!take(s.triangles.size() + t.triangles.size())) return;
        const SolidClip ofS = clipSolid(s, volume_.vectors, box), ofT = clipSolid(t, volume_.vectors, box);
        if (!take(plane::comparisons(ofS.roofs, ofT.roofs))) return;
        const auto [a, b] = inOrder(s.label, t.label);
        SolidOverlap overlap{a, b};
        const double lowest = std::min(ofS.lowest, ofT.lowest);
        overlap.volume = std::max(0.0, plane::commonVolume(ofS.roofs, ofT.roofs, lowest));
        overlap.bound = boundOfCommonVolume(ofS.area + ofT.area, volume_.vectors.unit, box, lowest);
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
    std::vector<MeshSolid> solids_;
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

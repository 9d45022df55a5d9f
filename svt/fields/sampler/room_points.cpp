#include <svt/fields/sampler/room_points.hpp>

#include <svt/analyze/space_boundaries.hpp>
#include <svt/fields/nearest_voxel.hpp>

#include <algorithm>

namespace svt::fields {
namespace {

using volume::kNoLabel;
using volume::SemanticVolume;

// The room of a place, else that of the nearest voxel within reach.
class RoomFinder {
public:
    RoomFinder(const SemanticVolume& volume, const std::vector<std::uint32_t>& spaces)
        : volume_(volume), spaces_(spaces), labelOfScalar_(volume.labels.labelOfScalar()) {}

    [[nodiscard]] std::uint32_t roomAt(Vec3d place) const {
        const auto voxel =
            nearestVoxel(volume_.grid, place, kWallReach, [&](Vec3i at) { return spaceOf(at) != kNoLabel; });
        return voxel ? spaceOf(*voxel) : kNoLabel;
    }

private:
    [[nodiscard]] std::uint32_t spaceOf(Vec3i voxel) const {
        const std::uint32_t label = labelOfScalar_[volume_.columns.scalarAt(voxel.x, voxel.y, voxel.z)];
        return label == kNoLabel ? kNoLabel : spaces_[label];
    }

    const SemanticVolume& volume_;
    const std::vector<std::uint32_t>& spaces_;
    std::vector<std::uint32_t> labelOfScalar_;
};

}  // namespace

RoomPoints::RoomPoints(const FieldHead& head, const SemanticVolume& volume)
    : spaces_(analyze::spacesOfLabels(volume.labels)), spacing_(volume.grid.spacing()) {
    const RoomFinder finder(volume, spaces_);
    std::vector<std::pair<std::uint32_t, std::size_t>> found;  // room, number of the point
    std::vector<Vec3d> places;
    for (std::size_t p = 0; p < head.points.size(); ++p) {
        places.push_back(volume.grid.indexFromWorld(head.points[p].at));
        if (const std::uint32_t room = finder.roomAt(places.back()); room != kNoLabel) found.emplace_back(room, p);
    }
    std::sort(found.begin(), found.end());
    firstOfSpace_.assign(spaces_.size() + 1, 0);
    for (const auto& [room, p] : found) {
        ++firstOfSpace_[room + 1];
        places_.push_back(places[p]);
        points_.push_back(p);
    }
    for (std::size_t s = 1; s < firstOfSpace_.size(); ++s) firstOfSpace_[s] += firstOfSpace_[s - 1];
}

}  // namespace svt::fields

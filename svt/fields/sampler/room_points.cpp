#include <svt/fields/sampler/room_points.hpp>

#include <svt/analyze/space_boundaries.hpp>

#include <algorithm>
#include <cmath>

namespace svt::fields {
namespace {

using volume::kNoLabel;
using volume::SemanticVolume;

// The room of a place in voxel (x, y, z), else the room of the nearest voxel within reach.
class RoomFinder {
public:
    RoomFinder(const SemanticVolume& volume, const std::vector<std::uint32_t>& spaces)
        : volume_(volume), spaces_(spaces), labelOfScalar_(volume.labels.labelOfScalar()) {}

    [[nodiscard]] std::uint32_t roomAt(Vec3d place) const {
        const Vec3i n = volume_.grid.dimension();
        Vec3i voxel;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(place[axis] > -1e6 && place[axis] < 1e6)) return kNoLabel;
            voxel[axis] = static_cast<std::int32_t>(std::floor(place[axis] + 0.5));
        }
        if (const std::uint32_t own = spaceOf(voxel); own != kNoLabel) return own;
        const Vec3d spacing = volume_.grid.spacing();
        Vec3i low, high;
        for (int axis = 0; axis < 3; ++axis) {
            const auto reach = static_cast<std::int32_t>(std::min(RoomPoints::kWallReach / spacing[axis], 32.0));
            low[axis] = std::max(0, voxel[axis] - reach);
            high[axis] = std::min(n[axis] - 1, voxel[axis] + reach);
        }
        std::uint32_t best = kNoLabel;
        double nearest = RoomPoints::kWallReach * RoomPoints::kWallReach;
        for (std::int32_t k = low.z; k <= high.z; ++k)
            for (std::int32_t j = low.y; j <= high.y; ++j)
                for (std::int32_t i = low.x; i <= high.x; ++i) {
                    const Vec3d way = scaled(toDouble(Vec3i{i, j, k}) - place, spacing);
                    if (!(dot(way, way) < nearest)) continue;
                    const std::uint32_t space = spaceOf({i, j, k});
                    if (space == kNoLabel) continue;
                    best = space;
                    nearest = dot(way, way);
                }
        return best;
    }

private:
    [[nodiscard]] std::uint32_t spaceOf(Vec3i voxel) const {
        const Vec3i n = volume_.grid.dimension();
        if (voxel.x < 0 || voxel.y < 0 || voxel.z < 0 || voxel.x >= n.x || voxel.y >= n.y || voxel.z >= n.z)
            return kNoLabel;
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

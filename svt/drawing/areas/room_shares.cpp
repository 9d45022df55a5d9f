#include <svt/drawing/room_floor_areas.hpp>

#include <svt/analyze/exclusive_volumes.hpp>
#include <svt/drawing/levels/level_parts.hpp>

#include <algorithm>

namespace svt::drawing {
namespace {

constexpr double kLeastOwn = 0.5;      // of the volume: zones have no more
constexpr double kLeastShared = 1e-4;  // of the volume: less is rounding, or a wrong corner

}  // namespace

std::vector<RoomShare> roomShares(const volume::SemanticVolume& volume) {
    const std::vector<volume::Label>& labels = volume.labels.labels;
    std::vector<RoomShare> shares(labels.size());
    std::vector<char> isRoom(labels.size(), 0);
    for (std::size_t l = 0; l < labels.size(); ++l) isRoom[l] = labels[l].count > 0 && isRoomSpace(labels[l]);
    if (std::count(isRoom.begin(), isRoom.end(), 1) < 2) return shares;
    const volume::SemanticVolume rooms = analyze::keepLabels(volume, isRoom);
    std::vector<std::uint64_t> lost(labels.size(), 0);  // voxels
    for (const volume::Overlap& overlap : rooms.labels.overlaps) lost[overlap.b] += overlap.voxels;
    const std::vector<analyze::Measure> own = analyze::exclusiveMeasures(rooms);
    for (std::size_t l = 0; l < labels.size(); ++l) {
        if (isRoom[l] == 0 || !own[l].volume) continue;
        const bool isExact = own[l].countedVolume == 0 && volume::hasClosedMesh(labels[l].filling);
        const double whole =
            isExact ? labels[l].volume : *own[l].volume + static_cast<double>(lost[l]) * volume.grid.voxelVolume();
        if (!(whole > 0)) continue;
        RoomShare& share = shares[l];
        share.own = std::clamp(*own[l].volume / whole, 0.0, 1.0);
        share.isZone = share.own <= kLeastOwn;
        share.isShared = share.own < 1 - kLeastShared;
    }
    return shares;
}

}  // namespace svt::drawing

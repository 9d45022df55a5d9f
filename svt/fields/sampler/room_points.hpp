#pragma once
/// \file
/// The points of a field by room: a point stands for its room only.

#include <svt/core/vec.hpp>
#include <svt/fields/field.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace svt::fields {

/// Finds the nearest point of a field in the room of a place. A point in no room belongs to the nearest one within kWallReach.
/// Immutable; any thread may read it.
class RoomPoints {
public:
    static constexpr std::size_t kNoPoint = std::numeric_limits<std::size_t>::max();

    RoomPoints() = default;
    /// \param volume  must outlive the object
    RoomPoints(const FieldHead& head, const volume::SemanticVolume& volume);

    /// The nearest point in the room of the label `label`, in metres; kNoPoint if there is none, or the label belongs to no room.
    /// \param index     of the place, index space
    /// \param accepts   called with the number of a point; points for which it is false do not count
    template <class Accepts>
    [[nodiscard]] std::size_t nearest(std::uint32_t label, Vec3d index, const Accepts& accepts) const noexcept {
        if (label == volume::kNoLabel || spaces_[label] == volume::kNoLabel) return kNoPoint;
        const std::uint32_t space = spaces_[label];
        std::size_t best = kNoPoint;
        double nearest = 0;
        for (std::uint32_t p = firstOfSpace_[space]; p < firstOfSpace_[space + 1]; ++p) {
            const Vec3d way = scaled(places_[p] - index, spacing_);
            const double distance = dot(way, way);
            if ((best == kNoPoint || distance < nearest) && accepts(points_[p])) {
                best = points_[p];
                nearest = distance;
            }
        }
        return best;
    }

private:
    std::vector<std::uint32_t> spaces_;        // by label
    std::vector<std::uint32_t> firstOfSpace_;  // by label: begin of its points
    std::vector<Vec3d> places_;                // of the points, by room, index space
    std::vector<std::size_t> points_;          // their numbers in the field
    Vec3d spacing_{1, 1, 1};
};

}  // namespace svt::fields

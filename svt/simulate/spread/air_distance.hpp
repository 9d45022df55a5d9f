#pragma once
/// \file
/// The length of the shortest way through the air of rooms: fast marching of second order (Sethian, "Fast marching
/// methods", SIAM Review 41, 1999).

#include <svt/core/vec.hpp>
#include <svt/simulate/spread/room_air.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::simulate {

/// Distances from one place after the other. Memory: 5 bytes for each voxel.
class AirDistance {
public:
    /// \param air  must outlive this
    AirDistance(const RoomAir& air, Vec3d spacing);

    /// Computes the distances from a place, whose air begins at `voxel`.
    /// \param index  of the place, index space
    /// \return the voxels that it reaches, nearest first; valid until the next call
    /// Cost: O(n log n) of these voxels.
    std::span<const std::uint32_t> from(Vec3d index, Vec3i voxel);

    [[nodiscard]] bool isReached(std::uint32_t voxel) const noexcept { return states_[voxel] == State::Accepted; }
    /// Metres from the last place to a voxel that it reaches.
    [[nodiscard]] float at(std::uint32_t voxel) const noexcept { return distances_[voxel]; }

private:
    enum class State : std::uint8_t {
        Trial,     // not reached, or with a distance that may become less
        Start,     // near the place, with its final distance
        Accepted,  // with its final distance
    };
    struct Trial {
        float distance = 0;
        std::uint32_t voxel = 0;
        // For a heap with the least distance at the front; a total order, so that results repeat.
        friend bool operator<(const Trial& a, const Trial& b) noexcept {
            return a.distance != b.distance ? a.distance > b.distance : a.voxel > b.voxel;
        }
    };
    /// The term a (d - t)^2 of one axis.
    struct Term {
        double t = 0, a = 0;
    };

    [[nodiscard]] bool isAccepted(std::uint32_t own, Vec3i place, int axis, std::int32_t by) const noexcept;
    void tryVoxel(std::uint32_t voxel, float distance);
    void startNear(Vec3d index, Vec3i voxel);
    [[nodiscard]] bool isInSight(Vec3i from, Vec3i to) const noexcept;
    [[nodiscard]] float solve(std::uint32_t voxel) const noexcept;

    const RoomAir& air_;
    Vec3d spacing_;
    std::array<std::uint32_t, 3> stride_{};
    std::vector<float> distances_;  // infinite: not reached
    std::vector<State> states_;
    std::vector<Trial> heap_;
    std::vector<std::uint32_t> accepted_;
};

}  // namespace svt::simulate

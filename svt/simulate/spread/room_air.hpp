#pragma once
/// \file
/// The voxels of air of rooms, and the passages between them.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace svt::simulate {

/// The zone of each voxel. Air passes within a room, and between a room and common air.
struct RoomAir {
    /// No air of rooms: solids and outside air.
    static constexpr std::uint32_t kNone = 0;
    /// Window reveals, doorways, and everything that is open.
    static constexpr std::uint32_t kCommon = 1;

    Vec3i size{};
    std::vector<std::uint32_t> zones;         ///< of voxels, x fastest: kNone, kCommon, or 2 + the label of the room
    std::vector<std::uint32_t> rooms;         ///< labels of spaces that have voxels, ascending
    std::vector<std::uint32_t> roomOfScalar;  ///< label of the space; kNoLabel: none
    /// Rooms that touch each other without common air between them, the lower label first; ascending.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> touching;

    [[nodiscard]] std::size_t number(Vec3i voxel) const noexcept {
        return static_cast<std::size_t>(voxel.x) +
               static_cast<std::size_t>(size.x) *
                   (static_cast<std::size_t>(voxel.y) +
                    static_cast<std::size_t>(size.y) * static_cast<std::size_t>(voxel.z));
    }
    [[nodiscard]] Vec3i place(std::size_t voxel) const noexcept {
        const auto across = static_cast<std::size_t>(size.x), layer = across * static_cast<std::size_t>(size.y);
        return {static_cast<std::int32_t>(voxel % across), static_cast<std::int32_t>(voxel % layer / across),
                static_cast<std::int32_t>(voxel / layer)};
    }
    [[nodiscard]] static bool passes(std::uint32_t a, std::uint32_t b) noexcept {
        return a != kNone && b != kNone && (a == b || a == kCommon || b == kCommon);
    }
};

/// \param open  queries of doors, rooms and other components that become common air
/// \return the air; BadQuery, NothingSelected of a query; BadArgument without rooms; GridTooLarge beyond 2^32 - 1
///         voxels
/// Cost: O(voxels). Memory: 4 bytes for each voxel, 16 for each run of voxels while it is made.
[[nodiscard]] Result<RoomAir> findRoomAir(const volume::SemanticVolume& volume, std::span<const std::string> open);

}  // namespace svt::simulate

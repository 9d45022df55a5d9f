#pragma once
/// \file
/// The runs of all columns as cells of conduction, air of zones, openings and blocked space; and the leaks between them.

#include <svt/simulate/materials/thermal_roles.hpp>
#include <svt/simulate/solver/cell_equations.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::simulate {

enum class RunKind : std::uint8_t {
    Solid,    ///< conducts; `number` is the first of its cells
    Cavity,   ///< enclosed air that touches no room: cells of mixed air
    Air,      ///< of zone `number`
    Opening,  ///< of opening `number`
    Blocked
};

struct RunPlace {
    RunKind kind = RunKind::Blocked;
    std::uint32_t number = 0;
    [[nodiscard]] bool hasCells() const noexcept { return kind <= RunKind::Cavity; }
};

/// The kind of every run of every column. Column (i, j) is number i + nx * j.
struct AirMap {
    const volume::ColumnVolume* columns = nullptr;
    Vec3i size{};
    std::vector<std::size_t> columnStart;  ///< of each column: its first run in `runs`; one more at the end
    std::vector<RunPlace> runs;
    std::uint32_t cells = 0;
    std::vector<AirLeak> leaks;  ///< label: the number of the zone; ascending

    [[nodiscard]] std::size_t columnNumber(std::int32_t i, std::int32_t j) const noexcept {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(i);
    }
    /// A run, its scalar, and its lowest voxel.
    struct Found {
        RunPlace place;
        volume::Scalar scalar = 0;
        std::uint32_t begin = 0;
    };
    /// The run at voxel (i, j, k), which must lie inside. Cost O(log runs).
    [[nodiscard]] Found find(Vec3i voxel) const noexcept;
    [[nodiscard]] RunPlace at(Vec3i voxel) const noexcept { return find(voxel).place; }
    /// The cell at voxel (i, j, k); 0: none.
    [[nodiscard]] std::uint32_t cellAt(Vec3i voxel) const noexcept;
};

/// Calls touch(a, b, from, to) for the runs a of one column and b of another that share the heights [from, to).
template <class Touch>
void forCommonHeights(std::span<const volume::Run> one, std::span<const volume::Run> other, const Touch& touch) {
    std::uint32_t from = 0;
    for (std::size_t a = 0, b = 0; a < one.size() && b < other.size();) {
        const std::uint32_t to = std::min(one[a].end, other[b].end);
        touch(a, b, static_cast<std::int32_t>(from), static_cast<std::int32_t>(to));
        from = to;
        if (one[a].end == to) ++a;
        if (other[b].end == to) ++b;
    }
}

/// \return the map, or GridTooLarge beyond 2^31 cells
/// Cost: O(runs of all columns). Memory: 16 bytes a run while it is made, then 8.
[[nodiscard]] Result<AirMap> makeAirMap(const volume::SemanticVolume& volume, const ThermalRoles& roles);

}  // namespace svt::simulate

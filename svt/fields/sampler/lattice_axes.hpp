#pragma once
/// \file
/// The cells of a lattice, and the voxels that they touch.

#include <svt/core/result.hpp>
#include <svt/fields/field.hpp>
#include <svt/fields/sampler/medium_grid.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::fields {

/// The nodes of a lattice along one axis.
struct LatticeAxis {
    std::int32_t size = 1;
    double first = 0, inverseStep = 1, step = 1;
    std::vector<double> positions;         ///< of the nodes of a rectilinear axis; else empty
    std::vector<std::int32_t> voxelOf;     ///< voxel that contains each node
    std::int32_t lowest = 0, highest = 0;  ///< voxels that contain the ends: half a step beyond the outermost nodes
    double low = 0, high = 0;              ///< the ends

    [[nodiscard]] std::int32_t cells() const noexcept { return std::max(1, size - 1); }
    [[nodiscard]] double at(std::int32_t node) const noexcept {
        return positions.empty() ? first + step * node : positions[static_cast<std::size_t>(node)];
    }
    /// Voxels of a cell, both included.
    [[nodiscard]] std::int32_t lowVoxel(std::int32_t cell) const noexcept {
        return cell == 0 ? lowest : voxelOf[static_cast<std::size_t>(cell)];
    }
    [[nodiscard]] std::int32_t highVoxel(std::int32_t cell) const noexcept {
        return cell + 2 >= size ? highest : voxelOf[static_cast<std::size_t>(cell) + 1];
    }
    /// Finds the cell of a place and its fraction.
    /// \return false beyond the ends, and for NaN
    [[nodiscard]] bool locate(double place, std::int32_t& cell, double& fraction) const noexcept {
        if (!(place >= low && place <= high)) return false;
        if (size == 1) {
            cell = 0;
            fraction = 0;
            return true;
        }
        if (positions.empty()) {
            const double t = std::min(std::max((place - first) * inverseStep, 0.0), size - 1.0);
            cell = std::min(static_cast<std::int32_t>(t), size - 2);
            fraction = t - cell;
            return true;
        }
        const auto above = std::upper_bound(positions.begin(), positions.end(), place);
        cell = std::clamp(static_cast<std::int32_t>(above - positions.begin()) - 1, 0, size - 2);
        const double from = at(cell), to = at(cell + 1);
        fraction = std::clamp((place - from) / (to - from), 0.0, 1.0);
        return true;
    }
};

/// The voxel that contains a place. The place must fit into an integer.
[[nodiscard]] inline std::int32_t voxelAt(double place) noexcept {
    return static_cast<std::int32_t>(std::floor(place + 0.5));
}

/// The cells of a lattice.
struct LatticeAxes {
    std::array<LatticeAxis, 3> axes;
    std::uint64_t largestCell = 1;  ///< voxels
    bool isFine = true;             ///< no step is longer than a voxel

    /// \return the axes, or BadField where the lattice is invalid (checkLattice)
    [[nodiscard]] static Result<LatticeAxes> make(const Lattice& lattice);

    /// A place in the lattice.
    struct Spot {
        Vec3i cell{};
        Vec3d fraction{};
    };
    [[nodiscard]] bool locate(Vec3d place, Spot& spot) const noexcept {
        return axes[0].locate(place.x, spot.cell.x, spot.fraction.x) &&
               axes[1].locate(place.y, spot.cell.y, spot.fraction.y) &&
               axes[2].locate(place.z, spot.cell.z, spot.fraction.z);
    }
    [[nodiscard]] VoxelBox boxOf(Vec3i cell) const noexcept {
        return {{axes[0].lowVoxel(cell.x), axes[1].lowVoxel(cell.y), axes[2].lowVoxel(cell.z)},
                {axes[0].highVoxel(cell.x), axes[1].highVoxel(cell.y), axes[2].highVoxel(cell.z)}};
    }
    [[nodiscard]] std::size_t nodeIndex(Vec3i node) const noexcept {
        return std::size_t(node.x) +
               std::size_t(axes[0].size) * (std::size_t(node.y) + std::size_t(axes[1].size) * std::size_t(node.z));
    }
    [[nodiscard]] std::size_t cellIndex(Vec3i cell) const noexcept {
        return std::size_t(cell.x) + std::size_t(axes[0].cells()) *
                                         (std::size_t(cell.y) + std::size_t(axes[1].cells()) * std::size_t(cell.z));
    }
    /// Node of corner c of a cell: bit 0 is the upper one along x, bit 1 along y, bit 2 along z.
    [[nodiscard]] Vec3i nodeOf(Vec3i cell, unsigned corner) const noexcept {
        return {std::min(cell.x + static_cast<std::int32_t>(corner & 1u), axes[0].size - 1),
                std::min(cell.y + static_cast<std::int32_t>(corner >> 1 & 1u), axes[1].size - 1),
                std::min(cell.z + static_cast<std::int32_t>(corner >> 2), axes[2].size - 1)};
    }
    [[nodiscard]] Vec3i voxelOf(Vec3i node) const noexcept {
        return {axes[0].voxelOf[std::size_t(node.x)], axes[1].voxelOf[std::size_t(node.y)],
                axes[2].voxelOf[std::size_t(node.z)]};
    }
    [[nodiscard]] Vec3d placeOf(Vec3i node) const noexcept {
        return {axes[0].at(node.x), axes[1].at(node.y), axes[2].at(node.z)};
    }
};

}  // namespace svt::fields

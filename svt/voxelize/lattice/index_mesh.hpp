#pragma once
/// \file
/// Objects in index space, snapped to the integer lattice on which all tests are evaluated.

#include <svt/mesh/mesh_set.hpp>
#include <svt/volume/grid.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace svt::voxelize {

/// 512 quanta per voxel. Vertices lie on even quanta, sample i at 512 * i + 1, so they never coincide.
inline constexpr int kQuantaBits = 9;
inline constexpr std::int64_t kQuanta = std::int64_t{1} << kQuantaBits;

/// First sample at or above `quanta`. An even coordinate is never exactly at a sample.
[[nodiscard]] constexpr std::int64_t firstSampleAbove(std::int64_t quanta) noexcept {
    return (quanta + kQuanta - 2) >> kQuantaBits;
}

using QuantaPoint = std::array<std::int32_t, 3>;

/// One object on the lattice.
struct IndexMesh {
    std::vector<QuantaPoint> points;  ///< per vertex of the mesh
    const mesh::ObjectMesh* mesh = nullptr;
};

/// From local space to index space of a grid: index = (axes^T * (local - shift)) / spacing.
class IndexFromLocal {
public:
    IndexFromLocal(const mesh::MeshSet& meshes, const volume::Grid& grid);
    [[nodiscard]] Vec3d point(Vec3d local) const noexcept { return direction(local) + offset_; }
    [[nodiscard]] Vec3d direction(Vec3d local) const noexcept {
        return {dot(rows_[0], local), dot(rows_[1], local), dot(rows_[2], local)};
    }
    /// Snapped; coordinates far outside the grid are clamped to +-2^28 quanta.
    [[nodiscard]] QuantaPoint quanta(Vec3d local) const noexcept;
    /// True if z of index space depends only on z of local space, so that planes z(x, y) can be carried over.
    [[nodiscard]] bool keepsVertical() const noexcept { return keepsVertical_; }
    /// Largest spacing of the three axes, metres.
    [[nodiscard]] double largestSpacing() const noexcept { return largestSpacing_; }
    /// Maps a plane z = a x + b y + c from local to index space (slopes in quanta of z per voxel of x and y).
    [[nodiscard]] mesh::Plane plane(const mesh::Plane& local) const noexcept;

private:
    std::array<Vec3d, 3> rows_;  // index = rows * local + offset
    Vec3d offset_;
    bool keepsVertical_ = true;
    double largestSpacing_ = 0;
};

[[nodiscard]] IndexMesh makeIndexMesh(const mesh::ObjectMesh& mesh, const IndexFromLocal& indexFromLocal);

}  // namespace svt::voxelize

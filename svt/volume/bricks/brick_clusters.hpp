#pragma once
/// \file
/// The bricks of a volume in clusters of 4 x 4 x 4, while a BrickVolume is made, and the same-label boxes that cover
/// them.
///
///     +-------+-------+-------+-------+      clusters of a row: clusters of one scalar have no list of bricks and
///     |   0   |   0   |  o o  |   2   |      are never split
///     |       |       |  o o  |       |
///     +-------+-------+-------+-------+

#include <svt/core/vec.hpp>
#include <svt/volume/brick_volume.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

/// The entry of a brick while bricks are made. Without a tag it is the number of a scalar.
struct BrickTag {
    static constexpr std::uint32_t kCoded = 0x40000000u;       ///< with the number of a box of coded bricks
    static constexpr std::uint32_t kVoxels = 0x80000000u;      ///< with the number of a palette brick
    static constexpr std::uint32_t kBoxed = kCoded | kVoxels;  ///< with the number of a same-label box
};

/// The entries of the 64 bricks of a cluster, x fastest, then y, then z. Beyond the border of the volume, the entries
/// at the border are repeated.
using ClusterEntries = std::array<std::uint32_t, 64>;

struct BrickClusters {
    Vec3i bricks;    ///< of the volume
    Vec3i clusters;  ///< of the volume
    /// By cluster, x fastest: the number of the scalar that all its bricks have; or kMixed and an index in `mixed`.
    std::vector<std::uint32_t> entries;
    std::vector<ClusterEntries> mixed;
    static constexpr std::int32_t kSize = BrickVolume::kClusterSize;
    static constexpr std::uint32_t kMixed = 0x80000000u;

    [[nodiscard]] std::size_t at(std::int32_t x, std::int32_t y, std::int32_t z) const noexcept {
        return static_cast<std::size_t>(x) +
               static_cast<std::size_t>(clusters.x) *
                   (static_cast<std::size_t>(y) + static_cast<std::size_t>(clusters.y) * static_cast<std::size_t>(z));
    }
};

/// Bricks [min, max) that all have one scalar.
struct BrickBox {
    Vec3i min, max;
    std::uint32_t scalar = 0;  ///< its number
};

/// Greedily covers the bricks without a tag with boxes. Boxes start at clusters of one scalar that no box contains in
/// full, then at bricks that no box contains. A box grows along x, then y, then z, over all bricks of its scalar,
/// including bricks of other boxes. So boxes may overlap, and a ray goes far in each. A budget for inspected clusters
/// bounds the cost; when it is used up, boxes grow over few clusters.
///
/// Replaces each scalar in `volume` by the number of the first box that contains the whole cluster, or the brick. The
/// numbers have no tag for clusters of one scalar, and BrickTag::kBoxed for bricks.
/// Cost: O(clusters), with a factor of up to 512.
[[nodiscard]] std::vector<BrickBox> boxUniformBricks(BrickClusters& volume, int threads);

}  // namespace svt::volume

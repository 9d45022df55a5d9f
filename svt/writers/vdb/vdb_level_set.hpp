#pragma once
/// \file
/// One tree of an OpenVDB file whose values are signed distances to the surface of some scalars' voxels: negative
/// inside, and active within three samples of the surface (OpenVDB's narrow band). Elsewhere the value is the width of
/// the band.
///
/// The surface is that of the voxels as cubes. The distance to the nearest cube of the other side is exact. It is
/// separable by axis, so three passes over lines compute it (Felzenszwalb and Huttenlocher 2012, within the band).

#include <svt/writers/vdb/vdb_tree.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::writers {

class VdbLevelSet {
public:
    static constexpr std::int32_t kHalfWidth = 3;  ///< samples

    /// \param blocks    must outlive the tree
    /// \param isInside  one flag per scalar
    /// \param spacing   metres, the same along all axes
    VdbLevelSet(const VdbBlocks& blocks, std::vector<bool> isInside, double spacing);

    /// Visits the samples of blocks that the band may touch. \param topology, buffers may be empty
    /// \return nothing, or Cancelled, or the first error of a sink
    [[nodiscard]] Result<void> write(const VdbSink& topology, const VdbSink& buffers) const;

private:
    enum class State : std::uint8_t { Outside, Inside, Band };
    [[nodiscard]] State stateOf(Vec3i block) const;
    bool distances(Vec3i block, std::vector<float>& values) const;
    [[nodiscard]] Result<void> writeUpper(Vec3i upper, const VdbSink& topology, const VdbSink& buffers) const;

    const VdbBlocks& blocks_;
    std::vector<bool> isInside_;
    float spacing_, background_;
};

}  // namespace svt::writers

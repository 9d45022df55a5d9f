#pragma once
/// \file
/// Plates of a solid that are thinner than a voxel: panes, leaves, jambs, sheets of metal.
///
/// Each sample line decides by itself whether material is thin: from the point where it enters the solid to the point
/// where it leaves through a face that is nearly parallel. So the result does not depend on the triangulation of faces,
/// nor on other parts behind a face: a jamb next to the door's leaf is also a plate.

#include <svt/voxelize/tiles/tile_plan.hpp>

#include <vector>

namespace svt::voxelize {

/// Claims of an object for its thin parts.
struct ThinClaims {
    std::uint32_t thin = 0;
    /// Claim of a plate without a sample inside but with a sample on one of its sides, within 1/128 voxel. The axes of
    /// the grid decide on which side of the face such a tie falls. On the other side, the sample would be inside. So
    /// the claim has the priority of samples inside.
    std::uint32_t tied = 0;
};

/// Adds, for each sample line along the dominant axis of a face, the nearest sample to the middle of the material
/// behind the face, where the material has no sample. Faces within 8 degrees of each other are the two sides of a
/// plate.
/// Cost: O(n log n) in triangles, then the sample lines of plates. The work ends after 34 million inspected boxes, or
/// 256 per triangle if this is more; the remaining faces get nothing.
void addThinPlates(const IndexMesh& mesh, const IndexFromLocal& indexFromLocal, Vec3i dimension,
                   const ThinClaims& claims, std::vector<ClaimedBox>& boxes);

/// Adds the samples [begin, end) along axes.x, in row `row` along axes.y, at sample `at` along axes.z.
void addInterval(const ScanAxes& axes, std::int32_t row, std::int32_t begin, std::int32_t end, std::int32_t at,
                 std::uint32_t claim, std::vector<ClaimedBox>& boxes);

/// Adds a row of samples; neighbours at the same `sampleAt` are merged into one box. -1: no sample.
template <class SampleAt>
void addRowOfSamples(const ScanAxes& axes, std::int32_t row, std::int32_t begin, std::int32_t end, std::uint32_t claim,
                     std::vector<ClaimedBox>& boxes, SampleAt&& sampleAt) {
    constexpr std::int32_t kNone = -1;
    std::int32_t from = begin, current = kNone;
    for (std::int32_t x = begin; x <= end; ++x) {
        const std::int32_t sample = x < end ? sampleAt(x) : kNone;
        if (x < end && sample == current) continue;
        if (current != kNone) addInterval(axes, row, from, x, current, claim, boxes);
        from = x;
        current = sample;
    }
}

}  // namespace svt::voxelize

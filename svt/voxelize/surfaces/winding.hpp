#pragma once
/// \file
/// Fills open shells with solid meaning by the generalized winding number.
///
///      .--o - - o--.          w(p) = n(p) - c(p)
///      |    lid    |          n: winding number of shell and lids together, which the sweep counts as for any solid
///      |           |  shell   c: winding number of the lids, their solid angle / 4 pi; only the rim (o) matters
///      |     p     |
///      `-----------'          p is inside  <=>  w >= 1/2  <=>  n >= ceil(c + 1/2)
///
/// Where |c| < 1/2 the threshold is 1, as for a closed solid; elsewhere boxes are added that count for the claim, or
/// against it, so that the sweep may always compare with 1:
///
///      o---------o     the lid, and below it the surface c = 1/2: other holes push it away from the lid. Between them
///       `._____,'      n = 1 but w < 1/2: boxes that count -1. For a single hole, a planar lid and the surface
///                      c = 1/2 would be the same, since a plane is seen under 2 pi from close by.

#include <svt/voxelize/surfaces/lid_field.hpp>
#include <svt/voxelize/tiles/tile_plan.hpp>

#include <atomic>
#include <memory>
#include <vector>

namespace svt::voxelize {

/// Fills the samples whose generalized winding number (Jacobson, Kavan & Sorkine 2013) is at least 1/2.
///
/// The winding number is evaluated as crossings minus a boundary integral (after the one-shot method of Martens &
/// Bessmeltsev 2025). Blocks of samples are halved until c is known well enough. In a block, each lid is a quadratic
/// polynomial with an error bound. Far lids are one polynomial for the block and all its parts (as in a fast multipole
/// method). Only samples for which the bound leaves the threshold open evaluate the solid angles. Close to a lid, its
/// side is decided as in the sweep, so that n and c always jump together.
///
/// The result is that of the sum over all triangles, except where that is within 1e-9 of 1/2, and for samples within
/// 1/256 voxel of the shell. Samples outside its bounding box are left out.
/// Cost: O(n log n) in the triangles, and O(samples close to the surfaces c = 1/2 + an integer, and to lids), each
/// times the pieces of lids close by. The work ends at a bound, which only heaps of loose triangles reach. Such a shell
/// should become a sheet.
class WindingFill {
public:
    /// \param shell  an open object of `meshes`
    /// \param claim  for the boxes
    /// \param solidAngles  the bound is this number + 20,000 * (samples of the bounding box)^(2/3)
    WindingFill(const mesh::ObjectMesh& shell, const mesh::MeshSet& meshes, const volume::Grid& grid,
                const IndexFromLocal& indexFromLocal, std::uint32_t claim, std::uint64_t solidAngles);

    /// Shell and lids, closed: to be swept.
    [[nodiscard]] const IndexMesh& covered() const noexcept { return lattice_; }

    /// The work comes in this many parts; part n may be done by any thread.
    [[nodiscard]] std::size_t partCount() const noexcept { return parts_.size(); }
    /// \return count of runs of samples that the part corrects; each takes 12 bytes until finish()
    std::size_t runPart(std::size_t n);

    /// Appends the boxes of all parts, disjoint as far as they count the same. Call it after all parts.
    /// \return count of samples within the bounding box of the shell whose winding number is over 1/4 away from every
    ///         whole number, where that distance differs from 1/4 by more than 0.01; closer ones may be miscounted
    std::uint64_t finish(std::vector<ClaimedBox>& boxes);
    /// The bound was reached: there are no boxes.
    [[nodiscard]] bool isOverBound() const noexcept { return work_ > bound_; }

private:
    friend class WindingBlocks;
    // Samples [low, high) of column (i, j) for which the sweep has to count `delta` more.
    struct Correction {
        std::uint16_t i, j, low, high;
        std::int32_t delta;
    };
    struct LidTriangle {
        Vec3d low, high;  // bounds, index space
        Vec3d normal;     // unit, index space
        double offset;
    };
    struct Part {
        Vec3i low;
        std::vector<Correction> corrections;
        std::uint64_t uncertain = 0;
    };

    CoveredShell shell_;
    IndexMesh lattice_;
    std::unique_ptr<LidField> field_;
    std::vector<LidTriangle> lids_;  // as the pieces of field_
    Vec3i begin_{}, end_{};          // samples inside the bounding box
    std::uint32_t claim_;
    std::vector<Part> parts_;
    std::atomic<std::uint64_t> work_{0};  // solid angles so far
    std::uint64_t bound_ = 0;
};

/// Generalized winding number of `mesh` at `point` (local space): the solid angles of all triangles (Van Oosterom &
/// Strackee 1983), divided by 4 pi. Reference implementation for tests. Cost: O(triangles).
[[nodiscard]] double windingNumber(const mesh::ObjectMesh& mesh, Vec3d point) noexcept;

}  // namespace svt::voxelize

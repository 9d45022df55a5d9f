#pragma once
/// \file
/// The owner of space that several objects claim, and the volume of space that two solids claim, m3. Closed meshes give
/// the exact volume, also of thin solids. Without them, voxels give the volume.

#include <svt/model/classes.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::analyze {

/// Whether a label is the glass of a window.
[[nodiscard]] bool isPane(const volume::Label& label);

/// The rank of a label's class where objects overlap; panes have that of furniture.
[[nodiscard]] model::ClassRank rankOf(const volume::Label& label);

/// All labels by their priority where objects overlap, the highest first: by class, solids before surfaces, then the
/// smaller volume, then the id (voxelize::ObjectClaim). Cost: O(n log n).
[[nodiscard]] std::vector<std::uint32_t> labelsByPriority(const volume::LabelTable& table);

/// Space that two labels claim.
struct SolidOverlap {
    std::uint32_t a = 0, b = 0;  ///< labels; `a` has the space: lower rank, then the smaller volume, then the id
    std::uint64_t voxels = 0;    ///< that both claimed; 0 where all of it lies between samples
    double volume = 0;           ///< m3
    double bound = 0;            ///< m3 by which `volume` may be off; infinite if unknown
    bool isExact = false;        ///< from meshes, whose points are rounded to VectorParts::unit; else from voxels
    bool isNested = false;       ///< one belongs to the other by hierarchy or groups, see volume::Overlap
};

struct SolidOverlapOptions {
    /// Maximum number of steps: inspected triangles and compared pairs of triangles. The overlaps of further solids
    /// come from voxels.
    std::uint64_t work = std::uint64_t{1} << 30;
};

struct SolidOverlaps {
    /// Ordered by (a, b): solids with a common volume that exceeds its bound, and all that share voxels.
    std::vector<SolidOverlap> pairs;
    /// Number of solids without a closed mesh in the volume: an overlap between samples is not found.
    std::size_t withoutMesh = 0;
    /// False if the work did not suffice for all pairs: an overlap between samples may be missing.
    bool isComplete = true;
};

/// The overlaps of all solids.
/// Cost: O(n log n) in solids, then for each pair whose boxes overlap its triangles there; at most `work`.
[[nodiscard]] SolidOverlaps solidOverlaps(const volume::SemanticVolume& volume,
                                          const SolidOverlapOptions& options = {});

/// Whether one label belongs to the other by the model's hierarchy or groups: a room in its building, a door in the
/// flat that has its wall as a member.
[[nodiscard]] bool areNested(const volume::LabelTable& table, std::uint32_t a, std::uint32_t b);

}  // namespace svt::analyze

#pragma once
/// \file
/// The best known volume of each feature with its parts, its bound, and where it comes from.
///
/// Closed meshes give exact volumes. Parts of a feature that are solids in the model lie within other parts (a room in
/// its building, a door in its wall) or beside them (the parts of a building). If every part with voxels lies in a
/// closed solid, and the outermost solids share no voxels, the volume of the feature is the sum of these solids. Several
/// of them must be parts of buildings, and must not have lost voxels to other features.
/// Otherwise it is the sum of analyze::ownMeasures(), in which voxels count the rest: open shells filled by winding
/// numbers, material behind surfaces, and solids that lost space to others.

#include <svt/analyze/extents.hpp>
#include <svt/volume/grid.hpp>
#include <svt/volume/label_table.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace svt::analyze {

enum class VolumeSource : std::uint8_t {
    None,    ///< unknown: neither a solid nor voxels with volume
    Meshes,  ///< exact, from closed meshes
    Voxels,  ///< counted
    Both     ///< partly exact, partly counted
};
/// "meshes", "voxels", "meshes and voxels"; empty for None.
[[nodiscard]] std::string_view volumeSourceName(VolumeSource source) noexcept;

struct KnownVolume {
    std::optional<double> volume;  ///< m3; empty: unknown
    /// m3 by which the volume may be off: 0 for closed meshes. For a counted part, half a voxel along its surface, and all
    /// voxels with an uncertain winding number. Its surface is that of its mesh, or of its voxels if these have less.
    /// Empty: unknown, in files of older versions.
    std::optional<double> bound;
    VolumeSource source = VolumeSource::None;
};

/// Volumes of the features of one table. Not thread-safe.
class KnownVolumes {
public:
    /// \param labels  must outlive the object, unchanged, like `extents`
    /// Cost: O(labels + overlaps).
    KnownVolumes(const volume::LabelTable& labels, const volume::Grid& grid, const Extents& extents);

    /// Cost: O(n log n) for n labels of the extent, plus their overlaps.
    [[nodiscard]] KnownVolume of(std::uint32_t label) const;

private:
    [[nodiscard]] std::optional<double> ofSolids(const std::vector<std::uint32_t>& extent) const;
    [[nodiscard]] KnownVolume ofOwn(const std::vector<std::uint32_t>& extent) const;
    [[nodiscard]] bool liesInSolid(std::uint32_t label) const;
    [[nodiscard]] std::optional<double> countingBound(std::uint32_t label) const;

    const volume::LabelTable& labels_;
    const Extents& extents_;
    std::vector<Measure> own_;
    std::vector<std::uint32_t> firstOverlap_;  // of l: labels_.overlaps[firstOverlap_[l]] .. [l + 1], by Overlap::a
    std::vector<std::uint32_t> losses_;        // by label: number of labels that took voxels of it
    std::vector<double> lostArea_;             // by label: m2 of the meshes that took voxels of it; NaN: unknown
    mutable std::vector<char> isInside_;       // by label: in the extent; 0 between calls
    double halfVoxel_ = 0, voxelVolume_ = 0;
    double voxelSurface_ = 0;  // m2 of one voxel
};

}  // namespace svt::analyze

#pragma once
/// \file
/// The value of a field at a point. Values never cross a wall: only nodes count that the point reaches through voxels of its
/// medium inside the cell of the lattice.
///
///     o---------#---o     o  node of the lattice      # voxels of a wall
///     |      p  #   |     The value at p is the mean of the two nodes on the left by their trilinear weights; those on the
///     |         #   |     right count for points on the right only.
///     o---------#---o
///
/// The medium of a point is that of its voxel: air (background, rooms and other spaces) or solid (any other component). So a field
/// of medium "all" has values in air and in walls, and does not mix the two. A point on the face between two voxels belongs
/// to the upper one.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/fields/field.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace svt::fields {

/// Whether a scalar of the volume belongs to the medium of a field, by scalar; background is entry 0. Air is background and
/// the labels that analyze::spacesOfLabels() names as spaces; solid is everything else. A query takes the parts of the selected
/// features along, see analyze::selectWithParts().
/// \return one entry per scalar of the label table; or BadQuery where the medium is a query that is not valid, NothingSelected
///         where it selects nothing
[[nodiscard]] Result<std::vector<char>> mediumOf(const FieldHead& head, const volume::SemanticVolume& volume);

/// Samples a field. Grid: by the rule above, trilinear inside a medium. Label: the value of the component at the point, else
/// that of the nearest ancestor with a value. Points: the value of the nearest point of the same room; no interpolation.
///
/// A cell of the lattice without a node that the point reaches: the value of the first node that the medium leads to, within 2
/// cells; else missing. A lattice reaches half a step beyond its outermost nodes.
///
/// Memory: 4 bytes per 512 voxels, 128 bytes per brick of 8 x 8 x 8 voxels with several media, and one bit per node. A
/// lattice with steps of more than one voxel also takes 4 bytes per cell, and a few bits per voxel of the cells with
/// several media.
class FieldSampler {
public:
    /// Voxels of a cell that a sampler can divide.
    static constexpr std::uint64_t kMaxCellVoxels = std::uint64_t{1} << 27;

    /// \param field, volume  must outlive the sampler
    /// \return the sampler; or as mediumOf(); BadField where the numbers of values and places do not agree; InputTooBig where a
    ///         cell of the lattice has more than kMaxCellVoxels voxels
    /// Cost: O(columns * runs of a column + values), and O(voxels of cells with several media) for steps of more than one voxel.
    [[nodiscard]] static Result<FieldSampler> make(const Field& field, const volume::SemanticVolume& volume);

    /// \param index      index space of the volume
    /// \param time       index into the times of the field
    /// \param component  0 .. components - 1
    /// \return the value, or NaN where it is missing, or for a time or component that does not exist. Any thread.
    [[nodiscard]] float at(Vec3d index, std::size_t time = 0, std::int32_t component = 0) const noexcept;

    /// The same between two times, linear; clamped to the first and the last. Missing if one of both values is missing.
    /// \param seconds  as in FieldHead::times
    [[nodiscard]] float atSeconds(Vec3d index, double seconds, std::int32_t component = 0) const noexcept;

    /// Smallest and largest value that is not missing, over all times and components; none if all are missing.
    [[nodiscard]] std::optional<std::pair<float, float>> range() const noexcept { return range_; }

    /// Whether the voxel that contains a point belongs to the medium of the field.
    [[nodiscard]] bool isInMedium(Vec3d index) const noexcept;

    /// Bytes of the tables of the sampler, without the field and the volume.
    [[nodiscard]] std::size_t sizeBytes() const noexcept;

private:
    struct Parts;

    FieldSampler() = default;
    std::shared_ptr<const Parts> parts_;
    std::optional<std::pair<float, float>> range_;
};

}  // namespace svt::fields

#pragma once
/// \file
/// The voxels of components as boxes with names: the common part of the writers for solvers.

#include <svt/analyze/merged_boxes.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::writers {

/// A group of merged boxes: a component, or all components of one class or material.
struct SolidGroup {
    std::string name;                       ///< name of the component, or its id; the class; the material
    std::uint32_t label = 0;                ///< the component, or the first of the group
    Vec3f color{};                          ///< colour of the label
    bool isHole = false, hasVents = false;  ///< selected by options.boxes.holes, options.boxes.vents
    friend bool operator==(const SolidGroup&, const SolidGroup&) = default;
};

/// Holes, and components with vents, have separate groups.
struct SolidBoxes {
    std::vector<SolidGroup> groups;        ///< in the order of their first labels
    std::vector<analyze::GroupBox> boxes;  ///< GroupBox::group: index into groups
};

/// Spaces (rooms, and their boundary surfaces) are air and are omitted, unless only spaces have voxels.
/// \return the boxes, or BadArgument for more than options.boxes.maxBoxes; BadQuery or NothingSelected of the two
///         queries
/// Cost: that of analyze::mergeBoxes().
[[nodiscard]] Result<SolidBoxes> solidBoxes(const volume::SemanticVolume& volume, const VolumeWriteOptions& options);

/// The material of a label by its attribute "material", otherwise its class.
[[nodiscard]] std::string materialOf(const volume::Label& label);

/// The corner of a box in metres along the grid's axes, from the lower corner of the first voxel.
[[nodiscard]] Vec3d cornerOf(Vec3i samples, const volume::Grid& grid) noexcept;

/// The place of coordinates of cornerOf(): "Metres from (x, y, z) along (x axis) and (y axis)", world space. The readers
/// of results find it by this text (field_readers::frameOfComment()).
[[nodiscard]] std::string placeText(const volume::Grid& grid);

/// Rounds to a micrometre (or square millimetre), so that a file has no digits from rounding errors.
[[nodiscard]] double roundedMetres(double metres) noexcept;

}  // namespace svt::writers

#pragma once
/// \file
/// The voxels of components as boxes with names: what the writers for solvers have in common.

#include <svt/analyze/merged_boxes.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::writers {

/// What boxes are merged for: a component, or all of one class or material.
struct SolidGroup {
    std::string name;                       ///< of the component, else its id; the class; the material
    std::uint32_t label = 0;                ///< the component; else the first of the group
    Vec3f color{};                          ///< of that label
    bool isHole = false, hasVents = false;  ///< selected by options.boxes.holes, options.boxes.vents
    friend bool operator==(const SolidGroup&, const SolidGroup&) = default;
};

/// Holes, and components with vents, have groups of their own.
struct SolidBoxes {
    std::vector<SolidGroup> groups;        ///< in the order of their first labels
    std::vector<analyze::GroupBox> boxes;  ///< GroupBox::group: index into groups
};

/// Spaces (rooms, and what bounds them as a surface) are air and are left out, unless nothing but spaces has voxels.
/// \return the boxes, or BadArgument for more than options.boxes.maxBoxes; BadQuery or NothingSelected of the two queries
/// Cost: that of analyze::mergeBoxes().
[[nodiscard]] Result<SolidBoxes> solidBoxes(const volume::SemanticVolume& volume, const VolumeWriteOptions& options);

/// The material of a label by its attribute "material", else its class.
[[nodiscard]] std::string materialOf(const volume::Label& label);

/// The corner of a box in metres along the grid's axes, from the lower corner of the first voxel.
[[nodiscard]] Vec3d cornerOf(Vec3i samples, const volume::Grid& grid) noexcept;

/// To a micrometre (or square millimetre), so that a file has no digits that are rounding alone.
[[nodiscard]] double roundedMetres(double metres) noexcept;

}  // namespace svt::writers

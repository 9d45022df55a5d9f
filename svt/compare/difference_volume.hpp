#pragma once
/// \file
/// Two states of a building as one volume: the space of each object before and after, coloured by its change.

#include <svt/compare/comparison.hpp>

namespace svt::compare {

/// A volume with one feature per kind of change ("added", "removed", ...), and below it the objects. An object of another
/// shape has up to three parts: `ID` (space that it has in both states), `ID/added` and `ID/removed`. Each label has the
/// attribute `change`. Where a room or building and a component claim a sample, the component has it.
/// Colours are those of Okabe and Ito (2008), which colour-blind readers can distinguish: added blue, removed vermilion,
/// moved purple, other changes yellow, unchanged grey.
/// \return the volume over both grids; BadArgument if the samples of the two grids do not coincide; GridTooLarge,
///         TooManyLabels
/// Cost: O(runs of both volumes).
[[nodiscard]] Result<volume::SemanticVolume> makeDifferenceVolume(const volume::SemanticVolume& was,
                                                                  const volume::SemanticVolume& is,
                                                                  const Comparison& comparison);

/// The colour of an object with this change in a difference volume, sRGB, 0..1.
[[nodiscard]] Vec3f colorOfChange(Change change) noexcept;

/// The volume, moved in world space. The voxels move with it, so their samples coincide with those of another volume
/// only if the vector is a multiple of the spacing.
/// \param vector  metres
/// \return the volume; errors of volume::Grid::fromParts()
[[nodiscard]] Result<volume::SemanticVolume> translated(const volume::SemanticVolume& volume, Vec3d vector);

}  // namespace svt::compare

#pragma once
/// \file
/// A building with its storeys drawn apart: the same volume with each storey lifted above the one below. What follows
/// (cuts, lenses, names, levels of detail, any renderer) need not know of it, for it is an ordinary volume.
///
///          +----+                  roof      +----+     + 2 d
///        +-+----+-+                        +-+----+-+
///        |  attic |    d                 - - - - - - -
///        +--------+   --->         attic   +--------+   + d, with its floor
///        |  ground |                       |        |
///        +--------+                      - - - - - - -
///                                  ground  +--------+   stays, open above

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

namespace svt::illustrate {

/// Lifts each storey of a building by `distance` times its number, the lowest being 0; the grid grows upwards.
///
/// What belongs to a storey by the tree or a group moves as a whole. All else (walls of the whole height, shafts) moves with
/// the storey in which at least 85 % of its height lies, and is cut into storeys otherwise: where the ceilings of rooms
/// are, so that a storey takes its floor with it. Where the model names no storeys they are those of findLevels(). Storeys
/// are counted in each building by itself; what belongs to no building stays.
/// \param distance  metres, > 0; rounded to whole bricks of 8 voxels, at least one
/// \param threads   0: all cores
/// \return the volume, or BadArgument: no building has two storeys, or the grid would be too high
/// Cost: O(distinct columns and rows + labels + planes and vectors times storeys); bricks are made anew.
[[nodiscard]] Result<volume::SemanticVolume> explodeStoreys(const volume::SemanticVolume& volume, double distance,
                                                            int threads = 0);

}  // namespace svt::illustrate

#pragma once
/// \file
/// A building with its storeys drawn apart: the same volume with each storey lifted above the one below. The result is
/// an ordinary volume, so later steps (cuts, lenses, names, levels of detail, any renderer) need no special case.
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

/// Lifts each storey of a building by `distance` times its number, where the lowest is 0. The grid grows upwards.
///
/// Labels that belong to a storey by the tree or a group move as a whole. Other labels (walls of the whole height,
/// shafts) move with the storey that contains at least 85 % of their height. Otherwise they are cut at the ceilings of
/// rooms, so that a storey moves with its floor. If the model declares no storeys, the levels of findLevels() are used.
/// Storeys are counted separately in each building. Labels outside of buildings do not move.
/// \param distance  metres, > 0; rounded to whole bricks of 8 voxels, at least one
/// \param threads   0: all cores
/// \return the volume, or BadArgument: no building has two storeys, or the grid would be too high
/// Cost: O(distinct columns and rows + labels + planes and vectors times storeys); bricks must be made again.
[[nodiscard]] Result<volume::SemanticVolume> explodeStoreys(const volume::SemanticVolume& volume, double distance,
                                                            int threads = 0);

}  // namespace svt::illustrate

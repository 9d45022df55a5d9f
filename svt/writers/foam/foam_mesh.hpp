#pragma once
/// \file
/// The mesh of an OpenFOAM case: a cube per voxel of air, and a patch per label that the air touches.
///
///     | constant/polyMesh/ | content                                                                          |
///     | points             | corners of the cells, metres along the axes of the grid from its lower corner    |
///     | faces              | inner faces by their cells, then those of each patch; normals leave the owner    |
///     | owner, neighbour   | the cells of each face; the owner of an inner face has the lower number          |
///     | boundary           | the patches                                                                      |

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/dense/new_folder.hpp>
#include <svt/writers/foam/air_cells.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::writers {

/// The faces between the cells and one label.
struct FoamPatch {
    std::uint32_t label = volume::kNoLabel;  ///< kNoLabel: background, also beyond the volume
    std::string name;                        ///< a word of OpenFOAM, unique: ASCII letters, digits and '_'
    bool isAir = false;                      ///< of a space that is not part of the case
    std::uint32_t faces = 0;
    double area = 0;  ///< m2, of the sides of voxels
};

/// \return the patches in the order of their labels, background last; or DiskFull, CannotWrite
/// Cost: O(voxels of the box). Memory: 4 bytes for each, and 16 bytes for each face of a patch.
[[nodiscard]] Result<std::vector<FoamPatch>> writeFoamMesh(const volume::SemanticVolume& volume, const AirCells& cells,
                                                           NewFolder& folder);

}  // namespace svt::writers

#pragma once
/// \file
/// Geometry for the Fire Dynamics Simulator of NIST (FDS 6, User's Guide: the namelist groups MESH, SURF, OBST, HOLE,
/// VENT): a mesh whose cells are the voxels, and components as boxes.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <string>
#include <string_view>

namespace svt::writers {

/// Writes one MESH, and one SURF and the OBSTs of each group. The MESH is enlarged to numbers of cells without prime
/// factors over 5, which the pressure solver requires. All of its sides except the bottom are open. Components of
/// options.boxes.holes become OBST and HOLE, those of options.boxes.vents OBST with VENTs on both sides. Coordinates
/// are metres along the grid's axes from its lower corner, because FDS does not use world coordinates.
/// \param name  name of the simulation, from which CHID is made
/// \return the document, ASCII, or the error of solidBoxes()
[[nodiscard]] Result<std::string> makeFds(const volume::SemanticVolume& volume, std::string_view name,
                                          const VolumeWriteOptions& options);

}  // namespace svt::writers

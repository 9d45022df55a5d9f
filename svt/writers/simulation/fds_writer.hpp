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

/// One MESH, grown to numbers of cells that have no prime factor over 5, which the pressure solver wants; its sides but
/// the bottom open; one SURF and the OBSTs of each group; options.boxes.holes as OBST and HOLE, options.boxes.vents as OBST with VENTs
/// on both sides. Metres along the grid's axes from its lower corner, for FDS takes no world coordinates.
/// \param name  of the simulation, from which CHID is made
/// \return the document, ASCII, or the error of solidBoxes()
[[nodiscard]] Result<std::string> makeFds(const volume::SemanticVolume& volume, std::string_view name,
                                          const VolumeWriteOptions& options);

}  // namespace svt::writers

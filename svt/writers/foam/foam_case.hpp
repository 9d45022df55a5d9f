#pragma once
/// \file
/// Cases of OpenFOAM (openfoam.com v1912 and later): the air of rooms, moved by warm and cold surfaces.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

/// Writes a folder for buoyantBoussinesqPimpleFoam (k-epsilon). It holds the mesh of writeFoamMesh(), fields
/// in `0`, schemes and tolerances in `system`, scripts for MPI and Slurm, and a table of the patches. README.md states
/// all assumptions. The folder appears when all of it is written. An existing one is never replaced.
///
/// Surfaces have 20 degrees Celsius unless FoamWriteOptions::temperatures says otherwise. Faces to other spaces and to
/// background are adiabatic.
/// \return bytes of all files
///         - errors of airCells(); BadQuery; WouldDestroy, CannotWrite, DiskFull.
///         - BadArgument for a temperature without the form "QUERY:CELSIUS", outside of -100 to 1000, or of components
///           that the air does not touch.
/// Cost and memory: those of airCells() and writeFoamMesh(); 150 bytes on disk per cell.
[[nodiscard]] Result<std::uint64_t> writeFoamCase(const volume::SemanticVolume& volume,
                                                  const std::filesystem::path& path, const VolumeWriteOptions& options);

}  // namespace svt::writers

#pragma once
/// \file
/// A field on a lattice as a file of VTK or as NRRD: 32-bit floats at the nodes, NaN where a value is missing. Places are metres in the
/// CRS of the model. Vectors are turned from the axes of the grid to those of the world.
///
///     .vti   regular lattices, also of rotated grids (ParaView, VTK 9, PyVista)
///     .vtr   lattices of a grid along the axes of the world, also with uneven steps
///     .nrrd  regular lattices, also of rotated grids (3D Slicer, ITK, pynrrd); one component
///
/// svt::field_readers reads the same values at the same places again.

#include <svt/core/result.hpp>
#include <svt/fields/field.hpp>
#include <svt/volume/grid.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace svt::field_writers {

/// \param field  of kind Grid
/// \param grid   of its volume
/// \param time   index into the times of the field
/// \param path   its ending determines the format
/// \return bytes written, or CannotWrite, DiskFull; BadArgument if the format cannot hold the field, with another that can
/// Cost: one pass over the values of the time. Memory: 16 MB.
[[nodiscard]] Result<std::uint64_t> writeLattice(const fields::Field& field, const volume::Grid& grid, std::size_t time,
                                                 const std::filesystem::path& path);

}  // namespace svt::field_writers

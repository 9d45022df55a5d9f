#pragma once
/// \file
/// Writes the surface of each label as triangles in the plain formats that CAD, print and mesh programs read. The surfaces
/// are those of a .glb (see GlbOptions::faces): closed for each label.
///
/// - OBJ: an object per label, named by its id, a group by its class, a material by its colour in `<stem>.mtl` beside it;
///   world coordinates, metres.
/// - PLY: binary, world coordinates as doubles; each face has `label` (its number in the table) and colour; comments tell
///   id, class and name of each label.
/// - STL: binary, no names; coordinates are 32-bit floats, so they are metres from the lower corner of the grid, along world
///   axes; the header of 80 bytes tells where that is.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

enum class HullFormat : std::uint8_t { Obj, Ply, Stl };

/// Writes one file (OBJ: two), all or nothing. Equal volumes give equal bytes.
/// \return bytes, or NothingSelected if no label has voxels, GridTooLarge for too many triangles, CannotWrite, DiskFull,
///         WouldDestroy (something else beside the OBJ), Cancelled
[[nodiscard]] Result<std::uint64_t> writeHulls(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                               HullFormat format, const VolumeWriteOptions& options);

}  // namespace svt::writers

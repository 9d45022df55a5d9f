#pragma once
/// \file
/// Components as boxes, for solvers with their own formats.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <string>

namespace svt::writers {

/// CSV with a header line and one line per box: its group, its samples [begin, end), its corners in metres along the
/// grid's axes from the lower corner of the first voxel.
/// \return the table, or the error of solidBoxes()
[[nodiscard]] Result<std::string> makeBoxTable(const volume::SemanticVolume& volume, const VolumeWriteOptions& options);

/// The same as JSON: "grid" with its place in the world, "groups", "boxes".
[[nodiscard]] Result<std::string> makeBoxJson(const volume::SemanticVolume& volume, const VolumeWriteOptions& options);

}  // namespace svt::writers

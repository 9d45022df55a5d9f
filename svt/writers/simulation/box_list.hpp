#pragma once
/// \file
/// Components as boxes, for solvers that have a format of their own.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <string>

namespace svt::writers {

/// A line per box: what it belongs to, its samples [begin, end), its corners in metres along the grid's axes from the
/// lower corner of the first voxel. CSV with a header line.
/// \return the table, or the error of solidBoxes()
[[nodiscard]] Result<std::string> makeBoxTable(const volume::SemanticVolume& volume, const VolumeWriteOptions& options);

/// The same as JSON: "grid" with what places it in the world, "groups", "boxes".
[[nodiscard]] Result<std::string> makeBoxJson(const volume::SemanticVolume& volume, const VolumeWriteOptions& options);

}  // namespace svt::writers

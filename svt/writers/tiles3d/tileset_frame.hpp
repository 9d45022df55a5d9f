#pragma once
/// \file
/// The common part of tilesets of surfaces and of voxels: the place on the globe, and its JSON.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/crs/globe.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <nlohmann/json.hpp>

namespace svt::writers {

using TilesetJson = nlohmann::ordered_json;

/// The frame at `corner`, by the options or the CRS of the volume.
/// \return the frame, or CannotProject, BadArgument for an invalid place
[[nodiscard]] Result<crs::GlobeFrame> frameOfVolume(const volume::SemanticVolume& volume, Vec3d corner,
                                                    const VolumeWriteOptions& options);

/// A box as its centre and half axes.
[[nodiscard]] TilesetJson boundingVolume(const Box3d& box);

/// A matrix whose columns are the axes and the origin.
[[nodiscard]] TilesetJson transformOf(const crs::GlobeFrame& frame);

/// The asset of a tileset; corner and CRS are extras.
[[nodiscard]] TilesetJson assetOf(const volume::SemanticVolume& volume, Vec3d corner);

}  // namespace svt::writers

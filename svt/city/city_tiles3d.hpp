#pragma once
/// \file
/// A city as 3D Tiles: which volume of it stands in which square of the quadtree.

#include <svt/city/city_folder.hpp>
#include <svt/core/progress.hpp>
#include <svt/writers/volume_formats.hpp>

#include <filesystem>

namespace svt::city {

/// Writes a city as 3D Tiles 1.1 with implicit tiling (svt/writers/city_tileset.hpp).
///
/// The squares are those of the city's tiles and the ones around them. A tile has the surfaces of detail 0, a feature a
/// building. A square around tiles has the finest coarser detail with at most 256 columns along a side: detail 1 has
/// buildings, too, coarser ones classes and mixtures of them.
/// \param finest  0; 1: tiles have detail 1, of which all are smaller
/// \return bytes of all files, or an error of City::find(), City::read(), writers::CityTileset
/// Memory: that of some tiles at a time.
[[nodiscard]] Result<std::uint64_t> writeCityTiles(const City& city, const std::filesystem::path& path,
                                                   const writers::VolumeWriteOptions& options, int finest, int threads,
                                                   const Progress* progress);

}  // namespace svt::city

#pragma once
/// \file
/// A city as 3D Tiles: one volume for each square of the quadtree.

#include <svt/city/city_folder.hpp>
#include <svt/core/progress.hpp>
#include <svt/writers/volume_formats.hpp>

#include <filesystem>

namespace svt::city {

/// Writes a city as 3D Tiles 1.1 with implicit tiling (svt/writers/city_tileset.hpp).
///
/// The squares are those of the city's tiles and the ones around them. A tile has the surfaces of detail 0, with a
/// feature for each building. A square around tiles has the finest coarser detail with at most 256 columns along a
/// side. Detail 1 also has buildings; coarser details have classes and mixtures of them.
/// \param finest  detail of the tiles: 0, or 1 for smaller files
/// \return bytes of all files, or an error of City::find(), City::read(), writers::CityTileset
/// Memory: a few tiles at a time.
[[nodiscard]] Result<std::uint64_t> writeCityTiles(const City& city, const std::filesystem::path& path,
                                                   const writers::VolumeWriteOptions& options, int finest, int threads,
                                                   const Progress* progress);

}  // namespace svt::city

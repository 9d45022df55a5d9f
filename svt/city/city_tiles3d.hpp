#pragma once
/// \file
/// A city as 3D Tiles: one volume for each square of the quadtree.

#include <svt/city/city_folder.hpp>
#include <svt/core/progress.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace svt::city {

/// Figures of a written tileset.
struct CityTilesReport {
    std::uint64_t bytes = 0;
    std::size_t tiles = 0;       ///< finest contents
    std::size_t voxelTiles = 0;  ///< those of tiles without meshes, whose surfaces are those of their voxels
};

/// Writes a city as 3D Tiles 1.1 with implicit tiling (svt/writers/city_tileset.hpp).
///
/// The squares are those of the city's tiles and larger ones around them. A tile has the faces of its meshes, with a
/// feature for each building. A square of 2048 m has the same faces, simplified to cubes of 8 m. Larger squares have the
/// voxels of the finest detail with at most 128 columns along a side, or of the coarsest, with classes and mixtures of
/// them. Smaller squares around tiles have no content.
/// \param finest  0; or 1: tiles are simplified, too, to twice the spacing of the city
/// \return figures, or an error of City::find(), City::read(), writers::CityTileset
/// Memory: a few tiles at a time.
[[nodiscard]] Result<CityTilesReport> writeCityTiles(const City& city, const std::filesystem::path& path,
                                                     const writers::VolumeWriteOptions& options, int finest,
                                                     int threads, const Progress* progress);

}  // namespace svt::city

#pragma once
/// \file
/// Passes over all tiles of a city, one after the other: damaged tiles, sections, and pairs of buildings that claim the
/// same space.

#include <svt/city/city_folder.hpp>
#include <svt/core/diagnostics.hpp>
#include <svt/core/progress.hpp>
#include <svt/drawing/section_drawing.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace svt::city {

/// The members of a tile that have its faces: see City::read() and City::readWithMeshes().
enum class TileFaces : std::uint8_t { Footprints, Meshes };

/// Reads the tiles of detail 0. Memory: one tile per thread.
/// \param rectangle  west, south, east, north in metres
/// \param threads    0: all cores
/// \param work       called in the order of tiles, never twice at once; an error ends the pass. It may change the tile.
/// \param isWanted   tiles that are read; null: all
/// \return nothing, or an error of City::find(), City::read() or `work`; Cancelled
[[nodiscard]] Result<void> forEachTile(const City& city, const std::array<double, 4>& rectangle, int threads,
                                       const Progress* progress,
                                       const std::function<Result<void>(volume::SemanticVolume&)>& work,
                                       const std::function<bool(const IndexEntry&)>& isWanted = {},
                                       TileFaces faces = TileFaces::Footprints);

/// Counts of the tiles of a city.
struct TileCheck {
    std::uint64_t tiles = 0, damaged = 0;
    std::uint64_t buildings = 0, solids = 0, open = 0;  ///< at detail 0; open: solids whose shell had holes
};
/// Reads all tiles of all details. Findings are damaged tiles, shells that had holes, missing packs, features that were
/// left out, and a wrong number of buildings.
/// \return the counts, or an error of City::find(); Cancelled
[[nodiscard]] Result<TileCheck> checkTiles(const City& city, const Progress* progress, Diagnostics& findings);

/// A drawing, and a volume with its labels and the grid that its coordinates refer to.
struct CitySection {
    drawing::SectionDrawing drawing;
    volume::SemanticVolume volume;
};

/// The tiles of detail 0 that cutCity() reads.
/// \return the tiles, or an error of frameVolume(), parseSectionPlane(), City::find()
[[nodiscard]] Result<std::vector<IndexEntry>> tilesOfSection(const City& city, const std::string& plane);

/// Cuts the tiles of a city that a plane meets, one after the other. Each building is complete in its tile, so there
/// are no seams.
/// \param plane  see parseSectionPlane(); positions refer to the box of the city
/// \return the section, or an error of forEachTile(), frameVolume(), parseSectionPlane(), drawSection()
/// Memory: one tile per thread, and the drawing.
[[nodiscard]] Result<CitySection> cutCity(const City& city, const std::string& plane,
                                          const drawing::SectionOptions& options, const Progress* progress);

struct CityOverlap {
    struct Building {
        std::string id, name;
    };
    Building a, b;
    std::uint64_t voxels = 0;
    double volume = 0;  ///< m3, of these voxels
    std::string tiles;  ///< one, or two with a blank between them
};

/// Pairs of different buildings (labels without parent) that claim a sample of detail 0. The query selects at least one
/// of the two, or something below it. Samples of pairs within a tile were counted when the tile was built. For pairs
/// from two tiles, all samples that both fill count.
/// \return the pairs, or an error of City::find(), City::read() or the query; Cancelled
/// Cost: each tile is read once, and again for each neighbour that it overlaps and that is no longer in memory.
[[nodiscard]] Result<std::vector<CityOverlap>> cityOverlaps(const City& city, const std::string& query,
                                                            const Progress* progress);

}  // namespace svt::city

#pragma once
/// \file
/// Tiles of a city with the samples of their neighbours, to find the neighbours of a building.

#include <svt/city/city_folder.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace svt::city {

/// A tile within its surroundings.
struct SurroundedTile {
    volume::SemanticVolume volume;
    std::uint32_t ownLabels = 0;  ///< the first labels are those of the tile; all others belong to neighbours
};

/// Reads the tiles of detail 0 one by one. Keeps up to 64 tiles in memory. Threads: one.
class SurroundedTiles {
public:
    /// \param reach  metres around the samples of a tile within which neighbours count
    /// \return the tiles, or an error of City::find()
    [[nodiscard]] static Result<SurroundedTiles> open(const City& city, double reach);

    [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }

    /// The tile with its meshes, and the samples of neighbours. A sample that a tile and a neighbour fill is that of the
    /// tile. Neighbours have no meshes, and only the voxels within reach.
    /// \return the tile, or an error of City::readWithMeshes(), joinVolumes()
    [[nodiscard]] Result<SurroundedTile> read(std::size_t number);

private:
    SurroundedTiles(const City& city, std::vector<IndexEntry> entries, double reach)
        : city_(&city), entries_(std::move(entries)), reach_(reach) {}
    /// The samples of a tile without its meshes.
    [[nodiscard]] Result<const volume::SemanticVolume*> samplesOf(const IndexEntry& entry);

    const City* city_;
    std::vector<IndexEntry> entries_;
    double reach_;
    using Place = std::pair<std::uint32_t, std::uint64_t>;  // pack, offset
    std::map<Place, volume::SemanticVolume> known_;
};

}  // namespace svt::city

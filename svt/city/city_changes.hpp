#pragma once
/// \file
/// The tiles in which two states of a city differ. Tiles with equal bytes are left out, so the cost of a comparison grows with
/// the changes, not with the city.

#include <svt/city/city_folder.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::city {

/// Tiles of one place that differ, at detail 0 along the Morton curve. One list may be empty.
struct ChangedTiles {
    std::vector<IndexEntry> was, is;
};

/// Buildings of one tile that moved to one other tile of another place, because one place would have more than 16 tiles.
struct MovedBuildings {
    ChangedTiles tiles;            ///< the tile before, and the tile after
    std::vector<std::string> ids;  ///< ascending
};

struct CityChanges {
    std::vector<ChangedTiles> places;
    std::uint64_t equalTiles = 0, equalBuildings = 0;
    /// A comparison of the places must leave them out, else it finds them removed and added.
    std::vector<MovedBuildings> apart;
};

/// Finds the tiles that differ. Tiles that were divided or joined are one place, and so are the tiles before and after of a
/// building that moved to another tile and kept its id.
/// \param threads  0: all cores; the result does not depend on it
/// \return the changes; BadArgument if the cities have different spacings or reference systems; CityIncomplete if packs of
///         one are missing; Cancelled; or an error of City::find(), City::readBytes(), openSvt()
/// Cost: the bytes of detail 0 of both cities are read; label tables of tiles that differ are decoded. Memory: the index, the
/// ids of buildings in tiles that differ, and two tiles per thread.
[[nodiscard]] Result<CityChanges> findCityChanges(const City& was, const City& is, int threads = 0,
                                                  const Progress* progress = nullptr);

/// The two states of a place.
struct PlaceStates {
    volume::SemanticVolume was, is;
};
/// Reads the tiles of a place, with their meshes. A state without tiles is empty on the grid of the other one.
/// \return the volumes, or an error of City::readWithMeshes(), joinVolumes()
[[nodiscard]] Result<PlaceStates> readPlace(const City& was, const City& is, const ChangedTiles& place);

/// Takes the geometry from buildings with their parts: from those with these ids, or from all others.
/// \param ids  ascending  \param areKept  whether those with these ids keep their geometry
/// \return by label: whether it was taken
std::vector<char> takeGeometry(volume::SemanticVolume& volume, const std::vector<std::string>& ids, bool areKept);

}  // namespace svt::city

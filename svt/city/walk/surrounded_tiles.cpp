#include <svt/city/city_surroundings.hpp>
#include <svt/city/join/join_volumes.hpp>
#include <svt/volume/volume_part.hpp>

#include <iterator>
#include <span>
#include <utility>

namespace svt::city {
namespace {

constexpr std::size_t kMostKnownTiles = 64;

// The box of the samples, wider in plan by `reach`; all heights.
Box3d boxAround(const volume::Grid& grid, double reach) {
    const Vec3d low = grid.origin(), s = grid.spacing();
    const Vec3i n = grid.dimension();
    constexpr double kAnyHeight = 1e6;
    Box3d box;
    box.min = {low.x - reach, low.y - reach, -kAnyHeight};
    box.max = {low.x + s.x * (n.x - 1) + reach, low.y + s.y * (n.y - 1) + reach, kAnyHeight};
    return box;
}

}  // namespace

Result<SurroundedTiles> SurroundedTiles::open(const City& city, double reach) {
    SVT_TRY(entries, city.find(0, kEverywhere));
    return SurroundedTiles(city, std::move(*entries), reach);
}

Result<const volume::SemanticVolume*> SurroundedTiles::samplesOf(const IndexEntry& entry) {
    const Place place(entry.pack, entry.offset);
    if (const auto known = known_.find(place); known != known_.end()) return &known->second;
    SVT_TRY(read, city_->read(entry));
    read->footprints = {};
    // Tiles are read in the order of the packs, so the first ones are needed least.
    if (known_.size() >= kMostKnownTiles)
        known_.erase(known_.begin()->first < place ? known_.begin() : std::prev(known_.end()));
    return &known_.emplace(place, std::move(*read)).first->second;
}

Result<SurroundedTile> SurroundedTiles::read(std::size_t number) {
    SVT_TRY(own, city_->readWithMeshes(entries_[number]));
    SurroundedTile result;
    result.ownLabels = static_cast<std::uint32_t>(own->labels.labels.size());
    const Box3d box = boxAround(own->grid, reach_);
    std::vector<volume::SemanticVolume> volumes;
    volumes.push_back(std::move(*own));
    const IndexEntry& entry = entries_[number];
    SVT_TRY(near, city_->find(0, {box.min.x, box.min.y, box.max.x, box.max.y}));
    for (const IndexEntry& other : *near) {
        if (other.tile == entry.tile) continue;
        SVT_TRY(samples, samplesOf(other));
        auto part = volume::volumeIn(**samples, box);
        if (!part && part.error().code() == Code::NothingSelected) continue;
        if (!part) return part.error();
        volumes.push_back(std::move(*part));
    }
    if (volumes.size() == 1) {
        result.volume = std::move(volumes.front());
        return result;
    }
    SVT_TRY(joined, joinVolumes(volumes));
    joined->vectors = joinTriangles(std::span(volumes).first(1), joined->grid);
    result.volume = std::move(*joined);
    return result;
}

}  // namespace svt::city

#include "city.hpp"

#include <svt/city/city_levels.hpp>
#include <svt/illustrate/view.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::web {
namespace {

// FNV-1a of where the tiles stand.
std::string keyOf(const std::vector<city::IndexEntry>& entries) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const city::IndexEntry& entry : entries)
        for (const std::uint64_t number : {std::uint64_t{entry.pack}, entry.offset, entry.size})
            hash = (hash ^ number) * 0x100000001b3u;
    return fmt::format("{}-{:x}", entries.size(), hash);
}

}  // namespace

Result<void> CityPage::open() {
    if (city_) return {};
    SVT_TRY(opened, city::City::open(bytes_.store(), {}));
    SVT_TRY(frame, city::frameVolume(*opened));
    city_ = std::move(*opened);
    frame_ = std::move(*frame);
    return {};
}

Result<city::ChosenTiles> CityPage::choose(const CityWish& wish) {
    if (!wish.scene) return city::ChosenTiles{{city_->top()}, std::size_t(city_->top().size), 1};
    // The camera alone: queries and planes find nothing in the frame.
    illustrate::Scene seen;
    seen.camera = wish.scene->camera;
    seen.width = wish.scene->width;
    seen.height = wish.scene->height;
    SVT_TRY(spec, illustrate::makeFrameSpec(seen, frame_));
    city::CameraView view = city::cameraViewOf(*spec, frame_.grid);
    view.pixel *= std::max(1.0, wish.pixels);
    return city::chooseTiles(*city_, view, wish.memoryBytes);
}

Result<CityPage::Look> CityPage::look(const CityWish& wish) {
    SVT_DO(open());
    SVT_TRY(chosen, choose(wish));
    Look look;
    look.pixels = chosen->pixels * std::max(1.0, wish.pixels);
    look.key = keyOf(chosen->entries);
    if (look.key == wish.shown) return look;
    // All of them are asked for before any is decoded.
    std::optional<Error> missing;
    for (const city::IndexEntry& entry : chosen->entries)
        if (auto read = city_->readBytes(entry); !read) missing = read.error();
    if (missing && bytes_.isWanting()) return *missing;
    auto parts = city::readTiles(*city_, *chosen);
    if (!parts) {
        // What is damaged or cannot be had is left out.
        std::erase_if(chosen->entries, [&](const city::IndexEntry& entry) {
            const auto volume = city_->read(entry);
            if (!volume) look.lacks.push_back(volume.error().where().toString() + ": " + volume.error().message());
            return !volume;
        });
        parts = city::readTiles(*city_, *chosen);
    }
    if (!parts) return parts.error();
    bytes_.forget();
    SVT_TRY(joined, city::joinTiles(*city_, frame_, *chosen, std::move(*parts)));
    look.tiles = chosen->entries.size();
    for (const city::IndexEntry& entry : chosen->entries) look.bytes += entry.size;
    if (!chosen->entries.empty()) {
        look.coarsest = chosen->entries.front().detail;
        look.finest = chosen->entries.back().detail;
    }
    look.session = Session::ofTiles(std::move(*joined));
    return look;
}

Result<illustrate::SceneCamera> CityPage::find(const std::string& id, const illustrate::SceneCamera& now,
                                               double aspect) {
    SVT_DO(open());
    SVT_TRY(places, city_->find(id));
    for (const city::City::Place& place : *places) {
        const double side = city::tileSide(place.tile, 0, city_->spacing());
        SVT_TRY(entries, city_->find(0, {place.tile.x * side, place.tile.y * side, (place.tile.x + 1) * side,
                                         (place.tile.y + 1) * side}));
        for (const city::IndexEntry& entry : *entries) {
            if (!(entry.tile == place.tile)) continue;
            SVT_TRY(tile, city_->read(entry));
            auto camera = illustrate::makeView("id=" + id, "", now, aspect, *tile);
            if (!camera) continue;  // another id of the same hash
            const Vec3d by = tile->grid.origin() - frame_.grid.origin();
            if (camera->eye) camera->eye = *camera->eye + by;
            if (camera->target) camera->target = *camera->target + by;
            return camera;
        }
    }
    return Error(Code::NothingSelected, fmt::format("the city has no building with the id '{}'", id));
}

}  // namespace svt::web

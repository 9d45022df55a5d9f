#include "city.hpp"

#include <svt/city/city_painter.hpp>
#include <svt/illustrate/view.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::web {
namespace {

// FNV-1a of the places of the tiles.
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
    SVT_TRY(view, city::viewOf(*wish.scene, frame_));
    view->pixel *= std::max(1.0, wish.pixels);
    return city::chooseTiles(*city_, *view, wish.memoryBytes);
}

Result<CityPage::Look> CityPage::look(const CityWish& wish) {
    SVT_DO(open());
    SVT_TRY(chosen, choose(wish));
    Look look;
    look.pixels = chosen->pixels * std::max(1.0, wish.pixels);
    look.key = keyOf(chosen->entries);
    if (look.key == wish.shown) return look;
    // Requests all tiles before decoding any.
    std::optional<Error> missing;
    for (const city::IndexEntry& entry : chosen->entries)
        if (auto read = city_->readBytes(entry); !read) missing = read.error();
    if (missing && bytes_.isWanting()) return *missing;
    auto parts = city::readTiles(*city_, *chosen);
    if (!parts) {
        // Leaves out tiles that are damaged or unavailable.
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
    city::Extract building;
    building.ids.push_back(id);
    SVT_TRY(part, city::extractVolume(*city_, building));
    // Shows the whole part, because all voxels of a building may belong to features below it.
    SVT_TRY(camera, illustrate::makeView("", "", now, aspect, *part, &frame_.grid));
    camera->around = "id=" + id;
    return camera;
}

Result<city::City::Found> CityPage::search(const std::string& text, std::size_t most) {
    SVT_DO(open());
    auto found = city_->search(text, most);
    // Pages of other words are fetched again, so that memory does not grow with each search.
    if (!bytes_.isWanting()) bytes_.forget();
    return found;
}

Result<city::CitySection> CityPage::cut(const std::string& plane, const drawing::SectionOptions& options,
                                        std::uint64_t mostBytes, const Progress* progress) {
    SVT_DO(open());
    SVT_TRY(tiles, city::tilesOfSection(*city_, plane));
    std::uint64_t bytes = 0;
    for (const city::IndexEntry& entry : *tiles) bytes += entry.size;
    if (bytes > mostBytes)
        return Error(
            Code::BadSection,
            fmt::format("the plane '{}' may cut {} tiles with {:.0f} MB, and the page reads at most {:.0f} MB; "
                        "draw it with 'svt section CITY --plane', or choose another plane",
                        plane, tiles->size(), double(bytes) / 1e6, double(mostBytes) / 1e6));
    for (const city::IndexEntry& entry : *tiles)
        if (auto read = city_->readBytes(entry); !read && !bytes_.isWanting()) return read.error();
    if (bytes_.isWanting()) return Error(Code::CannotOpen, "bytes of tiles are not here yet");
    auto section = city::cutCity(*city_, plane, options, progress);
    bytes_.forget();
    return section;
}

}  // namespace svt::web

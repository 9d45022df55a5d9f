#include <apps/cli/options/city_page.hpp>

#include <apps/cli/output/messages.hpp>

#include <svt/city/city_levels.hpp>
#include <svt/city/city_view.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {

bool isCity(const std::filesystem::path& input) {
    // As it was given: the generic form has but one slash behind "http:".
    const std::string text = input.string();
    if (text.starts_with("http://") || text.starts_with("https://")) return true;
    std::error_code ignored;
    return std::filesystem::is_regular_file(input / "city.json", ignored);
}

Result<volume::SemanticVolume> pageVolume(const std::filesystem::path& folder) {
    // Of the members: about as much as the page loads in some seconds, and draws within its memory.
    constexpr std::uint64_t kMostBytes = 6'000'000;
    constexpr double kMostSamples = 8192;
    const auto city = city::City::open(folder);
    if (!city) return city.error();
    const Box3d& box = city->box();
    const double extent = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
    city::Extract extract;
    extract.box = {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z};
    extract.hasBox = true;
    for (extract.detail = 0; extract.detail < city->topDetail(); ++extract.detail) {
        const auto entries = city::allTiles(*city, extract.detail);
        if (!entries) return entries.error();
        std::uint64_t bytes = 0;
        for (const city::IndexEntry& entry : *entries) bytes += entry.size;
        if (bytes <= kMostBytes && extent / city::spacingOf(extract.detail, city->spacing()).x <= kMostSamples) break;
    }
    auto volume = city::extractVolume(*city, extract);
    if (!volume) return volume;
    note(
        fmt::format("the page shows all of the city at detail {} ({}), voxels of {:g} m; svt city extract takes a "
                    "part at a finer one",
                    extract.detail,
                    extract.detail == 0   ? "all labels"
                    : extract.detail == 1 ? "one label a building"
                                          : "classes",
                    volume->grid.spacing().x));
    return volume;
}

}  // namespace svt::cli

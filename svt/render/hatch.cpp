#include <svt/render/hatch.hpp>

#include <algorithm>
#include <array>

namespace svt::render {
namespace {

constexpr std::array<std::string_view, 10> kNames{
    "none", "masonry", "concrete", "reinforced-concrete", "timber", "insulation", "earth", "steel", "glass", "general"};

}  // namespace

std::string_view hatchName(Hatch hatch) noexcept { return kNames[static_cast<std::size_t>(hatch)]; }

std::span<const std::string_view> hatchNames() noexcept { return kNames; }

std::optional<Hatch> hatchFromName(std::string_view name) noexcept {
    const auto found = std::ranges::find(kNames, name);
    if (found == kNames.end()) return std::nullopt;
    return static_cast<Hatch>(found - kNames.begin());
}

}  // namespace svt::render

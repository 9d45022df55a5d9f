#pragma once
/// \file
/// Hatches of cut faces: what a component is made of, in the signs of building drawings (after ISO 128-3 and
/// DIN 1356-1).

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace svt::render {

enum class Hatch : std::uint8_t {
    None,
    Masonry,             ///< narrow lines rising to the right
    Concrete,            ///< dots and small triangles, as gravel lies
    ReinforcedConcrete,  ///< lines rising to the right, every second one dashed
    Timber,              ///< grain
    Insulation,          ///< a zigzag between lines
    Earth,               ///< groups of three lines, turned from field to field
    Steel,               ///< pairs of narrow lines rising to the right
    Glass,               ///< sparse short strokes
    General              ///< wide lines rising to the right: any other solid
};

/// "masonry", "reinforced-concrete", ...; "none".
[[nodiscard]] std::string_view hatchName(Hatch hatch) noexcept;
/// All names, in the order of the enum.
[[nodiscard]] std::span<const std::string_view> hatchNames() noexcept;
[[nodiscard]] std::optional<Hatch> hatchFromName(std::string_view name) noexcept;

/// How a hatch is drawn. All in metres.
struct HatchPen {
    double spacing;    ///< between the lines of Hatch::Masonry
    double lineWidth;  ///< >= 0
    double pixel;      ///< width over which edges of lines are softened, > 0
};

/// How much ink lies at (u, v) of a cut face, 0..1. Where lines come closer than two pixels, their mean.
[[nodiscard]] double hatchInk(Hatch hatch, double u, double v, const HatchPen& pen) noexcept;

}  // namespace svt::render

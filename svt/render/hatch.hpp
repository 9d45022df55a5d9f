#pragma once
/// \file
/// Hatches of caps (cut faces): they show the material of a component as building drawings do (after ISO 128-3 and
/// DIN 1356-1).

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace svt::render {

enum class Hatch : std::uint8_t {
    None,
    Masonry,             ///< narrow lines rising to the right
    Concrete,            ///< dots and small triangles, like gravel
    ReinforcedConcrete,  ///< lines rising to the right, every second one dashed
    Timber,              ///< grain
    Insulation,          ///< a zigzag between lines
    Earth,               ///< groups of three lines, rotated from field to field
    Steel,               ///< pairs of narrow lines rising to the right
    Glass,               ///< sparse short strokes
    General              ///< wide lines rising to the right: any other solid
};

/// "masonry", "reinforced-concrete", ..., "none".
[[nodiscard]] std::string_view hatchName(Hatch hatch) noexcept;
/// All names, in the order of the enum.
[[nodiscard]] std::span<const std::string_view> hatchNames() noexcept;
[[nodiscard]] std::optional<Hatch> hatchFromName(std::string_view name) noexcept;

/// How a hatch is drawn. All in metres.
struct HatchPen {
    double spacing;    ///< between the lines of Hatch::Masonry
    double lineWidth;  ///< >= 0
    double pixel;      ///< filter width: edges of lines are antialiased over it, > 0
};

/// Coverage by ink at (u, v) of a cap, 0..1; u and v in metres. Where lines are closer than two pixels, their mean.
[[nodiscard]] double hatchCoverage(Hatch hatch, double u, double v, const HatchPen& pen) noexcept;

}  // namespace svt::render

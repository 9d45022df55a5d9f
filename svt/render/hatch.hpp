#pragma once
/// \file
/// Hatches of caps (cut faces): they show the material of a component as building drawings do (after ISO 128-3 and
/// DIN 1356-1).

#include <svt/core/names.hpp>

#include <array>
#include <cstdint>

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

constexpr auto namesOf(Hatch) {
    return std::to_array<Name<Hatch>>({{Hatch::None, "none"},
                                       {Hatch::Masonry, "masonry"},
                                       {Hatch::Concrete, "concrete"},
                                       {Hatch::ReinforcedConcrete, "reinforced-concrete"},
                                       {Hatch::Timber, "timber"},
                                       {Hatch::Insulation, "insulation"},
                                       {Hatch::Earth, "earth"},
                                       {Hatch::Steel, "steel"},
                                       {Hatch::Glass, "glass"},
                                       {Hatch::General, "general"}});
}

/// How a hatch is drawn. All in metres.
struct HatchPen {
    double spacing;    ///< between the lines of Hatch::Masonry
    double lineWidth;  ///< >= 0
    double pixel;      ///< filter width: edges of lines are antialiased over it, > 0
};

/// Coverage by ink at (u, v) of a cap, 0..1; u and v in metres. Where lines are closer than two pixels, their mean.
[[nodiscard]] double hatchCoverage(Hatch hatch, double u, double v, const HatchPen& pen) noexcept;

}  // namespace svt::render

#pragma once
/// \file
/// How a section drawing looks on paper, whatever it is written to: which lines are bold, which hatch fills what.

#include <svt/drawing/hatches.hpp>
#include <svt/drawing/section_drawing.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace svt::writers {

/// A tile of a hatch, millimetres on paper, after ISO 128-3 and DIN 1356-1.
struct HatchTile {
    render::Hatch hatch;
    double width, height;
    double turnDegrees;  ///< of the tile, clockwise on paper
    const char* tint;    ///< background color below the lines
    const char* lines;   ///< path of SVG, drawn with narrow lines
    const char* filled;  ///< path, or none
};
[[nodiscard]] std::span<const HatchTile> hatchTiles() noexcept;

/// Lower left and upper right corner of all that is drawn; both zero where nothing is.
[[nodiscard]] std::pair<drawing::PlanePoint, drawing::PlanePoint> drawnBox(const drawing::SectionDrawing& drawing);

class DrawingStyle {
public:
    /// \param millimetres  on paper per metre
    DrawingStyle(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume, double millimetres);

    [[nodiscard]] render::Hatch hatchOf(std::uint32_t label) const noexcept { return hatches_[label]; }
    /// Rooms, units, storeys, and what is not drawn.
    [[nodiscard]] bool isSpace(std::uint32_t label) const noexcept;
    /// Cut load-bearing or enclosing parts have bold outlines. Fillings, furniture and parts only a line or two thick
    /// have thin ones.
    [[nodiscard]] bool isBold(std::uint32_t label) const noexcept;
    /// Thin between two cut parts and around fillings and furniture.
    [[nodiscard]] bool isBoldBetween(std::uint32_t left, std::uint32_t right) const noexcept;

private:
    [[nodiscard]] bool isSheet(std::uint32_t label) const noexcept;
    [[nodiscard]] bool isSlim(const drawing::SectionComponent& component, double millimetres) const noexcept;

    const volume::SemanticVolume& volume_;
    std::vector<render::Hatch> hatches_;  // by label
    std::vector<std::uint8_t> isSlim_;    // by label
};

}  // namespace svt::writers

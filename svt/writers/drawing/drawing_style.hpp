#pragma once
/// \file
/// The style of a section drawing on paper, the same for all formats: line widths and hatches.

#include <svt/drawing/hatches.hpp>
#include <svt/drawing/section_drawing.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace svt::writers {

/// A tile of a hatch, millimetres on paper, according to ISO 128-3 and DIN 1356-1.
struct HatchTile {
    render::Hatch hatch;
    double width, height;
    double turnDegrees;  ///< of the tile, clockwise on paper
    const char* tint;    ///< background color below the lines
    const char* lines;   ///< path of SVG, drawn with narrow lines
    const char* filled;  ///< path, or none
};
[[nodiscard]] std::span<const HatchTile> hatchTiles() noexcept;

/// Lower left and upper right corner of the drawing; both zero if it is empty.
[[nodiscard]] std::pair<drawing::PlanePoint, drawing::PlanePoint> drawnBox(const drawing::SectionDrawing& drawing);

class DrawingStyle {
public:
    /// \param millimetres  on paper per metre
    DrawingStyle(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume, double millimetres);

    [[nodiscard]] render::Hatch hatchOf(std::uint32_t label) const noexcept { return (*hatches_)[label]; }
    /// Whether a label is a room, unit or storey, or not drawn.
    [[nodiscard]] bool isSpace(std::uint32_t label) const noexcept;
    /// Cut load-bearing or enclosing parts have bold outlines. Fillings, furniture and parts that are only one or two
    /// lines thick have thin ones.
    [[nodiscard]] bool isBold(std::uint32_t label) const noexcept;
    /// Thin between two cut parts and around fillings and furniture; bold between a part and the ground.
    [[nodiscard]] bool isBoldBetween(std::uint32_t left, std::uint32_t right) const noexcept;

private:
    [[nodiscard]] bool isSheet(std::uint32_t label) const noexcept;
    [[nodiscard]] bool isGround(std::uint32_t label) const noexcept;
    [[nodiscard]] bool isSlim(const drawing::SectionComponent& component, double millimetres) const noexcept;

    const volume::SemanticVolume& volume_;
    std::shared_ptr<const std::vector<render::Hatch>> hatches_;  // by label
    std::vector<std::uint8_t> isSlim_;                           // by label
};

}  // namespace svt::writers

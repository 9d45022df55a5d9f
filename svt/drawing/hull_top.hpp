#pragma once
/// \file
/// The highest point of a building in a section or an elevation.

#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/label_table.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace svt::drawing {

class HullTop {
public:
    /// Cost: O(labels).
    explicit HullTop(const volume::LabelTable& table);

    /// The highest v of walls, slabs and roofs that are cut or visible, metres; without any, that of all components except spaces.
    /// Trees, handrails, and spaces in the open air above a roof may be higher. Nothing if the drawing has no lines.
    [[nodiscard]] std::optional<double> of(const SectionDrawing& drawing) const;

private:
    enum class Part : std::uint8_t { Space, Hull, Other };
    std::vector<Part> parts_;  // by label
};

}  // namespace svt::drawing

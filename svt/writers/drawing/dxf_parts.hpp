#pragma once
/// \file
/// Names of layers, patterns of hatches and outlines in DXF drawings.

#include <svt/drawing/hatches.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/label_table.hpp>

#include <array>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::writers {

/// One family of parallel lines of a hatch, metres in the drawing at a scale of 1:100.
struct DxfHatchLine {
    double degrees;
    double x, y;       ///< a point of one of the lines
    double distance;   ///< between lines
    double dash, gap;  ///< 0: continuous
};
struct DxfHatch {
    render::Hatch hatch;
    const char* name;
    std::span<const DxfHatchLine> lines;
};
/// The pattern for a hatch; nullptr for none.
[[nodiscard]] const DxfHatch* dxfHatchOf(render::Hatch hatch) noexcept;

/// The content of a layer, as in the names of ISO 13567-2: the field "presentation".
enum class DxfContent : char { Element = 'E', Hatch = 'H', Text = 'T', Dimension = 'D' };

/// The layer of a component: its `ifcType`, otherwise its class, with its function if that is a word: `IfcWall`,
/// `BuildingConstructiveElement_wall`, `Door`.
[[nodiscard]] std::string dxfLayerOf(const volume::Label& label);

/// The layer of a component according to ISO 13567-2, ten characters: agent `A-`, element by the table of CI/SfB
/// (`21----` external walls), presentation (`E-`).
/// \param isExternal  of walls and doors, see drawing::findExternalParts()
/// \param field  the user-defined field, eight characters behind the empty optional fields: lines beyond the cut
[[nodiscard]] std::string isoLayerOf(const volume::Label& label, bool isExternal, DxfContent content,
                                     std::string_view field = {});
/// The same for content that does not belong to a component: texts, dimensions.
[[nodiscard]] std::string isoLayerOf(DxfContent content);

/// Outlines of components without the joints between walls of one material: the drawing has no border there.
class DxfOutlines {
public:
    explicit DxfOutlines(const drawing::SectionDrawing& drawing);

    /// The parts of a ring that have borders; the whole ring if it has no joint.
    /// \param isClosed  set to whether it is the whole ring
    [[nodiscard]] std::vector<std::vector<drawing::PlanePoint>> partsOf(const drawing::Ring& ring,
                                                                        bool& isClosed) const;

private:
    using Edge = std::array<double, 4>;  // u and v of both ends
    [[nodiscard]] bool isJoint(drawing::PlanePoint from, drawing::PlanePoint to) const;

    std::set<Edge> rings_, borders_;  // rings in their direction, borders in both
};

}  // namespace svt::writers

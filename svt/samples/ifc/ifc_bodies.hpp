#pragma once
/// \file
/// Solids of the designs as IFC bodies: a piece is an extrusion, a solid a union or difference of extrusions.

#include <svt/samples/ifc/ifc_records.hpp>
#include <svt/samples/parts/plan.hpp>

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace svt::samples {

/// Writes representation items; each has the style of its material.
class IfcBodies {
public:
    IfcBodies(IfcRecords& records, int context) : records_(records), context_(context) {}

    /// One piece as an IfcExtrudedAreaSolid: a box stands on a rectangle and goes up, a prism goes along its axis.
    /// \param frame  axes of the product, in the plan
    int extrusion(const Frame& frame, Axis axis, const Piece& piece);

    /// A solid without the pieces that `isLeftOut` marks, as one extrusion or a tree of IfcBooleanResult.
    /// \param isLeftOut  by piece; may be empty
    int solid(const Frame& frame, const Solid& solid, const std::vector<bool>& isLeftOut, bool& isBoolean);

    /// A closed shell of planar faces as an IfcFacetedBrep.
    /// \param vertices  of the plan, to which the rings of the shell refer
    int brep(const Frame& frame, std::span<const Point> vertices, const Shell& shell, Material shown);

    /// IfcShapeRepresentation 'Body' of items.
    int representation(const std::vector<int>& items, std::string_view type);
    /// IfcProductDefinitionShape of representations.
    int shape(const std::vector<int>& representations);

    /// Gives an item the colour of a material.
    void style(int item, Material material);
    /// IfcSurfaceStyle of a colour, written once.
    int surfaceStyle(std::string_view name, const std::array<double, 3>& color, double transparency);

    [[nodiscard]] int context() const { return context_; }

private:
    IfcRecords& records_;
    int context_;
};

}  // namespace svt::samples

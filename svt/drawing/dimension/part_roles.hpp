#pragma once
/// \file
/// The role of each component in dimensions and extents: measured as hull, opening or room, or only drawn.

#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <vector>

namespace svt::drawing {

enum class PartRole : std::uint8_t {
    Nothing,       ///< not measured: furniture, installations, railings, coverings, terraces, closure surfaces
    Surroundings,  ///< terrain, vegetation, roads, city furniture: not measured, and not part of the building's extent
    Space,         ///< rooms, units, storeys
    Opening,       ///< windows and doors with their casings, frames and panes
    Hull,          ///< walls, slabs, roofs, and bodies of buildings without parts
    Frame,         ///< beams, stairs, cladding: they count where they touch the hull
    Column         ///< counts where it touches the hull, and in drawings without a hull
};

/// The roles by label. Classes decide, then `ifcType`, `function` and `predefinedType`. Names decide only for components
/// without a type, and for IfcBuildingElementProxy: "RPC Tree" is vegetation. Parts of a component without a type of
/// their own, such as the layers of a wall, have its role.
[[nodiscard]] std::vector<PartRole> partRoles(const volume::LabelTable& table);

/// The roles within a drawing: a frame or a column that touches the hull there counts as hull, others as nothing.
/// Without a hull, all columns count as hull, and frames as nothing.
[[nodiscard]] std::vector<PartRole> rolesIn(const SectionDrawing& drawing, std::vector<PartRole> roles);

}  // namespace svt::drawing

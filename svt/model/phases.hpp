#pragma once
/// \file
/// Phases: the parts of an object that have a style of their own, such as the pane of a window or the handle of a door.
///
///     Window "W1"            frame: the opaque part of the largest extent stays the object
///       WindowPhase "glass"  pane: attributes phase = glass, transparency = 0.8
///
/// An object and its phases own one range of scalars, as an object and the layers of its material do.

#include <svt/model/building_model.hpp>

#include <cstddef>
#include <string_view>

namespace svt::model {

/// The name of phases of glass in all formats.
inline constexpr std::string_view kGlass = "glass";
/// The attributes of an object with phases, and of these.
inline constexpr std::string_view kPhaseAttribute = "phase", kTransparencyAttribute = "transparency";

/// Maximum number of phases of an object, beside the one that stays with it. Smaller ones stay with it, too.
inline constexpr std::size_t kMaxPhases = 16;

/// Whether a name of a material, style or part says glass: one of its words is "glass" or "glazing" in one of several
/// languages. "Glass wool" and "Fiberglass Batt" do not.
[[nodiscard]] bool saysGlass(std::string_view name);

/// Moves the parts of objects with a material of their own to features below the object, one per material.
///
/// A part is a solid, or the surfaces of a material that form closed shells. Open surfaces of doors, windows and their
/// like are parts as well, except where they bound a space together with others. The opaque part of the largest extent
/// stays the geometry of the object: the frame of a door, not its leaf. Doors, windows, installations and furniture are
/// split by all materials, other objects only where a part is glass or named by the file. Spaces, buildings, boundary
/// surfaces and objects with several levels of detail are not split.
///
/// Glass gets the attribute `phase` with the value "glass", also where an object is all glass. Transparent materials give
/// the attribute `transparency` (0: opaque, 1: invisible). A pane of a door or window whose material is named glass but
/// opaque counts as transparent, see the attribute `transparencyAssumed`.
///
/// A model that is split again stays as it is.
/// \return number of phases added
/// Cost: O(n) in the number of points.
std::size_t splitPhases(BuildingModel& model);

}  // namespace svt::model

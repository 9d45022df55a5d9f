#pragma once
/// \file
/// Tests whether the interior of a solid is connected although its shells touch along lines (404).

#include <svt/validate/solids/bodies.hpp>

#include <optional>
#include <vector>

namespace svt::validate {

/// \param shells  of one solid, all oriented away from its material, valid, without common faces; the exterior first
/// \return a point of a part that is cut off (units), empty if the interior is connected
///
/// Shells are cut where others touch them. Connected pieces of surface bound the same part of the interior, and so do
/// two pieces that see each other through it. Lines of sight are sound but not complete: a part that is visible only
/// around many corners may be reported as cut off. They are needed only where lines of contact cut a shell into pieces,
/// which is rare.
[[nodiscard]] std::optional<Vec3d> findCutOffPart(const std::vector<const Body*>& shells, double noise);

}  // namespace svt::validate

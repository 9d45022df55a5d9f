#pragma once
/// \file
/// Is the interior of a solid in one piece although its shells touch along lines (404)?

#include <svt/validate/solids/bodies.hpp>

#include <optional>
#include <vector>

namespace svt::validate {

/// \param shells  of one solid, all looking away from its material, valid, without faces in common; the exterior first
/// \return a point of a part that is cut off (units), empty if the interior is connected
///
/// Shells are cut where others touch them. Pieces of surface that hang together have the same part of the interior
/// before them, and so have two pieces that see each other through it. Lines of sight are sound but not complete: a
/// part that is only seen around many corners may be reported as cut off. They are asked for only where lines of contact
/// cut a shell in pieces, which is rare.
[[nodiscard]] std::optional<Vec3d> findCutOffPart(const std::vector<const Body*>& shells, double noise);

}  // namespace svt::validate

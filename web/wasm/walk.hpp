#pragma once
/// \file
/// Walking through the open volume: where one can stand, and steps that glide along walls, over sills and up stairs.

#include "session.hpp"

#include <optional>

namespace svt::web {

/// Metres from the floor to the eye.
inline constexpr double kEyeHeight = 1.65;

/// A place where one can stand: there is air for a body, and a floor below. Those in rooms come first, then those nearest
/// to `wanted`.
/// \param wanted  of the eye, metres from the grid's lower corner; its height says which floor, within 1.5 m
/// \return the eye, or nothing where there is no such place within 60 m
[[nodiscard]] std::optional<Vec3d> standingPlace(const Session& session, Vec3d wanted);

/// Where the eye is after a step: as far as there is air, and along what is in the way; up and down steps of at most 0.45 m
/// where one stood on the floor. Who stands in something solid already gets out of it.
[[nodiscard]] Vec3d afterStep(const Session& session, Vec3d eye, Vec3d step);

}  // namespace svt::web

#pragma once
/// \file
/// Walking through the open volume: places to stand, and steps that glide along walls, over sills and up stairs.

#include "session.hpp"

#include <optional>

namespace svt::web {

/// Metres from the floor to the eye.
inline constexpr double kEyeHeight = 1.65;

/// Finds a place where a person can stand: with air for a body, and a floor below. Places in rooms have priority, then
/// places nearest to `wanted`.
/// \param wanted  position of the eye, metres from the grid's lower corner; its height selects the floor, within 1.5 m
/// \return the eye, or nothing if there is no such place within 60 m
[[nodiscard]] std::optional<Vec3d> standingPlace(const Session& session, Vec3d wanted);

/// The position of the eye after a step. The step goes as far as there is air, and along obstacles. From a floor, it
/// goes up and down steps of at most 0.45 m. A person inside something solid can leave it.
[[nodiscard]] Vec3d afterStep(const Session& session, Vec3d eye, Vec3d step);

}  // namespace svt::web

#pragma once
/// \file
/// A scene at a time: what moves between its key frames, and the camera that goes around.

#include <svt/illustrate/scene.hpp>

#include <span>
#include <string>

namespace svt::illustrate {

/// The scene at a time of its motion, without motion itself. Each member that some key gives goes from its value at the
/// key before to that at the key after; the scene itself, with the defaults of members that it leaves out, holds at time 0. Numbers, points and colours go
/// through all that lies between; so do the numbers of cuts and keeps whose text is else the same ("z>6" to "z>1"). An
/// eye goes around its target, on a great circle. What cannot be between changes at its key. With Motion::turn the
/// camera also goes around a vertical axis, evenly; a named view is then so far away that all that the scene
/// draws at its beginning stays in the picture.
/// \param seconds  less than 0 is 0, more than the motion lasts is its end
/// \return the scene, or BadScene where the members of that moment do not fit together; BadQuery, NothingSelected or
///         BadCamera where a named view that turns cannot be made
/// Cost: O(members of the scene and its keys); where a named view turns, also that of visiblePoints().
[[nodiscard]] Result<Scene> sceneAt(const Scene& scene, double seconds, const volume::SemanticVolume& volume);

/// Lets the cuts of the passes go to `cuts` until a time, evenly unless the scene has keys already: adds a key.
/// \param cuts     one for each pass; those that differ from the scene's move
/// \param seconds  above 0, within the motion
/// \return success, or BadArgument where a key of the scene already gives one of these cuts
[[nodiscard]] Result<void> addCutKey(Scene& scene, std::span<const std::string> cuts, double seconds);

/// Checks that the scene can be made at each of its keys.
/// \return success, or BadScene that names the member as "/motion/keys/N/scene/..."
[[nodiscard]] Result<void> checkMotion(const Scene& scene, const std::string& name);

/// Number of pictures of a motion: one at time 0, and so on at its rate; at least 1.
[[nodiscard]] int pictureCount(const Motion& motion) noexcept;

}  // namespace svt::illustrate

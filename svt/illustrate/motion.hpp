#pragma once
/// \file
/// A scene at a time: members that change between its key frames, and a camera that orbits the model.

#include <svt/illustrate/scene.hpp>

#include <span>
#include <string>

namespace svt::illustrate {

/// The scene at a time of its motion, without the motion itself. Each member that a key sets changes from its value at
/// the previous key to that at the next key. The scene itself, with defaults for omitted members, is the key at time 0.
/// Numbers, points and colours are interpolated, as are the numbers of cuts and keeps with otherwise equal text ("z>6"
/// to "z>1"). An eye moves around its target on a great circle. Members that cannot be interpolated change at their
/// key. With Motion::turn, the camera also orbits a vertical axis evenly. A named view then keeps enough distance that
/// all parts that the scene draws at its beginning stay in the picture.
/// \param seconds  clamped to the duration of the motion
/// \return the scene, or BadScene if the members at that time are inconsistent; BadQuery, NothingSelected or BadCamera
///         if a turning named view cannot be made
/// Cost: O(members of the scene and its keys); for a turning named view, also that of visiblePoints().
[[nodiscard]] Result<Scene> sceneAt(const Scene& scene, double seconds, const volume::SemanticVolume& volume);

/// Adds a key at which the cuts of the passes reach `cuts`. The pace is even, unless the scene already has keys.
/// \param cuts     one per pass; those that differ from the scene's move
/// \param seconds  above 0, within the motion
/// \return success, or BadArgument if a key of the scene already sets one of these cuts
[[nodiscard]] Result<void> addCutKey(Scene& scene, std::span<const std::string> cuts, double seconds);

/// Checks that the scene is valid at each of its keys.
/// \return success, or BadScene with the member as "/motion/keys/N/scene/..."
[[nodiscard]] Result<void> checkMotion(const Scene& scene, const std::string& name);

/// The number of pictures of a motion: the first at time 0, the next ones at its rate; at least 1.
[[nodiscard]] int pictureCount(const Motion& motion) noexcept;

}  // namespace svt::illustrate

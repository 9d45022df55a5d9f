#pragma once
/// \file
/// Views that show a part of a volume, as cameras of scenes.

#include <svt/illustrate/scene.hpp>

namespace svt::illustrate {

/// A view of what `query` selects, as large as fits.
/// \param query   empty: the whole volume
/// \param preset  from where, see render::cameraPresetNames(); empty: from where `now` looks
/// \param now     the camera to go on from: projection, field of view, and where it looks
/// \param aspect  width / height of the picture, > 0
/// \return a camera with eye and target, and a zoom of 1 unless it goes on from a parallel `now`; or BadQuery,
///         NothingSelected, BadCamera
[[nodiscard]] Result<SceneCamera> viewOf(const std::string& query, const std::string& preset, const SceneCamera& now,
                                         double aspect, const volume::SemanticVolume& volume);

}  // namespace svt::illustrate

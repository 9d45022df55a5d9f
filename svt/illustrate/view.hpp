#pragma once
/// \file
/// Cameras of scenes that show a part of a volume.

#include <svt/illustrate/scene.hpp>

namespace svt::illustrate {

/// A view of the labels that `query` selects, as large as possible.
/// \param query   empty: the whole volume
/// \param preset  named view, see render::cameraPresetNames(); empty: the view direction of `now`
/// \param now     the current camera: projection, field of view and view direction
/// \param aspect  width / height of the picture, > 0
/// \param frame   eye and target are in metres from the lower corner of this grid; null: from that of `volume`
/// \return a camera with eye and target, and a zoom of 1 unless it continues a parallel `now`; or BadQuery,
///         NothingSelected, BadCamera
[[nodiscard]] Result<SceneCamera> makeView(const std::string& query, const std::string& preset, const SceneCamera& now,
                                           double aspect, const volume::SemanticVolume& volume,
                                           const volume::Grid* frame = nullptr);

}  // namespace svt::illustrate

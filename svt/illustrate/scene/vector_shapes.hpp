#pragma once
/// \file
/// Lines and meshes of a scene's pass, from the edges and meshes of the model that a volume stores.

#include <svt/analyze/selection.hpp>
#include <svt/illustrate/scene.hpp>

namespace svt::illustrate {

/// Adds the lines and meshes of `wanted` to `pass`.
/// \param rows  of volume.labels
/// \return success, or BadArgument if the volume was built without them or a size is not a length; BadQuery,
///         NothingSelected
[[nodiscard]] Result<void> addShapes(const ScenePass& wanted, const volume::SemanticVolume& volume,
                                     const analyze::LabelRows& rows, render::Pass& pass);

}  // namespace svt::illustrate

#pragma once
/// \file
/// Lines and meshes of a scene's pass, from what a volume keeps of its model.

#include <svt/illustrate/scene.hpp>

namespace svt::illustrate {

/// Puts the lines and meshes that `wanted` asks for into `pass`.
/// \return BadArgument where the volume was built without them or a size is no length; BadQuery, NothingSelected
[[nodiscard]] Result<void> addShapes(const ScenePass& wanted, const volume::SemanticVolume& volume, render::Pass& pass);

}  // namespace svt::illustrate

#pragma once
/// \file
/// Volumes as JSON, as commands print it and Python has it. Stable; described in docs/user/json.md.

#include <svt/record/record.hpp>
#include <svt/volume/semantic_volume.hpp>

namespace svt::frontend {

using record::Json;

[[nodiscard]] Json toJson(const AttributeValue& value);
[[nodiscard]] Json toJson(Vec3d v);
[[nodiscard]] Json toJson(Vec3i v);
/// dimension, spacing, origin, axes.
[[nodiscard]] Json gridJson(const volume::Grid& grid);
/// One feature: id, class, name, parent, first, count, voxels, volume, closed, filling, ...
[[nodiscard]] Json labelJson(const volume::LabelTable& table, std::uint32_t label, const volume::Grid& grid);
[[nodiscard]] Json overlapsJson(const volume::LabelTable& table);
/// What `svt info --json` prints.
[[nodiscard]] Json infoJson(const volume::SemanticVolume& volume);

}  // namespace svt::frontend

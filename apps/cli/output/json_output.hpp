#pragma once
/// \file
/// JSON printed by commands. Stable; described in docs/user/json.md.

#include <svt/pipeline/build_volume.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <nlohmann/json.hpp>

namespace svt::cli {

using Json = nlohmann::ordered_json;

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
[[nodiscard]] Json diagnosticsJson(const Diagnostics& diagnostics);

/// Prints with two spaces of indentation; invalid UTF-8 is replaced.
void print(const Json& json);

}  // namespace svt::cli

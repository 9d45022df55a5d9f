#pragma once
/// \file
/// The JSON of volumes that commands print and Python returns. Stable; described in docs/user/json.md.

#include <svt/analyze/known_volumes.hpp>
#include <svt/record/record.hpp>
#include <svt/volume/semantic_volume.hpp>

namespace svt::frontend {

using record::Json;

[[nodiscard]] Json toJson(const AttributeValue& value);
/// A single value, or an array of several.
[[nodiscard]] Json toJson(const AttributeList& list);
[[nodiscard]] Json toJson(Vec3d v);
[[nodiscard]] Json toJson(Vec3i v);
/// dimension, spacing, origin, and the axes as frame.
[[nodiscard]] Json gridJson(const volume::Grid& grid);
/// One feature: id, class, name, parent, first, count, its own and total voxels and volumes, closed, filling, ...
[[nodiscard]] Json labelJson(const volume::LabelTable& table, const analyze::FeatureMeasure& measure,
                             const analyze::KnownVolume& volume, const volume::Grid& grid);
/// Pairs of labels that claim the same voxels: a, b, voxels, nested.
[[nodiscard]] Json overlapsJson(const volume::LabelTable& table);
/// All of a volume, as `svt info --json` prints it.
[[nodiscard]] Json infoJson(const volume::SemanticVolume& volume);

}  // namespace svt::frontend

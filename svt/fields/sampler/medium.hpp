#pragma once
/// \file
/// The medium of each scalar, for the grid of media.

#include <svt/core/result.hpp>
#include <svt/fields/field.hpp>
#include <svt/fields/sampler/medium_grid.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <vector>

namespace svt::fields {

/// Whether each scalar is air: background, and the scalars of spaces.
[[nodiscard]] std::vector<char> airOf(const volume::LabelTable& labels);

/// Medium::None where mediumOf() is false, else whether the scalar is air or solid.
/// \return or as mediumOf()
[[nodiscard]] Result<std::vector<Medium>> mediaOf(const FieldHead& head, const volume::SemanticVolume& volume);

}  // namespace svt::fields

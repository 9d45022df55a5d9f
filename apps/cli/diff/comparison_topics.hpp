#pragma once
/// \file
/// The changes between two states as issues (BCF).

#include <apps/cli/diff/changed_storeys.hpp>
#include <apps/cli/diff/compared.hpp>

#include <svt/writers/bcf_file.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace svt::cli {

/// One topic per row: texts, the objects, a camera that looks at them from the south-east, and a picture. Coordinates are
/// those of the model that has the objects: the new one, or the old one for removed objects.
/// \param rows      numbers of Comparison::rows, which differ
/// \param pictures  of the difference volume; null: topics without pictures
/// Cost: that of drawing::labelExtents() of both volumes, and of a picture per row.
[[nodiscard]] Result<std::vector<writers::BcfTopic>> changeTopics(const Compared& compared,
                                                                  std::span<const std::uint32_t> rows,
                                                                  ChangePictures* pictures);

}  // namespace svt::cli

#pragma once
/// \file
/// The labels whose voxels are air, for the writers of solvers.

#include <svt/volume/label_table.hpp>

#include <cstdint>
#include <vector>

namespace svt::writers {

/// The space whose air the voxels of each label are: that of spaces themselves, and of the sheets that bound a room.
/// kNoLabel: material, also furniture.
[[nodiscard]] std::vector<std::uint32_t> airOfLabels(const volume::LabelTable& labels);

}  // namespace svt::writers

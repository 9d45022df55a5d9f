#pragma once
/// \file
/// Values of labels for keys: class, name, storey, material and other attributes. For sums by keys.

#include <svt/analyze/extents.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace svt::frontend {

/// The keys of a list such as "material,storey".
[[nodiscard]] std::vector<std::string> splitKeys(std::string_view keys);

/// The value of each label for a key, empty: none. The keys `class`, `name`, `id`, `ifcType`, `material` and `color`
/// (#rrggbb, as in the volume) describe the finest feature that contains the label. `storey` is the storey that contains
/// the label. All other keys are attributes, like keys in quotes. A feature without one has that of the next feature
/// around it: a room has the owner of its flat.
/// \param features  that have values, ascending
/// Cost: O(labels of all extents of the features).
[[nodiscard]] std::vector<std::string> valuesOfKey(const std::string& key, const volume::LabelTable& table,
                                                   const analyze::Extents& extents,
                                                   const std::vector<std::uint32_t>& features);

/// The note that no feature of a sum has a value for a key.
[[nodiscard]] std::string noValueOfKey(std::string_view key);

}  // namespace svt::frontend

#pragma once
/// \file
/// Finds the features without geometry of two volumes that are the same one: storeys, zones, groups, sites.

#include <svt/compare/comparison.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::compare {

/// The new feature of each old one, and the reverse; kNoLabel without one.
struct FeaturePairs {
    std::vector<std::uint32_t> isOfWas, wasOfIs;
};

/// Completes the pairs by features without geometry. In this order, among those not yet paired:
/// 1. by class and id
/// 2. by class and members: the groups that have more than half of each other's paired members
/// 3. by class, name and the paired parent
/// 4. by class and name
/// 5. features without members that nothing distinguishes (class, name, parent, attributes), in their order
///
/// In 1, 3 and 4, only features with a unique key are paired. 2 to 4 are repeated, because each pair may make others unique.
/// With MatchBy::Id, only 1 applies.
/// \param hasGeometryOfWas, hasGeometryOfIs  by label: the feature has been matched, or has no partner
/// \return the number of features left over, of both volumes, although the other one has features of their class and name:
///         several are possible partners
/// Cost: O(n log n) in features, times their depth in the tree.
[[nodiscard]] std::size_t matchGroups(const volume::SemanticVolume& was, const volume::SemanticVolume& is, MatchBy by,
                                      const std::vector<char>& hasGeometryOfWas,
                                      const std::vector<char>& hasGeometryOfIs, FeaturePairs& pairs);

}  // namespace svt::compare

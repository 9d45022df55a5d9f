#pragma once
/// \file
/// Names, classes, storeys and attributes of matched features.

#include <svt/compare/comparison.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace svt::compare {

/// The new feature of each old one, and the reverse; kNoLabel without one.
struct FeaturePairs {
    std::vector<std::uint32_t> isOfWas, wasOfIs;
};

/// Completes the pairs by features without geometry, such as storeys: by id, then by class and name where these are
/// unique.
/// \param hasGeometryOfWas, hasGeometryOfIs  by label: the feature has been matched, or has no partner
void matchGroups(const volume::SemanticVolume& was, const volume::SemanticVolume& is,
                 const std::vector<char>& hasGeometryOfWas, const std::vector<char>& hasGeometryOfIs,
                 FeaturePairs& pairs);

/// Compares the properties of the one old and the one new feature of `row`. Two storeys are the same one if matchGroups()
/// paired them.
/// \param wasStoreys, isStoreys  by label, see drawing::storeysOfLabels()
void compareProperties(const volume::SemanticVolume& was, const volume::SemanticVolume& is, const FeaturePairs& pairs,
                       const std::vector<std::uint32_t>& wasStoreys, const std::vector<std::uint32_t>& isStoreys,
                       ComparisonRow& row);

}  // namespace svt::compare

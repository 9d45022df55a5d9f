#pragma once
/// \file
/// Names, classes, storeys and attributes of matched features.

#include <svt/compare/comparison.hpp>
#include <svt/compare/rows/match_groups.hpp>

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace svt::compare {

/// The features of a volume by id, found at the first question. Ids that occur twice belong to none.
class FeatureIds {
public:
    /// \param table  must outlive the object
    explicit FeatureIds(const volume::LabelTable& table) : table_(table) {}
    [[nodiscard]] std::uint32_t find(std::string_view id);

private:
    const volume::LabelTable& table_;
    bool isFilled_ = false;
    std::unordered_map<std::string_view, std::uint32_t> labels_;
};

/// Compares the properties of the one old and the one new feature of `row`. Two storeys are the same one if matchGroups()
/// paired them. An attribute whose two values are the ids of one pair is the same reference. Two numbers whose difference is at
/// most the rounding of 32-bit numbers (2^-23 of the larger) are the same.
/// \param wasStoreys, isStoreys  by label, see drawing::storeysOfLabels()
void compareProperties(const volume::SemanticVolume& was, const volume::SemanticVolume& is, const FeaturePairs& pairs,
                       const std::vector<std::uint32_t>& wasStoreys, const std::vector<std::uint32_t>& isStoreys,
                       FeatureIds& wasIds, FeatureIds& isIds, ComparisonRow& row);

}  // namespace svt::compare

#pragma once
/// \file
/// The labels of a difference volume, and the one that has a sample.

#include <svt/compare/comparison.hpp>

#include <cstdint>
#include <vector>

namespace svt::compare {

/// The label table, and by label of the old and the new volume the scalars of its parts; 0: none.
class DifferenceLabels {
public:
    DifferenceLabels(const volume::SemanticVolume& was, const volume::SemanticVolume& is, const Comparison& comparison);

    [[nodiscard]] const volume::LabelTable& table() const noexcept { return table_; }
    /// The scalar of a sample that the old volume gives to `was` and the new one to `is`; kNoLabel: to none.
    [[nodiscard]] volume::Scalar scalarAt(std::uint32_t was, std::uint32_t is) const noexcept;
    /// The label of a whole object of the old (new) volume in this table, whose faces it keeps; kNoLabel without one.
    [[nodiscard]] std::uint32_t wholeOfWas(std::uint32_t label) const noexcept { return wholeOfWas_[label]; }
    [[nodiscard]] std::uint32_t wholeOfIs(std::uint32_t label) const noexcept { return wholeOfIs_[label]; }

private:
    void addRow(const ComparisonRow& row, std::uint32_t number);
    volume::Scalar addPart(const volume::Label& object, const char* suffix, const ComparisonRow& row, bool isWhole);

    const volume::SemanticVolume &was_, &is_;
    volume::LabelTable table_;
    std::uint32_t group_ = 0;
    std::vector<std::uint32_t> rowOfWas_, rowOfIs_, wholeOfWas_, wholeOfIs_;
    std::vector<volume::Scalar> kept_, added_, removed_;  // by new, new and old label
    std::vector<char> isSpaceOfWas_, isSpaceOfIs_;
};

}  // namespace svt::compare

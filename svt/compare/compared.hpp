#pragma once
/// \file
/// Two states of a building, their comparison, and the rows as reports describe them.

#include <svt/compare/comparison.hpp>
#include <svt/core/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace svt::compare {

/// Two volumes and their comparison.
struct Compared {
    const volume::SemanticVolume &was, &is;
    const Comparison& comparison;
    std::string wasFile{}, isFile{};  ///< as given by the user
    Vec3d shift{};                    ///< metres by which the new volume was moved for the comparison
    CompareOptions options{};         ///< of the comparison
};

/// Whether the boxes of two grids have common space. Models that do not overlap have only added and removed objects.
[[nodiscard]] bool overlapInSpace(const volume::Grid& a, const volume::Grid& b);

/// The features of one volume, as rows describe them.
class StateFeatures {
public:
    /// \param volume  must outlive the object
    explicit StateFeatures(const volume::SemanticVolume& volume);

    [[nodiscard]] const volume::Label& operator[](std::uint32_t label) const { return labels_[label]; }
    /// Name of the storey of a label, or its id; empty without a storey.
    [[nodiscard]] std::string storeyOf(std::uint32_t label) const;
    [[nodiscard]] std::vector<std::string> ids(const std::vector<std::uint32_t>& labels) const;

private:
    const std::vector<volume::Label>& labels_;
    std::vector<std::uint32_t> storeys_;
};

/// The feature that names a row: the new one, or the removed one.
struct RowSubject {
    const StateFeatures* features;
    std::uint32_t label;

    [[nodiscard]] const volume::Label& operator*() const { return (*features)[label]; }
    [[nodiscard]] std::string storey() const { return features->storeyOf(label); }
};
[[nodiscard]] RowSubject subjectOf(const ComparisonRow& row, const StateFeatures& was, const StateFeatures& is);

/// Names of the properties that differ: "class, name, fireRating". \param most  further ones are counted
[[nodiscard]] std::string otherProperties(const ComparisonRow& row, std::size_t most);

/// m3 added and removed; empty: unknown.
[[nodiscard]] std::optional<double> changedVolume(const ComparisonRow& row);

/// The rows that differ: by changed volume from the largest, then those with unknown volume by distance from the
/// largest. Equal ones stay in their order. Numbers of Comparison::rows.
[[nodiscard]] std::vector<std::uint32_t> rowsByVolume(const Comparison& comparison);

/// m3 by class. Objects of one class hardly contain each other, so these sums count each place once.
struct ClassSums {
    std::string className;
    std::size_t objects = 0, unknown = 0;      ///< whose space changed, and whose volumes are unknown
    std::optional<double> added{}, removed{};  ///< of the objects whose volumes are known; empty: none
    std::optional<double> bound{};             ///< m3 by which each of the two may be off; empty: unknown
};
/// The sums of rows whose space changed, in the order of the classes' first rows.
/// \param rows  numbers of Comparison::rows
/// \param sums  of other comparisons, to which these are added
[[nodiscard]] std::vector<ClassSums> sumsByClass(const Compared& compared, std::span<const std::uint32_t> rows,
                                                 std::vector<ClassSums> sums = {});
/// The numbers of all rows.
[[nodiscard]] std::vector<std::uint32_t> allRows(const Comparison& comparison);

/// The sums of all components: objects other than rooms and further spaces, buildings and their parts, which contain
/// components. Empty className. A sum is empty if no volume is known; `bound` is empty if one of the bounds is unknown.
[[nodiscard]] ClassSums sumsOfComponents(const Compared& compared);

/// Rounds to a tenth of a micrometre or the like, so that no report has digits from rounding errors.
[[nodiscard]] double withoutRounding(double value) noexcept;

/// The properties that differ with their numbers of rows: "class 1, attributes 2". Empty without any.
[[nodiscard]] std::string propertiesText(const PropertyCounts& counts);

/// A clause without a full stop on features of Comparison::ambiguousGroups; empty without any.
[[nodiscard]] std::string ambiguousText(const Comparison& comparison);

/// "1 removed, 3 changed, 41 same; without geometry: 1 added; 2 with other properties (name 1, attributes 2)". It names at
/// least one difference if the comparison has one.
[[nodiscard]] std::string comparisonSummary(const Comparison& comparison);

}  // namespace svt::compare

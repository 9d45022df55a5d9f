// Rows as reports describe them: their order, and sums without double counting.
#include <svt/compare/compared.hpp>

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace svt::compare {
namespace {

constexpr std::array<Vec3d, 3> kWorldAxes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};

/// Both states have the same labels; tests add rows.
struct ReportCase {
    volume::SemanticVolume volume;
    Comparison comparison;

    ComparisonRow& add(const std::string& className, Change change, std::optional<double> added,
                       std::optional<double> removed, std::optional<double> bound) {
        volume::Label label;
        label.id = className + std::to_string(volume.labels.labels.size());
        label.className = className;
        const auto number = static_cast<std::uint32_t>(volume.labels.labels.size());
        volume.labels.labels.push_back(std::move(label));
        ComparisonRow row;
        row.change = change;
        row.was = row.is = {number};
        row.hasGeometry = true;
        row.added = added;
        row.removed = removed;
        row.bound = bound;
        comparison.rows.push_back(std::move(row));
        return comparison.rows.back();
    }
    [[nodiscard]] Compared compared() const { return {volume, volume, comparison}; }
};

TEST(ComparedRows, SumsOfComponentsLeaveOutWhatContainsThem) {
    ReportCase report;
    report.add("Wall", Change::Changed, 1.0, 0.5, 0.01);
    report.add("Wall", Change::Moved, 0.25, 0.25, 0.02);
    report.add("Door", Change::Removed, 0.0, 0.125, 0.0);
    report.add("BuildingRoom", Change::Changed, 100.0, 50.0, 1.0);
    report.add("Building", Change::Changed, 100.0, 50.0, 1.0);
    report.add("Wall", Change::Same, 0.0, 0.0, 0.0);
    const ClassSums sums = sumsOfComponents(report.compared());
    EXPECT_EQ(sums.objects, 3U);
    EXPECT_EQ(sums.unknown, 0U);
    EXPECT_DOUBLE_EQ(sums.added.value(), 1.25);
    EXPECT_DOUBLE_EQ(sums.removed.value(), 0.875);
    EXPECT_DOUBLE_EQ(sums.bound.value(), 0.03);
}

TEST(ComparedRows, UnknownIsNotZero) {
    ReportCase report;
    report.add("Wall", Change::Changed, {}, {}, {});
    ClassSums sums = sumsOfComponents(report.compared());
    EXPECT_EQ(std::pair(sums.objects, sums.unknown), std::pair(std::size_t{1}, std::size_t{1}));
    EXPECT_FALSE(sums.added || sums.removed || sums.bound);
    report.add("Door", Change::Changed, 1.0, 0.0, {});
    report.add("Window", Change::Changed, 2.0, 0.0, 0.5);
    sums = sumsOfComponents(report.compared());
    EXPECT_DOUBLE_EQ(sums.added.value(), 3.0);
    EXPECT_FALSE(sums.bound) << "one of the bounds is unknown";
    EXPECT_EQ(sums.unknown, 1U);
}

TEST(ComparedRows, BeginWithTheLargestChange) {
    ReportCase report;
    report.add("Wall", Change::Same, 0.0, 0.0, 0.0).hasOtherName = true;
    report.add("Wall", Change::Changed, {}, {}, {}).distance = 0.5;
    report.add("Wall", Change::Changed, 1.0, 2.0, 0.0);
    report.add("Wall", Change::Same, 0.0, 0.0, 0.0);
    report.add("Wall", Change::Added, 4.0, 0.0, 0.0);
    EXPECT_EQ(rowsByVolume(report.comparison), (std::vector<std::uint32_t>{4, 2, 1, 0}));
}

// A difference that only a group, or only a property has, is in the summary.
TEST(ComparedRows, SummaryNamesEachDifference) {
    ReportCase report;
    report.add("Wall", Change::Same, 0.0, 0.0, 0.0);
    report.add("Wall", Change::Changed, 1.0, 0.0, 0.0);
    ComparisonRow& renamed = report.add("Wall", Change::Same, 0.0, 0.0, 0.0);
    renamed.hasOtherName = renamed.hasOtherStorey = true;
    renamed.attributes.push_back({"fireRating", {}, {}});
    ComparisonRow& group = report.add("Zone", Change::Added, {}, {}, {});
    group.hasGeometry = false;
    group.was.clear();
    for (const ComparisonRow& row : report.comparison.rows) report.comparison.count(row);
    EXPECT_EQ(comparisonSummary(report.comparison),
              "1 changed, 2 same; without geometry: 1 added; 1 with other properties (name 1, storey 1, attributes 1)");
    EXPECT_EQ(comparisonSummary({}), "no objects");
    EXPECT_EQ(ambiguousText(report.comparison), "");
    report.comparison.ambiguousGroups = 4;
    EXPECT_EQ(ambiguousText(report.comparison).substr(0, 27), "4 features without geometry");
}

TEST(ComparedRows, GridsApartDoNotOverlap) {
    const auto gridAt = [](double x) {
        return volume::Grid::fromParts({11, 11, 11}, {0.1, 0.1, 0.1}, {x, 0, 0}, kWorldAxes).value();
    };
    EXPECT_TRUE(overlapInSpace(gridAt(0), gridAt(0.9)));
    EXPECT_FALSE(overlapInSpace(gridAt(0), gridAt(1.2)));
}

}  // namespace
}  // namespace svt::compare

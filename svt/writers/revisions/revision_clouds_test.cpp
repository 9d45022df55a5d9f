// Revision clouds, their numbers, and the list of revisions.
#include <svt/writers/revisions/revision_clouds.hpp>
#include <svt/writers/revisions/revision_list.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace svt::writers {
namespace {

using drawing::PlanePoint, drawing::RevisionLines;

constexpr double kAt100 = 10;  // millimetres per metre at 1:100

// A rectangle of changed lines, metres.
RevisionLines changedBox(std::uint32_t number, double u, double v, double width, double height) {
    RevisionLines lines;
    lines.revision.number = number;
    lines.added = {{{u, v}, {u + width, v}},
                   {{u + width, v}, {u + width, v + height}},
                   {{u + width, v + height}, {u, v + height}},
                   {{u, v + height}, {u, v}}};
    return lines;
}

bool isInside(const RevisionMarks::Path& ring, PlanePoint p) {
    bool inside = false;
    for (std::size_t n = 0; n + 1 < ring.size(); ++n) {
        const PlanePoint a = ring[n], b = ring[n + 1];
        if ((a.v > p.v) != (b.v > p.v) && p.u < a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u)) inside = !inside;
    }
    return inside;
}

double distanceToRing(const RevisionMarks::Path& ring, PlanePoint p) {
    double nearest = 1e9;
    for (const PlanePoint q : ring) nearest = std::min(nearest, std::hypot(q.u - p.u, q.v - p.v));
    return nearest;
}

TEST(RevisionClouds, EncloseTheChangedLines) {
    drawing::SectionDrawing drawing;
    drawing.revisions = {changedBox(1, 2, 3, 4, 1)};
    const RevisionMarks marks = placeRevisions(drawing, kAt100);
    ASSERT_EQ(marks.clouds.size(), 1u);
    EXPECT_EQ(marks.clouds[0].numbers, std::vector<std::uint32_t>{1});
    const RevisionMarks::Path ring = cloudPath(marks.clouds[0]);
    for (const RevisionLines::Line& line : drawing.revisions[0].added)
        for (int n = 0; n <= 20; ++n) {
            const double t = n / 20.0;
            const PlanePoint p{10 * (line.from.u + t * (line.to.u - line.from.u)),
                               10 * (line.from.v + t * (line.to.v - line.from.v))};
            EXPECT_TRUE(isInside(ring, p));
            EXPECT_GT(distanceToRing(ring, p), 2) << "millimetres";
        }
    EXPECT_FALSE(isInside(ring, {10, 35}));
}

TEST(RevisionClouds, HaveArcsOfOneLengthThatBulgeOutwards) {
    drawing::SectionDrawing drawing;
    drawing.revisions = {changedBox(1, 0, 0, 6, 0.24), changedBox(2, 0, 0, 0.24, 5)};  // an L
    const RevisionMarks marks = placeRevisions(drawing, kAt100);
    ASSERT_EQ(marks.clouds.size(), 1u);
    EXPECT_EQ(marks.clouds[0].numbers, (std::vector<std::uint32_t>{1, 2}));
    const RevisionMarks::Path& ends = marks.clouds[0].ends;
    double area = 0;
    for (std::size_t n = 0; n < ends.size(); ++n) {
        const PlanePoint a = ends[n], b = ends[(n + 1) % ends.size()];
        const double chord = std::hypot(b.u - a.u, b.v - a.v);
        EXPECT_GT(chord, 3.5);  // across a corner it is shorter
        EXPECT_LT(chord, 8);
        area += 0.5 * (a.u * b.v - b.u * a.v);
    }
    EXPECT_GT(area, 0) << "counter-clockwise";
    const RevisionMarks::Path ring = cloudPath(marks.clouds[0]);
    double withArcs = 0;
    for (std::size_t n = 0; n + 1 < ring.size(); ++n)
        withArcs += 0.5 * (ring[n].u * ring[n + 1].v - ring[n + 1].u * ring[n].v);
    EXPECT_GT(withArcs, area * 1.02) << "outwards";
    // The inner corner of the L is outside: the cloud follows the walls.
    EXPECT_FALSE(isInside(ring, {30, 30}));
}

TEST(RevisionClouds, MergeWhereTheyWouldOverlap) {
    drawing::SectionDrawing drawing;
    drawing.revisions = {changedBox(1, 0, 0, 1, 1), changedBox(2, 1.6, 0, 1, 1), changedBox(3, 9, 0, 1, 1)};
    const RevisionMarks marks = placeRevisions(drawing, kAt100);
    ASSERT_EQ(marks.clouds.size(), 2u);
    EXPECT_EQ(marks.clouds[0].numbers, (std::vector<std::uint32_t>{1, 2}));
    EXPECT_EQ(marks.clouds[1].numbers, (std::vector<std::uint32_t>{3}));
    EXPECT_EQ(marks.tags.size(), 3u);
    // At 1:20, they have space between them.
    EXPECT_EQ(placeRevisions(drawing, 50).clouds.size(), 3u);
}

TEST(RevisionClouds, HaveTheirNumbersOutsideOfThemAndClearOfTexts) {
    drawing::SectionDrawing drawing;
    drawing.revisions = {changedBox(12, 0, 0, 2, 2)};
    const RevisionMarks free = placeRevisions(drawing, kAt100);
    ASSERT_EQ(free.tags.size(), 1u);
    EXPECT_EQ(free.tags[0].text, "12");
    const RevisionMarks::Path ring = cloudPath(free.clouds[0]);
    for (const PlanePoint corner : free.tags[0].corners) EXPECT_FALSE(isInside(ring, corner));
    const PlanePoint low = free.tags[0].corners[0];
    const RevisionObstacle text{{low.u, low.v}, {low.u + 6, low.v + 6}};
    const RevisionMarks other = placeRevisions(drawing, kAt100, std::span(&text, 1));
    const PlanePoint moved = other.tags[0].corners[0];
    EXPECT_GT(std::hypot(moved.u - low.u, moved.v - low.v), 5);
}

TEST(RevisionClouds, EncloseWhatTheySurround) {
    drawing::SectionDrawing drawing;
    drawing.revisions = {changedBox(1, 0, 0, 10, 8), changedBox(2, 4, 4, 1, 1)};
    EXPECT_EQ(placeRevisions(drawing, kAt100).clouds.size(), 1u) << "no cloud within a cloud";
}

TEST(RevisionClouds, AreNoneWithoutRevisions) {
    const RevisionMarks marks = placeRevisions({}, kAt100);
    EXPECT_TRUE(marks.clouds.empty() && marks.tags.empty() && marks.removed.empty());
}

TEST(RevisionList, StatesWhatItLeavesOut) {
    std::vector<drawing::Revision> revisions;
    for (std::uint32_t n = 1; n <= 20; ++n)
        revisions.push_back({n, "moved", "Chair", "BuildingFurniture", "", 0.25, 0.0001});
    const RevisionListSize size = revisionListSize(revisions.size(), 230, 6);
    EXPECT_EQ(size.columns, 2u);
    EXPECT_EQ(size.rows, 6u);
    const RevisionList list = makeRevisionList(revisions, 0, 0, 230, 6);
    const auto has = [&](const std::string& text) {
        return std::any_of(list.texts.begin(), list.texts.end(), [&](const auto& t) { return t.text == text; });
    };
    EXPECT_TRUE(has("11"));
    EXPECT_FALSE(has("12"));
    EXPECT_TRUE(has("9 further changes"));
    EXPECT_TRUE(has("0.250"));
    EXPECT_TRUE(has("<0.001"));
    for (const auto& text : list.texts) EXPECT_LE(text.y, size.height);
    const RevisionList all = makeRevisionList(std::span(revisions).first(12), 0, 0, 230, 6);
    EXPECT_TRUE(std::any_of(all.texts.begin(), all.texts.end(), [](const auto& t) { return t.text == "12"; }));
}

TEST(RevisionList, HasADashForUnknownVolumes) {
    const std::vector<std::string> texts = revisionTexts({0, "changed", "Roof", "RoofSurface", "", {}, {}}, {});
    EXPECT_EQ(texts, (std::vector<std::string>{"\u2013", "changed", "Roof", "\u2013", "\u2013"}));
}

}  // namespace
}  // namespace svt::writers

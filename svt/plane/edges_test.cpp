#include <svt/plane/edges.hpp>

#include <gtest/gtest.h>

#include <random>

namespace svt::plane {
namespace {

using Segment = std::pair<Point, Point>;

std::vector<Segment> edgesOf(const std::vector<std::vector<Point>>& rings) {
    std::vector<Segment> edges;
    for (const auto& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
    return edges;
}

const std::vector<Point> kOutline{{0, 0}, {10, 0}, {10, 10}, {0, 10}};

TEST(MeetBeyondEnds, SimpleRingsDoNot) {
    EXPECT_FALSE(meetBeyondEnds(edgesOf({kOutline})));
    EXPECT_FALSE(
        meetBeyondEnds(edgesOf({kOutline, {{2, 2}, {2, 4}, {4, 4}, {4, 2}}, {{5, 2}, {5, 4}, {7, 4}, {7, 2}}})));
    EXPECT_FALSE(meetBeyondEnds(edgesOf({{{0, 0}, {5, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 5}}}))) << "straight corners";
}

TEST(MeetBeyondEnds, WhatTouchesOrCrossesDoes) {
    EXPECT_TRUE(meetBeyondEnds(edgesOf({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}}))) << "a bow tie";
    EXPECT_TRUE(meetBeyondEnds(edgesOf({kOutline, {{0, 5}, {4, 6}, {4, 4}}}))) << "a corner on an edge";
    EXPECT_TRUE(meetBeyondEnds(edgesOf({kOutline, {{0, 0}, {4, 6}, {6, 4}}}))) << "a corner on a corner";
    EXPECT_TRUE(meetBeyondEnds(edgesOf({kOutline, {{10, 2}, {10, 4}, {7, 3}}}))) << "an edge on an edge";
    EXPECT_TRUE(meetBeyondEnds(edgesOf({kOutline, kOutline})));
    EXPECT_TRUE(meetBeyondEnds(edgesOf({{{0, 0}, {10, 0}, {4, 0}, {4, 8}}}))) << "folded back";
    EXPECT_TRUE(meetBeyondEnds(edgesOf({{{0, 0}, {10, 0}, {10, 0}, {4, 8}}}))) << "an edge without length";
}

// Every pair of edges held against each other.
bool meetPairwise(const std::vector<Segment>& edges) {
    for (std::size_t a = 0; a < edges.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const Segment &e = edges[a], &f = edges[b];
            const Meeting meeting = meet(e.first, e.second, f.first, f.second);
            if (meeting == Meeting::None) continue;
            const bool isNeighbour = b + 1 == a || (b == 0 && a + 1 == edges.size());
            if (!isNeighbour || meeting == Meeting::Cross) return true;
            // Of neighbours only the shared corner may lie on both.
            const Point shared = e.first == f.second || e.first == f.first ? e.first : e.second;
            const Point ofE = e.first == shared ? e.second : e.first, ofF = f.first == shared ? f.second : f.first;
            if (meet(shared, ofE, ofF, ofF) != Meeting::None || meet(shared, ofF, ofE, ofE) != Meeting::None)
                return true;
        }
    return false;
}

TEST(MeetBeyondEnds, IsWhatPairsTell) {
    std::mt19937 random(1);
    int meeting = 0, rings = 0;
    for (int n = 3; n < 9; ++n)
        for (int grid : {4, 9, 40})
            for (int round = 0; round < 400; ++round) {
                std::vector<Point> ring;
                while (ring.size() < std::size_t(n)) {
                    const Point p{std::int64_t(random() % unsigned(grid)), std::int64_t(random() % unsigned(grid))};
                    if (ring.empty() || (p != ring.back() && (ring.size() + 1 < std::size_t(n) || p != ring.front())))
                        ring.push_back(p);
                }
                const bool expected = meetPairwise(edgesOf({ring}));
                EXPECT_EQ(meetBeyondEnds(edgesOf({ring})), expected) << n << " " << grid << " " << round;
                meeting += expected;
                ++rings;
            }
    EXPECT_GT(meeting, rings / 10);
    EXPECT_LT(meeting, rings * 9 / 10);
}

}  // namespace
}  // namespace svt::plane

#include <svt/validate/polygons/sweep_edges.hpp>

#include <gtest/gtest.h>

#include <random>

namespace svt::validate {
namespace {

std::vector<FlatEdge> edgesOf(const std::vector<std::vector<Point2>>& rings) {
    std::vector<FlatEdge> edges;
    for (const auto& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
    return edges;
}

const std::vector<Point2> kOutline{{0, 0}, {10, 0}, {10, 10}, {0, 10}};

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
bool meetPairwise(const std::vector<FlatEdge>& edges) {
    for (std::size_t a = 0; a < edges.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const FlatEdge &e = edges[a], &f = edges[b];
            const Meeting meeting = meet(e[0], e[1], f[0], f[1]);
            if (meeting == Meeting::None) continue;
            const bool isNeighbour = b + 1 == a || (b == 0 && a + 1 == edges.size());
            if (!isNeighbour || meeting == Meeting::Cross) return true;
            // Of neighbours only the shared corner may lie on both.
            const Point2 shared = e[0] == f[1] || e[0] == f[0] ? e[0] : e[1];
            const Point2 ofE = e[0] == shared ? e[1] : e[0], ofF = f[0] == shared ? f[1] : f[0];
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
                std::vector<Point2> ring;
                while (ring.size() < std::size_t(n)) {
                    const Point2 p{std::int64_t(random() % unsigned(grid)), std::int64_t(random() % unsigned(grid))};
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
}  // namespace svt::validate

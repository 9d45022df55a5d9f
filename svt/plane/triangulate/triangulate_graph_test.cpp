#include <svt/plane/triangulate_graph.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace svt::plane {
namespace {

using Corners = std::pair<std::uint32_t, std::uint32_t>;
constexpr int kSide = 6;  // squares along each axis

// The borders of the squares that are in, each with the inside on its left. Points are numbered (kSide + 1) * v + u.
std::vector<Corners> bordersOf(const std::vector<bool>& isIn) {
    const auto square = [&](int u, int v) {
        return u >= 0 && v >= 0 && u < kSide && v < kSide && isIn[std::size_t(kSide * v + u)];
    };
    const auto corner = [](int u, int v) { return static_cast<std::uint32_t>((kSide + 1) * v + u); };
    std::vector<Corners> borders;
    for (int v = 0; v <= kSide; ++v)
        for (int u = 0; u <= kSide; ++u) {
            if (square(u, v) != square(u, v - 1))
                borders.push_back(square(u, v) ? Corners(corner(u, v), corner(u + 1, v))
                                               : Corners(corner(u + 1, v), corner(u, v)));
            if (square(u, v) != square(u - 1, v))
                borders.push_back(square(u, v) ? Corners(corner(u, v + 1), corner(u, v))
                                               : Corners(corner(u, v), corner(u, v + 1)));
        }
    return borders;
}

// Squares as parallelograms: no border is parallel to an axis unless `shear` is 0.
std::vector<Point> cornersOf(std::int64_t shear) {
    std::vector<Point> points;
    for (std::int64_t v = 0; v <= kSide; ++v)
        for (std::int64_t u = 0; u <= kSide; ++u) points.push_back({7 * u - shear * v, 5 * v + shear * u});
    return points;
}

EdgeGraph graphOf(const std::vector<Corners>& borders, const std::vector<Point>& points) {
    EdgeGraph graph;
    for (std::uint32_t n = 0; n < points.size(); ++n) graph.vertices.push_back({points[n], n});
    for (const auto& [from, to] : borders)
        graph.edges.push_back(points[from] < points[to] ? Edge{from, to} : Edge{to, from});
    graph.tidy();
    return graph;
}

// Each side of a triangle is a border, or the side of another triangle on its other side: so triangles with a positive
// area cover the inside once, and all its corners are theirs.
void expectCovers(const std::vector<std::array<std::uint32_t, 3>>& triangles, const std::vector<Corners>& borders,
                  const std::vector<Point>& points) {
    std::map<Corners, int> sides;
    for (const auto& corners : triangles) {
        EXPECT_EQ(turn(points[corners[0]], points[corners[1]], points[corners[2]]), 1);
        for (std::size_t n = 0; n < 3; ++n) {
            const Corners side(corners[n], corners[(n + 1) % 3]);
            ++sides[side];
            --sides[{side.second, side.first}];
        }
    }
    for (const Corners& border : borders) {
        --sides[border];
        ++sides[{border.second, border.first}];
    }
    for (const auto& [side, count] : sides) EXPECT_EQ(count, 0) << side.first << " " << side.second;
}

TEST(TriangulateInside, CoversTheInsideOnceAndKeepsAllCorners) {
    std::mt19937 random(3);
    for (int round = 0; round < 1400; ++round) {
        const unsigned tenths = 2 + unsigned(round) % 8;  // of the squares
        std::vector<bool> isIn;
        for (int n = 0; n < kSide * kSide; ++n) isIn.push_back(random() % 10 < tenths);
        const std::vector<Corners> borders = bordersOf(isIn);
        const std::vector<Point> points = cornersOf(round % 7 - 3);
        const EdgeGraph graph = graphOf(borders, points);
        SCOPED_TRACE(round);
        expectCovers(triangulateInside(graph), borders, points);
        if (HasFailure()) return;
    }
}

// Rings around (0, 0), of which every ray from there meets one corner at most: they do not meet themselves.
TEST(TriangulateInside, CoversStars) {
    std::mt19937 random(4);
    for (int round = 0; round < 4000; ++round) {
        const std::int64_t reach = 3 + round % 7;
        const auto number = [&] { return std::int64_t(random() % unsigned(2 * reach + 1)) - reach; };
        std::map<double, Point> byAngle;
        for (int n = 0; n < 16; ++n) {
            const Point p{number(), number()};
            if (p != Point{}) byAngle[std::atan2(double(p.v), double(p.u))] = p;
        }
        std::vector<Point> points;
        for (const auto& [angle, p] : byAngle) points.push_back(p);
        std::vector<Corners> borders;
        bool isStar = points.size() > 2;
        for (std::uint32_t n = 0; n < points.size(); ++n) {
            borders.emplace_back(n, (n + 1) % static_cast<std::uint32_t>(points.size()));
            isStar = isStar && turn(points[borders[n].first], points[borders[n].second], {}) == 1;
        }
        if (!isStar) continue;
        SCOPED_TRACE(round);
        expectCovers(triangulateInside(graphOf(borders, points)), borders, points);
        if (HasFailure()) return;
    }
}

TEST(TriangulateInside, NothingIsInsideOfNothing) { EXPECT_TRUE(triangulateInside({}).empty()); }

}  // namespace
}  // namespace svt::plane

#include <svt/plane/triangulate_rings.hpp>

#include <gtest/gtest.h>

#include <random>

namespace svt::plane {
namespace {

// Rings over points of their own.
struct Plan {
    std::vector<std::vector<RingCorner>> rings;
    std::vector<Vec3d> points;

    void add(const std::vector<Point>& ring) {
        rings.emplace_back();
        for (const Point& at : ring) {
            rings.back().push_back({at, static_cast<std::uint32_t>(points.size())});
            points.push_back({double(at.u), double(at.v), 0});
        }
    }
    [[nodiscard]] double areaOfRings() const {
        double sum = 0;
        for (const auto& ring : rings)
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Point a = ring[i].at, b = ring[(i + 1) % ring.size()].at;
                sum += (double(a.u) * double(b.v) - double(b.u) * double(a.v)) / 2;
            }
        return sum;
    }
    // All triangles turn the right way, so that none overlap where the areas are equal.
    [[nodiscard]] double areaOf(const std::vector<std::array<std::uint32_t, 3>>& triangles) const {
        double sum = 0;
        for (const auto& t : triangles) {
            const double area = cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]).z / 2;
            EXPECT_GT(area, 0);
            sum += area;
        }
        return sum;
    }
};

TEST(TriangulateRings, AFacadeOfWindowsIsCutAroundThem) {
    constexpr std::int64_t kSide = 40, kPitch = 1000;
    Plan plan;
    plan.add({{0, 0}, {kSide * kPitch, 0}, {kSide * kPitch, kSide * kPitch}, {0, kSide * kPitch}});
    for (std::int64_t v = 0; v < kSide; ++v)
        for (std::int64_t u = 0; u < kSide; ++u) {
            const Point at{u * kPitch + 250, v * kPitch + 250};
            plan.add({at, {at.u, at.v + 500}, {at.u + 500, at.v + 500}, {at.u + 500, at.v}});
        }
    const auto triangles = triangulateRings(plan.rings, plan.points);
    EXPECT_EQ(triangles.size(), plan.points.size() + 2 * (plan.rings.size() - 1) - 2);
    EXPECT_NEAR(plan.areaOf(triangles), plan.areaOfRings(), 1);
}

TEST(TriangulateRings, HolesOfAnySizeInAJaggedBorderAreLeftOut) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        std::mt19937_64 random(seed);
        const auto below = [&](std::int64_t n) { return static_cast<std::int64_t>(random() % std::uint64_t(n)); };
        // Teeth along two sides, and in each cell of 10 x 10 a hole or none.
        Plan plan;
        std::vector<Point> border;
        for (std::int64_t u = 0; u < 100; ++u) border.push_back({u * 100, -below(3000)});
        for (std::int64_t u = 100; u > 0; --u) border.push_back({u * 100, 10000 + below(3000)});
        plan.add(border);
        for (std::int64_t v = 0; v < 10; ++v)
            for (std::int64_t u = 0; u < 10; ++u) {
                if (below(4) == 0) continue;
                const Point at{u * 1000 + 150 + below(300), v * 1000 + 50 + below(400)};
                if (at.u > 9300) continue;
                plan.add({at, {at.u + below(50), at.v + 100 + below(400)}, {at.u + 60 + below(400), at.v + below(90)}});
            }
        const auto triangles = triangulateRings(plan.rings, plan.points);
        EXPECT_EQ(triangles.size(), plan.points.size() + 2 * (plan.rings.size() - 1) - 2) << seed;
        EXPECT_NEAR(plan.areaOf(triangles), plan.areaOfRings(), 1) << seed;
    }
}

}  // namespace
}  // namespace svt::plane

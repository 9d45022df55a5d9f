#include <svt/drawing/dimension/border_strips.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace svt::drawing {
namespace {

// Edges of all lengths, also level ones and points: all of a strip are found, once, in the order of the drawing.
TEST(BorderStrips, FindAllEdgesBetweenTwoHeights) {
    SectionDrawing drawing;
    std::mt19937 random(3);
    const auto number = [&](double reach) {
        return reach * (2 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 1);
    };
    for (std::uint32_t n = 0; n < 200; ++n) {
        SectionBorder border;
        border.left = n;
        PlanePoint p{number(50), number(50)};
        for (int k = 0; k < 5; ++k) {
            border.points.push_back(p);
            p = {p.u + number(3), p.v + (k == 2 ? 0 : number(n % 20 == 0 ? 60 : 3))};
        }
        drawing.borders.push_back(border);
    }
    const BorderStrips strips(drawing);
    std::size_t most = 0;
    for (int n = 0; n < 200; ++n) {
        const double low = number(120), high = low + std::abs(number(6));
        const auto found = strips.between(low, high);
        most = std::max(most, found.size());
        auto at = found.begin();
        for (const SectionBorder& border : drawing.borders)
            for (std::size_t k = 0; k + 1 < border.points.size(); ++k) {
                const PlanePoint a = border.points[k], b = border.points[k + 1];
                const bool isNext = at != found.end() && at->border == &border && at->a == a && at->b == b;
                if (isNext) ++at;
                const bool isBetween = std::max(a.v, b.v) >= low && std::min(a.v, b.v) <= high;
                ASSERT_TRUE(isNext || !isBetween) << border.left << ' ' << k;
            }
        ASSERT_EQ(at, found.end());
    }
    EXPECT_LT(most, 600u);  // of 800
    EXPECT_TRUE(BorderStrips(SectionDrawing{}).between(-1, 1).empty());
}

}  // namespace
}  // namespace svt::drawing

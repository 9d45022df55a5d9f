#include <svt/volume/bricks/side_masks.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace svt::volume {
namespace {

TEST(FindSides, AgreesWithEachSample) {
    constexpr double kMargin = 1e-3;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(-1, 1);
    int near = 0, split = 0;
    for (int n = 0; n < 2000; ++n) {
        Vec3d normal{part(random), part(random), part(random)};
        if (n % 3 == 0) normal.x = 0;
        if (n % 5 == 0) normal.z = 0;
        if (n % 7 == 0) normal = {0, n % 2 == 0 ? 1.0 : -1.0, 0};
        const double first = n % 11 == 0 ? -3.0 : -dot(normal, Vec3d{3.5, 3.5, 3.5}) + 3 * part(random);
        SideMask expected{}, mask;
        mask.fill(0x5555555555555555ull);
        bool isClear = true;
        for (int k = 0; k < 8; ++k)
            for (int j = 0; j < 8; ++j)
                for (int i = 0; i < 8; ++i) {
                    const double value = first + normal.y * j + normal.z * k + normal.x * i;
                    isClear = isClear && std::abs(value) >= kMargin;
                    if (value > 0) expected[static_cast<std::size_t>(k)] |= std::uint64_t{1} << (i + 8 * j);
                }
        EXPECT_EQ(findSides(first, normal, kMargin, mask), isClear);
        EXPECT_EQ(mask, expected);
        near += isClear ? 0 : 1;
        split += expected[0] != expected[7] ? 1 : 0;
    }
    EXPECT_GT(near, 100);  // both outcomes occur
    EXPECT_GT(2000 - near, 100);
    EXPECT_GT(split, 1000);
}

}  // namespace
}  // namespace svt::volume

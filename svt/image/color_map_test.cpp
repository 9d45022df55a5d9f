#include <svt/image/color_map.hpp>
#include <svt/image/color_text.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace svt::image {
namespace {

std::string ends(ColorMap map) {
    return colorText(mapColor(map, 0)) + " " + colorText(mapColor(map, 127 / 255.0)) + " " +
           colorText(mapColor(map, 1));
}

TEST(ColorMap, EndsAndMiddleEntriesAreThoseOfTheSources) {
    EXPECT_EQ(ends(ColorMap::Viridis), "#440154 #21908d #fde725");
    EXPECT_EQ(colorText(mapColor(ColorMap::Cividis, 0)), "#00224e");
    EXPECT_EQ(colorText(mapColor(ColorMap::Cividis, 1)), "#fee838");
    EXPECT_EQ(colorText(mapColor(ColorMap::Inferno, 0)), "#000004");
    EXPECT_EQ(colorText(mapColor(ColorMap::Inferno, 1)), "#fcffa4");
    EXPECT_EQ(colorText(mapColor(ColorMap::Batlow, 0)), "#011959");
    EXPECT_EQ(colorText(mapColor(ColorMap::Batlow, 1)), "#faccfa");
    EXPECT_EQ(colorText(mapColor(ColorMap::Vik, 0)), "#001261");
    EXPECT_EQ(colorText(mapColor(ColorMap::Vik, 1)), "#590008");
}

TEST(ColorMap, LightnessHasOneDirectionExceptAroundAMiddle) {
    for (const auto& [map, name] : namesOf(ColorMap{})) {
        const auto colors = mapColors(map);
        ASSERT_EQ(colors.size(), 256u);
        const auto lightness = [&](std::size_t n) {
            return 0.2126f * colors[n].x + 0.7152f * colors[n].y + 0.0722f * colors[n].z;
        };
        int up = 0, down = 0;
        for (std::size_t n = 0; n + 16 < 256; n += 16) (lightness(n + 16) > lightness(n) ? up : down) += 1;
        if (map == ColorMap::Vik)
            EXPECT_TRUE(up > 5 && down > 5) << name;
        else
            EXPECT_TRUE(up == 0 || down == 0) << name;
    }
}

TEST(ColorMap, SharesOutsideAreClamped) {
    EXPECT_EQ(mapColor(ColorMap::Batlow, -1), mapColor(ColorMap::Batlow, 0));
    EXPECT_EQ(mapColor(ColorMap::Batlow, 2), mapColor(ColorMap::Batlow, 1));
    EXPECT_EQ(mapColor(ColorMap::Batlow, std::nan("")), mapColor(ColorMap::Batlow, 0));
    EXPECT_EQ(mapColors(ColorMap::Greys).front(), mapColor(ColorMap::Greys, 0));
}

}  // namespace
}  // namespace svt::image

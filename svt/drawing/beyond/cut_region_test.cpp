/// The parts of lines within a cut, compared with the polygons point by point.

#include <svt/drawing/beyond/cut_region.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace svt::drawing {
namespace {

bool hasPointInside(const Ring& ring, PlanePoint p) {
    bool isInside = false;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
        if ((a.v > p.v) != (b.v > p.v) && a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u) < p.u) isInside = !isInside;
    }
    return isInside;
}

// Neighbours that share sides, oblique shapes, a large ring with a hole, and a room, which hides nothing.
TEST(CutRegion, CoversTheLinesWithinItsPolygons) {
    volume::SemanticVolume volume = volume::test::emptyVolume({4, 4, 4}, {1, 1, 1}, {0, 0, 0});
    volume::test::addGroup(volume, "walls", "BuildingConstructiveElement");
    volume::test::addGroup(volume, "room", "BuildingRoom");
    SectionDrawing drawing;
    SectionComponent walls{0, {}, 0, 0, true, 0}, room{1, {}, 0, 0, true, 0};
    for (int n = 0; n < 30; ++n) {
        const double u = n % 6, v = 2.0 * (n / 6);
        walls.polygons.push_back({{{u, v}, {u + 1, v}, {u + 1, v + 0.7}, {u, v + 0.3}}, {}, 0});
    }
    walls.polygons.push_back({{{-3, -3}, {12, -3}, {12, 13}, {-3, 13}}, {{{-2, -2}, {-2, 12}, {11, 12}, {11, -2}}}, 0});
    room.polygons.push_back({{{7, 0}, {10, 0}, {10, 9}, {7, 9}}, {}, 0});
    drawing.components = {walls, room};
    const CutRegion region(drawing, volume.labels);
    std::mt19937 random(3);
    const auto number = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
    };
    CutRegion::Scratch scratch;
    int inside = 0;
    for (int n = 0; n < 2000; ++n) {
        const PlanePoint from{number(-5, 14), number(-5, 15)}, to{number(-5, 14), number(-5, 15)};
        std::vector<LinePart> covered;
        region.addCovered(from, to, scratch, covered);
        for (int step = 0; step < 50; ++step) {
            const double t = number(0, 1);
            const PlanePoint p{from.u + t * (to.u - from.u), from.v + t * (to.v - from.v)};
            int rings = 0;
            for (const SectionPolygon& polygon : walls.polygons) {
                rings += hasPointInside(polygon.outer, p) ? 1 : 0;
                for (const Ring& hole : polygon.holes) rings += hasPointInside(hole, p) ? 1 : 0;
            }
            const bool isCovered = std::any_of(covered.begin(), covered.end(),
                                               [&](const LinePart& part) { return t >= part.from && t <= part.to; });
            ASSERT_EQ(isCovered, rings % 2 == 1) << p.u << " " << p.v;
            inside += isCovered ? 1 : 0;
        }
    }
    EXPECT_GT(inside, 10'000);
}

}  // namespace
}  // namespace svt::drawing

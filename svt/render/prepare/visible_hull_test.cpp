#include <svt/render/prepare/visible_hull.hpp>
#include <svt/render/test_volume_test.hpp>
#include <svt/render/walk/run_walk.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace svt::render {
namespace {

using test::makeBody;
using test::makeTurnedHouse;
using test::makeVolume;
using test::stylesOf;
using test::TestVolume;

// The interval from where a ray enters the first visible label to where it leaves the last.
class Extent {
public:
    explicit Extent(const PassTable& table) : table_(table) {}

    bool enter(volume::Scalar scalar, double from, const RunStart&) {
        if (isVisible(scalar)) first = std::min(first, from);
        return false;
    }
    bool leave(volume::Scalar scalar, double, double to) {
        if (isVisible(scalar)) last = to;
        return false;
    }

    double first = std::numeric_limits<double>::infinity(), last = 0;

private:
    bool isVisible(volume::Scalar scalar) const { return table_[scalar].kind != LinearStyle::Kind::Hidden; }

    const PassTable& table_;
};

FrameSpec frameOf(const TestVolume& volume, const char* name, std::vector<Style> styles) {
    return test::presetFrame(320, 240, name, volume, std::move(styles));
}

void expectHeld(const TestVolume& volume, const FrameSpec& spec) {
    const CameraRays rays(spec, volume.grid);
    const PassTable table(spec.passes[0], {}, volume.bricks.scalarCount());
    const VisibleHull hull(volume.bricks, table, rays, 2);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-1, 1), size(0, 0.2);
    constexpr int kSquares = 600;
    for (int square = 0; square < kSquares; ++square) {
        const double u = place(random), v = place(random), side = square % 2 == 0 ? 0.02 : size(random);
        const ViewRect rect{u, u + side, v, v + side};
        const RaySpan span = hull.spanOf(rect);
        for (int n = 0; n < 20; ++n) {
            const double s = n == 0 ? 0 : n == 1 ? 1 : (place(random) + 1) / 2, t = n < 2 ? s : (place(random) + 1) / 2;
            const CameraRay ray = rays.at(u + s * side, v + t * side);
            const RaySpan inside = spanInVolume(ray.voxelRay, volume.bricks.dimension());
            Extent extent(table);
            if (inside.from < inside.to) walkRuns(volume.bricks, ray.voxelRay, inside.from, inside.to, extent);
            if (!(extent.first < extent.last)) continue;
            EXPECT_LT(span.from, extent.first) << rect.left << ' ' << rect.low;
            EXPECT_GT(span.to, extent.last) << rect.left << ' ' << rect.low;
        }
    }
}

TEST(VisibleHull, NoRayComesToAnythingOutsideOfIt) {
    const TestVolume house = makeTurnedHouse();
    for (const char* name : {"iso", "top", "front", "left"}) {
        SCOPED_TRACE(name);
        FrameSpec spec = frameOf(house, name, stylesOf({{{1, 1, 1}, 1}, {{1, 1, 1}, 1}, {{1, 1, 1}, 0.3f}}));
        expectHeld(house, spec);
        spec.camera.projection = Camera::Projection::Orthographic;
        spec.camera.orthographicHeight = 12;
        expectHeld(house, spec);
        // From within, where slabs lie around the eye and behind it.
        spec.camera.projection = Camera::Projection::Perspective;
        spec.camera.eye = house.grid.worldFromIndex({40, 50, 20});
        expectHeld(house, spec);
    }
}

TEST(VisibleHull, IsTightAroundATurnedWall) {
    const TestVolume wall = makeBody({256, 160, 16}, {0.1, 0.1, 0.1}, [](Vec3d p) {
        const double c = std::cos(test::kTurn), s = std::sin(test::kTurn), x = p.x - 12.8, y = p.y - 8;
        return std::abs(c * x + s * y) < 12 && std::abs(c * y - s * x) < 1;
    });
    const FrameSpec spec = frameOf(wall, "top", stylesOf({{{1, 1, 1}, 1}}));
    const CameraRays rays(spec, wall.grid);
    const VisibleHull hull(wall.bricks, PassTable(spec.passes[0], {}, 2), rays, 1);
    const Frame frame = test::cast(wall, spec);
    int shown = 0, told = 0;
    constexpr int kSide = 4;  // pixels
    for (int y = 0; y < spec.height; y += kSide)
        for (int x = 0; x < spec.width; x += kSide) {
            bool isShown = false;
            for (int n = 0; n < kSide * kSide; ++n)
                isShown = isShown || frame.label.at(x + n % kSide, y + n / kSide) != 0;
            const RaySpan span = hull.spanOf({2.0 * x / spec.width - 1, 2.0 * (x + kSide) / spec.width - 1,
                                              1 - 2.0 * (y + kSide) / spec.height, 1 - 2.0 * y / spec.height});
            shown += isShown ? 1 : 0;
            told += span.from < span.to ? 1 : 0;
        }
    // Bricks are as wide as a third of the wall. Without slabs across it, it takes 3.4 times as many squares.
    EXPECT_LT(told, 2.3 * shown);
}

TEST(VisibleHull, HoldsWhatIsVisibleAlone) {
    const TestVolume volume = makeVolume({64, 64, 64}, {0.1, 0.1, 0.1}, [](std::int32_t i, std::int32_t, std::int32_t) {
        return i < 8 ? 1u : i >= 40 && i < 48 ? 2u : 0u;
    });
    FrameSpec spec = frameOf(volume, "front", {Style{{}, 0}, Style{{}, 0}, Style{{1, 1, 1}, 1}});
    spec.camera = test::frontFrame(320, 240, {3.2, 3.2, 3.2}, 8, {}).camera;
    const CameraRays rays(spec, volume.grid);
    const VisibleHull hull(volume.bricks, PassTable(spec.passes[0], {}, 3), rays, 1);
    const auto isAnyAt = [&](double x) {  // metres
        const double u = (x - 3.2) / (4 * 320.0 / 240);
        const RaySpan span = hull.spanOf({u - 1e-3, u + 1e-3, -1e-3, 1e-3});
        return span.from < span.to;
    };
    EXPECT_FALSE(isAnyAt(0.4)) << "hidden";
    EXPECT_FALSE(isAnyAt(3.9));
    EXPECT_TRUE(isAnyAt(4.4));
    EXPECT_FALSE(isAnyAt(4.9));
    const PassTable nothing({std::vector<Style>(3, Style{{}, 0}), {}, Pass::Join::Over}, {}, 3);
    const RaySpan span = VisibleHull(volume.bricks, nothing, rays, 1).spanOf({-1, 1, -1, 1});
    EXPECT_FALSE(span.from < span.to);
}

}  // namespace
}  // namespace svt::render

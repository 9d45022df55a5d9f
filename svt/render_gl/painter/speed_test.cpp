#include <svt/core/test_data_test.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/render/camera_presets.hpp>
#include <svt/render_gl/compare_test.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <iostream>

namespace svt::render_gl {
namespace {

double processorOf(const std::function<void()>& work) {
    const auto begin = std::clock();
    work();
    return 1000.0 * double(std::clock() - begin) / CLOCKS_PER_SEC;
}

double millisecondsOf(const std::function<void()>& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

// Figures for README.md; nothing is expected of them.
TEST(GlSpeed, OfTheFzkHaus) {
    if (std::getenv("SVT_MEASURE") == nullptr) GTEST_SKIP() << "a measurement; set SVT_MEASURE to take it";
    SVT_NEEDS_GL();
    SVT_NEEDS_DATA(file, "fzk_haus_citygml3.gml");
    pipeline::BuildOptions options;
    options.dimension = Vec3i{800, 700, 400};
    const auto built = pipeline::buildVolume(std::span(&file, 1), options);
    ASSERT_TRUE(built) << built.error().toString();
    const volume::Grid& grid = built->volume.grid;
    const auto bricks = *volume::BrickVolume::fromColumns(built->volume.columns);
    for (const float opacity : {1.0f, 0.3f})
        for (const bool isCut : {false, true}) {
            render::FrameSpec spec;
            spec.camera = *render::cameraPreset("iso", grid);
            std::vector<render::Style> styles(bricks.scalarCount(), {{0.8f, 0.7f, 0.6f}, opacity});
            styles[0].opacity = 0;
            spec.passes.push_back({styles, {}, render::Pass::Join::Over});
            if (isCut)
                spec.passes[0].clips = {
                    render::ClipRegion::plane({0, -1, 0}, grid.worldFromIndex({400.2, 350.2, 200.2}))};
            std::optional<Result<GlRenderer>> renderer;
            const double made = millisecondsOf([&] { renderer.emplace(GlRenderer::make(bricks, grid)); });
            ASSERT_TRUE(*renderer) << renderer->error().toString();
            for (const int width : {640, 1280}) {
                spec.width = width;
                spec.height = width * 9 / 16;
                const double first = millisecondsOf([&] { (void)(*renderer)->read(spec); });
                const double first2 = millisecondsOf([&] { (void)(*renderer)->pick(spec, 0, 0); });
                double drawn = 1e9, cast = 1e9, drawnProcessor = 1e9, castProcessor = 1e9;
                for (int n = 0; n < 5; ++n) {
                    const auto draw = [&] { (void)(*renderer)->readColor(spec); };
                    const auto castRays = [&] { (void)render::castRays(bricks, grid, spec); };
                    drawnProcessor =
                        std::min(drawnProcessor, processorOf([&] { drawn = std::min(drawn, millisecondsOf(draw)); }));
                    castProcessor =
                        std::min(castProcessor, processorOf([&] { cast = std::min(cast, millisecondsOf(castRays)); }));
                }
                std::cout << test::context()->renderer() << ", opacity " << opacity << (isCut ? ", cut, " : ", ")
                          << width << ": made " << made << " ms, first " << first << " ms, pick " << first2
                          << " ms, drawn " << drawn << " ms (" << drawnProcessor << " of processors), cast " << cast
                          << " ms (" << castProcessor << ")\n";
            }
        }
}

// How long the first pixel takes, of processor time: mostly the driver's compiler.
TEST(GlSpeed, OfShaders) {
    if (std::getenv("SVT_MEASURE") == nullptr) GTEST_SKIP() << "a measurement; set SVT_MEASURE to take it";
    SVT_NEEDS_GL();
    const Vec3i n{40, 40, 40};
    for (const bool isRound : {false, true}) {
        std::vector<volume::Scalar> scalars;
        for (int k = 0; k < n.z; ++k)
            for (int j = 0; j < n.y; ++j)
                for (int i = 0; i < n.x; ++i) {
                    const int x = i - 20, y = j - 20, z = k - 20;
                    const bool isInside = isRound ? x * x + y * y + z * z < 18 * 18 : i > 5 && j > 5 && k > 9;
                    scalars.push_back(isInside ? 1u : 0u);
                }
        const auto bricks = *volume::BrickVolume::fromColumns(volume::ColumnVolume::fromDense(n, scalars));
        const auto grid =
            *volume::Grid::fromParts(n, {0.1, 0.1, 0.1}, {0, 0, 0}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
        for (int what = 0; what < 6; ++what) {
            render::FrameSpec spec;
            spec.camera = *render::cameraPreset("iso", grid);
            render::Style body{{0.5f, 0.5f, 0.5f}, what == 2 || what == 3 ? 0.5f : 1.0f};
            if (what == 4) body.hatch = render::Hatch::Concrete;
            spec.passes.push_back({{{{}, 0}, body}, {}, render::Pass::Join::Over});
            if (what == 1 || what == 3 || what == 4)
                spec.passes[0].clips = {render::ClipRegion::plane({0, -1, 0}, {0, 1.23, 0})};
            if (what == 5) spec.passes[0].lines = {{{{{0, 0, 0}, {4, 4, 4}, 1}}}};
            auto renderer = GlRenderer::make(bricks, grid);
            ASSERT_TRUE(renderer);
            const double begin = double(std::clock());
            const double wall = millisecondsOf([&] { EXPECT_TRUE(renderer->pick(spec, 640, 360)); });
            const double middle = double(std::clock());
            (void)renderer->pick(spec, 640, 360);
            const char* const names[]{"opaque", "opaque, cut", "glass", "glass, cut", "hatched", "lines"};
            std::cout << (isRound ? "round, " : "flat, ") << names[what] << ": "
                      << (middle - begin) / CLOCKS_PER_SEC * 1000 << " ms of processor time, " << wall << " ms, again "
                      << (double(std::clock()) - middle) / CLOCKS_PER_SEC * 1000 << "\n";
        }
    }
}

}  // namespace
}  // namespace svt::render_gl

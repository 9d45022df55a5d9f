#include <svt/core/test_data_test.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/render/camera_presets.hpp>
#include <svt/render_gl/compare_test.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>

namespace svt::render_gl {
namespace {

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
                double drawn = 1e9, cast = 1e9;
                for (int n = 0; n < 5; ++n) {
                    drawn = std::min(drawn, millisecondsOf([&] { (void)(*renderer)->readColor(spec); }));
                    cast = std::min(cast, millisecondsOf([&] { (void)render::castRays(bricks, grid, spec); }));
                }
                std::cout << test::context()->renderer() << ", opacity " << opacity << (isCut ? ", cut, " : ", ")
                          << width << ": made " << made << " ms, first " << first << " ms, pick " << first2
                          << " ms, drawn " << drawn << " ms, cast " << cast << " ms\n";
            }
        }
}

}  // namespace
}  // namespace svt::render_gl

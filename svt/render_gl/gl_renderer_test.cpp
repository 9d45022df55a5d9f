#include <svt/core/test_data_test.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/render/camera_presets.hpp>
#include <svt/render/png.hpp>
#include <svt/render_gl/compare_test.hpp>
#include <svt/samples/sample.hpp>

#include <chrono>
#include <iostream>

namespace svt::render_gl {
namespace {

using render::FrameSpec;
using render::Style;

struct Model {
    volume::BrickVolume bricks;
    volume::Grid grid;
    std::vector<Style> styles;
};

TEST(GlRenderer, First) {
    SVT_NEEDS_GL();
    SVT_NEEDS_DATA(file, "fzk_haus_citygml3.gml");
    pipeline::BuildOptions options;
    options.dimension = Vec3i{800, 700, 400};
    const std::filesystem::path files[]{file};
    auto built = pipeline::buildVolume(files, options);
    ASSERT_TRUE(built) << built.error().toString();
    const auto& volume = built->volume;
    auto bricks = *volume::BrickVolume::fromColumns(volume.columns);
    FrameSpec spec;
    spec.width = 640;
    spec.height = 360;
    spec.camera = *render::cameraPreset("iso", volume.grid);
    std::vector<Style> styles(bricks.scalarCount());
    styles[0].opacity = 0;
    for (std::size_t n = 1; n < styles.size(); ++n)
        styles[n].color = {float(n * 37 % 100) / 100, float(n * 61 % 100) / 100, float(n * 17 % 100) / 100};
    spec.passes.push_back({styles, {}, render::Pass::Join::Over});
    auto renderer = GlRenderer::make(bricks, volume.grid);
    ASSERT_TRUE(renderer) << renderer.error().toString();
    const auto now = [] { return std::chrono::steady_clock::now(); };
    const auto ms = [](auto a, auto b) { return std::chrono::duration<double, std::milli>(b - a).count(); };
    for (int round = 0; round < 4; ++round) {
        auto t0 = now();
        auto drawn = renderer->read(spec);
        ASSERT_TRUE(drawn) << drawn.error().toString();
        auto t1 = now();
        auto cast = render::castRays(bricks, volume.grid, spec);
        auto t2 = now();
        std::cout << "gl " << ms(t0, t1) << " cpu " << ms(t1, t2) << "\n";
        if (round == 3) {
            auto d = test::compare(bricks, volume.grid, spec, *drawn, *cast, 2);
            std::cout << "labels " << d.labels << " edges " << d.edges << " depths " << d.depths << " colors "
                      << d.colors << " largest " << d.largestColor << " at " << d.x << "," << d.y << "\n";
            (void)render::writePng("/tmp/glx/gl.png", drawn->color);
            (void)render::writePng("/tmp/glx/cpu.png", cast->color);
        }
    }
}

}  // namespace
}  // namespace svt::render_gl

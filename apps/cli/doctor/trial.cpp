#include <apps/cli/doctor/trial.hpp>

#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <span>

namespace svt::cli {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

bool isApart(image::Rgba8 a, image::Rgba8 b) {
    constexpr int kBound = 3;
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b), std::abs(a.a - b.a)}) > kBound;
}

}  // namespace

Result<TestVolume> buildTestVolume() {
    SVT_TRY(text, samples::writeSample(samples::SampleKind::House, samples::SampleFormat::CityGml3, {}));
    const std::span<const char> document(*text);
    const auto start = Clock::now();
    SVT_TRY(model, readers::readModel(std::as_bytes(document), "house.gml"));
    pipeline::BuildOptions options;
    options.spacing = Vec3d{0.2, 0.2, 0.2};
    SVT_TRY(output, pipeline::buildVolume(*model, options));
    return TestVolume{std::move(output->volume), secondsSince(start)};
}

Result<TestPicture> drawTestPicture(illustrate::ScenePainter& painter, const illustrate::ScenePainter::Draw& draw) {
    illustrate::Scene scene;
    scene.width = 320;
    scene.height = 180;
    scene.samples = 1;
    scene.passes[0].representation.level = 0;  // the level that OpenGL draws
    TestPicture picture;
    for (double* seconds : {&picture.firstSeconds, &picture.seconds}) {
        const auto start = Clock::now();
        SVT_TRY(painting, painter.paint(scene, draw));
        *seconds = secondsSince(start);
        picture.frame = std::move(painting->frame);
    }
    return picture;
}

Result<render::Frame> castByCpu(std::span<const render::DrawnVolume> volumes, const render::FrameSpec& spec) {
    return render::castRays(volumes, spec);
}

std::size_t differingPixels(const render::Frame& a, const render::Frame& b) {
    std::size_t differing = 0;
    for (std::size_t n = 0; n < a.label.pixels().size(); ++n)
        differing += a.label.pixels()[n] != b.label.pixels()[n] || isApart(a.color.pixels()[n], b.color.pixels()[n]);
    return differing;
}

}  // namespace svt::cli

#include <apps/cli/doctor/gl_probe.hpp>

#include <apps/cli/doctor/trial.hpp>
#include <apps/cli/output/json_output.hpp>

#include <svt/core/machine.hpp>
#include <svt/render_gl/egl_context.hpp>
#include <svt/render_gl/gl_renderer.hpp>

#include <optional>
#include <sstream>

namespace svt::cli {
namespace {

// Prints a separate line, even if the driver has written an unfinished one.
void tell(const Say& say, const Json& json) {
    say("\n" + json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

// Reports each finding at once, so that it is kept if the next step crashes.
void drawByGl(const Say& say) {
    const auto context = render_gl::EglContext::make();
    if (!context) return tell(say, {{"contextFault", context.error().message()}});
    const std::string renderer = context->renderer();
    tell(say, {{"renderer", renderer},
               {"version", context->version()},
               {"isSoftware", render_gl::isSoftwareRenderer(renderer)}});

    const auto house = buildTestVolume();
    if (!house) return tell(say, {{"pictureFault", house.error().message()}});
    illustrate::ScenePainter painter(house->volume);
    const auto cast = drawTestPicture(painter, castByCpu);
    if (!cast) return tell(say, {{"pictureFault", cast.error().message()}});
    std::optional<render_gl::GlRenderer> made;
    const auto drawn = drawTestPicture(
        painter,
        [&made](std::span<const render::DrawnVolume> volumes, const render::FrameSpec& spec) -> Result<render::Frame> {
            if (!made) {
                SVT_TRY(gl, render_gl::GlRenderer::make(volumes[0].bricks(), volumes[0].grid()));
                made.emplace(std::move(*gl));
            }
            return made->read(spec);
        });
    if (!drawn) return tell(say, {{"pictureFault", drawn.error().message()}});
    tell(say, {{"firstSeconds", drawn->firstSeconds},
               {"seconds", drawn->seconds},
               {"pixels", drawn->frame.label.pixels().size()},
               {"differing", differingPixels(drawn->frame, cast->frame)}});
}

}  // namespace

GlProbe probeGl() {
    constexpr double kSeconds = 10;
    const OwnProcessResult result = inOwnProcess(kSeconds, drawByGl);
    GlProbe probe;
    Json told = Json::object();
    std::istringstream lines(result.text);
    for (std::string line; std::getline(lines, line);) {
        const Json part = Json::parse(line, nullptr, false);
        if (part.is_object())
            told.update(part);
        else if (!line.empty())
            probe.messages += line + "\n";
    }
    probe.contextFault = told.value("contextFault", "");
    probe.renderer = told.value("renderer", "");
    probe.version = told.value("version", "");
    probe.isSoftware = told.value("isSoftware", false);
    probe.pictureFault = told.value("pictureFault", "");
    probe.firstSeconds = told.value("firstSeconds", 0.0);
    probe.seconds = told.value("seconds", 0.0);
    probe.pixels = told.value("pixels", std::size_t{0});
    probe.differing = told.value("differing", std::size_t{0});
    if (!result.fault.empty()) {
        // A driver that fails after drawing, while it is released, does no harm.
        const std::string fault = "the graphics driver failed: " + result.fault;
        if (!told.contains("renderer"))
            probe.contextFault = fault;
        else if (probe.pixels == 0)
            probe.pictureFault = fault;
    }
    return probe;
}

}  // namespace svt::cli

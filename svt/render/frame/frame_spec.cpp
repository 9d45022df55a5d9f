#include <svt/render/frame/share.hpp>
#include <svt/render/frame_spec.hpp>

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace svt::render {
namespace {

Result<void> checkCamera(const Camera& camera) {
    if (!isFinite(camera.eye) || !isFinite(camera.target) || !isFinite(camera.up))
        return Error(Code::BadCamera, "eye, target and up of the camera must be finite");
    const Vec3d view = camera.target - camera.eye;
    if (!(length(view) > 0) || !std::isfinite(length(view)))
        return Error(Code::BadCamera, "eye and target of the camera are the same point; move one of them");
    // Up counts as parallel to the view if the sine of the angle between them is at most 1e-6.
    if (!(length(cross(normalized(view), normalized(camera.up))) > 1e-6))
        return Error(Code::BadCamera,
                     "up of the camera is zero or along the view; choose another up, such as y for a "
                     "view from above");
    if (camera.projection == Camera::Projection::Perspective &&
        !(camera.verticalFovDegrees > 0 && camera.verticalFovDegrees < 180))
        return Error(Code::BadCamera,
                     fmt::format("a field of view of {} degrees is out of range; it must be greater than "
                                 "0 and less than 180",
                                 camera.verticalFovDegrees));
    if (camera.projection == Camera::Projection::Orthographic &&
        !(camera.orthographicHeight > 0 && std::isfinite(camera.orthographicHeight)))
        return Error(Code::BadCamera,
                     fmt::format("an orthographic height of {} m is out of range; it must be greater than 0",
                                 camera.orthographicHeight));
    return {};
}

Result<void> checkLook(const FrameSpec& spec) {
    const Light& light = spec.light;
    if (!isFinite(light.direction) || !(length(light.direction) > 0))
        return Error(Code::BadFrame, "the direction to the light is zero or not finite");
    if (!(light.key >= 0 && light.key <= 100) || !(light.ambient >= 0 && light.ambient <= 100) ||
        !isShare(light.ambientOcclusion))
        return Error(Code::BadFrame, "key and ambient light must be 0 to 100, ambient occlusion 0 to 1");
    if (!(light.size >= 0 && light.size <= 20))
        return Error(Code::BadFrame, "the diameter of the key light must be 0 to 20 degrees");
    if (!isColor(spec.background.top) || !isColor(spec.background.bottom) || !isShare(spec.background.alpha))
        return Error(Code::BadFrame, "colours and alpha of the background must be 0 to 1");
    const auto isWidth = [](float width) { return width >= 0 && width <= BorderLines::kMaxWidth; };
    const BorderLines& borders = spec.borders;
    if (!isShare(borders.strength) || !isColor(borders.color))
        return Error(Code::BadFrame, "strength and colour of border lines must be 0 to 1");
    const HatchStyle& hatches = spec.hatches;
    if (!isShare(hatches.strength) || !isColor(hatches.color))
        return Error(Code::BadFrame, "strength and colour of hatches must be 0 to 1");
    if (!isWidth(borders.width) || !isWidth(borders.cutWidth) || !isWidth(hatches.width))
        return Error(Code::BadFrame, fmt::format("widths of lines must be 0 to {} pixels", BorderLines::kMaxWidth));
    if (!(hatches.spacing > 0 && std::isfinite(hatches.spacing)))
        return Error(Code::BadFrame, fmt::format("a hatch spacing of {} m is out of range; it must be greater than 0",
                                                 hatches.spacing));
    return {};
}

Result<void> checkPass(const Pass& pass, std::size_t number) {
    const auto bad = [&](std::string_view what) {
        return Error(Code::BadFrame, fmt::format("pass {}: {}", number, what));
    };
    for (std::size_t scalar = 0; scalar < pass.styles.size(); ++scalar)
        if (!isColor(pass.styles[scalar].color) || !isShare(pass.styles[scalar].opacity))
            return bad(fmt::format("colour and opacity of scalar {} must be 0 to 1", scalar));
    std::size_t parts = 0;
    for (const ClipRegion& clip : pass.clips) {
        SVT_DO(checkClip(clip, fmt::format("pass {}", number)));
        parts += clip.parts.size();
    }
    if (parts > Pass::kMaxClipParts)
        return bad(fmt::format("clips of {} parts are over the limit of {}", parts, Pass::kMaxClipParts));
    if (auto checked = checkShapes(pass.lines, pass.triangles); !checked) return bad(checked.error().message());
    return {};
}

}  // namespace

Result<void> checkFrameSpec(const FrameSpec& spec) {
    if (spec.width < 1 || spec.height < 1 || spec.width > FrameSpec::kMaxSize || spec.height > FrameSpec::kMaxSize)
        return Error(Code::BadFrame, fmt::format("a picture of {} x {} pixels is out of range; 1 to {} are possible",
                                                 spec.width, spec.height, FrameSpec::kMaxSize));
    const int samples = spec.samplesPerPixel;
    if (samples != 1 && samples != 4 && samples != 9 && samples != 16)
        return Error(Code::BadFrame, fmt::format("{} samples per pixel are not possible; 1, 4, 9 or 16 are", samples));
    SVT_DO(checkCamera(spec.camera));
    SVT_DO(checkLook(spec));
    if (spec.passes.size() > FrameSpec::kMaxPasses)
        return Error(Code::BadFrame,
                     fmt::format("{} passes are over the limit of {}", spec.passes.size(), FrameSpec::kMaxPasses));
    for (std::size_t number = 0; number < spec.passes.size(); ++number)
        if (auto checked = checkPass(spec.passes[number], number); !checked) return checked;
    return {};
}

}  // namespace svt::render

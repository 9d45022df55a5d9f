#include <svt/render/light/cap_hatch.hpp>

#include <svt/render/picture_constants.hpp>

#include <algorithm>
#include <cmath>

namespace svt::render {

void hatchCap(const PreparedFrame& frame, std::size_t pass, double u, double v, Sample& sample) noexcept {
    const auto& styles = frame.spec.passes[pass].styles;
    const Hatch hatch = sample.label < styles.size() ? styles[sample.label].hatch : Hatch::None;
    const HatchStyle& style = frame.spec.hatches;
    if (hatch == Hatch::None || !(style.strength > 0)) return;
    const Vec3d normal{sample.normal.x, sample.normal.y, sample.normal.z};
    const volume::Grid& grid = frame.volumes.front().grid;
    // The hatch's vertical axis is the grid's up direction projected onto the face; on nearly horizontal faces, north.
    const Vec3d north = grid.axes()[1], level = grid.axes()[2];
    const Vec3d above = std::abs(dot(normal, level)) < kLevelCap ? level : north;
    const Vec3d up = normalized(above - normal * dot(normal, above));
    const Vec3d right = cross(up, normal);
    const double depth = static_cast<double>(sample.depth);
    const Vec3d point = frame.rays().worldAt(u, v, depth) - grid.origin();
    const double pixel = frame.rays().pixelSize(depth);
    // At a grazing angle a pixel covers more of the face.
    const double facing = std::max(std::abs(dot(normal, frame.rays().forward())), kLeastCapFacing);
    const HatchPen pen{style.spacing, static_cast<double>(style.width) * pixel,
                       pixel / (facing * std::sqrt(double(frame.spec.samplesPerPixel)))};
    const auto ink = static_cast<float>(hatchCoverage(hatch, dot(point, right), dot(point, up), pen)) * style.strength;
    sample.color = sample.color * (1 - ink) + frame.hatchColor * (ink * sample.alpha);
}

}  // namespace svt::render

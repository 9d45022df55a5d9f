#include <svt/render/light/surface_light.hpp>

#include <svt/render/picture_constants.hpp>

#include <algorithm>
#include <cmath>

namespace svt::render {
namespace {

std::uint64_t part(std::int32_t c, int shift) noexcept { return static_cast<std::uint64_t>(c) << shift; }

}  // namespace

Surface SurfaceLight::at(const LinearStyle& style, const SurfaceHit& hit) const {
    Surface surface = findNormal(style, hit);
    const bool isOpen = !style.isBody || surface.isAroundEye || frame_.spec.light.ambientOcclusion <= 0;
    const Vec3d point = hit.origin + hit.direction * hit.from;
    surface.light =
        lightOn(surface.normal, hit.view, isOpen ? 1 : openness(point, surface.outwardIndex, surface.cavity), point);
    return surface;
}

double SurfaceLight::lightSurface(const LinearStyle& style, Vec3d normal, Vec3d view, Vec3d point) const noexcept {
    const bool isOpen = !style.isBody || frame_.spec.light.ambientOcclusion <= 0;
    return lightOn(normal, view, isOpen ? 1 : openness(point, volume_.directions.outwardIndex(normal), 0), point);
}

Surface SurfaceLight::findNormal(const LinearStyle& style, const SurfaceHit& hit) const {
    Surface surface;
    DirectionTable::Directions found;
    bool isAway = false;
    if (hit.cap) {
        found.normal =
            hit.cap.normalAt(volume_.grid.worldFromIndex(hit.origin + hit.direction * hit.from - Vec3d{0.5, 0.5, 0.5}));
        found.outwardIndex = volume_.directions.outwardIndex(found.normal);
        isAway = dot(found.normal, hit.view) < 0;
        surface.isCap = true;
    } else if (hit.faceNormal != nullptr) {
        found.normal = *hit.faceNormal;
        found.outwardIndex = volume_.directions.outwardIndex(found.normal);
        isAway = dot(found.normal, hit.view) < 0;
    } else if (hit.plane != volume::BrickVolume::kNoPlane) {
        found = volume_.directions.plane(hit.plane);
        isAway = dot(volume_.bricks.planes()[hit.plane].normal, hit.direction) > 0;
    } else if (hit.axis < 0) {
        found.normal = hit.view;
        surface.isAroundEye = true;
    } else if (style.isBody && hit.isVoxel && !frame_.spec.passes[passNumber_].hasCells) {
        const SurfaceNormal& fitted = normalAt(hit.voxel, hit.axis, hit.direction[hit.axis] > 0 ? -1 : 1);
        found = volume_.directions.directions(toDouble(fitted.indexNormal));
        surface.cavity = std::clamp(
            (double(fitted.filledShare) - double(SurfaceNormal::kPlaneFilledShare) - kCavityFrom) * kCavityGain, 0.0,
            1.0);
    } else {
        found = volume_.directions.axis(hit.axis);
        isAway = hit.direction[hit.axis] > 0;
    }
    surface.normal = isAway ? -found.normal : found.normal;
    surface.outwardIndex = isAway ? -found.outwardIndex : found.outwardIndex;
    return surface;
}

const SurfaceNormal& SurfaceLight::normalAt(Vec3i voxel, int axis, int sign) const {
    // 17 bits per coordinate, 3 for the face, 6 for the pass.
    const std::uint64_t key = part(voxel.x, 0) | part(voxel.y, 17) | part(voxel.z, 34) |
                              part(2 * axis + (sign > 0 ? 1 : 0), 51) | part(std::int32_t(passNumber_), 54);
    NormalCache::Slot& slot = cache_.slot(key);
    if (slot.key != key) {
        slot.key = key;
        const PassTable& table = pass_.table;
        slot.normal = surfaceNormal(volume_.bricks, voxel, axis, sign,
                                    [&](volume::Scalar scalar) { return table[scalar].isBody; });
    }
    return slot.normal;
}

// 1 where nothing occludes, less in corners.
double SurfaceLight::openness(Vec3d point, Vec3d outwardIndex, double cavity) const noexcept {
    const double occlusion = std::min(1.0, pass_.occlusion.occlusion(point, outwardIndex) + kCavityOcclusion * cavity);
    return 1 - double(frame_.spec.light.ambientOcclusion) * occlusion;
}

double SurfaceLight::unshaded(Vec3d point, Vec3d normal) const noexcept {
    // Turned away from the light: nothing to look up.
    if (frame_.shadows.isEmpty() || !(dot(normal, frame_.towardsLight) > 0)) return 1;
    return frame_.shadows.lightAt(volume_.grid.worldFromIndex(point - Vec3d{0.5, 0.5, 0.5}), normal);
}

// Key light, sky and a little light from the viewer, all attenuated by occlusion (`open`).
double SurfaceLight::lightOn(Vec3d normal, Vec3d view, double open, Vec3d point) const noexcept {
    const Light& light = frame_.spec.light;
    double key = std::max(0.0, dot(normal, frame_.towardsLight));
    if (!frame_.shadows.isEmpty()) key = key * unshaded(point, normal);
    const double facing = std::max(0.0, dot(normal, view));
    const double sky = kSkyAside + kSkyAbove * normal.z;
    return double(light.ambient) * open * (kSkyShare * sky + kViewerShare * facing) +
           double(light.key) * key * (kKeyShut + kKeyOpen * open);
}

}  // namespace svt::render

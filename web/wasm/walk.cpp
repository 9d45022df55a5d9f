#include "walk.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace svt::web {
namespace {

constexpr double kBodyRadius = 0.22;   // metres
constexpr double kHighestStep = 0.45;  // metres
constexpr double kStride = 0.08;       // metres; longer steps are divided

// Whether a body with this eye has room around it, from the highest step to above the head.
bool hasRoom(const Session& session, Vec3d eye) {
    for (const double below : {kEyeHeight - kHighestStep - 0.05, 0.8, 0.4, 0.0, -0.1}) {
        const Vec3d middle{eye.x, eye.y, eye.z - below};
        if (!session.isAir(middle)) return false;
        for (int n = 0; n < 8; ++n) {
            const double angle = n * std::numbers::pi / 4;
            const Vec3d side{kBodyRadius * std::cos(angle), kBodyRadius * std::sin(angle), 0};
            if (!session.isAir(middle + side)) return false;
        }
    }
    return true;
}

// The height of the floor below the eye, from kHighestStep above the feet to kHighestStep below them.
std::optional<double> floorBelow(const Session& session, Vec3d eye) {
    constexpr double kFine = 0.02;
    const double feet = eye.z - kEyeHeight;
    for (double z = feet + kHighestStep; z >= feet - kHighestStep; z -= kFine)
        if (!session.isAir({eye.x, eye.y, z})) return z + kFine;
    return std::nullopt;
}

std::optional<Vec3d> standingAt(const Session& session, Vec3d eye) {
    // Accepts a floor slightly higher or lower than that of the level.
    for (const double offset : {0.0, 0.4, -0.4, 0.8, -0.8, 1.2, -1.2}) {
        Vec3d at{eye.x, eye.y, eye.z + offset};
        const auto floor = floorBelow(session, at);
        if (!floor) continue;
        at.z = *floor + kEyeHeight;
        if (hasRoom(session, at)) return at;
    }
    return std::nullopt;
}

// One short step: the whole step, or else along one axis; then onto the floor.
Vec3d shortStep(const Session& session, Vec3d eye, Vec3d step) {
    const bool wasStuck = !hasRoom(session, eye);
    const bool stood = floorBelow(session, eye).has_value();
    Vec3d at = eye;
    const Vec3d level{step.x, step.y, 0};
    for (const Vec3d part : {level, Vec3d{step.x, 0, 0}, Vec3d{0, step.y, 0}}) {
        Vec3d next = eye + part;
        if (stood && step.z == 0)
            if (const auto floor = floorBelow(session, next)) next.z = *floor + kEyeHeight;
        if (!wasStuck && !hasRoom(session, next)) continue;
        at = next;
        break;
    }
    const Vec3d risen{at.x, at.y, at.z + step.z};
    return step.z != 0 && (wasStuck || hasRoom(session, risen)) ? risen : at;
}

}  // namespace

std::optional<Vec3d> standingPlace(const Session& session, Vec3d wanted) {
    constexpr double kApart = 0.4, kFar = 60;
    std::optional<Vec3d> outside;
    if (const auto here = standingAt(session, wanted); here && session.isInRoom(*here)) return here;
    for (double radius = 0; radius <= kFar; radius += kApart) {
        const int count = std::max(1, static_cast<int>(2 * std::numbers::pi * radius / kApart));
        for (int n = 0; n < count; ++n) {
            const double angle = 2 * std::numbers::pi * n / count;
            const Vec3d near = wanted + Vec3d{radius * std::cos(angle), radius * std::sin(angle), 0};
            const auto found = standingAt(session, near);
            if (!found) continue;
            if (session.isInRoom(*found)) return found;
            if (!outside) outside = found;
        }
    }
    return outside;
}

Vec3d afterStep(const Session& session, Vec3d eye, Vec3d step) {
    const int count = std::clamp(static_cast<int>(std::ceil(length(step) / kStride)), 1, 64);
    for (int n = 0; n < count; ++n) eye = shortStep(session, eye, step * (1.0 / count));
    return eye;
}

}  // namespace svt::web

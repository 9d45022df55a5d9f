#include <svt/compare/shape/rotation.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace svt::compare {
namespace {

constexpr double kTurnPi = 3.14159265358979323846;
constexpr double kUpright = 1e-3;       // largest vertical part of the unit normal of an upright face
constexpr double kOneDirection = 2e-3;  // radians between faces of one direction
constexpr std::size_t kMostAngles = 16;

// Upright faces with one horizontal normal.
struct Direction {
    double angle = 0, area = 0;  // radians, m2
};

double turnedBy(double from, double to) noexcept {
    const double angle = std::remainder(to - from, 2 * kTurnPi);
    return angle <= -kTurnPi + 1e-9 ? angle + 2 * kTurnPi : angle;
}

// Ascending by angle. The last ones may continue at the first.
std::vector<Direction> directionsOf(const Faces& faces) {
    std::vector<Direction> all;
    for (std::size_t t = 0; t < faces.triangles.size(); ++t) {
        const auto [a, b, c] = faces.corners(t);
        const Vec3d normal = cross(b - a, c - a);
        const double twice = length(normal);
        if (!(twice > 0) || std::abs(normal.z) > kUpright * twice) continue;
        all.push_back({std::atan2(normal.y, normal.x), twice / 2});
    }
    std::sort(all.begin(), all.end(), [](const Direction& a, const Direction& b) { return a.angle < b.angle; });
    std::vector<Direction> merged;
    const auto join = [](Direction& into, const Direction& more) {
        into.area += more.area;
        into.angle += turnedBy(into.angle, more.angle) * more.area / into.area;
    };
    for (const Direction& direction : all) {
        if (!merged.empty() && direction.angle - merged.back().angle < kOneDirection)
            join(merged.back(), direction);
        else
            merged.push_back(direction);
    }
    if (merged.size() > 1 && std::abs(turnedBy(merged.back().angle, merged.front().angle)) < kOneDirection) {
        join(merged.front(), merged.back());
        merged.pop_back();
    }
    return merged;
}

// The angle of the longer principal axis in plan, radians; nothing where no axis is longer.
std::optional<double> principalAngle(const Shape& shape) {
    const auto [xx, yy, zz, xy, yz, zx] = shape.moments;
    if (std::hypot(xx - yy, 2 * xy) < 1e-3 * (xx + yy)) return std::nullopt;
    return 0.5 * std::atan2(2 * xy, xx - yy);
}

// Radians, the smallest first.
std::vector<double> possibleAngles(const Shape& a, const Shape& b) {
    std::vector<double> angles;
    const std::vector<Direction> before = directionsOf(a.faces), after = directionsOf(b.faces);
    // The direction with the fewest alike ones leaves the fewest angles.
    std::vector<double> found;
    double best = 0;
    for (const Direction& direction : before) {
        found.clear();
        for (const Direction& other : after)
            if (std::abs(other.area - direction.area) <= 0.02 * direction.area + 1e-4)
                found.push_back(turnedBy(direction.angle, other.angle));
        if (found.empty() || (!angles.empty() && (found.size() > angles.size() ||
                                                  (found.size() == angles.size() && direction.area <= best))))
            continue;
        angles = found;
        best = direction.area;
    }
    if (before.empty() && after.empty()) {
        const auto from = principalAngle(a), to = principalAngle(b);
        if (from && to) angles = {turnedBy(*from, *to), turnedBy(*from, *to + kTurnPi)};
    }
    std::sort(angles.begin(), angles.end(), [](double s, double t) {
        return std::abs(std::abs(s) - std::abs(t)) > 1e-6 ? std::abs(s) < std::abs(t) : s > t;
    });
    if (angles.size() > kMostAngles) angles.resize(kMostAngles);
    return angles;
}

// A turn about the vertical keeps area, height, and these parts of the moments.
bool mayBeTurned(const Shape& a, const Shape& b, double most) {
    if (a.isSolid != b.isSolid || a.faces.triangles.empty() || b.faces.triangles.empty()) return false;
    const double size = std::max(length(a.box.size()), length(b.box.size())) + most;
    const double areaOff = most * size * 8 + 1e-9 * (a.area + b.area), off = areaOff * size * size;
    if (std::abs(a.area - b.area) > areaOff || std::abs(a.box.size().z - b.box.size().z) > 2 * most) return false;
    const auto& s = a.moments;
    const auto& t = b.moments;
    return std::abs(s[2] - t[2]) <= off && std::abs(s[0] + s[1] - t[0] - t[1]) <= off &&
           std::abs(std::hypot(s[4], s[5]) - std::hypot(t[4], t[5])) <= 2 * off;
}

// Whether faces that are off by `rest` explain the other area and volume. A hole changes them by more, and may lie between
// the points.
bool isExplained(const Shape& a, const Shape& b, double rest) {
    constexpr double kRounding = 4e-6;  // metres, of points of both shapes
    const double size = std::max(length(a.box.size()), length(b.box.size()));
    const double off = rest + kRounding;
    if (std::abs(a.area - b.area) > 8 * off * size) return false;
    return !a.volume || !b.volume || std::abs(*a.volume - *b.volume) <= off * (a.area + b.area);
}

}  // namespace

std::optional<double> rotationBetween(const Shape& a, const FaceTree& treeOfA, const Shape& b, const FaceTree& treeOfB,
                                      double most) {
    if (!mayBeTurned(a, b, most)) return std::nullopt;
    for (const double angle : possibleAngles(a, b)) {
        const Turn turn{a.center, b.center, std::cos(angle), std::sin(angle)};
        double rest = largestDistance(a.faces, treeOfB, turn, most);
        if (rest <= most) rest = std::max(rest, largestDistance(b.faces, treeOfA, turn.reversed(), most));
        if (rest <= most && isExplained(a, b, rest)) return angle * 180 / kTurnPi;
    }
    return std::nullopt;
}

}  // namespace svt::compare

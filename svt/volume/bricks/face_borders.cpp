#include <svt/volume/face_planes.hpp>

#include <algorithm>
#include <cmath>

namespace svt::volume {
namespace {

// Voxels: by how much rounding may move a plane past samples; the minimum distance of a plane from samples.
constexpr double kRounding = 1.0 / 256, kInset = 1e-3;
constexpr std::size_t kMaxCandidates = std::size_t{1} << 22;  // only a malicious file needs more

// Where the line through `point` along the axis meets the plane.
double placeOf(const BrickPlane& plane, int axis, Vec3d point) noexcept {
    point[axis] = 0;
    return -(dot(plane.normal, point) + plane.offset) / plane.normal[axis];
}

// The area of the brick's side that the box of the faces covers, square voxels; negative if it is not next to the
// brick.
double overlapOf(const FacePlane& face, int axis, Vec3i brick) noexcept {
    double area = 1;
    for (int n = 0; n < 3; ++n) {
        const auto a = static_cast<std::size_t>(n);
        const int from = std::max<int>(face.min[a], brick[n]), to = std::min<int>(face.max[a], brick[n] + 8);
        if (to < from) return -1;
        if (n != axis) area *= to - from;
    }
    return area;
}

// The plane, if it passes between the samples on both sides of the border in the whole brick. A plane that is too close
// to samples is moved away from them.
std::optional<BrickPlane> between(const BrickPlane& plane, int axis, std::int32_t border, Vec3i brick) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    Vec3d middle = toDouble(brick);
    middle[b] += 4;
    middle[c] += 4;
    const double away = placeOf(plane, axis, middle) - border;
    if (std::abs(away) > 0.5 + kRounding) return std::nullopt;
    const double tilt = 4 * (std::abs(plane.normal[b]) + std::abs(plane.normal[c]));
    if (tilt < 1e-4) {
        BrickPlane upright;
        upright.normal[axis] = 1;
        constexpr double kUnit = double(1 << 20);  // as precise as planes are stored
        upright.offset = -(border + std::round(std::clamp(away, kInset - 0.5, 0.5 - kInset) * kUnit) / kUnit);
        return upright;
    }
    if (std::abs(away) + tilt > 0.5 - kInset) return std::nullopt;
    return plane;
}

}  // namespace

FaceBorders::FaceBorders(Vec3i low, Vec3i size, std::span<const FacePlane> faces) : low_(low), size_(size) {
    for (int axis = 0; axis < 3; ++axis)
        byBorder_[static_cast<std::size_t>(axis)].resize(static_cast<std::size_t>(size[axis]) + 1);
    for (const FacePlane& face : faces)
        for (int axis = 0; axis < 3; ++axis) add(face, axis);
}

void FaceBorders::add(const FacePlane& face, int axis) {
    BrickPlane plane = face.plane;
    if (std::abs(plane.normal[axis]) < 1 - 1e-6) return;
    if (plane.normal[axis] < 0) plane = {plane.normal * -1.0, -plane.offset};
    double least = 1e300, most = -1e300;
    for (int corner = 0; corner < 4; ++corner) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        Vec3d point = toDouble(low_);
        if ((corner & 1) != 0) point[b] += size_[b];
        if ((corner & 2) != 0) point[c] += size_[c];
        const double place = placeOf(plane, axis, point) - low_[axis];
        least = std::min(least, place);
        most = std::max(most, place);
    }
    const double first = std::max(std::ceil(least - 0.5 - kRounding), 0.0);
    const double last = std::min(std::floor(most + 0.5 + kRounding), double(size_[axis]));
    for (double border = first; border <= last && count_ < kMaxCandidates; ++border, ++count_)
        byBorder_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(border)].push_back({plane, &face});
}

std::optional<BrickPlane> FaceBorders::find(int axis, std::int32_t border, Vec3i brick) const {
    const std::int32_t number = border - low_[axis];
    if (number < 0 || number > size_[axis]) return std::nullopt;
    std::optional<BrickPlane> best;
    double mostOverlap = -1;
    for (const Candidate& candidate : byBorder_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(number)]) {
        const double overlap = overlapOf(*candidate.face, axis, brick);
        if (overlap <= mostOverlap) continue;
        const auto plane = between(candidate.plane, axis, border, brick);
        if (!plane) continue;
        best = plane;
        mostOverlap = overlap;
    }
    return best;
}

}  // namespace svt::volume

#include <svt/simulate/spread/air_distance.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace svt::simulate {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
// Voxels around the place have the straight distance, because fronts are too round for differences there.
constexpr std::int32_t kStart = 4;

}  // namespace

AirDistance::AirDistance(const RoomAir& air, Vec3d spacing)
    : air_(air),
      spacing_(spacing),
      stride_{1, static_cast<std::uint32_t>(air.size.x),
              static_cast<std::uint32_t>(air.size.x) * static_cast<std::uint32_t>(air.size.y)},
      distances_(air.zones.size(), kFar),
      states_(air.zones.size(), State::Trial) {}

std::span<const std::uint32_t> AirDistance::from(Vec3d index, Vec3i voxel) {
    for (const std::uint32_t v : accepted_) {
        distances_[v] = kFar;
        states_[v] = State::Trial;
    }
    accepted_.clear();
    startNear(index, voxel);
    while (!heap_.empty()) {
        std::pop_heap(heap_.begin(), heap_.end());
        const std::uint32_t own = heap_.back().voxel;
        heap_.pop_back();
        if (states_[own] == State::Accepted) continue;
        states_[own] = State::Accepted;
        accepted_.push_back(own);
        const Vec3i place = air_.place(own);
        for (int axis = 0; axis < 3; ++axis)
            for (const std::int32_t by : {-1, 1}) {
                const std::int32_t to = place[axis] + by;
                if (to < 0 || to >= air_.size[axis]) continue;
                const std::uint32_t stride = stride_[static_cast<std::size_t>(axis)];
                const std::uint32_t next = by < 0 ? own - stride : own + stride;
                if (states_[next] == State::Trial && RoomAir::passes(air_.zones[own], air_.zones[next]))
                    tryVoxel(next, solve(next));
            }
    }
    return accepted_;
}

void AirDistance::tryVoxel(std::uint32_t voxel, float distance) {
    if (!(distance < distances_[voxel])) return;
    distances_[voxel] = distance;
    heap_.push_back({distance, voxel});
    std::push_heap(heap_.begin(), heap_.end());
}

// Whether all voxels of the box between two voxels are air that is connected with the first.
bool AirDistance::isInSight(Vec3i from, Vec3i to) const noexcept {
    const std::uint32_t zone = air_.zones[air_.number(from)];
    for (std::int32_t k = std::min(from.z, to.z); k <= std::max(from.z, to.z); ++k)
        for (std::int32_t j = std::min(from.y, to.y); j <= std::max(from.y, to.y); ++j)
            for (std::int32_t i = std::min(from.x, to.x); i <= std::max(from.x, to.x); ++i)
                if (air_.zones[air_.number({i, j, k})] != zone) return false;
    return true;
}

void AirDistance::startNear(Vec3d index, Vec3i voxel) {
    for (std::int32_t k = std::max(0, voxel.z - kStart); k <= std::min(air_.size.z - 1, voxel.z + kStart); ++k)
        for (std::int32_t j = std::max(0, voxel.y - kStart); j <= std::min(air_.size.y - 1, voxel.y + kStart); ++j)
            for (std::int32_t i = std::max(0, voxel.x - kStart); i <= std::min(air_.size.x - 1, voxel.x + kStart);
                 ++i) {
                if (!isInSight(voxel, {i, j, k})) continue;
                const double distance = length(scaled(toDouble(Vec3i{i, j, k}) - index, spacing_));
                const auto start = static_cast<std::uint32_t>(air_.number({i, j, k}));
                tryVoxel(start, static_cast<float>(distance));
                states_[start] = State::Start;
            }
}

bool AirDistance::isAccepted(std::uint32_t own, Vec3i place, int axis, std::int32_t by) const noexcept {
    const std::int32_t to = place[axis] + by;
    if (to < 0 || to >= air_.size[axis]) return false;
    const std::uint32_t stride = stride_[static_cast<std::size_t>(axis)];
    const std::uint32_t next = by < 0 ? own - stride : own + stride;
    return states_[next] == State::Accepted && RoomAir::passes(air_.zones[own], air_.zones[next]);
}

// The root of sum a (d - t)^2 = 1 over the axes, with one-sided differences of first or second order.
float AirDistance::solve(std::uint32_t voxel) const noexcept {
    std::array<Term, 3> terms;
    std::size_t count = 0;
    Vec3i place = air_.place(voxel);
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint32_t stride = stride_[static_cast<std::size_t>(axis)];
        const double h = spacing_[axis];
        Term best{std::numeric_limits<double>::infinity(), 0};
        float nearest = kFar;
        for (const std::int32_t by : {-1, 1}) {
            if (!isAccepted(voxel, place, axis, by)) continue;
            const std::uint32_t next = by < 0 ? voxel - stride : voxel + stride;
            const float first = distances_[next];
            if (!(first < nearest)) continue;
            nearest = first;
            best = {double{first}, 1 / (h * h)};
            Vec3i beyond = place;
            beyond[axis] += by;
            if (!isAccepted(next, beyond, axis, by)) continue;
            const float second = distances_[by < 0 ? next - stride : next + stride];
            if (second <= first) best = {(4 * double{first} - double{second}) / 3, 9 / (4 * h * h)};
        }
        if (best.a > 0) terms[count++] = best;
    }
    std::sort(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Term& a, const Term& b) { return a.t < b.t; });
    // An axis along which the front arrives later than the result does not count.
    double a = 0, b = 0, c = -1, result = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < count && terms[n].t < result; ++n) {
        a += terms[n].a;
        b += terms[n].a * terms[n].t;
        c += terms[n].a * terms[n].t * terms[n].t;
        result = (b + std::sqrt(std::max(0.0, b * b - a * c))) / a;
    }
    return static_cast<float>(result);
}

}  // namespace svt::simulate

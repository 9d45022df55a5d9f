#include <svt/drawing/field/region_grid.hpp>

#include <algorithm>
#include <cmath>

namespace svt::drawing {
namespace {

constexpr double kMostNodes = 2e6;  // of a region
constexpr int kAround = 3;          // nodes beyond each side

// Nodes of a lattice along one of its axes, in index space.
struct IndexNodes {
    double first = 0, step = 1;
    std::span<const double> positions;  // empty: regular
};

IndexNodes indexNodes(const fields::FieldHead& head, int axis) {
    if (head.kind != fields::FieldKind::Grid) return {};
    const auto& positions = head.lattice.positions[static_cast<std::size_t>(axis)];
    if (positions.size() > 1) return {0, 1, positions};
    if (head.lattice.size[axis] <= 1) return {};
    return {head.lattice.first[axis], head.lattice.step[axis], {}};
}

// Regular nodes through `origin`, from `low` to `high` and some more.
std::vector<double> regular(double origin, double step, double low, double high) {
    const double begin = std::floor((low - origin) / step) - kAround, end = std::ceil((high - origin) / step) + kAround;
    std::vector<double> nodes;
    for (auto n = static_cast<std::int64_t>(begin); n <= static_cast<std::int64_t>(end); ++n)
        nodes.push_back(origin + double(n) * step);
    return nodes;
}

// The given nodes, divided, and continued regularly at both ends.
std::vector<double> irregular(std::vector<double> given, int parts, double low, double high) {
    if (given.front() > given.back()) std::reverse(given.begin(), given.end());
    const double before = given[1] - given[0], after = given.back() - given[given.size() - 2];
    while (given.front() > low - kAround * before) given.insert(given.begin(), given.front() - before);
    while (given.back() < high + kAround * after) given.push_back(given.back() + after);
    std::vector<double> nodes;
    for (std::size_t n = 0; n + 1 < given.size(); ++n)
        for (int part = 0; part < parts; ++part) nodes.push_back(given[n] + (given[n + 1] - given[n]) * part / parts);
    nodes.push_back(given.back());
    const auto first = std::lower_bound(nodes.begin(), nodes.end(), low);
    const auto last = std::upper_bound(nodes.begin(), nodes.end(), high);
    return {first - std::min<std::ptrdiff_t>(kAround, first - nodes.begin()),
            last + std::min<std::ptrdiff_t>(kAround, nodes.end() - last)};
}

// The axis of the grid along which a direction runs; -1: none.
int axisAlong(const volume::Grid& grid, Vec3d direction) noexcept {
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(dot(grid.axes()[static_cast<std::size_t>(axis)], direction)) > 1 - 1e-12) return axis;
    return -1;
}

double smallestStep(const FieldSource& source) {
    double least = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
        const IndexNodes nodes = indexNodes(source.field.head, axis);
        double step = nodes.step;
        for (std::size_t n = 0; n + 1 < nodes.positions.size(); ++n)
            step = n == 0 ? nodes.positions[1] - nodes.positions[0]
                          : std::min(step, nodes.positions[n + 1] - nodes.positions[n]);
        least = std::min(least, step * source.volume.grid.spacing()[axis]);
    }
    return least;
}

std::vector<double> along(const FieldSource& source, Vec3d direction, double low, double high, double refine) {
    const volume::Grid& grid = source.volume.grid;
    const int axis = axisAlong(grid, direction);
    if (axis < 0) return regular(0, smallestStep(source) / refine, low, high);
    const double sign = dot(grid.axes()[static_cast<std::size_t>(axis)], direction) < 0 ? -1 : 1;
    const double metres = sign * grid.spacing()[axis];
    const double zero = dot(grid.origin() - source.axes.origin, direction);
    const IndexNodes nodes = indexNodes(source.field.head, axis);
    if (nodes.positions.empty())
        return regular(zero + metres * nodes.first, std::abs(metres) * nodes.step / refine, low, high);
    std::vector<double> given;
    for (const double position : nodes.positions) given.push_back(zero + metres * position);
    return irregular(std::move(given), std::max(1, static_cast<int>(std::ceil(refine))), low, high);
}

}  // namespace

NodeLines nodeLines(const FieldSource& source, PlanePoint low, PlanePoint high, double refine) {
    NodeLines lines;
    for (int trial = 0; trial < 12; ++trial, refine /= 2) {
        // Never makes much more than it keeps: a fine lattice over a large region is taken in larger steps.
        const double step = smallestStep(source) / refine;
        if ((high.u - low.u) / step * ((high.v - low.v) / step) > kMostNodes && refine > 1e-3) continue;
        break;
    }
    lines.us = along(source, source.axes.u, low.u, high.u, refine);
    lines.vs = along(source, source.axes.v, low.v, high.v, refine);
    return lines;
}

}  // namespace svt::drawing

#include <svt/volume/grid.hpp>

#include <fmt/format.h>

#include <cmath>

namespace svt::volume {
namespace {

constexpr char kAxisNames[] = "xyz";

Result<void> checkDimension(Vec3d dimension) {
    for (int axis = 0; axis < 3; ++axis) {
        const double count = dimension[axis];
        if (!(count >= 2 && count <= Grid::kMaxDimension))
            return Error(
                Code::BadDimension,
                fmt::format("dimension {} along {} is out of range; 2 to {} samples are possible; choose another "
                            "dimension or spacing",
                            count, kAxisNames[axis], Grid::kMaxDimension));
    }
    const double columns = dimension.x * dimension.y;
    constexpr double kMaxColumns = 2147483648.0;
    if (columns > kMaxColumns)
        return Error(Code::GridTooLarge,
                     fmt::format("{} x {} columns are over the limit of {}; choose a coarser spacing", dimension.x,
                                 dimension.y, kMaxColumns));
    return {};
}

}  // namespace

Result<Grid> Grid::fromDimension(const Box3d& envelope, Vec3i dimension) {
    if (envelope.isEmpty() || !isFinite(envelope.min) || !isFinite(envelope.max))
        return Error(Code::BadDimension, "the envelope is empty: there is no geometry to lay a grid over");
    const Vec3d count{double(dimension.x), double(dimension.y), double(dimension.z)};
    SVT_DO(checkDimension(count));
    Vec3d size = envelope.size();
    const double largest = std::max({size.x, size.y, size.z});
    const double smallest = std::max(largest * 1e-3, 1e-3);
    Grid grid;
    grid.dimension_ = dimension;
    grid.origin_ = envelope.min;
    for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] < smallest) {
            grid.origin_[axis] -= (smallest - size[axis]) / 2;
            size[axis] = smallest;
        }
        grid.spacing_[axis] = size[axis] / (dimension[axis] - 1);
    }
    return grid;
}

Result<Grid> Grid::fromSpacing(const Box3d& envelope, Vec3d spacing) {
    if (envelope.isEmpty() || !isFinite(envelope.min) || !isFinite(envelope.max))
        return Error(Code::BadDimension, "the envelope is empty: there is no geometry to lay a grid over");
    Vec3d count;
    const Vec3d size = envelope.size();
    for (int axis = 0; axis < 3; ++axis) {
        if (!(spacing[axis] > 0) || !std::isfinite(spacing[axis]))
            return Error(Code::BadDimension,
                         fmt::format("spacing {} m along {} is out of range; it must be greater than 0", spacing[axis],
                                     kAxisNames[axis]));
        // The tolerance avoids an extra step where rounding pushes a whole number of steps up. One step more is the
        // margin, half of it at each side.
        count[axis] = std::max(0.0, std::ceil(size[axis] / spacing[axis] - 1e-6)) + 2;
    }
    SVT_DO(checkDimension(count));
    Grid grid;
    for (int axis = 0; axis < 3; ++axis) {
        grid.dimension_[axis] = static_cast<std::int32_t>(count[axis]);
        grid.spacing_[axis] = spacing[axis];
        grid.origin_[axis] = envelope.min[axis] - ((count[axis] - 1) * spacing[axis] - size[axis]) / 2;
    }
    return grid;
}

Result<Grid> Grid::fromParts(Vec3i dimension, Vec3d spacing, Vec3d origin, const std::array<Vec3d, 3>& axes) {
    SVT_DO(checkDimension({double(dimension.x), double(dimension.y), double(dimension.z)}));
    for (int axis = 0; axis < 3; ++axis)
        if (!(spacing[axis] > 0) || !std::isfinite(spacing[axis]) || !std::isfinite(origin[axis]))
            return Error(Code::BadDimension, "spacing must be greater than 0 and origin finite");
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            if (!(std::abs(dot(axes[a], axes[b]) - (a == b ? 1.0 : 0.0)) < 1e-9))
                return Error(Code::BadDimension, "the axes of the grid are not a rotation");
    if (!(dot(cross(axes[0], axes[1]), axes[2]) > 0))
        return Error(Code::BadDimension, "the axes of the grid are mirrored, not a rotation");
    Grid grid;
    grid.dimension_ = dimension;
    grid.spacing_ = spacing;
    grid.origin_ = origin;
    grid.axes_ = axes;
    return grid;
}

std::uint64_t Grid::sampleCount() const noexcept {
    return std::uint64_t(dimension_.x) * std::uint64_t(dimension_.y) * std::uint64_t(dimension_.z);
}

bool Grid::isAxisParallel() const noexcept {
    return axes_[0] == Vec3d{1, 0, 0} && axes_[1] == Vec3d{0, 1, 0} && axes_[2] == Vec3d{0, 0, 1};
}

Vec3d Grid::worldFromIndexDirection(Vec3d index) const noexcept {
    return axes_[0] * (index.x * spacing_.x) + axes_[1] * (index.y * spacing_.y) + axes_[2] * (index.z * spacing_.z);
}

Vec3d Grid::worldFromIndex(Vec3d index) const noexcept { return origin_ + worldFromIndexDirection(index); }

Vec3d Grid::indexFromWorldDirection(Vec3d world) const noexcept {
    return {dot(world, axes_[0]) / spacing_.x, dot(world, axes_[1]) / spacing_.y, dot(world, axes_[2]) / spacing_.z};
}

Vec3d Grid::indexFromWorld(Vec3d world) const noexcept { return indexFromWorldDirection(world - origin_); }

Grid Grid::turned(const std::array<Vec3d, 3>& axes, Vec3d pivot) const {
    Grid grid = *this;
    grid.axes_ = axes;
    grid.origin_ = pivot + axes[0] * origin_.x + axes[1] * origin_.y + axes[2] * origin_.z;
    return grid;
}

}  // namespace svt::volume

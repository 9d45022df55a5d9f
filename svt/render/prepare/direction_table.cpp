#include <svt/render/prepare/direction_table.hpp>

#include <algorithm>
#include <cmath>

namespace svt::render {

DirectionTable::DirectionTable(const volume::BrickVolume& volume, const volume::Grid& grid) : grid_(grid) {
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d index{};
        index[axis] = 1;
        axes_[static_cast<std::size_t>(axis)] = directions(index);
    }
    planes_.reserve(volume.planes().size());
    for (const volume::BrickPlane& plane : volume.planes()) planes_.push_back(directions(plane.normal));
}

DirectionTable::Directions DirectionTable::directions(Vec3d index) const noexcept {
    Directions found;
    Vec3d normal{};
    for (int axis = 0; axis < 3; ++axis)
        normal = normal + grid_.axes()[static_cast<std::size_t>(axis)] * (index[axis] / grid_.spacing()[axis]);
    found.normal = normalized(normal);
    found.outwardIndex = outwardIndex(found.normal);
    return found;
}

Vec3d DirectionTable::outwardIndex(Vec3d normal) const noexcept {
    const Vec3d index = grid_.indexFromWorldDirection(normal);
    const double longest = std::max({std::abs(index.x), std::abs(index.y), std::abs(index.z)});
    return longest > 0 ? index / longest : index;
}

}  // namespace svt::render

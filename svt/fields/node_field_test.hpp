#pragma once
/// \file
/// Fields for tests: a node at each voxel, with a value by its place.

#include <svt/core/vec.hpp>
#include <svt/fields/field.hpp>

#include <functional>
#include <string>
#include <utility>

namespace svt::fields::test {

/// A field of temperatures in Cel at one time. Node (i, j, k) is the centre of voxel (i, j, k).
/// \param step     metres between nodes
/// \param valueAt  of a place in metres from node (0, 0, 0), along the axes of the grid; NaN: missing
inline Field nodeField(std::string name, std::string medium, Vec3i size, double step,
                       const std::function<double(Vec3d)>& valueAt) {
    Field field;
    field.head.name = std::move(name);
    field.head.unit = "Cel";
    field.head.medium = std::move(medium);
    field.head.lattice.size = size;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                field.values.push_back(static_cast<float>(valueAt({step * i, step * j, step * k})));
    return field;
}

}  // namespace svt::fields::test

#pragma once
/// \file
/// Numpy arrays on memory of the library, and points in numpy arrays for the library, both without copies.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <pybind11/numpy.h>

#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::python {

namespace py = pybind11;

/// An array that owns the memory of `values`.
template <class T>
[[nodiscard]] py::array_t<T> arrayOf(std::vector<T> values) {
    auto owned = std::make_unique<std::vector<T>>(std::move(values));
    const std::vector<T>& memory = *owned;
    const py::capsule owner(owned.release(), [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
    return py::array_t<T>(static_cast<py::ssize_t>(memory.size()), memory.data(), owner);
}

/// A read-only array on memory of `owner`.
template <class T>
[[nodiscard]] py::array_t<T> viewOf(std::vector<py::ssize_t> shape, const T* memory, const py::object& owner) {
    py::array_t<T> view(std::move(shape), memory, owner);
    view.attr("flags").attr("writeable") = false;
    return view;
}

/// Points: an array of any shape whose last axis is x, y, z. Other types than doubles are converted.
using PointArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

static_assert(sizeof(Vec3d) == 3 * sizeof(double));

/// The points of an array, without a copy. Throws ValueError if the last axis does not have three numbers.
[[nodiscard]] inline std::span<const Vec3d> pointsOf(const PointArray& array, std::string_view name) {
    if (array.ndim() == 0 || array.shape(array.ndim() - 1) != 3)
        throw py::value_error(std::string(name) + ": expected an array of points, whose last axis is x, y, z");
    return {reinterpret_cast<const Vec3d*>(array.data()), static_cast<std::size_t>(array.size() / 3)};
}

/// The shape of an array with one value per point.
[[nodiscard]] inline std::vector<py::ssize_t> shapeOfPoints(const PointArray& array) {
    return {array.shape(), array.shape() + array.ndim() - 1};
}

[[nodiscard]] inline py::tuple toPython(Vec3d v) { return py::make_tuple(v.x, v.y, v.z); }
[[nodiscard]] inline py::tuple toPython(Vec3i v) { return py::make_tuple(v.x, v.y, v.z); }

}  // namespace svt::python

// Numeric queries of a volume: dense arrays, labels at points, labels along rays, contacts.
#include "arrays.hpp"
#include "bindings.hpp"
#include "long_call.hpp"
#include "volume_object.hpp"

#include <svt/render/ray_labels.hpp>
#include <svt/volume/dense.hpp>
#include <svt/volume/point_samples.hpp>
#include <svt/volume/volume_part.hpp>

#include <pybind11/stl.h>

namespace svt::python {
namespace {

using volume::IndexBox;
using WorldBox = std::array<double, 6>;

IndexBox samplesIn(const volume::Grid& grid, const std::optional<WorldBox>& box) {
    if (!box) return {{0, 0, 0}, grid.dimension()};
    const WorldBox& b = *box;
    return valueOf(volume::samplesIn(grid, {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}}));
}

template <class T>
py::array denseOf(const volume::ColumnVolume& columns, const IndexBox& box) {
    const Vec3i size = box.end - box.begin;
    // Memory of numpy, which requests large pages.
    py::array_t<T> array({py::ssize_t(size.z), py::ssize_t(size.y), py::ssize_t(size.x)});
    const std::span<T> out(array.mutable_data(), static_cast<std::size_t>(array.size()));
    runLong(py::none(), [&](const Progress* progress) {
        // In slabs, so that Ctrl-C has an effect; large enough that each column is searched few times.
        constexpr std::int32_t kSlices = 256;
        const std::size_t slice = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
        for (std::int32_t k = 0; k < size.z && !Progress::isCancelled(progress); k += kSlices) {
            const std::int32_t end = std::min(k + kSlices, size.z);
            volume::copyBox<T>(columns,
                               {box.begin.y, box.end.y, box.begin.z + k, box.begin.z + end, box.begin.x, box.end.x},
                               out.subspan(slice * std::size_t(k), slice * std::size_t(end - k)));
        }
    });
    return array;
}

py::array denseOf(const SharedVolume& volume, const IndexBox& samples) {
    const volume::SemanticVolume& v = volume->volume();
    switch (v.labels.scalarBits()) {
        case 8: return denseOf<std::uint8_t>(v.columns, samples);
        case 16: return denseOf<std::uint16_t>(v.columns, samples);
        default: return denseOf<std::uint32_t>(v.columns, samples);
    }
}

py::array dense(const SharedVolume& volume, const std::optional<WorldBox>& box) {
    return denseOf(volume, samplesIn(volume->volume().grid, box));
}

/// The samples from `begin` up to `end` (exclusive), each (i, j, k).
py::array denseSlab(const SharedVolume& volume, const std::array<std::int32_t, 3>& begin,
                    const std::array<std::int32_t, 3>& end) {
    const Vec3i dimension = volume->volume().grid.dimension();
    const IndexBox samples{{begin[0], begin[1], begin[2]}, {end[0], end[1], end[2]}};
    for (int axis = 0; axis < 3; ++axis)
        if (samples.begin[axis] < 0 || samples.begin[axis] >= samples.end[axis] || samples.end[axis] > dimension[axis])
            throw py::index_error("no samples from " + std::to_string(samples.begin[axis]) + " up to " +
                                  std::to_string(samples.end[axis]) + "; the axis has " +
                                  std::to_string(dimension[axis]));
    return denseOf(volume, samples);
}

/// Up to this number of points or rays, the work ends before another thread has started.
constexpr std::size_t kFew = 10000;

py::array_t<volume::Scalar> sampleScalars(const SharedVolume& volume, const PointArray& points) {
    const std::span<const Vec3d> places = pointsOf(points, "points");
    py::array_t<volume::Scalar> scalars(shapeOfPoints(points));
    const std::span<volume::Scalar> out(scalars.mutable_data(), places.size());
    const auto& v = volume->volume();
    const py::gil_scoped_release released;
    volume::samplePoints(v.columns, v.grid, places, out, places.size() < kFew ? 1 : 0);
    return scalars;
}

/// Entry s: index of the label that owns scalar s, -1 for background.
py::array_t<std::int32_t> labelOfScalar(const SharedVolume& volume) {
    const std::vector<std::uint32_t> labels = volume->volume().labels.labelOfScalar();
    return arrayOf(std::vector<std::int32_t>(labels.begin(), labels.end()));
}

py::tuple rays(const SharedVolume& volume, const PointArray& origins, const PointArray& directions,
               const py::object& report) {
    const std::span<const Vec3d> from = pointsOf(origins, "origins"), along = pointsOf(directions, "directions");
    auto found = longCall(report, [&](const Progress* progress) -> Result<render::RayIntervals> {
        SVT_TRY(bricks, volume->bricks(progress));
        const auto& v = volume->volume();
        return render::labelsAlongRays(**bricks, v.grid, v.labels, from, along, 0, progress);
    });
    return py::make_tuple(arrayOf(std::move(found.start)), arrayOf(std::move(found.intervals)));
}

/// A row of the numpy array of contacts: b is -1 for background.
struct ContactRow {
    std::int32_t a, b;
    double area;
};

py::array_t<ContactRow> contacts(const SharedVolume& volume) {
    std::vector<ContactRow> rows;
    runLong(py::none(), [&](const Progress*) {
        for (const analyze::Contact& contact : volume->measures().contacts)
            rows.push_back({static_cast<std::int32_t>(contact.a), static_cast<std::int32_t>(contact.b), contact.area});
    });
    return arrayOf(std::move(rows));
}

}  // namespace

void bindSamples(py::module_& module) {
    using render::LabelInterval;
    PYBIND11_NUMPY_DTYPE(LabelInterval, label, enter, leave);
    PYBIND11_NUMPY_DTYPE(ContactRow, a, b, area);
    module.def("samples_in", [](const SharedVolume& volume, const WorldBox& box) {
        const IndexBox samples = samplesIn(volume->volume().grid, box);
        return py::make_tuple(toPython(samples.begin), toPython(samples.end));
    });
    module.def("dense", &dense, py::arg("volume"), py::arg("box"));
    module.def("dense_slab", &denseSlab, py::arg("volume"), py::arg("begin"), py::arg("end"));
    module.def("sample_scalars", &sampleScalars, py::arg("volume"), py::arg("points"));
    module.def("label_of_scalar", &labelOfScalar, py::arg("volume"));
    module.def("rays", &rays, py::arg("volume"), py::arg("origins"), py::arg("directions"), py::arg("progress"));
    module.def("contacts", &contacts, py::arg("volume"));
    module.def("world_from_index", [](const SharedVolume& volume, const PointArray& index) {
        const auto& grid = volume->volume().grid;
        PointArray world(std::vector<py::ssize_t>(index.shape(), index.shape() + index.ndim()));
        const auto in = pointsOf(index, "index");
        auto* out = reinterpret_cast<Vec3d*>(world.mutable_data());
        for (const Vec3d& i : in) *out++ = grid.worldFromIndex(i);
        return world;
    });
    module.def("index_from_world", [](const SharedVolume& volume, const PointArray& world) {
        const auto& grid = volume->volume().grid;
        PointArray index(std::vector<py::ssize_t>(world.shape(), world.shape() + world.ndim()));
        const auto in = pointsOf(world, "points");
        auto* out = reinterpret_cast<Vec3d*>(index.mutable_data());
        for (const Vec3d& w : in) *out++ = grid.indexFromWorld(w);
        return index;
    });
}

}  // namespace svt::python

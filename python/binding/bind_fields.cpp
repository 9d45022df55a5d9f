// Fields of a volume: numbers with a unit, over time, beside the labels.
#include "arrays.hpp"
#include "bindings.hpp"
#include "long_call.hpp"
#include "volume_object.hpp"

#include <svt/core/parallel.hpp>
#include <svt/fields/field_sampler.hpp>
#include <svt/fields/field_statistics.hpp>
#include <svt/fields/svt_fields.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <mutex>

namespace svt::python {
namespace {

using fields::Field;
using fields::FieldHead;
using fields::FieldKind;

/// A field and its volume. Safe to use from several threads.
class FieldObject {
public:
    FieldObject(Field made, SharedVolume beside) : field(std::move(made)), volume(std::move(beside)) {}

    /// Cost: FieldSampler::make() once. Call it without the GIL.
    [[nodiscard]] Result<const fields::FieldSampler*> sampler() {
        const std::lock_guard lock(making_);
        if (!sampler_) {
            SVT_TRY(made, fields::FieldSampler::make(field, volume->volume()));
            sampler_.emplace(std::move(*made));
        }
        return &*sampler_;
    }

    const Field field;
    const SharedVolume volume;

private:
    std::mutex making_;
    std::optional<fields::FieldSampler> sampler_;
};
using SharedField = std::shared_ptr<FieldObject>;

/// Lengths of the axes of values: times, components of a vector, then z, y, x of a grid or the places.
std::vector<py::ssize_t> shapeOf(const FieldHead& head, std::size_t labelCount) {
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(head.times.size())};
    if (head.components > 1) shape.push_back(head.components);
    if (head.kind == FieldKind::Grid)
        shape.insert(shape.end(), {head.lattice.size.z, head.lattice.size.y, head.lattice.size.x});
    else
        shape.push_back(static_cast<py::ssize_t>(fields::placeCount(head, labelCount)));
    return shape;
}

py::dict headOf(const FieldHead& head) {
    py::dict out;
    out["name"] = head.name;
    out["kind"] = nameOf(head.kind);
    out["quantity"] = head.quantity;
    out["unit"] = head.unit;
    out["components"] = head.components;
    out["medium"] = head.medium;
    out["times"] = py::array_t<double>(static_cast<py::ssize_t>(head.times.size()), head.times.data());
    out["epoch"] = head.epoch ? py::object(py::str(*head.epoch)) : py::object(py::none());
    out["precision"] = head.precision;
    out["by"] = head.by;
    out["parameters"] = head.parameters;
    out["size"] = toPython(head.lattice.size);
    out["first"] = toPython(head.lattice.first);
    out["step"] = toPython(head.lattice.step);
    out["positions"] = py::cast(head.lattice.positions);
    py::list ids, at;
    for (const fields::FieldPoint& point : head.points) {
        ids.append(point.id);
        at.append(toPython(point.at));
    }
    out["point_ids"] = ids;
    out["points"] = at;
    return out;
}

/// {name: {member: value}} of the fields of a `.svt`, with `range` and `bytes`.
py::dict listFields(const std::filesystem::path& path) {
    std::vector<fields::ListedField> listed;
    {
        const py::gil_scoped_release released;
        listed = valueOf(fields::listFields(path));
    }
    py::dict out;
    for (const fields::ListedField& one : listed) {
        py::dict head = headOf(one.stored.head);
        const auto& range = one.stored.range;
        head["range"] = range ? py::object(py::make_tuple(range->first, range->second)) : py::object(py::none());
        head["bytes"] = one.bytes;
        out[py::str(one.stored.head.name)] = head;
    }
    return out;
}

SharedField readField(const SharedVolume& volume, const std::filesystem::path& path, const std::string& name,
                      const py::object& report) {
    Field field = longCall(report, [&](const Progress*) -> Result<Field> { return fields::readField(path, name); });
    return std::make_shared<FieldObject>(std::move(field), volume);
}

py::array_t<float> valuesOf(const py::object& self) {
    const auto& object = *self.cast<SharedField>();
    const std::size_t labels = object.volume->volume().labels.labels.size();
    return viewOf(shapeOf(object.field.head, labels), object.field.values.data(), self);
}

/// Up to this number of points, the work ends before another thread has started.
constexpr std::size_t kFewPoints = 10000;

/// Values at world points: an array of their shape, with a last axis of components for vectors.
py::array_t<float> sampleField(const SharedField& object, const PointArray& points, double seconds) {
    const std::span<const Vec3d> places = pointsOf(points, "points");
    const auto components = static_cast<std::size_t>(object->field.head.components);
    std::vector<py::ssize_t> shape = shapeOfPoints(points);
    if (components > 1) shape.push_back(static_cast<py::ssize_t>(components));
    py::array_t<float> values(shape);
    float* const out = values.mutable_data();
    runLong(py::none(), [&](const Progress*) {
        const fields::FieldSampler& sampler = *valueOf(object->sampler());
        const volume::Grid& grid = object->volume->volume().grid;
        parallelFor(places.size(), kFewPoints, 0, [&](std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; n < end; ++n)
                for (std::size_t c = 0; c < components; ++c)
                    out[n * components + c] =
                        sampler.atSeconds(grid.indexFromWorld(places[n]), seconds, static_cast<std::int32_t>(c));
        });
    });
    return values;
}

struct StatisticsColumns {
    std::vector<std::int64_t> label;
    std::vector<double> time, mean, min, max, deviation, volume, missing;
    std::vector<double> shareOver, shareUnder, hoursOver, hoursUnder, hoursUnknown;

    void add(std::uint32_t row, double seconds, const fields::FieldFigures& figures) {
        const auto number = [](const std::optional<double>& value) { return value.value_or(std::nan("")); };
        label.push_back(row);
        time.push_back(seconds);
        mean.push_back(number(figures.mean));
        min.push_back(number(figures.min));
        max.push_back(number(figures.max));
        deviation.push_back(number(figures.deviation));
        volume.push_back(figures.volume);
        missing.push_back(figures.missing);
        shareOver.push_back(number(figures.shareOver));
        shareUnder.push_back(number(figures.shareUnder));
    }
};

/// {column: array}. \param isByTime  a row for each label and time; else one per label over all times, with hours
py::dict statisticsOf(const SharedField& object, const std::optional<std::string>& by, std::optional<double> over,
                      std::optional<double> under, bool isByTime, const py::object& report) {
    StatisticsColumns columns = longCall(report, [&](const Progress*) -> Result<StatisticsColumns> {
        const volume::SemanticVolume& volume = object->volume->volume();
        const Field& field = object->field;
        fields::StatisticsOptions options;
        options.over = over;
        options.under = under;
        if (field.head.components > 1) options.component = fields::StatisticsOptions::kMagnitude;
        SVT_TRY(rows, fields::statisticsRows(by.value_or(""), field.head, volume));
        SVT_TRY(sums, fields::sumField(field, volume, options));
        StatisticsColumns made;
        for (const fields::StatisticsRow& row : *rows) {
            for (std::size_t t = 0; t < sums->times.size() && isByTime; ++t)
                made.add(row.label, sums->times[t], fields::figuresAt(*sums, row.labels, t));
            if (isByTime) continue;
            made.add(row.label, std::nan(""), fields::figuresOverTimes(*sums, row.labels));
            const fields::HoursBeyond hours = fields::hoursBeyond(*sums, row.labels);
            made.hoursOver.push_back(hours.over.value_or(std::nan("")));
            made.hoursUnder.push_back(hours.under.value_or(std::nan("")));
            made.hoursUnknown.push_back(hours.unknown);
        }
        return made;
    });
    py::dict out;
    out["label"] = arrayOf(std::move(columns.label));
    if (isByTime) out["time"] = arrayOf(std::move(columns.time));
    out["mean"] = arrayOf(std::move(columns.mean));
    out["min"] = arrayOf(std::move(columns.min));
    out["max"] = arrayOf(std::move(columns.max));
    out["deviation"] = arrayOf(std::move(columns.deviation));
    out["volume"] = arrayOf(std::move(columns.volume));
    out["missing"] = arrayOf(std::move(columns.missing));
    if (over) out["share_over"] = arrayOf(std::move(columns.shareOver));
    if (under) out["share_under"] = arrayOf(std::move(columns.shareUnder));
    if (isByTime) return out;
    if (over) out["hours_over"] = arrayOf(std::move(columns.hoursOver));
    if (under) out["hours_under"] = arrayOf(std::move(columns.hoursUnder));
    if (over || under) out["hours_unknown"] = arrayOf(std::move(columns.hoursUnknown));
    return out;
}

template <class T>
T memberOf(const py::dict& head, const char* name) {
    return head[name].cast<T>();
}

Vec3d vectorOf(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

FieldHead headFrom(const py::dict& given) {
    FieldHead head;
    head.name = memberOf<std::string>(given, "name");
    const auto kind = memberOf<std::string>(given, "kind");
    if (!fromName<FieldKind>(kind)) throw py::value_error("kind: expected one of grid, label, points");
    head.kind = *fromName<FieldKind>(kind);
    head.quantity = memberOf<std::string>(given, "quantity");
    head.unit = memberOf<std::string>(given, "unit");
    head.components = memberOf<std::int32_t>(given, "components");
    head.medium = memberOf<std::string>(given, "medium");
    head.times = memberOf<std::vector<double>>(given, "times");
    head.epoch = memberOf<std::optional<std::string>>(given, "epoch");
    head.precision = memberOf<double>(given, "precision");
    head.by = memberOf<std::string>(given, "by");
    head.parameters = memberOf<std::string>(given, "parameters");
    const auto size = memberOf<std::array<std::int32_t, 3>>(given, "size");
    head.lattice.size = {size[0], size[1], size[2]};
    head.lattice.first = vectorOf(memberOf<std::array<double, 3>>(given, "first"));
    head.lattice.step = vectorOf(memberOf<std::array<double, 3>>(given, "step"));
    head.lattice.positions = memberOf<std::array<std::vector<double>, 3>>(given, "positions");
    const auto ids = memberOf<std::vector<std::string>>(given, "point_ids");
    const auto points = memberOf<std::vector<std::array<double, 3>>>(given, "points");
    for (std::size_t n = 0; n < ids.size(); ++n) head.points.push_back({ids[n], vectorOf(points[n])});
    return head;
}

using FloatArray = py::array_t<float, py::array::c_style | py::array::forcecast>;

std::uint64_t addField(const SharedVolume& volume, const std::filesystem::path& input,
                       const std::filesystem::path& output, const py::dict& given, const FloatArray& values,
                       const py::object& report) {
    Field field;
    field.head = headFrom(given);
    field.values.assign(values.data(), values.data() + values.size());
    return longCall(report, [&](const Progress*) -> Result<std::uint64_t> {
        SVT_DO(fields::mediumOf(field.head, volume->volume()));
        return fields::writeFields(input, output, std::span(&field, 1));
    });
}

std::uint64_t removeFields(const std::filesystem::path& input, const std::filesystem::path& output,
                           const std::vector<std::string>& names) {
    return longCall(py::none(), [&](const Progress*) -> Result<std::uint64_t> {
        return fields::writeFields(input, output, {}, names);
    });
}

}  // namespace

void bindFields(py::module_& module) {
    py::class_<FieldObject, SharedField>(module, "Field")
        .def_property_readonly("head", [](const FieldObject& object) { return headOf(object.field.head); })
        .def_property_readonly("values", &valuesOf);
    module.def("list_fields", &listFields, py::arg("path"));
    module.def("read_field", &readField, py::arg("volume"), py::arg("path"), py::arg("name"), py::arg("progress"));
    module.def("sample_field", &sampleField, py::arg("field"), py::arg("points"), py::arg("seconds"));
    module.def("field_statistics", &statisticsOf, py::arg("field"), py::arg("by"), py::arg("over"), py::arg("under"),
               py::arg("by_time"), py::arg("progress"));
    module.def("add_field", &addField, py::arg("volume"), py::arg("input"), py::arg("output"), py::arg("head"),
               py::arg("values"), py::arg("progress"));
    module.def("remove_fields", &removeFields, py::arg("input"), py::arg("output"), py::arg("names"));
}

}  // namespace svt::python

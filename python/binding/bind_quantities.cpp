// Quantities of objects, as lists by column.
#include "bindings.hpp"
#include "long_call.hpp"
#include "volume_object.hpp"

#include <svt/analyze/selection.hpp>
#include <svt/quantities/quantities.hpp>
#include <svt/quantities/touching_faces.hpp>

#include <pybind11/stl.h>

namespace svt::python {
namespace {

using quantities::ObjectQuantities;

struct MeasuredObjects {
    std::vector<ObjectQuantities> objects;
    std::vector<std::vector<quantities::TouchingArea>> touching;  // by object; empty: not asked for
};

MeasuredObjects measure(const volume::SemanticVolume& volume, const std::vector<std::uint32_t>& objects,
                        bool exterior) {
    MeasuredObjects measured;
    measured.objects = quantities::measureObjects(volume, objects);
    if (exterior) measured.touching = quantities::findTouchingAreas(volume, measured.objects);
    return measured;
}

struct FigureColumn {
    const char* name;
    std::optional<double> ObjectQuantities::*figure;
};
constexpr FigureColumn kFigureColumns[] = {{"net_volume", &ObjectQuantities::netVolume},
                                           {"gross_volume", &ObjectQuantities::grossVolume},
                                           {"side_area", &ObjectQuantities::sideArea},
                                           {"top_area", &ObjectQuantities::topArea},
                                           {"bottom_area", &ObjectQuantities::bottomArea},
                                           {"outer_area", &ObjectQuantities::outerArea},
                                           {"opening_area", &ObjectQuantities::openingArea},
                                           {"thickness", &ObjectQuantities::thickness},
                                           {"length", &ObjectQuantities::length},
                                           {"width", &ObjectQuantities::width},
                                           {"height", &ObjectQuantities::height},
                                           {"perimeter", &ObjectQuantities::perimeter},
                                           {"bound", &ObjectQuantities::bound},
                                           {"gross_bound", &ObjectQuantities::grossBound}};

// The areas that outside air touches, by orientation; None without a mesh.
void addExterior(const MeasuredObjects& measured, py::dict& columns) {
    for (std::size_t way = 0; way < quantities::kFacingNames.size(); ++way) {
        py::list column;
        for (std::size_t n = 0; n < measured.objects.size(); ++n) {
            double area = 0;
            for (const quantities::TouchingArea& touching : measured.touching[n])
                if (touching.isOutside && std::size_t(touching.facing) == way) area += touching.area;
            column.append(measured.objects[n].outerArea ? py::object(py::float_(area)) : py::none());
        }
        columns[py::str("exterior_" + std::string(quantities::kFacingNames[way]))] = column;
    }
}

/// {column: [value of each object]}; None is unknown.
py::dict quantitiesOf(const SharedVolume& shared, const std::optional<std::string>& query, bool exterior,
                      const py::object& report) {
    const MeasuredObjects measured = longCall(report, [&](const Progress*) -> Result<MeasuredObjects> {
        const volume::SemanticVolume& volume = shared->volume();
        if (!query) return measure(volume, quantities::defaultObjects(volume), exterior);
        std::vector<std::string> nothing;
        const analyze::LabelRows rows(volume, &nothing);
        SVT_TRY(selected, analyze::selectLabels(rows, *query));
        return measure(volume, quantities::objectsOf(volume, *selected), exterior);
    });
    py::dict columns;
    py::list labels, openings, trust;
    for (const ObjectQuantities& object : measured.objects) {
        labels.append(object.label);
        openings.append(object.openings ? py::object(py::int_(*object.openings)) : py::none());
        const std::string_view name = nameOf(object.trust);
        trust.append(name.empty() ? py::object(py::none()) : py::str(name.data(), name.size()));
    }
    columns["label"] = labels;
    for (const FigureColumn& column : kFigureColumns) {
        py::list values;
        for (const ObjectQuantities& object : measured.objects) {
            const std::optional<double>& value = object.*column.figure;
            values.append(value ? py::object(py::float_(*value)) : py::none());
        }
        columns[column.name] = values;
    }
    columns["openings"] = openings;
    columns["trust"] = trust;
    if (exterior) addExterior(measured, columns);
    return columns;
}

}  // namespace

void bindQuantities(py::module_& module) {
    module.def("quantities", &quantitiesOf, py::arg("volume"), py::arg("query"), py::arg("exterior"),
               py::arg("progress"));
}

}  // namespace svt::python

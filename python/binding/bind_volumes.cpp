// Volumes: properties, labels, files, parts.
#include "arrays.hpp"
#include "bindings.hpp"
#include "keywords.hpp"
#include "long_call.hpp"
#include "volume_object.hpp"

#include <svt/crs/projection.hpp>
#include <svt/frontend/volume_json.hpp>
#include <svt/frontend/volume_part.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/volume_readers/label_array.hpp>
#include <svt/volume_readers/read_label_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace svt::python {
namespace {

using Path = std::filesystem::path;
using volume::kNoLabel;

/// A label of a volume: index and the volume that has it.
struct LabelReference {
    SharedVolume volume;
    std::uint32_t index;
    [[nodiscard]] const volume::Label& get() const { return volume->label(index); }
    [[nodiscard]] LabelReference other(std::uint32_t label) const { return {volume, label}; }
};

std::vector<std::string> namesOf(const VolumeObject& volume, std::string volume::Label::*member) {
    std::vector<std::string> names;
    for (const volume::Label& label : volume.volume().labels.labels) names.push_back(label.*member);
    return names;
}

const VolumeObject::Measures& measuresOf(const SharedVolume& volume) {
    const VolumeObject::Measures* measures = nullptr;
    runLong(py::none(), [&](const Progress*) { measures = &volume->measures(); });
    return *measures;
}

py::object boxOf(const LabelReference& label) {
    const Box3d box = measuresOf(label.volume).labels[label.index].box;
    if (box.isEmpty()) return py::none();
    py::array_t<double> array({2, 3});
    for (int axis = 0; axis < 3; ++axis) {
        array.mutable_at(0, axis) = box.min[axis];
        array.mutable_at(1, axis) = box.max[axis];
    }
    return array;
}

SharedVolume openVolume(const Path& path, const Path& labels, const py::object& report) {
    Diagnostics findings;
    auto read = longCall(report, [&](const Progress* progress) -> Result<volume::SemanticVolume> {
        if (!volume::isSvtFile(path) && volume_readers::looksLikeLabelVolume(path))
            return volume_readers::readLabelVolume(path, {labels, 0, progress, &findings});
        if (!labels.empty())
            return Error(Code::BadArgument,
                         "labels names the values of a label volume, but this file is not one; leave it out",
                         Place{path.string(), 0, 0, {}});
        return volume::readSvt(path);
    });
    return std::make_shared<VolumeObject>(std::move(read), std::move(findings),
                                          volume::isSvtFile(path) ? std::filesystem::absolute(path) : Path());
}

volume::Grid gridOf(Vec3i dimension, const std::array<double, 3>& spacing, const std::array<double, 3>& origin,
                    const std::array<std::array<double, 3>, 3>& axes) {
    const auto vector = [](const std::array<double, 3>& v) { return Vec3d{v[0], v[1], v[2]}; };
    return valueOf(volume::Grid::fromParts(dimension, vector(spacing), vector(origin),
                                           {vector(axes[0]), vector(axes[1]), vector(axes[2])}));
}

SharedVolume volumeOfArray(const py::array& samples, const std::array<double, 3>& spacing,
                           const std::array<double, 3>& origin, const std::array<std::array<double, 3>, 3>& axes,
                           const std::string& labels, const std::string& crs, const std::string& source,
                           const py::object& report) {
    if (samples.ndim() != 3 || (samples.flags() & py::array::c_style) == 0)
        throw py::value_error("expected a C-ordered array of three axes");
    Vec3i dimension;
    for (int axis = 0; axis < 3; ++axis) {
        const py::ssize_t size = samples.shape(2 - axis);
        if (size < 2 || size > volume::Grid::kMaxDimension)
            throw Failure(
                Error(Code::BadDimension, "an axis of " + std::to_string(size) + " samples; 2 to 65535 are possible"));
        dimension[axis] = static_cast<std::int32_t>(size);
    }
    volume_readers::LabelArray array;
    array.grid = gridOf(dimension, spacing, origin, axes);
    array.samples = {static_cast<const std::byte*>(samples.data()), static_cast<std::size_t>(samples.nbytes())};
    array.bits = static_cast<int>(samples.itemsize() * 8);
    array.isSigned = samples.dtype().kind() == 'i';
    array.crsName = crs;
    array.source = source;
    auto made = longCall(
        report, [&](const Progress* progress) { return volume_readers::volumeFromArray(array, labels, 0, progress); });
    return std::make_shared<VolumeObject>(std::move(made));
}

/// The options of `svt convert` for the part and the format of the output.
struct SaveOptions {
    frontend::VolumePart part;
    writers::VolumeWriteOptions write;
};

record::Members<SaveOptions> membersOf(const SaveOptions*) noexcept {
    static constexpr record::Member<SaveOptions> kMembers[] = {frontend::part<&SaveOptions::part>("part"),
                                                               frontend::part<&SaveOptions::write>("write")};
    return kMembers;
}

std::uint64_t save(const SharedVolume& volume, const Path& path, const py::dict& given, const py::object& report) {
    auto options = fromKeywords<SaveOptions>(given);
    return longCall(report, [&](const Progress* progress) -> Result<std::uint64_t> {
        std::optional<volume::SemanticVolume> part;
        if (options.part.isPart()) {
            SVT_TRY(made, options.part.of(volume->volume(), 0));
            part = std::move(*made);
        }
        const volume::SemanticVolume& written = part ? *part : volume->volume();
        if (path.extension() == ".svt") return volume::writeSvt(written, path);
        options.write.progress = progress;
        return writers::writeVolume(written, path, options.write);
    });
}

std::vector<std::uint32_t> query(const SharedVolume& volume, const std::string& text) {
    std::vector<std::string> nothing;
    const analyze::LabelRows rows(volume->volume(), &nothing);
    return valueOf(analyze::selectLabels(rows, text));
}

/// The same part as `svt convert` with --box, --select and --level.
SharedVolume partOf(const SharedVolume& whole, const std::optional<std::array<double, 6>>& box,
                    const std::optional<std::string>& select, int level, const py::object& report) {
    frontend::VolumePart part;
    part.level = level;
    if (box) part.box.assign(box->begin(), box->end());
    if (select) part.select = *select;
    auto made = longCall(report, [&](const Progress*) { return part.of(whole->volume(), 0); });
    return std::make_shared<VolumeObject>(std::move(made));
}

const analyze::FeatureMeasure& measureOf(const LabelReference& label) {
    return measuresOf(label.volume).features[label.index];
}

const analyze::KnownVolume& bestVolumeOf(const LabelReference& label) {
    return measuresOf(label.volume).volumes[label.index];
}

py::object known(const std::optional<double>& value) { return value ? py::object(py::float_(*value)) : py::none(); }

/// Measures of a label with its parts, as the columns of `svt query`.
void bindTotals(py::class_<LabelReference>& label) {
    label
        .def_property_readonly(
            "own_volume", [](const LabelReference& l) { return known(measureOf(l).own.volume); },
            "Volume in m3 without its parts: of its closed mesh, or of its voxels; None for surfaces.")
        .def_property_readonly(
            "total_volume", [](const LabelReference& l) { return known(measureOf(l).total.volume); },
            "Volume in m3 with its parts, each counted once; None if no part has a volume.")
        .def_property_readonly(
            "total_voxels", [](const LabelReference& l) { return measureOf(l).total.voxels; },
            "Number of voxels of the label and its parts: a flat with its rooms.")
        .def_property_readonly(
            "total_area", [](const LabelReference& l) { return measureOf(l).total.area; },
            "Surface of the label with its parts in m2; contacts between parts are inside.")
        .def_property_readonly(
            "faces",
            [](const LabelReference& l) {
                const auto& areas = measuresOf(l.volume).faces[l.index];
                py::dict faces;
                for (std::size_t kind = 0; kind < areas.size(); ++kind)
                    faces[py::str(std::string(analyze::kFaceKindNames[kind]))] = known(areas[kind]);
                return faces;
            },
            "m2 of the model's faces of the label and its parts, by kind: roof, wall, ground, window, door. None: the "
            "label lacks faces of the kind, or this volume keeps no mesh of them.")
        .def_property_readonly(
            "parts",
            [](const LabelReference& l) {
                std::vector<LabelReference> parts;
                for (const std::uint32_t p : analyze::Extents(l.volume->volume().labels).of(l.index))
                    parts.push_back(l.other(p));
                return parts;
            },
            "The labels that together are the feature: itself, its children and members, with their parts.");
}

void bindLabelMeasures(py::class_<LabelReference>& label) {
    label
        .def_property_readonly(
            "voxels", [](const LabelReference& l) { return l.get().voxels; }, "Number of its voxels.")
        .def_property_readonly(
            "volume", [](const LabelReference& l) { return known(bestVolumeOf(l).volume); },
            "Best known volume in m3 with its parts, as `svt query` compares it; None if unknown, as for surfaces.")
        .def_property_readonly(
            "volume_bound",
            [](const LabelReference& l) {
                return bestVolumeOf(l).volume ? known(bestVolumeOf(l).bound) : py::object(py::none());
            },
            "m3 by which `volume` may be off: 0 from closed meshes; None if unknown.")
        .def_property_readonly(
            "volume_source",
            [](const LabelReference& l) { return std::string(analyze::volumeSourceName(bestVolumeOf(l).source)); },
            "'meshes', 'voxels', 'meshes and voxels', or '' if the volume is unknown.")
        .def_property_readonly(
            "voxel_volume",
            [](const LabelReference& l) { return double(l.get().voxels) * l.volume->volume().grid.voxelVolume(); },
            "Volume of its voxels, m3.")
        .def_property_readonly(
            "area", [](const LabelReference& l) { return measuresOf(l.volume).labels[l.index].area; },
            "Surface of its voxels in m2. The first access in a volume measures all labels.")
        .def_property_readonly(
            "outside_area", [](const LabelReference& l) { return measuresOf(l.volume).labels[l.index].outsideArea; },
            "The part of `area` that touches background, m2.")
        .def_property_readonly("box", &boxOf,
                               "Box of its mesh, or of its voxels without one: array (2, 3) of the lower and upper "
                               "corner, world space, metres; "
                               "None without voxels.");
}

void bindLabels(py::module_& module) {
    py::class_<LabelReference> label(module, "Label", "A component of a volume, with one or more scalars.");
    label
        .def_property_readonly(
            "index", [](const LabelReference& l) { return l.index; }, "Number in Volume.labels.")
        .def_property_readonly(
            "id", [](const LabelReference& l) { return textOf(l.get().id); }, "Id in the model.")
        .def_property_readonly(
            "class_name", [](const LabelReference& l) { return textOf(l.get().className); },
            "Class by its name in CityGML 3.0, such as 'BuildingRoom'.")
        .def_property_readonly(
            "name", [](const LabelReference& l) { return textOf(l.get().name); }, "Name, or ''.")
        .def_property_readonly(
            "attributes", [](const LabelReference& l) { return attributesOf(l.get().attributes); },
            "Attributes by name: str, int, float or bool; a list if there are several values. In it, None is a record "
            "without a value, a list one with several.")
        .def_property_readonly(
            "parent",
            [](const LabelReference& l) -> py::object {
                return l.get().parent == kNoLabel ? py::object(py::none()) : py::cast(l.other(l.get().parent));
            },
            "The label above it in the tree, or None.")
        .def_property_readonly(
            "children",
            [](const LabelReference& l) {
                std::vector<LabelReference> children;
                for (std::uint32_t c = l.index + 1; c < l.get().subtreeEnd; c = l.volume->label(c).subtreeEnd)
                    children.push_back(l.other(c));
                return children;
            },
            "The labels directly below it in the tree.")
        .def_property_readonly(
            "groups",
            [](const LabelReference& l) {
                std::vector<LabelReference> groups;
                for (const std::uint32_t g : l.get().groups) groups.push_back(l.other(g));
                return groups;
            },
            "Groups, storeys and units that have it as a member.")
        .def_property_readonly(
            "scalars",
            [](const LabelReference& l) {
                return py::module_::import("builtins").attr("range")(l.get().first, l.get().first + l.get().count);
            },
            "The values of its samples in Volume.dense(), a range; empty without voxels.")
        .def_property_readonly(
            "filling", [](const LabelReference& l) { return std::string(fillingName(l.get().filling)); },
            "Method by which it got its voxels: 'solid', 'surface', 'body', ...")
        .def_property_readonly(
            "color", [](const LabelReference& l) { return toPython(toDouble(l.get().color)); },
            "Colour: red, green, blue as sRGB, 0 to 1.")
        .def_property_readonly(
            "opacity", [](const LabelReference& l) { return double(l.get().opacity); },
            "Share of light that one metre of it stops, 0 to 1; 1: opaque.")
        .def("__eq__", [](const LabelReference& a,
                          const LabelReference& b) { return a.volume == b.volume && a.index == b.index; })
        .def("__eq__", [](const LabelReference&, const py::object&) { return false; })
        .def("__hash__",
             [](const LabelReference& l) { return py::hash(py::make_tuple(std::uintptr_t(l.volume.get()), l.index)); })
        .def("__repr__", [](const LabelReference& l) {
            return textOf("<svt.Label " + std::to_string(l.index) + " " + l.get().className + " '" +
                          (l.get().name.empty() ? l.get().id : l.get().name) + "'>");
        });
    bindLabelMeasures(label);
    bindTotals(label);
}

}  // namespace

void bindVolumes(py::module_& module) {
    bindLabels(module);
    const auto grid = [](const SharedVolume& v) -> const volume::Grid& { return v->volume().grid; };
    py::class_<VolumeObject, SharedVolume>(module, "Volume")
        .def_property_readonly("dimension", [=](const SharedVolume& v) { return toPython(grid(v).dimension()); })
        .def_property_readonly("spacing", [=](const SharedVolume& v) { return toPython(grid(v).spacing()); })
        .def_property_readonly("origin", [=](const SharedVolume& v) { return toPython(grid(v).origin()); })
        .def_property_readonly("axes",
                               [=](const SharedVolume& v) {
                                   const auto& axes = grid(v).axes();
                                   return py::make_tuple(toPython(axes[0]), toPython(axes[1]), toPython(axes[2]));
                               })
        .def_property_readonly("crs", [](const SharedVolume& v) { return textOf(v->volume().crsName); })
        .def_property_readonly("name", [](const SharedVolume& v) { return textOf(v->volume().modelName); })
        .def_property_readonly("source", [](const SharedVolume& v) { return textOf(v->volume().source); })
        .def_property_readonly(
            "path", [](const SharedVolume& v) { return v->path().empty() ? std::nullopt : std::optional(v->path()); })
        .def_property_readonly("findings", [](const SharedVolume& v) { return toPython(v->findings()); })
        .def_property_readonly("scalar_bits", [](const SharedVolume& v) { return v->volume().labels.scalarBits(); })
        .def_property_readonly("scalar_count", [](const SharedVolume& v) { return v->volume().labels.scalarCount(); })
        .def_property_readonly("size_bytes", [](const SharedVolume& v) { return v->volume().columns.sizeBytes(); })
        .def_property_readonly("label_count", [](const SharedVolume& v) { return v->volume().labels.labels.size(); })
        .def_property_readonly("ids", [](const SharedVolume& v) { return namesOf(*v, &volume::Label::id); })
        .def_property_readonly("names", [](const SharedVolume& v) { return namesOf(*v, &volume::Label::name); })
        .def("label",
             [](const SharedVolume& v, std::size_t index) {
                 if (index >= v->volume().labels.labels.size())
                     throw py::index_error("no label " + std::to_string(index));
                 return LabelReference{v, static_cast<std::uint32_t>(index)};
             })
        .def("label_json", [](const SharedVolume& v) { return volume::writeLabelsJson(v->volume().labels); })
        .def("info_json",
             [](const SharedVolume& v) {
                 return frontend::infoJson(v->volume()).dump(-1, ' ', false, record::Json::error_handler_t::replace);
             })
        .def("query", &query, py::arg("text"))
        .def("part", &partOf, py::arg("box"), py::arg("select"), py::arg("level"), py::arg("progress"))
        .def("save", &save, py::arg("path"), py::arg("options"), py::arg("progress"));
    module.def("crs_wkt", &crs::wktOf, py::arg("epsg"), py::arg("vertical"));
    module.def("crs_projjson", &crs::projJsonOf, py::arg("epsg"), py::arg("vertical"));
    module.def("save_keywords", [] { return describeKeywords(frontend::optionsOf<SaveOptions>()); });
    module.def("open", &openVolume, py::arg("path"), py::arg("labels"), py::arg("progress"));
    module.def("from_array", &volumeOfArray, py::arg("samples"), py::arg("spacing"), py::arg("origin"), py::arg("axes"),
               py::arg("labels"), py::arg("crs"), py::arg("source"), py::arg("progress"));
}

}  // namespace svt::python

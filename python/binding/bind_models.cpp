// Models: reading, and building volumes from them.
#include "bindings.hpp"
#include "keywords.hpp"
#include "long_call.hpp"
#include "volume_object.hpp"

#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/model_joiner.hpp>
#include <svt/samples/sample.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace svt::python {
namespace {

using Paths = std::vector<std::filesystem::path>;

/// A feature of a model: index and the model that has it.
struct FeatureReference {
    std::shared_ptr<ModelObject> model;
    std::uint32_t index;
    [[nodiscard]] const model::Feature& get() const { return model->model.features[index]; }
};

std::shared_ptr<ModelObject> readModel(const Paths& paths, const py::dict& given, const py::object& report) {
    auto read = std::make_shared<ModelObject>();
    auto options = fromKeywords<readers::ReadOptions>(given);
    read->model = longCall(report, [&](const Progress* progress) {
        options.progress = progress;
        return readers::readModels(paths, options, &read->findings);
    });
    return read;
}

/// The options of `svt build` for converting a model to a volume, from keywords.
pipeline::BuildOptions buildOptions(const py::dict& given, const std::vector<std::string>& vectors,
                                    const SharedVolume& gridOf) {
    auto options = fromKeywords<pipeline::BuildOptions>(given);
    // Like the command: meshes are kept if possible, unless `vectors` is given.
    if (vectors.empty()) options.vectors = {.meshes = true, .isRequired = false};
    for (const std::string& kind : vectors) {
        if (kind != "edges" && kind != "meshes" && kind != "none")
            throw Failure(
                Error(Code::BadArgument, "vectors: '" + kind + "' is unknown; expected 'edges', 'meshes' or 'none'"));
        options.vectors.edges = options.vectors.edges || kind == "edges";
        options.vectors.meshes = options.vectors.meshes || kind == "meshes";
    }
    if (gridOf != nullptr) {
        if (options.dimension || options.spacing)
            throw Failure(
                Error(Code::BadArgument, "grid_of excludes dimension and spacing; the other volume has them already"));
        options.grid = gridOf->volume().grid;
    }
    return options;
}

SharedVolume buildFiles(const Paths& paths, const py::dict& given, const std::vector<std::string>& vectors,
                        const SharedVolume& gridOf, const py::object& report) {
    pipeline::BuildOptions options = buildOptions(given, vectors, gridOf);
    Diagnostics findings;
    auto built = longCall(report, [&](const Progress* progress) {
        options.progress = progress;
        return pipeline::buildVolume(paths, options, &findings);
    });
    return std::make_shared<VolumeObject>(std::move(built.volume), std::move(findings));
}

SharedVolume buildModel(const std::shared_ptr<ModelObject>& read, const py::dict& given,
                        const std::vector<std::string>& vectors, const SharedVolume& gridOf, const py::object& report) {
    pipeline::BuildOptions options = buildOptions(given, vectors, gridOf);
    Diagnostics findings = read->findings;
    auto built = longCall(report, [&](const Progress* progress) {
        options.progress = progress;
        // buildVolume() adds features for caps; the model of the caller does not change.
        model::BuildingModel copy = read->model;
        return pipeline::buildVolume(copy, options, &findings);
    });
    return std::make_shared<VolumeObject>(std::move(built.volume), std::move(findings));
}

std::string writeSample(const std::string& kind, std::uint64_t seed) {
    samples::SampleOptions options;
    options.seed = seed;
    if (const auto known = fromName<samples::SampleKind>(kind))
        return valueOf(samples::writeSample(*known, samples::SampleFormat::CityGml3, options));
    throw Failure(Error(Code::BadArgument, "sample '" + kind + "': possible are house, tower and district"));
}

void bindFeatures(py::module_& module) {
    py::class_<FeatureReference>(module, "Feature", "A feature of a model: building, storey, room, wall, window, ...")
        .def_property_readonly(
            "index", [](const FeatureReference& f) { return f.index; }, "Number in Model.features.")
        .def_property_readonly(
            "id", [](const FeatureReference& f) { return textOf(f.get().id); }, "Id in the file; unique in the model.")
        .def_property_readonly(
            "class_name", [](const FeatureReference& f) { return textOf(f.get().className); },
            "Class by its name in CityGML 3.0, such as 'BuildingRoom'.")
        .def_property_readonly(
            "name", [](const FeatureReference& f) { return textOf(f.get().name); }, "Name, or ''.")
        .def_property_readonly(
            "attributes", [](const FeatureReference& f) { return attributesOf(f.get().attributes); },
            "Attributes by name: str, int, float or bool; a list if there are several values. In it, None is a record "
            "without a value, a list one with several.")
        .def_property_readonly(
            "parent",
            [](const FeatureReference& f) -> py::object {
                if (f.get().parent == model::kNoFeature) return py::none();
                return py::cast(FeatureReference{f.model, f.get().parent});
            },
            "The feature above it in the tree, or None.")
        .def_property_readonly(
            "children",
            [](const FeatureReference& f) {
                std::vector<FeatureReference> children;
                for (const std::uint32_t c : f.get().children) children.push_back({f.model, c});
                return children;
            },
            "The features below it, in the order of the file.")
        .def("__repr__", [](const FeatureReference& f) {
            return textOf("<svt.Feature " + f.get().className + " '" +
                          (f.get().name.empty() ? f.get().id : f.get().name) + "'>");
        });
}

}  // namespace

void bindModels(py::module_& module) {
    bindFeatures(module);
    py::class_<ModelObject, std::shared_ptr<ModelObject>>(module, "Model")
        .def_property_readonly("name", [](const ModelObject& m) { return textOf(m.model.name); })
        .def_property_readonly("format", [](const ModelObject& m) { return textOf(m.model.format); })
        .def_property_readonly("source", [](const ModelObject& m) { return textOf(m.model.source); })
        .def_property_readonly("crs", [](const ModelObject& m) { return textOf(m.model.crs.name); })
        .def_property_readonly("findings", [](const ModelObject& m) { return toPython(m.findings); })
        .def_property_readonly("feature_count", [](const ModelObject& m) { return m.model.features.size(); })
        .def("feature", [](const std::shared_ptr<ModelObject>& m, std::size_t index) {
            if (index >= m->model.features.size()) throw py::index_error("no feature " + std::to_string(index));
            return FeatureReference{m, static_cast<std::uint32_t>(index)};
        });
    module.def("read", &readModel, py::arg("paths"), py::arg("options"), py::arg("progress"));
    module.def("build_files", &buildFiles, py::arg("paths"), py::arg("options"), py::arg("vectors"), py::arg("grid_of"),
               py::arg("progress"));
    module.def("build_model", &buildModel, py::arg("model"), py::arg("options"), py::arg("vectors"), py::arg("grid_of"),
               py::arg("progress"));
    module.def("build_keywords", [] { return describeKeywords(frontend::optionsOf<pipeline::BuildOptions>()); });
    module.def("sample", &writeSample, py::arg("kind"), py::arg("seed"));
}

}  // namespace svt::python

// The extension module svt._native. What users see stands in python/svt, with docstrings.
#include "bindings.hpp"

PYBIND11_MODULE(_native, module) {
    module.doc() = "What python/svt is made of: calls of the library. Not for use by others.";
    module.attr("version") = SVT_VERSION;
    svt::python::registerFailures();
    svt::python::bindModels(module);
    svt::python::bindVolumes(module);
    svt::python::bindSamples(module);
    svt::python::bindSections(module);
    svt::python::bindPictures(module);
}

// The extension module svt._native. The interface for users is in python/svt, with docstrings.
#include "bindings.hpp"

PYBIND11_MODULE(_native, module) {
    module.doc() = "Internal functions of the library for the package svt. Import svt instead.";
    module.attr("version") = SVT_VERSION;
    svt::python::registerFailures();
    svt::python::bindModels(module);
    svt::python::bindVolumes(module);
    svt::python::bindSamples(module);
    svt::python::bindSections(module);
    svt::python::bindFields(module);
    svt::python::bindQuantities(module);
    svt::python::bindPictures(module);
}

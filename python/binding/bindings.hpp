#pragma once
/// \file
/// What each source adds to the module svt._native. The classes and calls of users stand in python/svt.

#include "failure.hpp"

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>

namespace svt::python {

/// A model that was read, and what was found in it.
struct ModelObject {
    model::BuildingModel model;
    Diagnostics findings;
};

void bindModels(py::module_& module);    ///< reading and building
void bindVolumes(py::module_& module);   ///< volumes and labels, files
void bindSamples(py::module_& module);   ///< dense arrays, points, rays, contacts
void bindSections(py::module_& module);  ///< section drawings
void bindPictures(py::module_& module);  ///< frames, PNG

}  // namespace svt::python

#pragma once
/// \file
/// The functions by which each source extends the module svt._native. The classes and functions for users are in
/// python/svt.

#include "failure.hpp"

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>

namespace svt::python {

/// A model with the findings of reading it.
struct ModelObject {
    model::BuildingModel model;
    Diagnostics findings;
};

void bindModels(py::module_& module);      ///< reading and building
void bindVolumes(py::module_& module);     ///< volumes and labels, files
void bindSamples(py::module_& module);     ///< dense arrays, points, rays, contacts
void bindSections(py::module_& module);    ///< section drawings
void bindFields(py::module_& module);      ///< fields of a volume
void bindQuantities(py::module_& module);  ///< quantities of objects
void bindPictures(py::module_& module);    ///< frames, PNG

}  // namespace svt::python

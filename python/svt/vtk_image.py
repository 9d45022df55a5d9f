"""Volumes as images of VTK and PyVista."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .optional import load

if TYPE_CHECKING:
    from .volume import Volume


def _texts(name: str, texts: list[str]) -> Any:
    array = load("vtkmodules.vtkCommonCore", "to_vtk()").vtkStringArray()
    array.SetName(name)
    for text in texts:
        array.InsertNextValue(text)
    return array


def image_of(volume: Volume) -> Any:
    """The volume as vtkImageData, with the cells, the field data and the names of the file that `save("v.vti")` writes:
    cell array `label` with the values of :meth:`svt.Volume.dense`."""
    model = load("vtkmodules.vtkCommonDataModel", "to_vtk()")
    to_vtk = load("vtkmodules.util.numpy_support", "to_vtk()").numpy_to_vtk
    image = model.vtkImageData()
    image.SetDimensions(*(size + 1 for size in volume.dimension))
    image.SetSpacing(*volume.spacing)
    image.SetOrigin(*volume.world((-0.5, -0.5, -0.5)))
    image.SetDirectionMatrix(np.array(volume.axes).T.ravel().tolist())
    cells = to_vtk(volume.dense().reshape(-1), deep=True)
    cells.SetName("label")
    image.GetCellData().SetScalars(cells)
    labels = list(volume.labels)
    fields = image.GetFieldData()
    fields.AddArray(_texts("label_id", [label.id for label in labels]))
    fields.AddArray(_texts("label_class", [label.class_name for label in labels]))
    fields.AddArray(_texts("label_name", [label.name for label in labels]))
    numbers = {
        "label_first": np.array([label.scalars.start for label in labels], np.uint32),
        "label_count": np.array([len(label.scalars) for label in labels], np.uint32),
        "label_parent": np.array([-1 if label.parent is None else label.parent.index for label in labels], np.int64),
        "label_color": np.array([label.color for label in labels], np.float32).reshape(-1, 3),
    }
    for name, values in numbers.items():
        array = to_vtk(values, deep=True)
        array.SetName(name)
        fields.AddArray(array)
    return image

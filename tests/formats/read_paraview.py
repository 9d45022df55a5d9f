"""Opens what svt writes in ParaView without a window: samples and place against a raw NRRD, the table of labels.

    pvpython --force-offscreen-rendering tests/formats/read_paraview.py FILE.vti|FILE.vtm REFERENCE.nrrd

Debian's python3-paraview replaces python3-vtk9, which other tests need: docs/dev/testing.md says how to have both.
"""
import re
import sys

import numpy as np
from paraview import servermanager, simple
from paraview.vtk.util.numpy_support import vtk_to_numpy

path, reference = sys.argv[1:3]
with open(reference, "rb") as file:
    head, _, data = file.read().partition(b"\n\n")


def field(pattern):
    """What the header says in the group of a pattern."""
    found = re.search(pattern, head)
    assert found, pattern
    return found[1]


sizes = [int(n) for n in field(rb"\nsizes: (.*)").split()]
kind = {b"uint8": np.uint8, b"uint16": np.uint16, b"uint32": np.uint32}[field(rb"\ntype: (\w+)")]
expected = np.frombuffer(data, kind).reshape(sizes[::-1])
origin = np.array([float(n) for n in field(rb"\nspace origin: \((.*)\)").split(b",")])
steps = np.array(
    [[float(n) for n in v.split(b",")] for v in re.findall(rb"\(([^)]*)\)", field(rb"\nspace directions: (.*)"))]
)

reader = simple.OpenDataFile(path)
whole = servermanager.Fetch(reader)
image = whole if whole.IsA("vtkImageData") else whole.GetBlock(0)
assert image.IsA("vtkImageData"), image.GetClassName()
labels = image.GetCellData().GetArray("label")
assert labels.GetNumberOfTuples() == expected.size, (labels.GetNumberOfTuples(), expected.shape)
assert (vtk_to_numpy(labels).reshape(expected.shape) == expected).all()
corner = np.array(image.GetOrigin()) + 0.5 * steps.sum(axis=0)
assert np.abs(corner - origin).max() < 1e-6, (corner, origin)
names = image.GetFieldData().GetAbstractArray("label_name")
assert names is not None and names.GetNumberOfValues() > 1
if whole is not image:
    print("levels", whole.GetNumberOfBlocks())
print(
    simple.GetParaViewVersion(),
    expected.shape,
    "same;",
    names.GetNumberOfValues(),
    "names, such as",
    repr(names.GetValue(1)),
)

"""Volumes in VTK: the same image as that of the written file."""
import importlib.util
import sys
import types
import unittest
from unittest import mock

import numpy as np

import svt
from common import house, needs, path


def turned():
    """4 x 3 x 2 samples, turned about z."""
    array = np.arange(24, dtype=np.uint16).reshape(2, 3, 4)
    return svt.Volume.from_dense(
        array, spacing=(0.5, 0.25, 1), origin=(10, 20, 30), axes=((0.8, 0.6, 0), (-0.6, 0.8, 0), (0, 0, 1))
    )


@needs("vtkmodules")
class Vtk(unittest.TestCase):
    def test_image_is_that_of_the_file(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOXML import vtkXMLImageDataReader

        for name, v in (("turned", turned()), ("house", house())):
            image = v.to_vtk()
            v.save(path(f"{name}.vti"))
            reader = vtkXMLImageDataReader()
            reader.SetFileName(path(f"{name}.vti"))
            reader.Update()
            other = reader.GetOutput()
            self.assertEqual(image.GetDimensions(), other.GetDimensions())
            np.testing.assert_allclose(image.GetOrigin(), other.GetOrigin(), rtol=1e-15)
            np.testing.assert_allclose(image.GetSpacing(), other.GetSpacing(), rtol=1e-15)
            for row in range(3):
                for column in range(3):
                    self.assertAlmostEqual(
                        image.GetDirectionMatrix().GetElement(row, column),
                        other.GetDirectionMatrix().GetElement(row, column),
                    )
            mine, theirs = image.GetCellData().GetScalars(), other.GetCellData().GetScalars()
            self.assertEqual((mine.GetName(), mine.GetDataType()), (theirs.GetName(), theirs.GetDataType()))
            np.testing.assert_array_equal(vtk_to_numpy(mine), vtk_to_numpy(theirs))
            names = [image.GetFieldData().GetArrayName(n) for n in range(image.GetFieldData().GetNumberOfArrays())]
            for field in names:
                mine, theirs = (one.GetFieldData().GetAbstractArray(field) for one in (image, other))
                self.assertEqual(mine.GetNumberOfValues(), theirs.GetNumberOfValues(), field)
                for n in range(mine.GetNumberOfValues()):
                    self.assertEqual(mine.GetVariantValue(n).ToString(), theirs.GetVariantValue(n).ToString(), field)

    def test_cell_at_a_point_has_the_label_there(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy

        for v in (house(), turned()):
            image = v.to_vtk()
            values = vtk_to_numpy(image.GetCellData().GetScalars())
            points = v.world(np.random.default_rng(1).random((200, 3)) * v.dimension - 0.5)
            for point, expected in zip(points, v.sample(points, scalars=True)):
                cell = [0, 0, 0]
                self.assertTrue(image.ComputeStructuredCoordinates(point, cell, [0.0, 0.0, 0.0]))
                self.assertEqual(values[image.ComputeCellId(cell)], expected)

    def test_image_outlives_the_volume(self):
        image = turned().to_vtk()
        self.assertEqual(image.GetCellData().GetScalars().GetTuple1(23), 23)

    def test_pyvista_gets_the_image(self):
        # Debian has no PyVista: a module of the same name stands for it where it is missing.
        if importlib.util.find_spec("pyvista") is not None:
            self.assertEqual(turned().to_pyvista().n_cells, 24)
            return
        double = types.SimpleNamespace(wrap=lambda image: ("wrapped", image.GetNumberOfCells()))
        with mock.patch.dict(sys.modules, {"pyvista": double}):
            self.assertEqual(turned().to_pyvista(), ("wrapped", 24))


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
"""Reads a volume that `svt convert` wrote with a program that knows nothing of SVT, and holds it against a raw NRRD of the
same volume, which is read here by hand: every sample, and where in the world the samples are.

    read_volume.py READER FILE REFERENCE.nrrd [SCALE]     exit code 77 where the reader is not installed

SCALE: units of the file per metre, 1 or 1000.
"""
import re
import sys

try:
    import numpy as np
except ImportError:
    print("no numpy")
    sys.exit(77)


def vectors(text):
    return np.array([[float(x) for x in v.split(",")] for v in re.findall(r"\(([^)]*)\)", text)])


def nrrd(path):
    """(samples as [z, y, x], 3 x 4 matrix from index to world, fields)"""
    import gzip

    head, data = open(path, "rb").read().split(b"\n\n", 1)
    lines = [line for line in head.decode().split("\n")[1:] if line and line[0] != "#" and ":=" not in line]
    fields = dict(line.split(": ", 1) for line in lines)
    if fields["encoding"] == "gzip":
        data = gzip.decompress(data)
    sizes = [int(n) for n in fields["sizes"].split()]
    samples = np.frombuffer(data, fields["type"]).reshape(sizes[::-1])
    matrix = np.column_stack([*vectors(fields["space directions"]), *vectors(fields["space origin"])])
    return samples, matrix


def vtk_points(image, sample_is_cell):
    """3 x 4 matrix of a vtkImageData: of the centres of cells, or of points."""
    direction = image.GetDirectionMatrix()
    d = np.array([[direction.GetElement(r, c) for c in range(3)] for r in range(3)])
    steps = d * np.array(image.GetSpacing())
    origin = np.array(image.GetOrigin())
    if sample_is_cell:
        cell = image.GetCell(0)
        points = np.array([cell.GetPoints().GetPoint(p) for p in range(8)])
        assert np.allclose(points.mean(axis=0), origin + steps.sum(axis=1) / 2), "VTK sees the first cell elsewhere"
        origin = points.mean(axis=0)
    return np.column_stack([steps, origin])


def vti(path):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader

    reader = vtkXMLImageDataReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    cells = image.GetCellData().GetScalars()
    assert cells is not None and cells.GetName() == "label", "no cell scalars 'label'"
    n = [d - 1 for d in image.GetDimensions()]
    fields = image.GetFieldData()
    for f in range(fields.GetNumberOfArrays()):
        array = fields.GetAbstractArray(f)
        if array.GetName() in ("label_id", "label_class", "label_name"):
            print(array.GetName(), [array.GetValue(i) for i in range(min(9, array.GetNumberOfValues()))])
        elif array.GetName().startswith("label_"):
            print(array.GetName(), vtk_to_numpy(array)[:9].tolist())
    assert fields.GetAbstractArray("svt_labels").GetValue(0).startswith('{"labels":[')
    return vtk_to_numpy(cells).reshape(n[::-1]), vtk_points(image, True)


def vtk_nrrd(path):
    """VTK's own reader of NRRD, which knows raw files alone and takes their directions for spacings."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkNrrdReader

    reader = vtkNrrdReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    n = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(n[::-1]), None


def nifti(path):
    import nibabel

    image = nibabel.load(path)
    assert image.header.get_xyzt_units()[0] == "meter"
    assert len(image.header.extensions) == 2
    assert image.header.extensions[1].get_content().startswith(b'{"labels":[')
    print(type(image).__name__)
    return np.asarray(image.dataobj).T, image.affine[:3]


def tiff(path):
    import tifffile

    with tifffile.TiffFile(path) as file:
        page = file.pages[0]
        matrix = np.array(page.tags[34264].value).reshape(4, 4)[:3]
        assert page.tags[65081].value.startswith('{"labels":[')
        spacing = np.linalg.norm(matrix[:, :3], axis=0)
        if file.is_ome:
            import xml.etree.ElementTree as tree

            pixels = tree.fromstring(file.ome_metadata).find(".//{*}Pixels")
            told = [float(pixels.get("PhysicalSize" + axis)) for axis in "XYZ"]
        elif file.is_imagej:
            ratio = [page.tags[tag].value for tag in ("XResolution", "YResolution")]
            told = [r[1] / r[0] for r in ratio] + [file.imagej_metadata["spacing"]]
            assert file.imagej_metadata["unit"] == "m"
        else:
            told = spacing
        assert np.allclose(told, spacing, rtol=1e-4), (told, spacing)
        samples = file.asarray()
    return samples, matrix


def zarr(path):
    """zarr-python: version 2; of every level the place, of the first the samples."""
    import zarr as library

    if not hasattr(library, "open_group"):
        raise ImportError("no zarr")
    group = library.open_group(path, mode="r")
    attributes = dict(group.attrs)
    scales = attributes["multiscales"][0]
    assert [axis["name"] for axis in scales["axes"]] == ["z", "y", "x"] and scales["version"] == "0.4"
    assert attributes["svt"]["labels.json"]["labels"][0]["first"] in (0, 1)
    print([p["gml:id"] for p in attributes["image-label"]["properties"]][:9])
    for dataset in scales["datasets"]:
        scale, move = (np.array(t[t["type"]][::-1]) for t in dataset["coordinateTransformations"])
        array = group[dataset["path"]]
        # The corner of the whole volume is the same for every level.
        corner = move - scale / 2
        if dataset["path"] == "0":
            first, matrix = corner, np.column_stack([np.diag(scale), move])
        assert np.allclose(corner, first, atol=1e-6), (corner, first)
        print("level", dataset["path"], array.shape, int(array[:].max()))
    return group["0"][:], matrix


def gdal(path):
    from osgeo import gdal as library

    library.UseExceptions()
    file = library.Open(path)
    pages = len(library.Open(path).GetSubDatasets()) or file.RasterCount
    print(pages, "pages by GDAL")
    slices = [library.Open(f"GTIFF_DIR:{p + 1}:{path}").ReadAsArray() for p in range(pages)]
    g = file.GetGeoTransform()
    # GDAL says where the corner of the first pixel is.
    return np.array(slices), ("plan", np.array([[g[1], g[2], g[0] + g[1] / 2 + g[2] / 2],
                                                [g[4], g[5], g[3] + g[4] / 2 + g[5] / 2]]))


def triangles(path):
    """(vertices as N x 3 doubles, triangles as M x 3 numbers) of an OBJ, PLY or STL, read by hand: VTK keeps 32-bit floats,
    which are half a metre apart where the coordinates of most CRSs are."""
    data = open(path, "rb").read()
    if path.endswith("obj"):
        lines = data.decode().split("\n")
        return (np.array([line.split()[1:] for line in lines if line.startswith("v ")], float),
                np.array([line.split()[1:] for line in lines if line.startswith("f ")], int) - 1)
    if path.endswith("stl"):
        corner = np.array([float(x) for x in data[:80].decode().split("from")[1].split()])
        faces = np.frombuffer(data[84:], np.dtype([("v", "<f4", (4, 3)), ("a", "<u2")]))
        return faces["v"][:, 1:].reshape(-1, 3) + corner, np.arange(3 * len(faces)).reshape(-1, 3)
    head, body = data.split(b"end_header\n", 1)
    count = {name: int(n) for name, n in re.findall(r"element (\w+) (\d+)", head.decode())}
    points = np.frombuffer(body, "<f8", 3 * count["vertex"]).reshape(-1, 3)
    kind = np.dtype([("n", "u1"), ("v", "<i4", 3), ("label", "<i4"), ("color", "u1", 3)])
    return points, np.frombuffer(body[24 * len(points):], kind)["v"]


def mesh(path):
    """Triangles: their volume and box as those of the voxels that are not background; VTK reads as many."""
    from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
    from vtkmodules.vtkIOPLY import vtkPLYReader

    reader = {"obj": vtkOBJReader, "stl": vtkSTLReader, "ply": vtkPLYReader}[path[-3:]]()
    reader.SetFileName(path)
    reader.Update()
    points, faces = triangles(path)
    assert reader.GetOutput().GetNumberOfCells() == len(faces), (reader.GetOutput().GetNumberOfCells(), len(faces))
    expected, place = nrrd(sys.argv[3])
    used = np.argwhere(expected > 0)[:, ::-1]
    corners = np.array([used.min(axis=0) - 0.5, used.max(axis=0) + 0.5])
    world = np.array([place @ np.append(c, 1) for c in corners])
    bounds = np.array([points.min(axis=0), points.max(axis=0)])
    assert np.allclose(bounds, world, rtol=0, atol=1e-3), (bounds, world)
    a, b, c = ((points - points.mean(axis=0))[faces[:, k]] for k in range(3))
    enclosed = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
    volume = len(used) * abs(np.linalg.det(place[:, :3]))
    assert abs(enclosed - volume) < 1e-4 * volume, (enclosed, volume)
    print("same", len(faces), "triangles,", enclosed, "of", volume)
    sys.exit(0)


READERS = {"nrrd": nrrd, "vti": vti, "vtknrrd": vtk_nrrd, "nifti": nifti, "tiff": tiff, "gdal": gdal, "zarr": zarr, "mesh": mesh}


def main():
    reader, path, reference = sys.argv[1:4]
    scale = float(sys.argv[4]) if len(sys.argv) > 4 else 1
    expected, place = nrrd(reference)
    try:
        samples, matrix = READERS[reader](path)
    except ImportError as error:
        print(error)
        sys.exit(77)
    assert samples.dtype == expected.dtype, (samples.dtype, expected.dtype)
    assert samples.shape == expected.shape, (samples.shape, expected.shape)
    assert (samples == expected).all(), f"{(samples != expected).sum()} samples differ"
    assert len(set(expected.shape)) == 3, "axes of equal length would hide a wrong order"
    if isinstance(matrix, tuple):
        corners = np.array([[i, j, 1] for i in (0, expected.shape[2]) for j in (0, expected.shape[1])]).T
        matrix, place = matrix[1], place[:2, [0, 1, 3]]
    elif matrix is not None:
        corners = np.array([[i, j, k, 1] for i in (0, expected.shape[2]) for j in (0, expected.shape[1])
                            for k in (0, expected.shape[0])]).T
    if matrix is not None:
        error = np.abs(matrix @ corners / scale - place @ corners).max()
        spacing = np.linalg.norm(place[:, :2], axis=0).min()
        assert error < 0.01 * spacing, f"samples are {error} m from where they should be"
    print("same", samples.shape, samples.dtype)


main()

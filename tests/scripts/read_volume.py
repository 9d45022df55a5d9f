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
    # Header, labels and seal of the volume.
    header, labels, seal = (extension.get_content() for extension in image.header.extensions)
    assert header.startswith(b"{") and labels.startswith(b'{"labels":[') and seal
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
            assert pixels is not None, "no Pixels"
            told = [float(pixels.attrib["PhysicalSize" + axis]) for axis in "XYZ"]
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
    return np.array(slices), (
        "plan",
        np.array([[g[1], g[2], g[0] + g[1] / 2 + g[2] / 2], [g[4], g[5], g[3] + g[4] / 2 + g[5] / 2]]),
    )


def triangles(path):
    """(vertices as N x 3 doubles, triangles as M x 3 numbers) of an OBJ, PLY or STL, read by hand: VTK keeps 32-bit floats,
    which are half a metre apart where the coordinates of most CRSs are."""
    data = open(path, "rb").read()
    if path.endswith("obj"):
        lines = data.decode().split("\n")
        return (
            np.array([line.split()[1:] for line in lines if line.startswith("v ")], float),
            np.array([line.split()[1:] for line in lines if line.startswith("f ")], int) - 1,
        )
    if path.endswith("stl"):
        corner = np.array([float(x) for x in data[:80].decode().split("from")[1].split()])
        faces = np.frombuffer(data[84:], np.dtype([("v", "<f4", (4, 3)), ("a", "<u2")]))
        return faces["v"][:, 1:].reshape(-1, 3) + corner, np.arange(3 * len(faces)).reshape(-1, 3)
    head, body = data.split(b"end_header\n", 1)
    count = {name: int(n) for name, n in re.findall(r"element (\w+) (\d+)", head.decode())}
    points = np.frombuffer(body, "<f8", 3 * count["vertex"]).reshape(-1, 3)
    kind = np.dtype([("n", "u1"), ("v", "<i4", 3), ("label", "<i4"), ("color", "u1", 3)])
    return points, np.frombuffer(body[24 * len(points) :], kind)["v"]


def mesh(path):
    """Triangles: their volume and box as those of the voxels that are not background; VTK reads as many."""
    if path.split(".")[-1] in ("obj", "stl", "ply"):
        from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
        from vtkmodules.vtkIOPLY import vtkPLYReader

    other = {"usda": usda, "precomputed": neuroglancer_mesh, "3dtiles": tileset}.get(path.split(".")[-1])
    points, faces = (other or triangles)(path)
    if other is None:
        reader = {"obj": vtkOBJReader, "stl": vtkSTLReader, "ply": vtkPLYReader}[path[-3:]]()
        reader.SetFileName(path)
        reader.Update()
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


def labels_of(path):
    """The labels of a NRRD of `svt convert`: dicts of the keys svt_label_N."""
    import json

    head = open(path, "rb").read().split(b"\n\n", 1)[0].decode()
    found = re.findall(r"^svt_label_(\d+):=(.*)$", head, re.M)
    return [json.loads(text.replace("\\\\", "\\")) for _, text in sorted(found, key=lambda f: int(f[0]))]


def vdb(path):
    """The OpenVDB library: labels, a mask for each class, the transform."""
    import pyopenvdb as library

    labels = library.read(path, "label")
    expected, _ = nrrd(sys.argv[3])
    samples = np.zeros(expected.shape[::-1], np.float32)
    labels.copyToArray(samples)
    table = labels_of(sys.argv[3])
    classes = sorted({label["class"] for label in table if label["count"] > 0 and label["voxels"] > 0})
    assert sorted(g.name for g in library.readAllGridMetadata(path)) == sorted(classes + ["label"])
    for name in classes:
        mask = np.zeros(expected.shape[::-1], np.float32)
        grid = library.read(path, name)
        assert grid.gridClass == "fog volume"
        grid.copyToArray(mask)
        inside = [
            s
            for label in table
            if label["class"] == name
            for s in range(label["first"], label["first"] + label["count"])
        ]
        assert (mask == np.isin(samples, inside)).all(), name
        assert grid.activeVoxelCount() == mask.sum(dtype=float), "what lies beyond the volume is not active"
    place = [labels.transform.indexToWorld(corner) for corner in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))]
    origin, *steps = (np.array(p) for p in place)
    return samples.T.astype(expected.dtype), np.column_stack([*(s - origin for s in steps), origin])


def levelset(path):
    """The OpenVDB library: the signed distances of each class, against all cubes within reach one by one."""
    import pyopenvdb as library

    expected, _ = nrrd(sys.argv[3])
    labels = library.read(path, "label")
    table = labels_of(sys.argv[3])
    origin, step = (np.array(labels.transform.indexToWorld(p)) for p in ((0, 0, 0), (1, 0, 0)))
    spacing = np.linalg.norm(step - origin)
    pad, reach = 8, 3
    samples = np.pad(expected.T.astype(np.int64), pad)
    checked = 0
    for name in sorted({label["class"] for label in table if label["count"] > 0 and label["voxels"] > 0}):
        grid = library.read(path, name)
        assert grid.gridClass == "level set" and abs(grid.background - 3 * spacing) < 1e-6 * spacing
        values = np.zeros(samples.shape, np.float32)
        grid.copyToArray(values, ijk=(-pad, -pad, -pad))
        scalars = [
            s
            for label in table
            if label["class"] == name
            for s in range(label["first"], label["first"] + label["count"])
        ]
        inside = np.isin(samples, scalars)
        squares = {True: np.full(samples.shape, np.inf), False: np.full(samples.shape, np.inf)}
        steps = range(-reach, reach + 1)
        for x in steps:
            for y in steps:
                for z in steps:
                    square = sum(max(abs(d) - 0.5, 0) ** 2 if d else 0 for d in (x, y, z))
                    moved = np.roll(inside, (x, y, z), (0, 1, 2))
                    for side in squares:
                        here = moved == side
                        squares[side][here] = np.minimum(squares[side][here], square)
        distance = np.minimum(np.sqrt(np.where(inside, squares[False], squares[True])), reach) * spacing
        assert np.abs(np.where(inside, -distance, distance) - values).max() < 1e-5 * spacing, name
        assert grid.activeVoxelCount() == (distance < 0.999999 * reach * spacing).sum(), name
        # The surface that the library makes of it lies around the voxels.
        near = grid.deepCopy()  # points are 32-bit floats: far from the origin they would be coarse
        near.transform = library.createLinearTransform()
        index, _ = near.convertToQuads()
        low, high = (np.array([f(np.nonzero(inside)[axis]) - pad for axis in range(3)]) for f in (np.min, np.max))
        for beyond in (low - 0.5 - index.min(axis=0), index.max(axis=0) - high - 0.5):
            assert -1 < beyond.min() and beyond.max() < 0.01, (name, beyond)  # corners are rounded
        checked += 1
    print("level sets", checked)
    return expected, None


def vtm(path):
    """All levels; the first one has the samples."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader

    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(path)
    reader.Update()
    blocks = reader.GetOutput()
    boxes = [np.array(blocks.GetBlock(b).GetBounds()) for b in range(blocks.GetNumberOfBlocks())]
    print("levels", len(boxes))
    # A level may be up to a cell of its own longer.
    for b, box in enumerate(boxes):
        step = np.repeat(blocks.GetBlock(b).GetSpacing(), 2)
        assert (np.abs(box - boxes[0]) <= step + 1e-6).all(), (b, box, boxes[0])
    image = blocks.GetBlock(0)
    n = [d - 1 for d in image.GetDimensions()]
    return vtk_to_numpy(image.GetCellData().GetArray("label")).reshape(n[::-1]), vtk_points(image, True)


def vox(path):
    """MagicaVoxel's format, read by hand: voxels by the graph of the scene, labels by the ids of its groups."""
    import struct

    data = open(path, "rb").read()
    assert data[:4] == b"VOX " and struct.unpack_from("<i", data, 4)[0] == 150
    assert data[8:12] == b"MAIN" and struct.unpack_from("<ii", data, 12) == (0, len(data) - 20)
    models, nodes, at = [], {}, 20
    palette, size = np.empty((0, 4), "u1"), ()

    def words(where, count):
        return struct.unpack_from(f"<{count}i", data, where)

    def dictionary(where):
        count, where = words(where, 1)[0], where + 4
        entries = {}
        for _ in range(count):
            pair = []
            for _ in range(2):
                length = words(where, 1)[0]
                pair.append(data[where + 4 : where + 4 + length].decode())
                where += 4 + length
            entries[pair[0]] = pair[1]
        return entries, where

    while at < len(data):
        name, length, at = data[at : at + 4], words(at + 4, 1)[0], at + 12
        if name == b"SIZE":
            size = words(at, 3)
        elif name == b"XYZI":
            models.append((size, np.frombuffer(data, "u1", 4 * words(at, 1)[0], at + 4).reshape(-1, 4)))
            assert len(models[-1][1]) * 4 + 4 == length and max(size) <= 256
            assert (models[-1][1][:, :3].max(axis=0) == np.array(size) - 1).all(), "a model is cut to its voxels"
        elif name == b"RGBA":
            palette = np.frombuffer(data, "u1", 1024, at).reshape(256, 4)
        else:
            entries, where = dictionary(at + 4)
            if name == b"nTRN":
                frame, end = dictionary(where + 16)
                nodes[words(at, 1)[0]] = ("t", entries, words(where, 1), frame)
            else:
                count = words(where, 1)[0]
                end = where + 4 + (4 if name == b"nGRP" else 8) * count
                nodes[words(at, 1)[0]] = ("g" if name == b"nGRP" else "s", entries, words(where + 4, count), {})
            assert end == at + length, name
        at += length
    expected, _ = nrrd(sys.argv[3])
    table = {label["id"]: label for label in labels_of(sys.argv[3])}
    samples = np.zeros(expected.shape, expected.dtype)

    def visit(number, move, owner):
        kind, entries, below, frame = nodes[number]
        owner = table[entries["svt_id"]] if "svt_id" in entries else owner
        if "svt_id" in entries:
            assert entries["_name"] == (owner["name"] or owner["id"]) and entries["svt_class"] == owner["class"]
        move = move + np.array([int(n) for n in frame.get("_t", "0 0 0").split()])
        if kind != "s":
            return [visit(n, move, owner) for n in below]
        extent, voxels = models[below[0]]
        x, y, z = (voxels[:, :3].astype(int) + move - np.array(extent) // 2).T
        assert (samples[z, y, x] == 0).all(), "a voxel twice"
        samples[z, y, x] = owner["first"]
        color = palette[voxels[:, 3].astype(int) - 1][0]
        assert np.allclose(color[:3] / 255, owner["color"], atol=0.003), (color, owner["color"])

    visit(0, np.zeros(3, int), None)
    root = nodes[0][1]
    spacing, origin = (np.array([float(n) for n in root[key].split()]) for key in ("svt_spacing", "svt_origin"))
    return samples, np.column_stack([np.diag(spacing), origin])


def usda(path):
    """USD, read by hand: names, tree, and the points in world space, as triangles()."""
    text = open(path, encoding="utf-8").read()
    assert text.startswith("#usda 1.0\n") and "metersPerUnit = 1" in text and 'upAxis = "Z"' in text
    transform = re.search(r"matrix4d xformOp:transform = \( (.*) \)\n", text)
    assert transform, "no transform"
    matrix = np.array([[float(n) for n in row.split(",")] for row in re.findall(r"\(([^()]*)\)", transform[1])])
    depth, points, faces, ids, first = 0, [], [], [], 0
    for line in text.split("\n"):
        depth += {"{": 1, "}": -1}.get(line, 0)
        if line.startswith("custom string svt:id = "):
            ids.append(line.split(" = ", 1)[1].strip('"'))
        if line.startswith("point3f[] points = "):
            points.append(np.array([[float(n) for n in p.split(",")] for p in re.findall(r"\(([^()]*)\)", line)]))
        if line.startswith("int[] faceVertexIndices = "):
            faces.append(np.array([int(n) for n in line.split("[")[2].strip("]").split(",")]).reshape(-1, 3) + first)
        if line.startswith("point3f[]"):
            first += len(points[-1])
    assert depth == 0, "every prim ends"
    print(ids)
    local = np.concatenate(points)
    return (np.column_stack([local, np.ones(len(local))]) @ matrix)[:, :3], np.concatenate(faces)


def neuroglancer_mesh(path):
    """Meshes of a precomputed folder as its specification has them: metres from the lower corner, along the axes."""
    import json
    import os

    info = json.load(open(os.path.join(path, "info")))
    folder = os.path.join(path, info["mesh"])
    assert json.load(open(os.path.join(folder, "info"))) == {"@type": "neuroglancer_legacy_mesh"}
    points, faces, first, seen = [], [], 0, set()
    for name in sorted(os.listdir(folder)):
        if not name.endswith(":0"):
            continue
        for fragment in json.load(open(os.path.join(folder, name)))["fragments"]:
            if fragment in seen:
                continue
            seen.add(fragment)
            data = open(os.path.join(folder, fragment), "rb").read()
            count = int.from_bytes(data[:4], "little")
            points.append(np.frombuffer(data, "<f4", 3 * count, 4).reshape(-1, 3) * 1e-9)
            faces.append(np.frombuffer(data, "<u4", -1, 4 + 12 * count).reshape(-1, 3).astype(int) + first)
            assert faces[-1].max() < first + count
            first += count
    expected, place = nrrd(sys.argv[3])
    corner = place @ np.array([-0.5, -0.5, -0.5, 1])
    axes = place[:, :3] / np.linalg.norm(place[:, :3], axis=0)
    return np.concatenate(points).astype(float) @ axes.T + corner, np.concatenate(faces)


def tileset(path):
    """3D Tiles: features, their table, and the points in world space, as triangles(); the place on the globe is told."""
    import json
    import os
    import struct

    tiles = json.load(open(os.path.join(path, "tileset.json")))
    assert tiles["asset"]["version"] == "1.1" and tiles["geometricError"] > 0
    root = tiles["root"]
    print("transform", json.dumps(root["transform"]))
    points, faces, first, ids = [], [], 0, []
    for tile in root.get("children", [root]):
        data = open(os.path.join(path, tile["content"]["uri"]), "rb").read()
        magic, version, length, text_length, kind = struct.unpack_from("<5I", data)
        assert (magic, version, length, kind) == (0x46546C67, 2, len(data), 0x4E4F534A)
        gltf, start = json.loads(data[20 : 20 + text_length]), 28 + text_length
        assert start % 8 == 0, "tables begin at multiples of 8"

        def view(number):
            told = gltf["bufferViews"][number]
            return data[start + told["byteOffset"] : start + told["byteOffset"] + told["byteLength"]]

        def values(accessor):
            told = gltf["accessors"][accessor]
            kinds = {5126: "<f4", 5125: "<u4", 5123: "<u2", 5121: "u1", 5120: "i1"}
            array = np.frombuffer(view(told["bufferView"]), kinds[told["componentType"]])
            return array.reshape(told["count"], -1)[:, : {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[told["type"]]]

        meta = gltf["extensions"]["EXT_structural_metadata"]
        table = meta["propertyTables"][0]
        strings = {}
        for name, property in table["properties"].items():
            if "stringOffsets" in property:
                size = {"UINT16": "<u2", "UINT32": "<u4"}[property.get("stringOffsetType", "UINT32")]
                offsets, all_text = np.frombuffer(view(property["stringOffsets"]), size), view(property["values"])
                strings[name] = [all_text[a:b].decode() for a, b in zip(offsets, offsets[1:])]
                assert len(strings[name]) == table["count"]
            elif name in meta["schema"].get("enums", {}):
                told = meta["schema"]["enums"][name]
                numbers = np.frombuffer(view(property["values"]), {"UINT8": "u1", "UINT16": "<u2"}[told["valueType"]])
                names = {choice["value"]: choice["name"] for choice in told["values"]}
                strings[name] = [names[int(number)] for number in numbers]
                assert len(strings[name]) == table["count"]
        volumes = np.frombuffer(view(table["properties"]["volume"]["values"]), "<f4")
        print(strings["id"], strings["name"], volumes.tolist())
        ids += strings["id"]
        box = np.array(tile["boundingVolume"]["box"])
        node = gltf["nodes"][0]
        scale, place = np.array(node.get("scale", [1, 1, 1])), np.array(node.get("translation", [0, 0, 0]))
        for primitive in gltf["meshes"][0]["primitives"]:
            attributes = primitive["attributes"]
            told = primitive["extensions"]["EXT_mesh_features"]["featureIds"][0]
            assert told == {"featureCount": table["count"], "attribute": 0, "label": "component", "propertyTable": 0}
            position = values(attributes["POSITION"]) * scale + place
            normal = values(attributes["NORMAL"]) / 127
            feature, index = values(attributes["_FEATURE_ID_0"])[:, 0], values(primitive["indices"]).reshape(
                -1, 3
            ).astype(int)
            assert (feature[index] == feature[index][:, :1]).all() and feature.max() < table["count"]
            a, b, c = (position[index[:, k]] for k in range(3))
            across = np.cross(b - a, c - a)
            across /= np.linalg.norm(across, axis=1)[:, None]
            assert (np.einsum("ij,ij->i", across, normal[index[:, 0]]) > 0.99).all(), "a normal is that of its face"
            world = np.column_stack([position[:, 0], -position[:, 2], position[:, 1]])
            half = np.abs(box[3:].reshape(3, 3)).sum(axis=0)
            assert (np.abs(world - box[:3]) <= half + 1e-4).all(), "all lies in the box of its tile"
            points.append(world)
            faces.append(index + first)
            first += len(world)
    assert len(set(ids)) == len(ids)
    return np.concatenate(points) + np.array(tiles["asset"]["extras"]["origin"]), np.concatenate(faces)


READERS = {
    "nrrd": nrrd,
    "vti": vti,
    "vtknrrd": vtk_nrrd,
    "nifti": nifti,
    "tiff": tiff,
    "gdal": gdal,
    "zarr": zarr,
    "mesh": mesh,
    "vdb": vdb,
    "levelset": levelset,
    "vtm": vtm,
    "vox": vox,
}


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
    assert reader == "levelset" or len(set(expected.shape)) == 3, "axes of equal length would hide a wrong order"
    if isinstance(matrix, tuple):
        corners = np.array([[i, j, 1] for i in (0, expected.shape[2]) for j in (0, expected.shape[1])]).T
        matrix, place = matrix[1], place[:2, [0, 1, 3]]
    elif matrix is not None:
        corners = np.array(
            [
                [i, j, k, 1]
                for i in (0, expected.shape[2])
                for j in (0, expected.shape[1])
                for k in (0, expected.shape[0])
            ]
        ).T
    if matrix is not None:
        apart = np.abs(matrix @ corners / scale - place @ corners).max()
        spacing = np.linalg.norm(place[:, :2], axis=0).min()
        assert apart < 0.01 * spacing, f"samples are {apart} m from where they should be"
    print("same", samples.shape, samples.dtype)


main()

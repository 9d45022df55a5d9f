"""Semantic volumes: the component of a building at each point."""
from __future__ import annotations

import base64
import html
import json
import os
from collections.abc import Mapping, Sequence
from typing import Any, Union

import numpy as np

from . import _native
from .errors import Finding
from .fields import Fields
from .labels import Labels
from .model import Model, PathLike, Progress, paths_of
from .optional import load
from .page import Page
from .picture import Frame
from .section import Section
from .viewer import View
from .vtk_image import image_of

#: A box along the world axes in metres: lower and upper corner, ((x, y, z), (x, y, z)) or six numbers.
Box = Union[Sequence[float], Sequence[Sequence[float]], np.ndarray]


def _box_of(box: Box) -> list[float]:
    numbers = np.asarray(box, dtype=float).reshape(-1).tolist()
    if len(numbers) != 6:
        raise ValueError(f"box: expected two corners of three numbers, found {len(numbers)} numbers")
    return numbers


class Runs(Sequence):
    """Runs of labels along rays. ``runs[r]`` are the runs of ray r: a structured array with the fields

    - ``label`` (uint32): index in Volume.labels,
    - ``enter``, ``leave`` (float64): metres from the origin of the ray.

    Background is left out. A label that a ray enters twice is listed twice.

    Attributes
    ----------
    all : structured ndarray
        The runs of all rays, ordered by ray. Not a copy.
    start : ndarray (rays + 1) uint64
        The runs of ray r are all[start[r]:start[r + 1]].
    """

    def __init__(self, start: np.ndarray, runs: np.ndarray) -> None:
        self.start = start
        self.all = runs

    def __len__(self) -> int:
        return len(self.start) - 1

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        index = int(index)
        if not -len(self) <= index < len(self):
            raise IndexError(f"no ray {index}")
        index %= len(self)
        return self.all[int(self.start[index]) : int(self.start[index + 1])]

    @property
    def ray(self) -> np.ndarray:
        """The ray of each run of `all`: int64 array."""
        return np.repeat(np.arange(len(self)), np.diff(self.start.astype(np.int64)))

    def __repr__(self) -> str:
        return f"<svt.Runs: {len(self)} rays, {len(self.all)} runs>"


class Volume:
    """A semantic volume: a grid of samples with the label of each. It never changes.

    Made by :func:`svt.build`, :func:`svt.open` and :meth:`from_dense`. Points are in world space, the coordinates of
    the model, in metres. Sample (i, j, k) is at origin + i * spacing[0] * axes[0] + j * spacing[1] * axes[1] + k *
    spacing[2] * axes[2], the centre of its voxel. Arrays of samples are indexed [k, j, i].
    """

    def __init__(self, native: _native.Volume) -> None:
        self._native = native
        self._labels: Labels | None = None

    # Properties

    @property
    def dimension(self) -> tuple[int, int, int]:
        """Samples along x, y, z."""
        return self._native.dimension

    @property
    def spacing(self) -> tuple[float, float, float]:
        """Metres between samples along x, y, z."""
        return self._native.spacing

    @property
    def origin(self) -> tuple[float, float, float]:
        """Sample (0, 0, 0) in world space, metres."""
        return self._native.origin

    @property
    def axes(self) -> tuple[tuple[float, float, float], ...]:
        """Unit vectors along which i, j and k grow, world space; a rotation."""
        return self._native.axes

    @property
    def voxel_volume(self) -> float:
        """Volume of one voxel, m3."""
        x, y, z = self.spacing
        return x * y * z

    @property
    def shape(self) -> tuple[int, int, int]:
        """Shape of dense(): samples along z, y, x."""
        return self.dimension[::-1]

    @property
    def dtype(self) -> np.dtype:
        """Type of dense(): the smallest of uint8, uint16 and uint32 that holds all scalars."""
        return np.dtype(f"u{self._native.scalar_bits // 8}")

    @property
    def size_bytes(self) -> int:
        """Memory of the samples in bytes: runs of equal labels, each column stored once."""
        return self._native.size_bytes

    @property
    def crs(self) -> str:
        """Name of the model's coordinate reference system, or ''."""
        return self._native.crs

    @property
    def name(self) -> str:
        """Name of the model, or ''."""
        return self._native.name

    @property
    def source(self) -> str:
        """File name of the model."""
        return self._native.source

    @property
    def labels(self) -> Labels:
        """The components, in the order of the tree."""
        if self._labels is None:
            self._labels = Labels(self._native)
        return self._labels

    @property
    def findings(self) -> list[Finding]:
        """Findings of the build; empty for a volume that was opened."""
        return self._native.findings

    @property
    def fields(self) -> Fields:
        """The fields of the `.svt` from which the volume was opened: temperatures, smoke, sensors."""
        return Fields(self)

    @property
    def box(self) -> np.ndarray:
        """Box around all voxels along the world axes: array (2, 3) of lower and upper corner, metres."""
        corners = self.world(
            [
                [i, j, k]
                for i in (-0.5, self.dimension[0] - 0.5)
                for j in (-0.5, self.dimension[1] - 0.5)
                for k in (-0.5, self.dimension[2] - 0.5)
            ]
        )
        return np.array([corners.min(axis=0), corners.max(axis=0)])

    def world(self, index: Any) -> np.ndarray:
        """World points of sample positions: array (..., 3) of i, j, k (may be fractions) to (..., 3) in metres."""
        return _native.world_from_index(self._native, index)

    def index(self, points: Any) -> np.ndarray:
        """Sample positions of world points: array (..., 3) in metres to (..., 3) of i, j, k, not rounded."""
        return _native.index_from_world(self._native, points)

    def info(self) -> dict:
        """Grid, labels and overlaps as plain data: the output of `svt info --json` (docs/user/json.md)."""
        return json.loads(self._native.info_json())

    # Queries

    def query(self, text: str) -> list[_native.Label]:
        """The labels that a query selects, such as ``'class=BuildingRoom and volume>20'``. The list may be empty.

        The language: docs/user/query-language.md. Raises svt.Error E901 if the text is not a query.
        """
        return [self._native.label(index) for index in self._native.query(text)]

    def dense(self, box: Box | None = None, level: int = 0) -> np.ndarray:
        """The scalars of the samples as an array, 0 for background. `svt convert` writes the same values as NRRD.

        Parameters
        ----------
        box
            World box in metres, bounds included: only the samples in it. :meth:`samples_in` returns their indices.
        level
            0 to 6: cells of 2**level samples along each axis, each with the label that fills most of it.

        Returns
        -------
        ndarray (nz, ny, nx) of uint8, uint16 or uint32
            C order, x fastest: a[k, j, i] is sample (i, j, k). ``a.T`` is the same memory as a[i, j, k]. The array is
            written once, directly from the runs of labels, and belongs to the caller. ``labels.of_scalar[a]`` are
            indices of labels.
        """
        if level:
            return self.part(box=box, level=level).dense()
        return _native.dense(self._native, None if box is None else _box_of(box))

    def samples_in(self, box: Box) -> tuple[tuple[int, int, int], tuple[int, int, int]]:
        """The samples in a world box (metres, bounds included): the first one and one past the last, each (i, j, k)."""
        return _native.samples_in(self._native, _box_of(box))

    def sample(self, points: Any, *, scalars: bool = False) -> np.ndarray:
        """The labels at points.

        Parameters
        ----------
        points : array (..., 3)
            World space, metres. An array of float64 in C order is read without a copy.
        scalars
            Return scalars as in dense() instead of labels.

        Returns
        -------
        ndarray (...) of int32
            Index in `labels`, -1 for background; with `scalars` uint32, 0 for background. A point belongs to the voxel
            that contains it.
        """
        found = _native.sample_scalars(self._native, points)
        return found if scalars else self.labels.of_scalar[found]

    def rays(self, origins: Any, directions: Any, *, progress: Progress = None) -> Runs:
        """The labels along rays, with the distances at which the rays enter and leave them.

        Parameters
        ----------
        origins : array (N, 3)
            World space, metres; may lie inside.
        directions : array (N, 3) or (3,)
            Any length except zero; a single direction applies to all rays.
        """
        return Runs(*_native.rays(self._native, np.atleast_2d(origins), directions, progress))

    def contacts(self) -> np.ndarray:
        """Pairs of labels that touch, with their contact areas: structured array with the fields ``a`` and ``b``
        (int32, indices of labels, a < b; b is -1 for background) and ``area`` (m2). Only the first call measures."""
        return _native.contacts(self._native)

    # Drawings and pictures

    def section(
        self,
        plane: str = "",
        *,
        show: str | Sequence[str] = (),
        hide: str | Sequence[str] = (),
        spaces: bool = True,
        min_area: float = 0,
        tolerance: float = -1,
        meshes: bool = True,
        progress: Progress = None,
    ) -> Section:
        """The section of the volume by a plane, as polygons.

        Parameters
        ----------
        plane
            ``'z=1.2'`` (metres above the lowest samples; x and y too), ``'z<1.2'`` (the other side),
            ``'storey=EG+1.1'``, or ``'A,B,C,D'``; default: 1.1 m above the ground floor.
        show, hide
            Queries: draw only the features that `show` selects, and not those that `hide` selects.
        spaces
            Also rooms, units and storeys.
        min_area
            Leave out smaller polygons, m2.
        tolerance
            Largest deviation of a border, metres; default: exact if the volume stores meshes.
        meshes
            Cut the meshes that the volume stores; False: the voxels.
        """
        native = _native.section(
            self._native, plane, _list_of(show), _list_of(hide), spaces, min_area, tolerance, meshes, progress
        )
        return Section(native, self._native)

    def frame(self, *, progress: Progress = None, **options: Any) -> Frame:
        """A picture with the label and depth of each pixel; options as for :meth:`render`."""
        return Frame(_native.draw(self._native, options, progress))

    def render(self, *, progress: Progress = None, **options: Any) -> np.ndarray:
        return self.frame(progress=progress, **options).color

    def view(self, *, height: int = 600, browser: bool = False) -> View:
        """Show the volume on the interactive page, served by `svt view`. In a notebook it is `height` pixels high.

        Keep the result: the page ends when the result is closed or deleted.
        """
        return View(self, height, browser)

    def page(self, *, height: int = 600, limit: int = 24_000_000) -> Page:
        """The volume and the interactive page in one HTML text, which needs neither a server nor the network.

        A notebook shows the page, `height` pixels high, and keeps it. ``v.page().save("house.html")`` writes a file that
        every browser opens.

        Parameters
        ----------
        limit
            Maximum size in bytes of the page in a notebook. If it is larger, the notebook shows a picture.
        """
        return Page(self, height, limit)

    # Other packages

    def to_xarray(self, *, level: int = 0, box: Box | None = None) -> Any:
        """The volume as an xarray.Dataset; the same as ``xarray.open_dataset("house.svt")`` of its file.

        The variable `label` (z, y, x) has the values of :meth:`dense`, 0 for background, unpacked when they are read.
        The columns `component_name`, `component_class`, `component_id`, `component_parent` and `component_label` are by
        value: ``ds.component_class[ds.label]``. Coordinates are metres in the CRS. A grid that is turned about z has 2D
        coordinates `xc` and `yc` instead of `x` and `y`. Names and CRS follow the CF conventions 1.10.

        Parameters
        ----------
        level
            0 to 6: cells of 2**level samples along each axis, each with the label that fills most of it.
        box
            World box in metres: only the samples in it.
        """
        load("xarray", "to_xarray()")
        from .xarray_backend import dataset_of

        return dataset_of(self, level, box)

    def to_vtk(self) -> Any:
        """The volume as vtkImageData, with the arrays of the `.vti` file that :meth:`save` writes.

        The cell array `label` has the values of :meth:`dense`; names, classes and colours are field data.
        """
        return image_of(self)

    def to_pyvista(self) -> Any:
        """The volume as pyvista.ImageData (before PyVista 0.40: UniformGrid), as of :meth:`to_vtk`."""
        return load("pyvista", "to_pyvista()").wrap(image_of(self))

    # Files and parts

    def part(
        self, *, box: Box | None = None, select: str | None = None, level: int = 0, progress: Progress = None
    ) -> Volume:
        """A part of the volume as a volume, like the output of `svt convert`: the samples in a world box, the labels
        that a query selects, a coarse level. Labels keep their numbers."""
        return Volume(self._native.part(None if box is None else _box_of(box), select, level, progress))

    def save(self, path: PathLike, *, progress: Progress = None, **options: Any) -> int:
        if options.get("box") is not None:
            options["box"] = tuple(_box_of(options["box"]))
        return self._native.save(os.fspath(path), options, progress)

    @classmethod
    def from_dense(
        cls,
        array: Any,
        labels: Any = None,
        *,
        spacing: float | Sequence[float] = 1,
        origin: Sequence[float] = (0, 0, 0),
        axes: Sequence[Sequence[float]] = ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
        like: Volume | None = None,
        crs: str = "",
        source: str = "array",
        progress: Progress = None,
    ) -> Volume:
        """A volume from an array of labels.

        Parameters
        ----------
        array : ndarray (nz, ny, nx) of bool or whole numbers up to 32 bits
            a[k, j, i] is sample (i, j, k); 0 is background. An array in C order with 8, 16 or 32 bits is read without a
            copy. Other arrays are copied.
        labels
            Meaning of the values. None: each value is a label. Labels of another volume: values are its scalars. A
            mapping from value to name, or to a dict with any of id, class, name, parent, color, opacity, attributes. Or
            a sequence of such dicts, each with a value (a number or a range [first, last]); see docs/user/build.md.
        spacing
            Metres between samples: one number, or along x, y, z.
        origin
            Sample (0, 0, 0) in world space, metres.
        axes
            Unit vectors along which i, j and k grow: a rotation.
        like
            A volume of the same dimension. The new volume has its grid and CRS.
        """
        array = np.asarray(array)
        if array.dtype == bool:
            array = array.astype(np.uint8)
        if array.dtype.kind not in "iu":
            raise TypeError(f"labels must be whole numbers, found {array.dtype}")
        if array.dtype.itemsize > 4:
            if array.size and (array.min() < 0 or array.max() > 0xFFFFFFFF):
                raise ValueError("labels must be numbers of 0 to 4294967295")
            array = array.astype(np.uint32)
        if like is not None:
            if array.shape != like.shape:
                raise ValueError(f"the array has the shape {array.shape}, but the volume in `like` has {like.shape}")
            spacing, origin, axes, crs = like.spacing, like.origin, like.axes, crs or like.crs
        if isinstance(spacing, (int, float)):
            spacing = (spacing,) * 3
        array = np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("="))
        native = _native.from_array(
            array, list(spacing), list(origin), [list(axis) for axis in axes], _table_of(labels), crs, source, progress
        )
        return cls(native)

    # Notebooks

    def _repr_html_(self) -> str:
        rows = [
            ("samples", "{} x {} x {}".format(*self.dimension)),
            ("spacing", "{:g} x {:g} x {:g} m".format(*self.spacing)),
            ("size", "{:.4g} x {:.4g} x {:.4g} m".format(*(n * s for n, s in zip(self.dimension, self.spacing)))),
            ("labels", str(len(self.labels))),
            ("memory", f"{self.size_bytes / 1e6:.3g} MB"),
            ("CRS", self.crs or "-"),
        ]
        picture = base64.b64encode(self.frame(size=(480, 300))._repr_png_()).decode()
        table = "".join(
            f"<tr><th style='text-align:left'>{name}</th><td style='text-align:left'>{html.escape(text)}</td></tr>"
            for name, text in rows
        )
        title = html.escape(self.name or self.source or "volume")
        return (
            f"<div><b>{title}</b><br><img alt='{title}' width='480' height='300' "
            f"src='data:image/png;base64,{picture}'><table>{table}</table></div>"
        )

    def __repr__(self) -> str:
        return "<svt.Volume '{}' {} x {} x {} samples, {} labels>".format(
            self.name or self.source, *self.dimension, len(self.labels)
        )


def _list_of(texts: str | Sequence[str]) -> list[str]:
    return [texts] if isinstance(texts, str) else list(texts)


def _table_of(labels: Any) -> str:
    """The table of labels as JSON."""
    if labels is None:
        return ""
    if isinstance(labels, Labels):
        return labels._native.label_json()
    if isinstance(labels, Mapping):
        labels = [
            {"value": value, **(entry if isinstance(entry, Mapping) else {"name": entry})}
            for value, entry in labels.items()
        ]

    def plain(value: Any) -> Any:
        if isinstance(value, np.generic):
            return value.item()
        if isinstance(value, range):
            return [value.start, value.stop - 1]
        raise TypeError(f"labels: {type(value).__name__} is not a text, number, list or dict")

    entries = [dict(entry) for entry in labels]
    for entry in entries:
        for key, value in entry.items():
            if isinstance(value, (range, np.generic)):
                entry[key] = plain(value)
    return json.dumps({"labels": entries}, default=plain)


def open(path: PathLike, *, labels: PathLike = "", progress: Progress = None) -> Volume:
    """Open a `.svt`, or a label volume of another program: NRRD, VTI, NIfTI, TIFF, CityGML with a volume.

    Parameters
    ----------
    labels
        For a label volume: a table (JSON) with the label of each value; see docs/user/build.md.
    """
    return Volume(_native.open(os.fspath(path), os.fspath(labels), progress))


def build(
    model: Model | PathLike | Sequence[PathLike],
    *,
    vectors: str | Sequence[str] = (),
    grid_of: Volume | None = None,
    progress: Progress = None,
    **options: Any,
) -> Volume:
    native_grid = None if grid_of is None else grid_of._native
    if isinstance(model, Model):
        made = _native.build_model(model._native, options, _list_of(vectors), native_grid, progress)
    else:
        made = _native.build_files(paths_of(model), options, _list_of(vectors), native_grid, progress)
    return Volume(made)


def _indented(text: str, blanks: int) -> str:
    return "".join(" " * blanks + line + "\n" for line in text.splitlines())


# Options and their descriptions are those of the command.
build.__doc__ = f"""Build a volume from a model.

    Parameters
    ----------
    model
        A model from svt.read(), a path, or several paths. Paths avoid a copy of the model.
    vectors
        Geometry of the model to store in addition to the voxels: 'meshes' (default if possible; sections are exact),
        'edges' (lines in pictures), both, or 'none'.
    grid_of
        A volume whose grid is used.
    progress
        A function that gets (stage, fraction) on the calling thread. An exception from it, or Ctrl-C, stops the work.

    Options of `svt build`, as keywords; a tuple for several numbers:

{_indented(_native.build_keywords(), 4)}
    Returns
    -------
    Volume
        Its findings are those of reading and building.
    """
Volume.render.__doc__ = f"""A picture: array (height, width, 4) of uint8: red, green, blue (sRGB), alpha; row 0 on top.

        The options are those of `svt render` with '_' for '-', and the pictures are the same. Use a tuple for several
        numbers (``size=(1280, 720)``), a list for a repeated option (``hide=['class=BuildingRoom', 'name~Dach']``), and
        a dict for queries with a value (``opacity={{'class=BuildingRoom': 0.2}}``).

{_indented(_native.draw_keywords(), 8)}"""
Volume.save.__doc__ = f"""Write the volume. The ending determines the format: `.svt`, or one of `svt convert`.

        Parameters
        ----------
        path
            A file, or a folder for formats that consist of a folder.
        progress
            A function that gets (stage, fraction) on the calling thread. An exception from it, or Ctrl-C, stops the
            work.

        Options of `svt convert`, as keywords; use a tuple for several numbers, such as ``place=(49.1, 8.44, 110)``. The
        options `select`, `box` and `level` select a part, for `.svt` as well.

{_indented(_native.save_keywords(), 8)}
        Returns
        -------
        int
            Number of bytes written. If writing fails, an existing file is kept.
        """

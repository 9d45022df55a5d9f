"""Section drawings: the parts that a plane cuts, as polygons with exact areas."""
from __future__ import annotations

import base64
import html
import json
import os
import warnings
from typing import Any, NamedTuple

import numpy as np

from . import _native
from .errors import Finding
from .model import PathLike
from .tables import columns_of_components, to_pandas


class Polygon:
    """A polygon of one component in a section.

    ``shapely.geometry.shape(polygon)`` converts it for Shapely. Coordinates are metres along the section's axes.

    Attributes
    ----------
    label : svt.Label
    outer : ndarray (N, 2) float64
        The outer ring, counter-clockwise; the first point is not repeated. A read-only view of the drawing.
    holes : list of ndarray (N, 2)
        Inner rings, clockwise.
    area : float
        m2, without holes.
    """

    __slots__ = ("label", "outer", "holes", "area")

    def __init__(self, label: _native.Label, area: float, outer: np.ndarray, holes: list[np.ndarray]) -> None:
        self.label = label
        self.area = area
        self.outer = outer
        self.holes = holes

    @property
    def __geo_interface__(self) -> dict:
        def closed(ring: np.ndarray) -> tuple:
            points = [tuple(point) for point in ring.tolist()]
            return tuple(points + points[:1])

        return {"type": "Polygon", "coordinates": (closed(self.outer), *(closed(hole) for hole in self.holes))}

    def __repr__(self) -> str:
        return f"<svt.Polygon of '{self.label.name or self.label.id}', {self.area:.4g} m2>"


class Component:
    """The part of one label that a plane cuts.

    Attributes
    ----------
    label : svt.Label
    area : float
        m2.
    area_bound : float
        Bound of the error of `area`, m2.
    is_exact : bool
        Cut from the model's mesh, not from voxels.
    line_length : float
        Length of the lines for a label without inside, metres.
    """

    def __init__(self, section: _native.Section, volume: _native.Volume, number: int) -> None:
        label, self.area, self.area_bound, self.is_exact, self.line_length = section.component(number)
        self.label = volume.label(label)
        self._section = section
        self._number = number

    @property
    def polygons(self) -> list[Polygon]:
        return [Polygon(self.label, *polygon) for polygon in self._section.polygons(self._number)]

    def __repr__(self) -> str:
        return f"<svt.Component '{self.label.name or self.label.id}', {self.area:.4g} m2>"


class Axes(NamedTuple):
    """The coordinate system of a section in world space: a point (u, v) is at origin + u * axes.u + v * axes.v."""

    origin: tuple[float, float, float]  #: metres
    u: tuple[float, float, float]
    v: tuple[float, float, float]
    normal: tuple[float, float, float]


class Section:
    """The section of a volume by a plane. Made by :meth:`svt.Volume.section`."""

    def __init__(self, native: _native.Section, volume: _native.Volume) -> None:
        self._native = native
        self._volume = volume

    @property
    def components(self) -> list[Component]:
        """Cut components, one per label, in the order of the labels."""
        return [Component(self._native, self._volume, n) for n in range(self._native.component_count)]

    @property
    def polygons(self) -> list[Polygon]:
        """All polygons of all components."""
        return [polygon for component in self.components for polygon in component.polygons]

    @property
    def lines(self) -> list[tuple[_native.Label, np.ndarray]]:
        """Labels without inside, each with a line of points (N, 2), metres along u and v."""
        return [(self._volume.label(label), points) for label, points in self._native.lines()]

    @property
    def area(self) -> float:
        """Area of all components, m2."""
        return self._native.area

    @property
    def is_exact(self) -> bool:
        """Whether meshes were cut; otherwise voxels."""
        return self._native.is_exact

    @property
    def axes(self) -> Axes:
        return Axes(*self._native.axes)

    @property
    def findings(self) -> list[Finding]:
        """Findings about the drawing: uncertain areas, a plane that coincides with faces."""
        return self._native.findings

    def world(self, points: np.ndarray) -> np.ndarray:
        """Points (..., 2) along u and v as world points (..., 3), metres."""
        points = np.asarray(points, dtype=float)
        origin, u, v, _ = (np.array(vector) for vector in self.axes)
        return origin + points[..., :1] * u + points[..., 1:2] * v

    def _text(self, kind: str, path: PathLike | None, scale: float = 0, encoding: str = "utf-8") -> str:
        return self._native.write(kind, scale, None if path is None else os.fspath(path)).decode(encoding, "replace")

    def to_svg(self, path: PathLike | None = None, scale: float = 100) -> str:
        """The drawing to scale as SVG: `scale` 100 draws 1 m as 10 mm. Also written to `path` if given."""
        return self._text("svg", path, scale)

    def to_pdf(self, path: PathLike | None = None, scale: float = 100) -> bytes:
        """The drawing to scale as PDF. Also written to `path` if given.

        Needs the cairo library. Warns (UserWarning) of letters that no font of the machine has, of Arabic and Hebrew text
        without joined letters, and of missing layers.
        """
        pdf, letters, has_unordered_text, no_layers = self._native.pdf(scale, None if path is None else os.fspath(path))
        if letters:
            text = f"no font on this machine has the letters '{letters}'; the PDF has boxes in their place"
            warnings.warn(f"{text}. Install a font that has them, or write SVG", stacklevel=2)
        if has_unordered_text:
            text = "the PDF has Arabic or Hebrew text from left to right, without joined letters"
            warnings.warn(f"{text}, because the FriBidi library is missing", stacklevel=2)
        if no_layers:
            warnings.warn(no_layers, stacklevel=2)
        return pdf

    def to_dxf(self, path: PathLike | None = None) -> str:
        """The drawing as DXF, in metres along u and v, with a layer per class. Also written to `path` if given, in code
        page 1252."""
        return self._text("dxf", path, encoding="cp1252")

    def to_geojson(self, path: PathLike | None = None) -> str:
        """The drawing as GeoJSON, in the model's coordinates. Also written to `path` if given."""
        return self._text("geojson", path)

    def to_csv(self, path: PathLike | None = None) -> str:
        """The areas as a CSV table. Also written to `path` if given."""
        return self._text("csv", path)

    @property
    def __geo_interface__(self) -> dict:
        """A GeoJSON FeatureCollection in the model's coordinates (x, y, z), one feature per component, with id, class,
        name and areas. The member `crs` names the CRS: coordinates are metres and not degrees.

        ``geopandas.GeoDataFrame.from_features(section)`` makes a map of a plan.
        """
        return json.loads(self.to_geojson())

    def to_pandas(self) -> Any:
        """The components as a pandas.DataFrame with one row per component.

        The index is the number of the label. The columns are id, class_name, name, polygons (their number), area (m2),
        area_bound, is_exact and line_length (m), as of :class:`svt.Component`.
        """
        return to_pandas(columns_of_components(self.components), "Section.to_pandas()")

    def to_dict(self) -> dict:
        """The plane, the areas and the hatches: the output of `svt section --json`."""
        return json.loads(self._text("json", None))

    def _repr_svg_(self) -> str:
        drawing = self.to_svg()
        return drawing[drawing.index("<svg") :]  # part of a page: without the declaration of a file

    def _repr_html_(self) -> str:
        # As a picture, because some programs remove drawings from the HTML of a notebook.
        drawing = base64.b64encode(self.to_svg().encode()).decode()
        return f'<img alt="{html.escape(repr(self))}" style="max-width:100%" src="data:image/svg+xml;base64,{drawing}">'

    def __repr__(self) -> str:
        return f"<svt.Section: {self._native.component_count} components, {self.area:.4g} m2>"

"""Semantic volume textures of building models: read, build, query, cut and draw.

    import svt
    v = svt.build("house.gml", spacing=0.02)
    v.labels["Unterzug-1"].volume
    v.query("class=BuildingRoom and volume>20")
    v.sample(points)
    v.section("z=1.2").polygons
    image = v.render(size=(1280, 720), section="y<4")

Lengths are in metres, points are in the model's coordinates, arrays of samples are indexed [k, j, i] (z, y, x). Long
work releases the interpreter for other threads, and Ctrl-C ends it. Errors are :class:`svt.Error` with a stable code.
"""
from . import _native
from ._native import Feature, Label
from .city import City
from .comparison import Comparison, diff
from .errors import Error, Finding, Place
from .fields import Field, Fields
from .labels import Labels
from .model import Model, read, sample
from .page import Page
from .picture import Frame, read_png, write_png
from .quantities import quantities
from .section import Axes, Component, Polygon, Section
from .take_off import TakeOff, contact_areas, take_off
from .viewer import View
from .volume import Runs, Volume, build, open

__version__: str = _native.version
__all__ = [
    "Axes",
    "City",
    "Comparison",
    "Component",
    "Error",
    "Feature",
    "Field",
    "Fields",
    "Finding",
    "Frame",
    "Label",
    "Labels",
    "Model",
    "Page",
    "Place",
    "Polygon",
    "Runs",
    "Section",
    "TakeOff",
    "View",
    "Volume",
    "build",
    "contact_areas",
    "diff",
    "open",
    "quantities",
    "read",
    "read_png",
    "sample",
    "take_off",
    "write_png",
]

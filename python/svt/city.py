"""Cities: folders of tiles made by `svt city`, drawn tile by tile."""
from __future__ import annotations

import os
from typing import Any

import numpy as np

from . import _native
from .model import PathLike, Progress
from .picture import Frame

Corner = tuple[float, float, float]


class City:
    """A city made by `svt city merge`: its folder, or the address of one (http://, https://).

    Parameters
    ----------
    path
        The folder or address.
    memory
        Memory limit for the tiles of a picture, in MB. With less memory, distant buildings are coarser.

    Raises
    ------
    svt.Error
        E101 or E601 to E605 if a file of the city is missing or damaged.
    """

    def __init__(self, path: PathLike, *, memory: float = 1000) -> None:
        self._native = _native.open_city(os.fspath(path), memory)

    @property
    def buildings(self) -> int:
        """Number of buildings."""
        return self._native.buildings

    @property
    def spacing(self) -> float:
        """Metres between samples of the finest tiles."""
        return self._native.spacing

    @property
    def crs(self) -> str:
        """Name of the coordinate reference system, or ''."""
        return self._native.crs

    @property
    def box(self) -> tuple[Corner, Corner]:
        """Lower and upper corner in the coordinates of the models, metres."""
        return self._native.box

    def frame(self, *, progress: Progress = None, **options: Any) -> Frame:
        """A picture with the label and depth of each pixel; options as for :meth:`render`."""
        return Frame(_native.draw_city(self._native, options, progress))

    def render(self, *, progress: Progress = None, **options: Any) -> np.ndarray:
        """A picture as an array (height, width, 4) of uint8. Options are those of :meth:`svt.Volume.render`, without
        cutaway, explode, inset, wireframe and vectors, which need a whole model."""
        return self.frame(progress=progress, **options).color

    def __repr__(self) -> str:
        return f"<svt.City: {self.buildings} buildings>"

"""Cities: folders of tiles made by `svt city`, drawn tile by tile."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _native
from .model import PathLike, Progress
from .picture import Frame

Corner = tuple[float, float, float]


@dataclass(frozen=True)
class FoundBuilding:
    """A building that :meth:`City.search` found. Texts that the model does not state are empty."""

    id: str
    name: str
    class_name: str
    address: str


@dataclass(frozen=True)
class Found:
    """Buildings that :meth:`City.search` found."""

    #: Number of all buildings that were found.
    count: int
    #: The first ones.
    buildings: list[FoundBuilding]


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

    def search(self, words: str, *, most: int = 100) -> Found:
        """Buildings whose names and attributes have all words, as ``svt city find`` gives them.

        Parameters
        ----------
        words
            Such as ``'hamburger 12'``, ``'street="Main Road"'`` or ``'yearOfConstruction=19'``. The last word may be the
            beginning of one.
        most
            Maximum number of listed buildings.

        Raises
        ------
        svt.Error
            E904 for a text without words, or if too many words have this beginning; E604 if the index of words is
            damaged, or missing because an earlier program merged the city.
        """
        count, rows = self._native.search(words, most)
        return Found(count, [FoundBuilding(*row) for row in rows])

    def frame(self, *, progress: Progress = None, **options: Any) -> Frame:
        """A picture with the label and depth of each pixel; options as for :meth:`render`."""
        return Frame(_native.draw_city(self._native, options, progress))

    def render(self, *, progress: Progress = None, **options: Any) -> np.ndarray:
        """A picture as an array (height, width, 4) of uint8. Options are those of :meth:`svt.Volume.render`, without
        cutaway, explode, inset, wireframe and vectors, which need a whole model."""
        return self.frame(progress=progress, **options).color

    def __repr__(self) -> str:
        return f"<svt.City: {self.buildings} buildings>"

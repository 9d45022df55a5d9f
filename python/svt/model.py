"""Models as read from a file: the tree of features before any voxel."""
from __future__ import annotations

import datetime
import operator
import os
from collections.abc import Sequence
from typing import Any, Callable, Iterator, Optional, Union

from . import _native
from .errors import Finding

PathLike = Union[str, "os.PathLike[str]"]
#: A function that gets the stage ('read', 'voxelize', ...) and its finished fraction, 0 to 1, on the calling thread.
Progress = Optional[Callable[[str, float], object]]


def paths_of(paths: PathLike | Sequence[PathLike]) -> list[str]:
    if isinstance(paths, (str, os.PathLike)):
        paths = [paths]
    return [os.fspath(path) for path in paths]


class Model(Sequence):
    """A building model: a sequence of its features, parents before children.

    Made by :func:`svt.read`. :func:`svt.build` takes a model and does not change it.
    """

    def __init__(self, native: _native.Model) -> None:
        self._native = native

    def __len__(self) -> int:
        return self._native.feature_count

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self._native.feature(i) for i in range(*index.indices(len(self)))]
        index = operator.index(index)
        if not -len(self) <= index < len(self):
            raise IndexError(f"no feature {index}; there are {len(self)}")
        return self._native.feature(index % len(self))

    def __iter__(self) -> Iterator[_native.Feature]:
        return (self._native.feature(i) for i in range(len(self)))

    @property
    def name(self) -> str:
        """Name of the whole model, or ''."""
        return self._native.name

    @property
    def format(self) -> str:
        """Format of the file, such as 'CityGML 3.0'."""
        return self._native.format

    @property
    def source(self) -> str:
        """Path as given."""
        return self._native.source

    @property
    def crs(self) -> str:
        """Name of the coordinate reference system, or ''."""
        return self._native.crs

    @property
    def findings(self) -> list[Finding]:
        """Findings of reading, in order."""
        return self._native.findings

    def __repr__(self) -> str:
        return f"<svt.Model '{self.name or self.source}' {self.format}, {len(self)} features>"


def read(
    paths: PathLike | Sequence[PathLike],
    *,
    crs: str | int = "",
    axis_order: str = "by-name",
    unit: str = "of-file",
    date: str | datetime.date | None = None,
    keep_far_features: bool = False,
    allow_truncated: bool = False,
    extrude_footprints: bool = False,
    layers: bool = False,
    progress: Progress = None,
) -> Model:
    """Read a model: CityGML, CityJSON, CityJSONSeq or IFC, plain or gzip. The content determines the format.

    Parameters
    ----------
    paths
        A file, or several that together are one model.
    crs
        EPSG code of a projection in metres to which the model is transformed, such as 25832; default: that of the file.
    axis_order
        Order of the first two coordinates in the file: 'east-north' or 'north-east', regardless of its CRS; 'by-name': as
        the name of the CRS defines it.
    unit
        GML, CityJSON: unit of the coordinates in the file, if they are lengths: 'm', 'dm', 'cm', 'mm', 'in', 'ft' or
        'ftUS'; 'of-file': the unit that the file states, else metres.
    date
        Read the features that exist on this day: 'YYYY-MM-DD' or a datetime.date; 'all' reads all features. Default:
        those that have not ended today. A finding (E128) names the features that are left out.
    keep_far_features
        Keep features that lie far away from all others.
    allow_truncated
        Read a file that was cut off (IFC, CityJSONSeq) up to the cut; a finding reports it.
    extrude_footprints
        Make solids from footprints that have a height as attribute.
    layers
        IFC: split walls and slabs into the layers of their material.
    progress
        A function that gets (stage, fraction).

    Raises
    ------
    svt.Error
        E101 to E137 if the file cannot be read, E904 for an invalid argument.
    """
    options = {
        "crs": crs or None,
        "axis_order": axis_order,
        "unit": unit,
        "date": date,
        "keep_far_features": keep_far_features,
        "allow_truncated": allow_truncated,
        "extrude_footprints": extrude_footprints,
        "layers": layers,
    }
    return Model(_native.read(paths_of(paths), options, progress))


def sample(kind: str = "house", path: PathLike | None = None, *, seed: int = 1) -> str:
    """The text of a generated model (CityGML 3.0), for trials without a file.

    Parameters
    ----------
    kind
        'house' (furnished), 'tower' (flats and owners) or 'district'.
    path
        File that the text is also written to.
    seed
        Seed for the owners of the tower and the houses of the district.
    """
    text = _native.sample(kind, seed)
    if path is not None:
        with open(path, "w", encoding="utf-8", newline="") as file:
            file.write(text)
    return text

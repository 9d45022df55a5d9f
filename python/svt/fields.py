"""Fields of a volume: numbers with a unit, over time, beside the labels. Values never cross a wall."""
from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Iterator

import numpy as np

from . import _native
from .model import PathLike, Progress
from .optional import load

if TYPE_CHECKING:
    from .volume import Volume

#: Points in the coordinates of the model by their names: {"s1": (x, y, z)}.
Points = Mapping[str, Sequence[float]]


class Field:
    """A field: temperature, density of smoke, values of sensors. It never changes.

    `kind` says where the values stand:

    - ``"grid"``: at the nodes of a lattice,
    - ``"label"``: at the components, in the order of Volume.labels,
    - ``"points"``: at named points, such as sensors.
    """

    def __init__(self, volume: Volume, native: _native.Field) -> None:
        self._volume = volume
        self._native = native
        self._head = native.head

    @property
    def name(self) -> str:
        return self._head["name"]

    @property
    def kind(self) -> str:
        """'grid', 'label' or 'points'."""
        return self._head["kind"]

    @property
    def quantity(self) -> str:
        """Quantity, such as 'temperature', or ''."""
        return self._head["quantity"]

    @property
    def unit(self) -> str:
        """UCUM code, such as 'Cel' or 'kg/m3'; '1' for a number without unit."""
        return self._head["unit"]

    @property
    def components(self) -> int:
        """1, or 3 for vectors along x, y, z of the grid of the volume."""
        return self._head["components"]

    @property
    def medium(self) -> str:
        """Voxels with values: 'air', 'solid', 'all' or a query."""
        return self._head["medium"]

    @property
    def times(self) -> np.ndarray:
        """Seconds, ascending: float64 array."""
        return self._head["times"]

    @property
    def epoch(self) -> str | None:
        """Date and time of 0 s in ISO 8601, or None."""
        return self._head["epoch"]

    @property
    def precision(self) -> float:
        """Step between stored values; 0: 32-bit floats."""
        return self._head["precision"]

    @property
    def by(self) -> str:
        """Program that made the values, or ''."""
        return self._head["by"]

    @property
    def parameters(self) -> dict[str, Any]:
        """Everything that was assumed for the values."""
        return json.loads(self._head["parameters"]) if self._head["parameters"] else {}

    @property
    def points(self) -> dict[str, tuple[float, float, float]]:
        """Points of a field of points by name, in the coordinates of the model."""
        return dict(zip(self._head["point_ids"], self._head["points"]))

    @property
    def nodes(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Positions of the nodes of a grid along i, j and k of the volume: three arrays; sample (i, j, k) is at i, j, k."""
        if self.kind != "grid":
            raise ValueError(f"the field '{self.name}' has no lattice; it is of kind '{self.kind}'")
        head = self._head
        if head["positions"][0]:
            return tuple(np.array(axis) for axis in head["positions"])  # type: ignore[return-value]
        along = zip(head["first"], head["step"], head["size"])
        return tuple(first + step * np.arange(size) for first, step, size in along)  # type: ignore[return-value]

    @property
    def values(self) -> np.ndarray:
        """All values: float32 array, NaN where a value is missing. Read-only, not a copy.

        The axes are time, component (only of vectors), then z, y, x of a grid, or the labels or the points.
        """
        return self._native.values

    def dense(self, time: int = 0, component: int = 0) -> np.ndarray:
        """The values at one of `times`: [k, j, i] of a grid, else one per label or point. Read-only, not a copy."""
        values = self.values[time]
        return values[component] if self.components > 1 else values

    def sample(self, points: Any, time: float | None = None) -> np.ndarray:
        """Values at points: float32 array (...), or (..., 3) of vectors; NaN where the field has no value.

        A value is interpolated only from nodes that the point reaches through voxels of its medium, so it never crosses a
        wall (docs/user/fields.md).

        Parameters
        ----------
        points
            Array (..., 3) in the coordinates of the model, metres.
        time
            Seconds; linear between two times, and that of the first or last time beyond them. Default: the first time.
        """
        seconds = float(self.times[0] if time is None else time)
        return _native.sample_field(self._native, points, seconds)

    def stats(
        self,
        by: str | None = None,
        *,
        over: float | None = None,
        under: float | None = None,
        by_time: bool = True,
        progress: Progress = None,
    ) -> np.ndarray:
        """Statistics per component, as of `svt field stats`: a structured array.

        The columns are label (index in Volume.labels), time (seconds), mean, min, max, deviation (in the unit; of vectors
        the length), volume and missing (m3 with and without values), and with limits share_over and share_under (0 to 1).
        NaN is unknown. ``pandas.DataFrame(field.stats())`` makes a table.

        Parameters
        ----------
        by
            A row for each feature that a query selects, such as ``'class=BuildingRoom'``; storeys with all their parts.
            Default: all components in the medium.
        over, under
            Limits in the unit of the field.
        by_time
            False: a row per component over all times, without time, and with hours_over, hours_under and hours_unknown: the
            hours in which the mean is beyond the limit.
        """
        columns = _native.field_statistics(self._native, by, over, under, by_time, progress)
        rows = np.empty(len(columns["label"]), [(name, values.dtype) for name, values in columns.items()])
        for name, values in columns.items():
            rows[name] = values
        return rows

    def to_xarray(self) -> Any:
        """The values as an xarray.DataArray with units and coordinates; needs xarray.

        The dimensions are time, component (of vectors), then z, y, x, or label, or point. Coordinates are in metres in the
        CRS of the model. Times are dates (UTC) if the field has an epoch, else seconds.
        """
        load("xarray", "Field.to_xarray()")
        from .xarray_backend import field_array  # imports xarray

        return field_array(self._volume, self)

    def __repr__(self) -> str:
        return f"<svt.Field '{self.name}' {self.kind}, {self.unit}, {len(self.times)} times, medium '{self.medium}'>"


class Fields(Mapping):
    """The fields of a `.svt` by name. Values are read when a field is asked for.

    ``v.fields["warm"]`` is a :class:`svt.Field`. A volume that was not opened from a `.svt` has none: save it, open the
    file, and add fields to it.
    """

    def __init__(self, volume: Volume) -> None:
        self._volume = volume

    @property
    def _path(self) -> str:
        """The file of the volume. Raises ValueError for a volume in memory."""
        path = self._volume._native.path
        if path is None:
            raise ValueError("the volume has no file; save it as .svt, open that file, and use its fields")
        return os.fspath(path)

    def _heads(self) -> dict[str, dict[str, Any]]:
        return {} if self._volume._native.path is None else _native.list_fields(self._path)

    def __iter__(self) -> Iterator[str]:
        return iter(self._heads())

    def __len__(self) -> int:
        return len(self._heads())

    def __contains__(self, name: object) -> bool:
        return name in self._heads()

    def __getitem__(self, name: str) -> Field:
        return self.read(name)

    def read(self, name: str, *, progress: Progress = None) -> Field:
        """A field with all values. Raises KeyError with the names of the fields."""
        heads = self._heads()
        if name not in heads:
            raise KeyError(f"no field has the name '{name}'; the fields are: {', '.join(heads) or 'none'}")
        return Field(self._volume, _native.read_field(self._volume._native, self._path, name, progress))

    def add(
        self,
        name: str,
        values: Any,
        *,
        unit: str,
        kind: str = "grid",
        quantity: str = "",
        medium: str = "all",
        times: Sequence[float] = (0,),
        epoch: str | None = None,
        components: int = 1,
        nodes: Sequence[Any] | None = None,
        points: Points | None = None,
        precision: float = 0,
        by: str = "",
        parameters: Mapping[str, Any] | None = None,
        output: PathLike | None = None,
        progress: Progress = None,
    ) -> Field:
        """Add a field to the file of the volume, in place of one with the same name, and return it.

        The file is written anew beside itself, then replaced. Labels are copied as bytes.

        Parameters
        ----------
        name
            Letters, digits, '_', '-' and '.'; begins with a letter.
        values
            Array as :attr:`Field.values`; the axes of a single time and of a single component may be left out. NaN is a
            missing value. Of kind 'label' also {label or id: value}, of kind 'points' also {name: value}.
        unit
            UCUM code, such as 'Cel', 'kg/m3', '[ppm]'; '1' for a number without unit.
        kind
            'grid', 'label' or 'points'.
        medium
            Voxels with values: 'air' (empty space and rooms), 'solid' (all others), 'all', or a query.
        times
            Seconds, ascending, one for each entry of the first axis.
        epoch
            Date and time of 0 s in ISO 8601 with zone, such as '2026-01-05T00:00:00Z'.
        components
            3 for vectors along x, y, z of the grid of the volume.
        nodes
            Positions of the nodes of a grid along i, j and k, as :attr:`Field.nodes`. Default: the samples of the volume.
        points
            Of kind 'points': coordinates by name.
        precision
            Step between stored values in the unit, for 16-bit storage; 0 keeps 32-bit floats.
        by, parameters
            Program that made the values, and everything that was assumed for them.
        output
            The `.svt` to write; default: the file of the volume. Another file gets all its fields, and the new one.
        """
        path = self._path
        head: dict[str, Any] = {
            "name": name,
            "kind": kind,
            "quantity": quantity,
            "unit": unit,
            "components": components,
        }
        head |= {"medium": medium, "times": [float(t) for t in times], "epoch": epoch, "precision": precision, "by": by}
        head["parameters"] = json.dumps(parameters) if parameters else ""
        head |= _lattice_of(nodes, self._volume.dimension)
        places = {} if points is None else {key: tuple(map(float, at)) for key, at in points.items()}
        head |= {"point_ids": list(places), "points": list(places.values())}
        count = {"label": len(self._volume.labels), "points": len(places)}
        axes = head["size"][::-1] if kind == "grid" else (count.get(kind, 0),)
        shape = (len(head["times"]),) + ((components,) if components > 1 else ()) + tuple(axes)
        if isinstance(values, Mapping):
            values = self._of_mapping(values, kind, list(places))
        array = np.asarray(values, np.float32)
        squeezed = tuple(n for i, n in enumerate(shape) if not (i == 0 and n == 1))
        if array.shape not in (shape, squeezed):
            raise ValueError(f"values: expected an array of shape {shape}, found {array.shape}")
        target = path if output is None else os.fspath(output)
        _native.add_field(self._volume._native, path, target, head, array.reshape(shape), progress)
        written = _native.read_field(self._volume._native, target, name, progress)
        return Field(self._volume, written)

    def remove(self, *names: str, output: PathLike | None = None) -> None:
        """Remove fields from the file of the volume, or write a copy without them to `output`."""
        _native.remove_fields(self._path, self._path if output is None else os.fspath(output), list(names))

    def _of_mapping(self, values: Mapping[Any, Any], kind: str, names: list[str]) -> np.ndarray:
        """Values by label or by name of a point as an array; the others are missing."""
        if kind == "grid":
            raise ValueError("values: expected an array for a field of kind 'grid'")
        length = len(self._volume.labels) if kind == "label" else len(names)
        series = np.atleast_1d(np.asarray(next(iter(values.values())), np.float32)) if values else np.zeros(1)
        array = np.full((len(series), length), np.nan, np.float32)
        for key, value in values.items():
            if kind == "label":
                place = key.index if isinstance(key, _native.Label) else self._volume.labels[key].index
            elif key in names:
                place = names.index(key)
            else:
                raise ValueError(f"values: '{key}' is not one of the points")
            array[:, place] = value
        return array

    def __repr__(self) -> str:
        return f"<svt.Fields: {', '.join(self) or 'none'}>"


def _lattice_of(nodes: Sequence[Any] | None, dimension: Sequence[int]) -> dict[str, Any]:
    """The members of a lattice: regular where the positions are evenly spaced."""
    lattice: dict[str, Any] = {"first": (0.0, 0.0, 0.0), "step": (1.0, 1.0, 1.0), "positions": ([], [], [])}
    if nodes is None:
        return lattice | {"size": tuple(dimension)}
    axes = [np.atleast_1d(np.asarray(axis, float)) for axis in nodes]
    if len(axes) != 3 or any(axis.ndim != 1 or axis.size == 0 for axis in axes):
        raise ValueError("nodes: expected the positions along i, j and k: three lists of numbers")
    lattice["size"] = tuple(axis.size for axis in axes)
    steps = [axis[1] - axis[0] if axis.size > 1 else 1.0 for axis in axes]
    regular = all(np.array_equal(axis, axis[0] + step * np.arange(axis.size)) for axis, step in zip(axes, steps))
    if regular:
        return lattice | {"first": tuple(axis[0] for axis in axes), "step": tuple(steps)}
    return lattice | {"positions": tuple(axis.tolist() for axis in axes)}

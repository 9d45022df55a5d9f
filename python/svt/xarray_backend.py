"""Volumes as datasets of xarray: `xarray.open_dataset("house.svt")`, and :meth:`svt.Volume.to_xarray`.

Import this module only where xarray is installed; xarray finds it by an entry point.
"""
from __future__ import annotations

import copy
import datetime
import os
from typing import Any, Iterable

import numpy as np
import xarray
from xarray.backends import BackendArray, BackendEntrypoint
from xarray.core import indexing

from . import _native
from .cf import flag_meanings, grid_mapping
from .fields import Field
from .volume import Box, Volume, open

#: Bytes of a chunk that dask gets by default.
_CHUNK_BYTES = 32_000_000


class VolumeArray(BackendArray):
    """The samples of a volume as in :meth:`svt.Volume.dense`, unpacked when they are read.

    Parameters
    ----------
    reopen
        The arguments of :func:`_volume_of` for another process; None if the volume has no file.
    """

    def __init__(self, volume: Volume, reopen: tuple | None) -> None:
        self._volume = volume
        self._reopen = reopen
        self.shape = volume.shape
        self.dtype = volume.dtype

    def __getitem__(self, key: indexing.ExplicitIndexer) -> np.ndarray:
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.BASIC, self._read)

    def _read(self, key: tuple[int | slice, ...]) -> np.ndarray:
        wanted = [
            range(*k.indices(size)) if isinstance(k, slice) else range(k % size, k % size + 1)
            for k, size in zip(key, self.shape)
        ]
        dropped = tuple(0 if isinstance(k, (int, np.integer)) else slice(None) for k in key)
        if not all(map(len, wanted)):
            return np.empty([len(along) for along in wanted], self.dtype)[dropped]
        z, y, x = wanted
        # With a step along z, only the wanted slices are unpacked.
        slabs = [z] if abs(z.step) == 1 else [range(k, k + 1) for k in z]
        return np.concatenate([self._slab(slab, y, x) for slab in slabs])[dropped]

    def _slab(self, z: range, y: range, x: range) -> np.ndarray:
        first = min(x[0], x[-1]), min(y[0], y[-1]), min(z[0], z[-1])
        end = max(x[0], x[-1]) + 1, max(y[0], y[-1]) + 1, max(z[0], z[-1]) + 1
        slab = _native.dense_slab(self._volume._native, first, end)
        return slab[:: z.step, :: y.step, :: x.step]

    def __deepcopy__(self, memo: dict) -> VolumeArray:
        return self  # a volume never changes

    def __reduce__(self) -> Any:
        if self._reopen is None:
            raise TypeError("a volume in memory cannot be sent to another process; save it and open the file")
        return _array_of, self._reopen


def _volume_of(path: str, level: int, box: Any) -> Volume:
    volume = open(path)
    return volume if level == 0 and box is None else volume.part(level=level, box=box)


def _array_of(*arguments: Any) -> VolumeArray:
    return VolumeArray(_volume_of(*arguments), arguments)


def _metres(name: str, axis: str, values: np.ndarray, dimensions: Any, is_projected: bool) -> xarray.Variable:
    attributes = {"units": "m", "long_name": {"X": "x", "Y": "y", "Z": "height"}[axis]}
    if name in ("x", "y", "z"):
        attributes["axis"] = axis
    if axis == "Z":
        attributes["positive"] = "up"
    elif is_projected:
        attributes["standard_name"] = f"projection_{axis.lower()}_coordinate"
    return xarray.Variable(dimensions, values, attributes)


def _places(volume: Volume, is_projected: bool, nodes: Any = None) -> dict[str, xarray.Variable]:
    """Coordinates in metres in the CRS. A grid turned about z has xc and yc by (y, x); one turned otherwise, none.

    Parameters
    ----------
    nodes
        Positions along i, j and k; default: the samples of the volume.
    """
    axes = np.array(volume.axes)
    along_i, along_j, along_k = map(np.arange, volume.dimension) if nodes is None else nodes
    nz, ny, nx = len(along_k), len(along_j), len(along_i)
    if np.abs(axes[2] - (0, 0, 1)).max() > 1e-12:
        return {}
    along = np.zeros((nz, 3))
    along[:, 2] = along_k
    places = {"z": _metres("z", "Z", volume.world(along)[:, 2], "z", is_projected)}
    index = np.zeros((ny, nx, 3))
    if np.abs(axes - np.eye(3)).max() > 1e-12:
        index[..., 1], index[..., 0] = np.meshgrid(along_j, along_i, indexing="ij")
        world = volume.world(index)
        for name, axis in (("xc", 0), ("yc", 1)):
            places[name] = _metres(name, "XY"[axis], world[..., axis], ("y", "x"), is_projected)
        return places
    index[0, :, 0], index[:, 0, 1] = along_i, along_j
    places["y"] = _metres("y", "Y", volume.world(index[:, 0])[:, 1], "y", is_projected)
    places["x"] = _metres("x", "X", volume.world(index[0])[:, 0], "x", is_projected)
    return places


def _components(volume: Volume) -> tuple[dict[str, xarray.Variable], list[str]]:
    """The component of each value of the samples, as columns; and a word of CF for each."""
    owners = [None if label < 0 else volume.labels[int(label)] for label in volume.labels.of_scalar]

    def column(values: Iterable[Any], kind: Any, long_name: str) -> xarray.Variable:
        return xarray.Variable("component", np.array(list(values), kind), {"long_name": long_name})

    parents = (owner and owner.parent for owner in owners)
    columns = {
        "component_label": column((-1 if o is None else o.index for o in owners), np.int32, "number in Volume.labels"),
        "component_id": column(("" if o is None else o.id for o in owners), object, "id in the model"),
        "component_class": column(("" if o is None else o.class_name for o in owners), object, "class by CityGML 3.0"),
        "component_name": column(("background" if o is None else o.name for o in owners), object, "name"),
        "component_parent": column(
            ("" if p is None else p.id for p in parents), object, "id of the parent in the tree"
        ),
    }
    words = flag_meanings(("background", "") if o is None else (o.name or o.id, f"component_{o.index}") for o in owners)
    return columns, words


def _dataset(volume: Volume, reopen: tuple | None) -> xarray.Dataset:
    mapping = grid_mapping(volume.crs)
    variables, words = _components(volume)
    attributes: dict[str, Any] = {
        "long_name": "component at the centre of the voxel",
        "flag_values": np.arange(len(words), dtype=volume.dtype),
        "flag_meanings": " ".join(words),
    }
    if mapping:
        attributes["grid_mapping"] = "crs"
        variables["crs"] = xarray.Variable((), np.int32(0), mapping)
    nz, ny, nx = volume.shape
    slices = max(1, min(nz, _CHUNK_BYTES // (nx * ny * volume.dtype.itemsize)))
    variables["label"] = xarray.Variable(
        ("z", "y", "x"),
        indexing.LazilyIndexedArray(VolumeArray(volume, reopen)),
        attributes,
        {"preferred_chunks": {"z": slices, "y": ny, "x": nx}, "zlib": True, "complevel": 1},
    )
    about = {
        "Conventions": "CF-1.10",
        "title": volume.name,
        "source": volume.source,
        "crs_name": volume.crs,
        "origin": list(volume.origin),
        "spacing": list(volume.spacing),
        "axes": [number for axis in volume.axes for number in axis],
    }
    return xarray.Dataset(variables, _places(volume, bool(mapping)), {key: v for key, v in about.items() if v != ""})


def _time(field: Field) -> xarray.Variable:
    """Times of a field: dates if it has an epoch, else seconds."""
    if field.epoch is None:
        return xarray.Variable("time", field.times, {"units": "s", "long_name": "time"})
    begin = datetime.datetime.fromisoformat(field.epoch.replace("Z", "+00:00"))
    utc = np.datetime64(begin.astimezone(datetime.timezone.utc).replace(tzinfo=None), "ns")
    return xarray.Variable("time", utc + np.round(field.times * 1e9).astype("timedelta64[ns]"), {"long_name": "time"})


def field_array(volume: Volume, field: Field) -> xarray.DataArray:
    """The values of a field with their units and coordinates."""
    coordinates: dict[str, xarray.Variable] = {"time": _time(field)}
    attributes = {"units": field.unit, "long_name": field.quantity or field.name, "medium": field.medium}
    mapping = grid_mapping(volume.crs)
    dimensions: tuple[str, ...] = {"grid": ("z", "y", "x"), "label": ("label",), "points": ("point",)}[field.kind]
    if field.kind == "grid":
        coordinates.update(_places(volume, bool(mapping), field.nodes))
    elif field.kind == "label":
        coordinates["label"] = xarray.Variable("label", np.array([label.id for label in volume.labels], object))
    else:
        at = np.array(list(field.points.values())).reshape(-1, 3)
        coordinates["point"] = xarray.Variable("point", np.array(list(field.points), object))
        for axis, name in enumerate("xyz"):
            coordinates[name] = _metres(name, name.upper(), at[:, axis], "point", bool(mapping))
    if mapping:
        attributes["grid_mapping"] = "crs"
        coordinates["crs"] = xarray.Variable((), np.int32(0), mapping)
    if field.components > 1:
        dimensions = ("component",) + dimensions
        coordinates["component"] = xarray.Variable("component", ["x", "y", "z"])
    return xarray.DataArray(field.values, coordinates, ("time",) + dimensions, field.name, attributes)


class SvtBackendEntrypoint(BackendEntrypoint):
    """Opens `.svt` files for xarray. Samples are unpacked slab by slab when they are read."""

    description = "Open semantic volume textures of buildings (.svt)"
    open_dataset_parameters = ("filename_or_obj", "drop_variables", "level", "box")

    def guess_can_open(self, filename_or_obj: Any) -> bool:
        """Whether it is the name of a `.svt` file."""
        if not isinstance(filename_or_obj, (str, os.PathLike)):
            return False
        return os.fspath(filename_or_obj).lower().endswith(".svt")

    def open_dataset(
        self,
        filename_or_obj: Any,
        *,
        drop_variables: str | Iterable[str] | None = None,
        level: int = 0,
        box: Box | None = None,
    ) -> xarray.Dataset:
        """The dataset of a file, or of a :class:`svt.Volume`.

        Parameters
        ----------
        level
            0 to 6: cells of 2**level samples along each axis, each with the label that fills most of it.
        box
            World box in metres: only the samples in it.
        """
        if isinstance(filename_or_obj, Volume):
            volume = filename_or_obj
            reopen = None
            if level != 0 or box is not None:
                volume = volume.part(level=level, box=box)
        else:
            reopen = (os.fspath(filename_or_obj), level, copy.copy(box))
            volume = _volume_of(*reopen)
        drop = [drop_variables] if isinstance(drop_variables, str) else list(drop_variables or ())
        return _dataset(volume, reopen).drop_vars(drop, errors="ignore")


def dataset_of(volume: Volume, level: int, box: Box | None) -> xarray.Dataset:
    """The dataset of a volume, with samples unpacked when they are read, and then kept."""
    return xarray.open_dataset(volume, engine=SvtBackendEntrypoint, level=level, box=box)

"""The labels of a volume: the components to which samples belong."""
from __future__ import annotations

import difflib
import operator
from collections.abc import Sequence
from typing import Any, Iterator

import numpy as np

from . import _native
from .tables import columns_of_labels, to_pandas


class Labels(Sequence):
    """All labels of a volume, in the order of the tree: a sequence of :class:`svt.Label`.

    ``labels[3]`` is the fourth label. ``labels["Unterzug-1"]`` is the label with that id, or else the only one with
    that name.
    """

    def __init__(self, native: _native.Volume) -> None:
        self._native = native
        self._numbers: tuple[dict[str, int], dict[str, list[int]]] | None = None  # by id, by name
        self._of_scalar: np.ndarray | None = None

    def __len__(self) -> int:
        return self._native.label_count

    def __iter__(self) -> Iterator[_native.Label]:
        return (self._native.label(i) for i in range(len(self)))

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, slice):
            return [self._native.label(i) for i in range(*key.indices(len(self)))]
        if isinstance(key, str):
            return self._native.label(self._find(key))
        index = operator.index(key)
        if not -len(self) <= index < len(self):
            raise IndexError(f"no label {index}; there are {len(self)}")
        return self._native.label(index % len(self))

    def __contains__(self, key: object) -> bool:
        if not isinstance(key, str):
            return any(label == key for label in self)
        by_id, by_name = self._index()
        return key in by_id or key in by_name

    @property
    def of_scalar(self) -> np.ndarray:
        """Label of each scalar: int32 array, entry s is the index of the label that owns scalar s, -1 for background.

        ``v.labels.of_scalar[v.dense()]`` is the label of every sample. Read-only, computed once.
        """
        if self._of_scalar is None:
            self._of_scalar = _native.label_of_scalar(self._native)
            self._of_scalar.flags.writeable = False
        return self._of_scalar

    def to_pandas(self, query: str = "all", *, attributes: bool = False, faces: bool = False) -> Any:
        """The labels that a query selects, as a pandas.DataFrame with one row per label.

        The index is the number of the label. The columns are id, class_name, name, parent (an id), voxels, volume (m3
        with all parts), volume_bound, volume_source, voxel_volume, area (m2), outside_area, total_volume and total_area
        (with all parts), and filling, as of :class:`svt.Label`. NaN: a surface has no volume, and a label without voxels
        has no area. The areas of all labels are measured once.

        Parameters
        ----------
        attributes
            Add a column ``attributes.NAME`` for each attribute; None where a label has no such attribute, a list where
            it has several values.
        faces
            Add the columns faces.roof, faces.wall, faces.ground, faces.window and faces.door: m2 of the model's faces
            with all parts, as of :attr:`svt.Label.faces`. NaN: none, or unknown because the volume keeps no meshes.
        """
        labels = [self._native.label(index) for index in self._native.query(query)]
        return to_pandas(columns_of_labels(labels, attributes, faces), "Labels.to_pandas()")

    def _index(self) -> tuple[dict[str, int], dict[str, list[int]]]:
        if self._numbers is None:
            by_id: dict[str, int] = {}
            for index, label_id in enumerate(self._native.ids):
                by_id.setdefault(label_id, index)
            by_name: dict[str, list[int]] = {}
            for index, name in enumerate(self._native.names):
                if name:
                    by_name.setdefault(name, []).append(index)
            self._numbers = by_id, by_name
        return self._numbers

    def _find(self, key: str) -> int:
        by_id, by_name = self._index()
        if key in by_id:
            return by_id[key]
        named = by_name.get(key, [])
        if len(named) == 1:
            return named[0]
        if named:
            raise KeyError(f"{len(named)} labels have the name '{key}'; take one by its id, or all by query()")
        near = difflib.get_close_matches(key, list(by_id) + list(by_name), 1)
        raise KeyError(f"no label has the id or name '{key}'" + (f"; did you mean '{near[0]}'?" if near else ""))

    def __repr__(self) -> str:
        return f"<svt.Labels: {len(self)}>"

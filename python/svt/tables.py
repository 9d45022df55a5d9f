"""Labels and sections as tables: one column per property, which pandas makes a DataFrame of."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Sequence

import numpy as np

from . import _native
from .optional import load

if TYPE_CHECKING:
    from .section import Component


def _known(values: list[float | None]) -> np.ndarray:
    """Numbers as float64; unknown ones are NaN."""
    return np.array([np.nan if value is None else value for value in values], float)


def columns_of_labels(labels: Sequence[_native.Label], attributes: bool, faces: bool) -> dict[str, Any]:
    """Column -> values, one per label. The columns are those of :meth:`svt.Labels.to_pandas`."""
    parents = [label.parent for label in labels]
    columns: dict[str, Any] = {
        "label": np.array([label.index for label in labels], np.int64),
        "id": [label.id for label in labels],
        "class_name": [label.class_name for label in labels],
        "name": [label.name for label in labels],
        "parent": [None if parent is None else parent.id for parent in parents],
        "voxels": np.array([label.voxels for label in labels], np.int64),
        "volume": _known([label.volume for label in labels]),
        "volume_bound": _known([label.volume_bound for label in labels]),
        "volume_source": [label.volume_source for label in labels],
        "voxel_volume": _known([label.voxel_volume if label.voxels else None for label in labels]),
        "area": _known([label.area if label.voxels else None for label in labels]),
        "outside_area": _known([label.outside_area if label.voxels else None for label in labels]),
        "total_volume": _known([label.total_volume for label in labels]),
        "total_area": _known([label.total_area if label.total_voxels else None for label in labels]),
        "filling": [label.filling for label in labels],
    }
    if faces:
        areas = [label.faces for label in labels]
        kinds = ("roof", "wall", "ground", "window", "door")
        columns.update({f"faces.{kind}": _known([each[kind] for each in areas]) for kind in kinds})
    if attributes:
        known = [label.attributes for label in labels]
        names: dict[str, None] = {}  # in the order of the model
        for each in known:
            names.update(dict.fromkeys(each))
        columns.update({f"attributes.{name}": [each.get(name) for each in known] for name in names})
    return columns


def columns_of_components(components: Sequence[Component]) -> dict[str, Any]:
    """Column -> values, one per component of a section. The columns are those of :meth:`svt.Section.to_pandas`."""
    return {
        "label": np.array([component.label.index for component in components], np.int64),
        "id": [component.label.id for component in components],
        "class_name": [component.label.class_name for component in components],
        "name": [component.label.name for component in components],
        "polygons": np.array([len(component.polygons) for component in components], np.int64),
        "area": np.array([component.area for component in components], float),
        "area_bound": np.array([component.area_bound for component in components], float),
        "is_exact": np.array([component.is_exact for component in components], bool),
        "line_length": np.array([component.line_length for component in components], float),
    }


def to_pandas(columns: dict[str, Any], user: str) -> Any:
    """A pandas.DataFrame of columns, with the number of the label as index."""
    return load("pandas", user).DataFrame(columns).set_index("label")

"""Quantities of objects as a table: volumes with and without openings, areas and lengths."""
from __future__ import annotations

from typing import Any

import numpy as np

from . import _native
from .model import Model, PathLike, Progress
from .tables import to_pandas
from .volume import Volume, build, open

#: Columns that are not numbers.
_OTHERS = ("label", "openings", "trust")


def _volume_of(model: Volume | Model | PathLike, options: dict[str, Any], progress: Progress) -> Volume:
    if isinstance(model, Volume) or (not isinstance(model, Model) and str(model).lower().endswith(".svt")):
        if options:
            raise TypeError(f"a volume is built already; options such as {next(iter(options))!r} need a model")
        return model if isinstance(model, Volume) else open(model, progress=progress)
    return build(model, vectors="meshes", progress=progress, **options)


def columns_of_quantities(volume: Volume, query: str | None, exterior: bool, progress: Progress) -> dict[str, Any]:
    """Column -> values, one per object. The columns are those of :func:`svt.quantities`."""
    measured = _native.quantities(volume._native, query, exterior, progress)
    labels = [volume.labels[index] for index in measured["label"]]
    columns: dict[str, Any] = {
        "label": np.array(measured["label"], np.int64),
        "id": [label.id for label in labels],
        "class_name": [label.class_name for label in labels],
        "name": [label.name for label in labels],
    }
    for name, values in measured.items():
        if name not in _OTHERS:
            columns[name] = np.array([np.nan if value is None else value for value in values], float)
    columns["openings"] = measured["openings"]
    columns["trust"] = measured["trust"]
    return columns


def quantities(
    model: Volume | Model | PathLike,
    query: str | None = None,
    *,
    exterior: bool = False,
    progress: Progress = None,
    **options: Any,
) -> Any:
    """Quantities of the objects of a model as a pandas.DataFrame with one row per object, as of `svt quantities`.

    The index is the number of the label. The columns are id, class_name, name, net_volume, gross_volume (m3), side_area,
    top_area, bottom_area, outer_area, opening_area (m2), thickness, length, width, height, perimeter (m), bound and
    gross_bound (m3), openings (a number) and trust. A number that is unknown is NaN; openings and trust are None.

    Parameters
    ----------
    model
        A volume, a model from svt.read(), or a path. A volume needs meshes for areas, lengths and openings.
    query
        Only the objects that a query selects; without it, all components.
    exterior
        Add the columns exterior_n, exterior_ne, ... exterior_top and exterior_bottom: m2 that outside air touches, by
        orientation. North is +y.
    progress
        A function that gets (stage, fraction) on the calling thread. An exception from it, or Ctrl-C, stops the work.
    options
        Of svt.build(), such as ``spacing=0.1``, if the model is not a volume.

    Rows have the whole volume of their object. Space that several objects share is in each of their rows, so sums of the
    column can exceed the volume of the union; `svt quantities` counts such space once.
    """
    volume = _volume_of(model, options, progress)
    return to_pandas(columns_of_quantities(volume, query, exterior, progress), "svt.quantities()")

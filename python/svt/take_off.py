"""Take-offs: quantities with sums by keys, formwork, exterior areas and stated quantities, and contacts of objects."""
from __future__ import annotations

import json
import os
import tempfile
from typing import Any, Mapping, Sequence

from .command import arguments_of, run_command
from .model import PathLike
from .optional import load
from .volume import Volume

#: Options that this module sets.
_OWN = {"json", "csv", "quiet", "verbose", "format", "output", "between", "settings"}
#: Columns of tables that hold texts.
_TEXTS = {"id", "class_name", "name", "storey", "material", "trust", "quantity", "a", "a_name", "b", "b_name"}


def _snake(name: str) -> str:
    """netVolume is net_volume; class is class_name, because Python reserves the word."""
    if name == "class":
        return "class_name"
    return "".join("_" + letter.lower() if letter.isupper() else letter for letter in name)


def _frame(rows: Sequence[Mapping[str, Any]], texts: set[str], what: str) -> Any:
    """A pandas.DataFrame; unknown numbers are NaN, and unknown texts are None."""
    pandas = load("pandas", what)
    names = list(dict.fromkeys(name for row in rows for name in row))
    columns = {}
    for name in names:
        values = [row.get(name) for row in rows]
        columns[name] = pandas.Series(values, dtype=object if name in texts else float)
    return pandas.DataFrame(columns)


def _renamed(row: Mapping[str, Any]) -> dict[str, Any]:
    return {_snake(name): value for name, value in row.items()}


class TakeOff:
    """Rows and sums of a model, as :func:`svt.take_off` gives them.

    Attributes
    ----------
    rows : list of dict
        One per object, with the keys of `svt quantities --json`. Unknown values are None.
    sums : list of dict
        One for each combination of the values of the keys: `by`, `objects`, sums by their names, `bound`, and `unknown`,
        the number of rows that a sum excludes. Empty without keys.
    total : dict
        The same sums over all rows.
    exterior : list of dict
        Per object its `id` and m2 by orientation: n, ne, e, se, s, sw, w, nw, top, bottom. Empty if not asked for.
    stated : list of dict
        The quantities that the file states, beside the measured ones. Empty if not asked for.
    assumptions : list of str
        Sentences that hold for these figures.
    """

    def __init__(self, report: Mapping[str, Any]) -> None:
        self.rows: list[dict[str, Any]] = report["rows"]
        self.sums: list[dict[str, Any]] = report.get("sums", [])
        self.total: dict[str, Any] = report["total"]
        self.exterior: list[dict[str, Any]] = report.get("exterior", [])
        self.stated: list[dict[str, Any]] = report.get("stated", [])
        self.assumptions: list[str] = report["assumptions"]

    def to_pandas(self) -> Any:
        """The rows as a pandas.DataFrame, with snake_case names. With exterior areas, also exterior_n to exterior_bottom.

        Unknown numbers are NaN, unknown texts None.
        """
        rows = [_renamed(row) for row in self.rows]
        for row, areas in zip(rows, self.exterior):
            row.update({"exterior_" + way: area for way, area in areas.items() if way != "id"})
        return _frame(rows, _TEXTS, "TakeOff.to_pandas()")

    def sums_to_pandas(self) -> Any:
        """The sums as a pandas.DataFrame: a column for each key, then objects and the sums.

        A sum leaves out objects whose figure is unknown; unknown_net_volume and others have their number.
        """
        rows, keys = [], set()
        for sums in self.sums:
            row: dict[str, Any] = dict(sums["by"])
            keys |= set(row)
            row.update(_renamed({name: value for name, value in sums.items() if not isinstance(value, dict)}))
            row.update({"exterior_" + way: area for way, area in sums.get("exterior", {}).items()})
            row.update({"unknown_" + _snake(name): count for name, count in sums.get("unknown", {}).items()})
            rows.append(row)
        frame = _frame(rows, keys, "TakeOff.sums_to_pandas()")
        unknown = [name for name in frame.columns if name.startswith("unknown_")]
        frame[unknown] = frame[unknown].fillna(0)
        return frame

    def stated_to_pandas(self) -> Any:
        """The stated quantities as a pandas.DataFrame: id, class_name, name, quantity, stated, measured, difference."""
        return _frame([_renamed(row) for row in self.stated], _TEXTS, "TakeOff.stated_to_pandas()")

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        volume = self.total["netVolume"]
        return f"<svt.TakeOff: {len(self.rows)} objects, {'unknown' if volume is None else f'{volume:.3f}'} m3>"


def _report(model: Volume | PathLike, arguments: Sequence[str], outputs: Sequence[PathLike] = ()) -> Any:
    """The report of `svt quantities --json`."""
    with tempfile.TemporaryDirectory(prefix="svt-quantities-") as folder:
        if isinstance(model, Volume):
            file = os.path.join(folder, "model.svt")
            model.save(file)
        else:
            file = os.path.abspath(os.fspath(model))
        words = ["quantities", file, "--quiet", "--json", *arguments]
        for output in outputs:
            words += ["--output", os.path.abspath(os.fspath(output))]
        return json.loads(run_command(words))


def take_off(
    model: Volume | PathLike,
    query: str | None = None,
    *,
    by: str | Sequence[str] = (),
    exterior: bool = False,
    formwork: str | None = None,
    stated: bool = False,
    output: PathLike | None = None,
    **options: Any,
) -> TakeOff:
    """Measure the objects of a model, and add them up by keys. The command `svt quantities` does the work.

    Sums count space that several objects share once, so the sum of net volumes is the volume of the union.

    Parameters
    ----------
    model
        A path of a model, of a .svt or of a city, or a volume. A volume needs meshes for areas, lengths and openings.
    query
        Only the objects that a query selects; without it, all components.
    by
        Keys of the sums, such as ``["class", "storey"]`` or any attribute.
    exterior
        Areas that outside air touches, by orientation.
    formwork
        A query: areas of its objects that touch neither each other nor soil.
    stated
        Compare the quantities that the file states (Qto sets, BaseQuantities).
    output
        A file to write in addition: .csv, .json, .parquet, .xlsx, or .ifc for a copy of an IFC model with quantities.
    options
        Options of `svt quantities` without their dashes: spacing, dimension, lod, crs, layers and others; see
        docs/user/quantities.md.

    Raises
    ------
    svt.Error
        If the model cannot be read, a query or an option is wrong, or the command is missing.
    """
    keys = by if isinstance(by, str) else ",".join(by)
    arguments = arguments_of(options, _OWN, "svt.take_off()")
    for option, value in (("--where", query), ("--by", keys), ("--formwork", formwork)):
        if value:
            arguments.append(f"{option}={value}")
    arguments += ["--exterior"] * exterior + ["--stated"] * stated
    return TakeOff(_report(model, arguments, () if output is None else (output,)))


def contact_areas(model: Volume | PathLike, a: str, b: str, **options: Any) -> list[dict[str, Any]]:
    """The areas with which objects of two queries touch, one dict per pair.

    The keys are a, a_name, b, b_name, area (m2 of the faces of `a` that touch `b`) and area_of_b (m2 of the faces of `b`
    that touch `a`). The difference of both areas shows the error. ``pandas.DataFrame(contact_areas(...))`` is a table.

    Parameters
    ----------
    model
        As for svt.take_off().
    a, b
        Queries.
    options
        Options of `svt quantities` without their dashes, such as spacing.
    """
    arguments = arguments_of(options, _OWN | {"by", "where", "exterior", "formwork", "stated"}, "svt.contact_areas()")
    rows = _report(model, [*arguments, f"--between={a}", f"--between={b}"])
    return [_renamed(row) for row in rows]

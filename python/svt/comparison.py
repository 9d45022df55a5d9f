"""Two states of a building: the objects that were moved, changed, added or removed."""
from __future__ import annotations

import json
import os
import tempfile
from typing import Any, Mapping, Sequence

from .command import arguments_of, run_command
from .model import PathLike
from .optional import load
from .volume import Volume

#: Exit codes of the command: equal states, different states.
_EQUAL, _DIFFERENT = 0, 7
#: Options that this module sets.
_OWN = {"json", "csv", "all", "quiet", "verbose", "format", "output"}


class Comparison:
    """The rows of two states, as :func:`svt.diff` gives them.

    Attributes
    ----------
    rows : list of dict
        One per object, and one per storey or group, with the keys of `svt diff --json`. Unknown values are None.
    summary : dict
        Sums over all rows, with the keys of `svt diff --json`.
    is_different : bool
        Whether any row differs.
    """

    def __init__(self, rows: list[dict[str, Any]], summary: dict[str, Any]) -> None:
        self.rows = rows
        self.summary = summary

    @property
    def is_different(self) -> bool:
        return bool(self.summary["different"])

    @property
    def changes(self) -> list[dict[str, Any]]:
        """The rows that differ."""
        return [row for row in self.rows if _differs(row)]

    def to_pandas(self, all: bool = False) -> Any:
        """The rows as a pandas.DataFrame.

        Columns: change, class_name, old, new (lists of ids), name, storey, dx, dy, dz, rotation, added, removed, bound,
        distance (metres, degrees, m3; NaN: unknown), exact, properties and attributes (dicts of the old and the new value).

        Parameters
        ----------
        all
            Also rows that do not differ.
        """
        pandas = load("pandas", "Comparison.to_pandas()")
        rows = self.rows if all else self.changes
        vectors = [row["vector"] or (None, None, None) for row in rows]
        numbers: dict[str, list[float | None]] = {
            "dx": [vector[0] for vector in vectors],
            "dy": [vector[1] for vector in vectors],
            "dz": [vector[2] for vector in vectors],
            **{key: [row[key] for row in rows] for key in ("rotation", "added", "removed", "bound", "distance")},
        }
        return pandas.DataFrame(
            {
                "change": [row["change"] for row in rows],
                "class_name": [row["class"] for row in rows],
                **{key: [row[key] for row in rows] for key in ("old", "new", "name", "storey")},
                **{key: pandas.Series(values, dtype=float) for key, values in numbers.items()},
                **{key: [row[key] for row in rows] for key in ("exact", "properties", "attributes")},
            }
        )

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        counts = [f"{count} {change}" for change, count in self.summary["changes"].items() if count]
        return f"<svt.Comparison: {', '.join(counts) or 'no objects'}>"


def _differs(row: Mapping[str, Any]) -> bool:
    """Other ids are not a difference."""
    return row["change"] != "same" or bool(row["attributes"]) or any(name != "id" for name in row["properties"])


def diff(
    old: Volume | PathLike,
    new: Volume | PathLike,
    *,
    output: PathLike | Sequence[PathLike] = (),
    **options: Any,
) -> Comparison:
    """Compare two states of a building.

    Objects are matched by the space that they occupy, and by ids. The command `svt diff` does the work.

    Parameters
    ----------
    old, new
        A path of a model or of a .svt, or a volume. Volumes have exact m3 only with meshes.
    output
        Files to write in addition: .csv, .json, .html, .bcf or .svt.
    options
        Options of `svt diff` without their dashes: match, tolerance, properties, align, spacing, dimension, lod, crs
        and others; see docs/user/diff.md.

    Raises
    ------
    svt.Error
        If a state cannot be read, the states cannot be compared, an option is wrong, or the command is missing.
    """
    outputs = [output] if isinstance(output, (str, os.PathLike)) else list(output)
    with tempfile.TemporaryDirectory(prefix="svt-diff-") as folder:
        files = []
        for name, state in (("old", old), ("new", new)):
            if isinstance(state, Volume):
                files.append(os.path.join(folder, name + ".svt"))
                state.save(files[-1])
            else:
                files.append(os.path.abspath(os.fspath(state)))
        rows = os.path.join(folder, "rows.json")
        arguments = ["diff", *files, "--quiet", *arguments_of(options, _OWN, "svt.diff()"), "--output", rows]
        for each in outputs:
            arguments += ["--output", os.path.abspath(os.fspath(each))]
        run_command(arguments, (_EQUAL, _DIFFERENT))
        with open(rows, encoding="utf-8") as file:
            read = json.load(file)
    return Comparison(read["rows"], read["summary"])

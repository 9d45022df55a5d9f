"""Metadata of netCDF by the CF conventions: names as flags, coordinate reference systems as grid mappings."""
from __future__ import annotations

import json
import re
import unicodedata
from typing import Any, Iterable

from . import _native

#: Letters whose usual spelling in ASCII is not that without the accent.
_SPELLED = str.maketrans(
    {"ä": "ae", "ö": "oe", "ü": "ue", "Ä": "Ae", "Ö": "Oe", "Ü": "Ue", "ß": "ss", "æ": "ae", "ø": "oe", "å": "aa"}
)


def _word(name: str) -> str:
    """A name in the characters that CF permits in flag_meanings: letters and digits of ASCII, and _ - . + @"""
    plain = unicodedata.normalize("NFKD", unicodedata.normalize("NFC", name).translate(_SPELLED))
    plain = plain.encode("ascii", "ignore").decode()
    return re.sub(r"[^A-Za-z0-9_\-.+@]+", "_", plain).strip("_")


def flag_meanings(names: Iterable[tuple[str, str]]) -> list[str]:
    """A word for each (name, other name): valid in flag_meanings, unique, and near to the name.

    The other name is used if the name has no such characters. Equal words get _2, _3, ...
    """
    taken: set[str] = set()
    words = []
    for name, other in names:
        word = unique = _word(name) or _word(other) or "component"
        number = 1
        while unique in taken:
            number += 1
            unique = f"{word}_{number}"
        taken.add(unique)
        words.append(unique)
    return words


def epsg_codes(crs: str) -> tuple[int, int]:
    """The EPSG codes in the name of a CRS: of the plan, and of the heights; 0: none."""
    separator, version = r"[:/#]+", r"(?:[0-9.]+[:/#]+)?"
    codes = re.findall(rf"epsg{separator}{version}([0-9]+)(?:\+(?:epsg{separator})?([0-9]+))?", crs, re.I)
    if not codes:
        return 0, 0
    vertical = codes[0][1] or (codes[1][0] if len(codes) > 1 else "0")
    return int(codes[0][0]), int(vertical)


#: Method of a projection in the EPSG dataset -> name in CF, {parameter in the EPSG dataset: attribute in CF}.
_METHODS: dict[str, tuple[str, dict[str, str]]] = {
    "Transverse Mercator": (
        "transverse_mercator",
        {
            "Latitude of natural origin": "latitude_of_projection_origin",
            "Longitude of natural origin": "longitude_of_central_meridian",
            "Scale factor at natural origin": "scale_factor_at_central_meridian",
            "False easting": "false_easting",
            "False northing": "false_northing",
        },
    ),
    "Lambert Conic Conformal (2SP)": (
        "lambert_conformal_conic",
        {
            "Latitude of false origin": "latitude_of_projection_origin",
            "Longitude of false origin": "longitude_of_central_meridian",
            "Easting at false origin": "false_easting",
            "Northing at false origin": "false_northing",
        },
    ),
}


def _mapping_of(conversion: dict[str, Any]) -> dict[str, Any]:
    """The projection in attributes of CF; empty for a method without them here. The WKT always has it."""
    name, attributes = _METHODS.get(conversion["method"]["name"], ("", {}))
    if not name:
        return {}
    values = {parameter["name"]: parameter["value"] for parameter in conversion["parameters"]}
    mapping: dict[str, Any] = {"grid_mapping_name": name}
    mapping.update({attribute: float(values[parameter]) for parameter, attribute in attributes.items()})
    if name == "lambert_conformal_conic":
        parallels = ("Latitude of 1st standard parallel", "Latitude of 2nd standard parallel")
        mapping["standard_parallel"] = [float(values[parallel]) for parallel in parallels]
    return mapping


def grid_mapping(crs: str) -> dict[str, Any]:
    """Attributes of a CF grid mapping for the name of a CRS: `crs_wkt`, `spatial_ref` (GDAL), and the projection by CF.

    Empty if the name has no EPSG code, if PROJ is missing or does not know the code, or if the CRS is not a projection.
    """
    plan, heights = epsg_codes(crs)
    text = _native.crs_projjson(plan, heights) if plan else ""
    if not text:
        heights, text = 0, _native.crs_projjson(plan, 0) if plan else ""
    if not text:
        return {}
    definition = json.loads(text)
    horizontal = definition["components"][0] if definition["type"] == "CompoundCRS" else definition
    if horizontal["type"] != "ProjectedCRS":
        return {}
    wkt = _native.crs_wkt(plan, heights)
    return {**_mapping_of(horizontal["conversion"]), "crs_wkt": wkt, "spatial_ref": wkt}

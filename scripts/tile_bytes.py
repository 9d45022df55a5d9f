#!/usr/bin/env python3
"""Reports where the bytes of 3D Tiles go: per feature, raw and compressed by gzip -9, part by part.

    scripts/tile_bytes.py FOLDER.3dtiles [--per COUNT]

Each part is compressed by itself, so their sum differs a little from the last row, which is that of whole files. Only
the finest contents count: those whose path has the most levels, or all files of a folder without levels.
"""
from __future__ import annotations

import argparse
import gzip
import json
import struct
import sys
from pathlib import Path


def packed(data: bytes) -> int:
    return len(gzip.compress(data, 9, mtime=0))


def read_glb(path: Path) -> tuple[bytes, dict, bytes]:
    """The bytes of the JSON, the JSON, and the binary chunk."""
    data = path.read_bytes()
    (size,) = struct.unpack_from("<I", data, 12)
    text = data[20 : 20 + size]
    return text, json.loads(text), data[28 + size :]


def names_of_views(document: dict) -> dict[int, str]:
    names: dict[int, str] = {}
    for primitive in document["meshes"][0]["primitives"]:
        for name, accessor in primitive["attributes"].items():
            names[document["accessors"][accessor]["bufferView"]] = name
        names[document["accessors"][primitive["indices"]]["bufferView"]] = "indices"
    for name, column in table_of(document)["properties"].items():
        names[column["values"]] = f"column {name}"
        if "stringOffsets" in column:
            names[column["stringOffsets"]] = "offsets of texts"
    return names


def table_of(document: dict) -> dict:
    return document["extensions"]["EXT_structural_metadata"]["propertyTables"][0]


def parts_of(path: Path) -> tuple[dict[str, bytes], int]:
    """The bytes of each part, and the number of features."""
    text, document, binary = read_glb(path)
    parts: dict[str, bytes] = {}
    names = names_of_views(document)
    for number, view in enumerate(document["bufferViews"]):
        view = view.get("extensions", {}).get("EXT_meshopt_compression", view)
        piece = binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
        parts[names[number]] = parts.get(names[number], b"") + piece
    parts["JSON"] = text
    return parts, table_of(document)["count"]


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("folder", type=Path)
    arguments.add_argument("--per", type=int, help="divisor, such as the number of buildings; default: features")
    options = arguments.parse_args()
    files = sorted(options.folder.rglob("*.glb"))
    finest = max((file.relative_to(options.folder).parts[:-1] for file in files), key=lambda p: int(p[1]) if p else 0)
    if finest:
        files = [file for file in files if file.relative_to(options.folder).parts[1] == finest[1]]
    raw: dict[str, int] = {}
    small: dict[str, int] = {}
    features = 0
    for file in files:
        parts, count = parts_of(file)
        features += count
        parts["whole files"] = file.read_bytes()
        for name, data in parts.items():
            raw[name] = raw.get(name, 0) + len(data)
            small[name] = small.get(name, 0) + packed(data)
    per = options.per or features
    whole = [(name, raw.pop(name), small.pop(name)) for name in ("whole files",)]
    for name, size, less in [(name, raw[name], small[name]) for name in raw] + whole:
        print(f"{name:24} {size / per:9.1f} {less / per:9.1f}")
    print(f"{len(files)} files, {features} features, per {per}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

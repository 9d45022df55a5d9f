#!/usr/bin/env python3
"""Volumes, drawings and pictures are equal to the last bit on every machine: tests/golden/manifest.json has digests.

    tests/scripts/manifest_test.py SVT

Models of SVT_DATA_DIR are tested where it is set. SVT_UPDATE_GOLDEN=1 writes the digests that are new or differ; look at the
pictures first.
"""
import gzip
import hashlib
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from typing import Callable

ROOT = pathlib.Path(__file__).resolve().parents[2]
MANIFEST = ROOT / "tests" / "golden" / "manifest.json"
DATA = os.environ.get("SVT_DATA_DIR", "")
SVT = ""

#: Name -> arguments of `svt sample`, with the name of the file that they write.
GENERATED = {
    "house.gml": ["house"],
    "house.ifc": ["house"],
    "turned-house.json": ["house", "--turn", "31"],
    "tower.gml": ["tower", "--storeys", "4"],
    "district.gml": ["district"],
}
#: Files of SVT_DATA_DIR.
REAL = ["fzk_haus_citygml3.gml", "fzk_haus.city.json", "fzk_haus.ifc", "samplehouse.ifc", "sig3d_lod4_citygml2.gml"]
#: Name -> arguments of a command on the volume, with the ending of its output.
OUTPUTS = {
    "labels": ("nrrd", ["convert"]),
    "section": ("svg", ["section", "--plane", "z=1.2"]),
    "picture": ("png", ["render", "--size", "320x240"]),
    "cut picture": ("png", ["render", "--size", "320x240", "--section", "y<4", "--camera", "iso"]),
}


def run(*arguments: object) -> None:
    done = subprocess.run([SVT, *map(str, arguments), "-q"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{' '.join(map(str, arguments))}: {done.stderr}"


def pixels(png: bytes) -> bytes:
    """Size and decoded rows of a PNG, which do not depend on the release of zlib."""
    place, rows, size = 8, b"", b""
    while place < len(png):
        (length,) = struct.unpack(">I", png[place : place + 4])
        kind, content = png[place + 4 : place + 8], png[place + 8 : place + 8 + length]
        size = content if kind == b"IHDR" else size
        rows += content if kind == b"IDAT" else b""
        place += 12 + length
    return size + zlib.decompress(rows)


def labels(nrrd: bytes) -> bytes:
    """Header and decoded samples of an NRRD."""
    header, _, samples = nrrd.partition(b"\n\n")
    return header + gzip.decompress(samples)


DECODERS: dict[str, Callable[[bytes], bytes]] = {".png": pixels, ".nrrd": labels, ".svg": bytes}


def digest(path: pathlib.Path) -> str:
    return hashlib.sha256(DECODERS[path.suffix](path.read_bytes())).hexdigest()[:32]


def digests_of(model: pathlib.Path, folder: pathlib.Path) -> dict[str, str]:
    volume = folder / "model.svt"
    run("build", model, "-o", volume, "--spacing", "0.1")
    found = {}
    for name, (ending, (command, *options)) in OUTPUTS.items():
        output = folder / f"{command}.{ending}"
        run(command, volume, *(["-o"] if command != "convert" else []), output, *options)
        found[name] = digest(output)
    return found


class Manifest(unittest.TestCase):
    maxDiff = None

    def compare(self, models: dict[str, pathlib.Path]) -> None:
        known = json.loads(MANIFEST.read_text(encoding="utf-8")) if MANIFEST.exists() else {}
        found = {}
        for name, path in models.items():
            with tempfile.TemporaryDirectory() as folder:
                found[name] = digests_of(path, pathlib.Path(folder))
        if os.environ.get("SVT_UPDATE_GOLDEN") == "1":
            MANIFEST.write_text(json.dumps({**known, **found}, indent=1, sort_keys=True) + "\n", encoding="utf-8")
            return
        self.assertEqual({name: known.get(name) for name in models}, found)

    def test_generated_models(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            models = {name: pathlib.Path(folder) / name for name in GENERATED}
            for name, path in models.items():
                run("sample", *GENERATED[name], "-o", path)
            self.compare(models)

    @unittest.skipUnless(DATA, "SVT_DATA_DIR is not set")
    def test_real_models(self) -> None:
        self.compare({name: pathlib.Path(DATA) / name for name in REAL})


if __name__ == "__main__":
    SVT = os.path.abspath(sys.argv.pop(1))
    unittest.main()

#!/usr/bin/env python3
"""Measures the share of the model's visible surface that the default picture of its volume loses.

  scripts/picture_loss.py MODEL... [--spacing 0.05] [--section z=1.5] [--pictures FOLDER] [--markdown]

Each model is built once and drawn in eight views, twice each: as voxels, and all features as triangles (`svt render --vectors
all`), which do not depend on voxels. Every pixel in which the triangles show an object is a sample of its surface. The sample is
lost if the picture of voxels shows that object nowhere within two voxels (at least one pixel) of it. A lost sample is

  hidden    if the picture of voxels shows another object within two voxels of it, such as the wall on a body's face
  missing   otherwise: the picture shows the background, or something farther away or nearer
  absent    if it is missing, and this object is nowhere in the picture within two voxels, at any depth

All objects are opaque. The last column names the objects that lost most samples. Needs only Python and svt:
build/release/bin/svt, or the program that SVT names.
"""
import argparse
import json
import math
import sys
import tempfile
from collections import Counter
from pathlib import Path

from picture_error import FAR, draw, run, scene_of, write_png

VIEWS = ("iso-se", "iso-sw", "iso-ne", "iso-nw", "front", "back", "left", "right")
REACH = 2  # voxels
FIELD_OF_VIEW = 30  # degrees


def objects_of(volume):
    """For each scalar the number of its object, and the names of the objects."""
    rows = json.loads(run("query", volume, "all", "--json"))
    owner, names = {}, {}
    for number, row in enumerate(rows):
        for scalar in range(row.get("first") or 0, (row.get("first") or 0) + (row.get("count") or 0)):
            owner[scalar] = number
        names[number] = f"{row.get('class', '')} {row.get('name') or row.get('id', '')}".strip()
    return owner, names


class View:
    """Two pictures of one view: of voxels and of triangles."""

    def __init__(self, voxels, meshes, owner, voxel):
        self.width, self.height = voxels[1][0], voxels[1][1]
        self.labels, self.depths = voxels[1][3], voxels[2][3]
        self.mesh_labels, self.mesh_depths = meshes[1][3], meshes[2][3]
        self.owner, self.voxel = owner, voxel

    def tolerance(self):
        return 1000 * REACH * self.voxel

    def owned_by(self, wanted):
        return lambda scalar: self.owner.get(scalar) == wanted

    def is_near(self, x, y):
        """Both pictures have a surface there, at the same depth within the reach; or both are too far away to tell."""
        other, depth = self.depths[y][x], self.mesh_depths[y][x]
        return bool(self.labels[y][x]) and (abs(other - depth) <= self.tolerance() or min(other, depth) == FAR)

    def shows(self, x, y, is_wanted, at_depth=True):
        """The picture of voxels has such an object around (x, y). Its depths there lie around that of the triangles, which may be
        far from each of them on a surface that is nearly parallel to the rays."""
        depth = self.mesh_depths[y][x]
        pixel = 2 * math.tan(math.radians(FIELD_OF_VIEW / 2)) * depth / 1000 / self.height
        reach = max(1, int(REACH * self.voxel / pixel))
        nearest, farthest = FAR, 0
        for v in range(max(0, y - reach), min(self.height, y + reach + 1)):
            for u in range(max(0, x - reach), min(self.width, x + reach + 1)):
                if is_wanted(self.labels[v][u]):
                    nearest, farthest = min(nearest, self.depths[v][u]), max(farthest, self.depths[v][u])
        margin = self.tolerance() if at_depth else FAR
        return farthest > 0 and nearest - margin <= depth <= farthest + margin

    def count(self, lost):
        """Samples, hidden, missing and absent ones, and rows of a picture of them."""
        samples = hidden = missing = absent = 0
        rows = []
        for y in range(self.height):
            paint = bytearray()
            for x, label in enumerate(self.mesh_labels[y]):
                color = (255, 255, 255)
                if label:
                    samples += 1
                    color = (200, 200, 200)
                    wanted = self.owner.get(label)
                    is_object = self.owned_by(wanted)
                    is_same = is_object(self.labels[y][x]) and self.is_near(x, y)
                    if not is_same and not self.shows(x, y, is_object):
                        is_hidden = self.is_near(x, y) or self.shows(x, y, bool)
                        hidden += is_hidden
                        missing += not is_hidden
                        absent += not is_hidden and not self.shows(x, y, is_object, at_depth=False)
                        lost[wanted] += 1
                        color = (255, 140, 0) if is_hidden else (220, 0, 0)
                paint += bytes(color)
            rows.append(paint)
        return (samples, hidden, missing, absent), rows


def measure(model, options, section, size, folder):
    name = model.name.replace(".", "_")
    volume = folder / f"{name}.svt"
    run("build", model, "-o", volume, "-q", *options)
    info = json.loads(run("info", volume, "--json"))
    voxel = max(info["grid"]["spacing"])
    owner, names = objects_of(volume)
    totals = [0, 0, 0, 0]
    lost: Counter = Counter()
    for view in VIEWS:
        scene = folder / f"{name}_{view}.scene.json"
        scene.write_text(json.dumps(scene_of(view, size[0], size[1], fov=FIELD_OF_VIEW)))
        extra = ["--section", section] if section else []
        voxels = draw(volume, scene, folder, f"{name}_{view}", extra)
        meshes = draw(volume, scene, folder, f"{name}_{view}_mesh", [*extra, "--vectors", "all"])
        of_view = View(voxels, meshes, owner, voxel)
        counts, rows = of_view.count(lost)
        totals = [a + b for a, b in zip(totals, counts)]
        write_png(folder / f"{name}_{view}_lost.png", size[0], rows)
    worst = [f"{names.get(number, '?')} ({count})" for number, count in lost.most_common(3)]
    return voxel, totals, worst


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--spacing", type=float, help="metres; the default spacing without it")
    parser.add_argument("--section", help="a cut that opens the model, such as z=1.5")
    parser.add_argument("--size", default="640x400")
    parser.add_argument("--pictures", type=Path, help="folder that keeps the pictures and volumes")
    parser.add_argument("--markdown", action="store_true", help="rows of a table")
    arguments = parser.parse_args()
    size = tuple(int(number) for number in arguments.size.split("x"))
    options = ["--spacing", str(arguments.spacing)] if arguments.spacing else []
    if arguments.pictures:
        arguments.pictures.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        folder = arguments.pictures or Path(scratch)
        for model in arguments.models:
            voxel, (samples, *counts), worst = measure(model, options, arguments.section, size, folder)
            hidden, missing, absent = (100 * count / max(1, samples) for count in counts)
            if arguments.markdown:
                figures = " | ".join(f"{share:.3f} %" for share in (absent, missing, hidden))
                print(f"| {model.name} | {100 * voxel:g} cm | {samples} | {figures} |", flush=True)
            else:
                print(
                    f"{model.name:36s} voxel {100 * voxel:5.1f} cm  {samples:8d} samples  absent {absent:6.3f} %  "
                    f"missing {missing:6.3f} %  hidden {hidden:6.3f} %  {'; '.join(worst)}",
                    flush=True,
                )


if __name__ == "__main__":
    sys.exit(main())

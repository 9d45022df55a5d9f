#!/usr/bin/env python3
"""Tells how far pictures of a volume are from pictures of the meshes that it was made of.

  scripts/picture_error.py MODEL... [--samples 200] [--spacing 0.04] [--view iso] [--pictures FOLDER] [--markdown]

Each model is built twice, with --samples samples along each axis and at --spacing, and drawn twice in the same view: as voxels,
and all features as triangles (`svt render --vectors all`), which know of no voxel. All is white and lit by one light, without
occlusion and lines, so that the gray of a pixel tells its normal. The figures, of the pixels where either picture has something:

  outline   one picture has the model there, the other the background
  label     both have it, but another feature, and the depths differ by more than half a voxel
  normal    both have it at the same depth (within one voxel), but the grays differ by more than 4 of 255
  depth     mean difference of the depths where both have it within two voxels, in voxels

--pictures writes both pictures and a third one that shows the pixels: red outline, blue label, orange normal. Rooms and what else
is air are left out. Works with Python alone; svt is build/release/bin/svt, or the program that SVT names.
"""
import argparse
import json
import os
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

SVT = os.environ.get("SVT", str(Path(__file__).resolve().parent.parent / "build/release/bin/svt"))
AIR = "class=BuildingRoom or class=IfcSpace or class=Room or class=BuildingUnit"
GRAY = 4  # of 255
FAR = 65535  # what --depth cannot tell, mm


def read_png(path):
    """Width, height, and rows of numbers: (channels, 8 or 16 bit). Not interlaced."""
    data = Path(path).read_bytes()
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at : at + 8])
        if kind == b"IHDR":
            width, height, bits, color = struct.unpack(">IIBB", data[at + 8 : at + 18])
        elif kind == b"IDAT":
            packed += data[at + 8 : at + 8 + size]
        at += 12 + size
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    step, raw, before = channels * bits // 8, zlib.decompress(packed), None
    rows: list = []
    stride = width * step
    for y in range(height):
        line = bytearray(raw[y * (stride + 1) + 1 : (y + 1) * (stride + 1)])
        unfilter(raw[y * (stride + 1)], line, before or bytearray(stride), step)
        rows.append(line)
        before = line
    if bits == 16:
        rows = [struct.unpack(f">{width * channels}H", row) for row in rows]
    return width, height, channels, rows


def unfilter(kind, line, before, step):
    for i in range(len(line) if kind else 0):
        a = line[i - step] if i >= step else 0
        b = before[i]
        if kind == 1:
            line[i] = (line[i] + a) & 255
        elif kind == 2:
            line[i] = (line[i] + b) & 255
        elif kind == 3:
            line[i] = (line[i] + (a + b) // 2) & 255
        else:
            c = before[i - step] if i >= step else 0
            p = a + b - c
            pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
            line[i] = (line[i] + (a if pa <= pb and pa <= pc else b if pb <= pc else c)) & 255


def write_png(path, width, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    raw = b"".join(b"\0" + bytes(row) for row in rows)
    Path(path).write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(raw, 6))
        + chunk(b"IEND", b"")
    )


def run(*arguments):
    done = subprocess.run([SVT, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"svt {' '.join(map(str, arguments))}\n{done.stderr}")
    return done.stdout


def draw(volume, scene, folder, name, extra=()):
    paths = [folder / f"{name}{part}.png" for part in ("", "_label", "_depth")]
    run(
        "render",
        volume,
        "--scene",
        scene,
        "-o",
        paths[0],
        "--labels",
        paths[1],
        "--depth",
        paths[2],
        "--level",
        0,
        "--surfaces",
        "voxels",
        "-q",
        *extra,
    )
    return [read_png(path) for path in paths]


def scene_of(view, width, height, eye=None, target=None, fov=30):
    camera = {"preset": view, "fit": "all", "fieldOfView": fov}
    if eye:
        camera.update(eye=eye, target=target)
    return {
        "format": "svt-scene",
        "version": 1,
        "size": [width, height],
        "samples": 1,
        "camera": camera,
        "ambientOcclusion": 0,
        "lines": {"strength": 0},
        "passes": [{"hide": [AIR], "styles": [{"select": "all", "color": "#ffffff", "opacity": 1}]}],
    }


def compare(voxels, meshes, voxel):
    """The four figures, and rows of a picture of the pixels that differ."""
    width, height, channels, color = voxels[0]
    counts = dict.fromkeys(("all", "outline", "label", "normal", "near"), 0)
    apart, rows = 0.0, []
    for y in range(height):
        row = bytearray()
        of = [(kind[2], kind[3][y]) for kind in (*voxels, *meshes)]
        for x in range(width):
            gray, label, depth, mesh_gray, mesh_label, mesh_depth = (line[x * step] for step, line in of)
            paint = (255, 255, 255)
            if label or mesh_label:
                counts["all"] += 1
                shade = 160 + mesh_gray // 4
                paint = (shade, shade, shade)
                gap = abs(depth - mesh_depth) / 1000 / voxel
                if not (label and mesh_label):
                    counts["outline"] += 1
                    paint = (220, 0, 0)
                elif label != mesh_label and gap > 0.5:
                    counts["label"] += 1
                    paint = (0, 60, 220)
                elif gap <= 1 and abs(gray - mesh_gray) > GRAY:
                    counts["normal"] += 1
                    paint = (255, 140, 0)
                if label and mesh_label and gap <= 2 and depth < FAR and mesh_depth < FAR:
                    counts["near"] += 1
                    apart += gap
            row += bytes(paint)
        rows.append(row)
    everything = max(1, counts["all"])
    figures = {name: 100 * counts[name] / everything for name in ("outline", "label", "normal")}
    figures["depth"] = apart / max(1, counts["near"])
    return figures, rows


def measure(model, options, view, size, folder):
    name = f"{model.name.split('.')[0]}_{'_'.join(options).replace('--', '').replace(',', 'x')}_{view}"
    volume = folder / f"{name}.svt"
    run("build", model, "-o", volume, "-q", *options)
    info = json.loads(run("info", volume, "--json"))
    voxel = max(info["grid"]["spacing"])
    scene = folder / f"{name}.scene.json"
    scene.write_text(json.dumps(scene_of(view, *size)))
    voxels = draw(volume, scene, folder, name)
    meshes = draw(volume, scene, folder, name + "_mesh", ["--vectors", "all"])
    figures, rows = compare(voxels, meshes, voxel)
    write_png(folder / f"{name}_error.png", size[0], rows)
    return voxel, figures


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--samples", type=int, default=200, help="samples along each axis; 0: not this way")
    parser.add_argument("--spacing", type=float, default=0.04, help="metres; 0: not this way")
    parser.add_argument("--view", default="iso")
    parser.add_argument("--size", default="960x600")
    parser.add_argument("--pictures", type=Path, help="folder that keeps the pictures and volumes")
    parser.add_argument("--markdown", action="store_true", help="rows of a table")
    arguments = parser.parse_args()
    size = tuple(int(number) for number in arguments.size.split("x"))
    ways = []
    if arguments.samples:
        ways.append((f"{arguments.samples} samples", ["--dimension", ",".join([str(arguments.samples)] * 3)]))
    if arguments.spacing:
        ways.append((f"{100 * arguments.spacing:g} cm", ["--spacing", str(arguments.spacing)]))
    if arguments.pictures:
        arguments.pictures.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        folder = arguments.pictures or Path(scratch)
        for model in arguments.models:
            for way, options in ways:
                voxel, f = measure(model, options, arguments.view, size, folder)
                if arguments.markdown:
                    print(
                        f"| {model.stem} | {way} | {100 * voxel:.1f} cm | {f['outline']:.2f} % | {f['label']:.2f} % | "
                        f"{f['normal']:.2f} % | {f['depth']:.2f} |"
                    )
                else:
                    print(
                        f"{model.stem:32s} {way:12s} voxel {100 * voxel:5.1f} cm  outline {f['outline']:5.2f} %  label "
                        f"{f['label']:5.2f} %  normal {f['normal']:5.2f} %  depth {f['depth']:.3f} voxels",
                        flush=True,
                    )


if __name__ == "__main__":
    main()

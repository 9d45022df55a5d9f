#!/usr/bin/env python3
"""Makes the table of docs/dev/pictures.md: how far pictures are from the triangles of the model, by an independent ray tracer.

  scripts/picture_oracle.py [MODEL...] [--spacings 0.2,0.1,0.05] [--planes] [--exact] [--maps FOLDER] [--cameras]

Without models: samples that svt generates, and the models of SVT_DATA_DIR (default ../shared/data) that are there. Each row has
the errors of eight cameras together; --cameras prints a row for each camera. --maps keeps a picture of the errors of each camera.
--exact measures the pictures of `svt render --surfaces exact`. Needs svt_picture_oracle (tests/pictures), which the build makes
where Embree is installed (scripts/setup.sh readers).
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BIN = Path(os.environ.get("SVT_BIN", ROOT / "build/release/bin"))
DATA = Path(os.environ.get("SVT_DATA_DIR", ROOT / "../shared/data"))
# Name of the row, arguments of `svt sample`, file.
SAMPLES = (
    ("sample house", ("house", "--format", "citygml3"), "house.gml"),
    ("sample house, IFC", ("house", "--format", "ifc"), "house.ifc"),
    ("sample house, LoD4 surfaces", ("house", "--format", "citygml2", "--thematic"), "house_lod4.gml"),
    ("sample tower", ("tower", "--format", "citygml3"), "tower.gml"),
)
FILES = (
    "fzk_haus_citygml3.gml",
    "fzk_haus.ifc",
    "sig3d_lod4_citygml2.gml",
    "samplehouse.ifc",
    "openhouse.ifc",
    "largebuilding.ifc",
)


def models(folder):
    for name, arguments, file in SAMPLES:
        subprocess.run([BIN / "svt", "sample", *arguments, "-o", folder / file, "-q"], check=True)
        yield name, folder / file
    for file in FILES:
        if (DATA / file).exists():
            yield file, DATA / file
        else:
            print(f"picture_oracle: {DATA / file} is absent", file=sys.stderr)


def rows(model, spacing, arguments):
    command = [str(BIN / "svt_picture_oracle"), str(model), "--spacing", str(spacing), "--size", arguments.size]
    command += [option for option in ("--planes", "--exact") if getattr(arguments, option[2:])]
    if arguments.maps:
        command += ["--maps", str(arguments.maps / f"{model.stem}_{spacing}")]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{done.stderr}")
    return json.loads(done.stdout)


def line(name, spacing, row):
    return (
        f"| {name} | {100 * spacing:g} cm | {row['outlinePercent']:.2f} % | {row['labelPercent']:.2f} % "
        f"| {row['normalPercent']:.2f} % | {1000 * row['depth50']:.1f} mm | {1000 * row['depth95']:.1f} mm "
        f"| {row['undecided']} of {row['pixels'] + row['undecided']} |"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", type=Path, nargs="*")
    parser.add_argument("--spacings", default="0.2,0.1,0.05", help="metres, with commas")
    parser.add_argument("--size", default="480x300", help="pixels")
    parser.add_argument("--planes", action="store_true", help="borders parallel to an axis at the model's faces, too")
    parser.add_argument("--exact", action="store_true", help="labels by the faces of the model (--surfaces exact)")
    parser.add_argument("--maps", type=Path, help="folder for a picture of the errors of each camera")
    parser.add_argument("--cameras", action="store_true", help="a row for each camera")
    arguments = parser.parse_args()
    if not (BIN / "svt_picture_oracle").exists():
        sys.exit(f"picture_oracle: {BIN}/svt_picture_oracle is absent: scripts/setup.sh readers, make build")
    print("| model | voxel | outline | label | normal | depth, 50 % | depth, 95 % | undecided pixels |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        given = [(model.name, model) for model in arguments.models]
        for name, model in given or models(Path(folder)):
            for spacing in map(float, arguments.spacings.split(",")):
                for row in rows(model, spacing, arguments):
                    if row["camera"] == "all":
                        print(line(name, spacing, row), flush=True)
                    elif arguments.cameras:
                        print(line(f"{name}, {row['camera']}", spacing, row), flush=True)


if __name__ == "__main__":
    main()

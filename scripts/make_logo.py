#!/usr/bin/env python3
"""Draws the logo with the program itself: a section through a small house. The left half is the exact section of
`svt section`. The right half shows the labels of the voxels that `svt build` makes at a spacing of 1 m.

    scripts/make_logo.py [--svt build/release/bin/svt] [--check]

Writes docs/images/logo.svg, logo_light.svg and logo_dark.svg for light and dark pages, the icon of the viewer page, and
the icons of cmake/desktop/icons, whose PNGs need rsvg-convert. With --check nothing is written, and the exit code is 1
if an SVG differs from the file in the tree.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
ICONS = ROOT / "cmake/desktop/icons"
SIZES = (16, 24, 32, 48, 64, 128, 256, 512)
UNIT = 4  # one metre, in units of the view box of 64: one pixel of an icon of 16 pixels
MARGIN = 1  # metre on each side
WIDTH, HEIGHT, MIDDLE = 14, 14, 7  # metres
DEPTH = 4

# The house in the plane of the section: x and z in metres. All parts are prisms along y.
INNER = 2 * math.sqrt(2)  # the roof is 2 m thick
RIDGE = HEIGHT + 0.1  # so that the centres of the outermost voxels lie inside the roof, not on its face
PARTS: dict[str, tuple[str, list]] = {
    "slab": ("BuildingConstructiveElement", [(0, 0), (14, 0), (14, 1), (0, 1)]),
    "wall-west": ("BuildingConstructiveElement", [(0, 1), (2, 1), (2, 7), (0, 7)]),
    "wall-east": ("BuildingConstructiveElement", [(12, 1), (14, 1), (14, 7), (12, 7)]),
    "ceiling": ("BuildingConstructiveElement", [(2, 6), (12, 6), (12, 7), (2, 7)]),
    "roof": (
        "BuildingConstructiveElement",
        [(0, 7), (2, 7), (INNER, 7), (7, 14 - INNER), (14 - INNER, 7), (12, 7), (14, 7), (7, RIDGE)],
    ),
    "room": ("BuildingRoom", [(2, 1), (12, 1), (12, 6), (2, 6)]),
    "attic": ("BuildingRoom", [(INNER, 7), (14 - INNER, 7), (7, 14 - INNER)]),
}
LIGHT = {
    "roof": "#b23a2e",
    "wall-west": "#3d4653",
    "wall-east": "#3d4653",
    "slab": "#3d4653",
    "ceiling": "#8d98a5",
    "room": "#2f9e94",
    "attic": "#f2b233",
}
DARK = {**LIGHT, "roof": "#e0594b", "wall-west": "#dfe4ea", "wall-east": "#dfe4ea", "slab": "#dfe4ea"}
# For pages and desktops that may be light or dark.
BOTH = {**LIGHT, "roof": "#c5473a", "wall-west": "#5d6977", "wall-east": "#5d6977", "slab": "#5d6977"}


def prism(outline: list, first: int) -> tuple[list, list]:
    """Vertices and faces of a prism along y; `first`: number of its first vertex."""
    count = len(outline)
    vertices = [(x, 0.0, z) for x, z in outline] + [(x, float(DEPTH), z) for x, z in outline]
    faces = [list(range(count)), list(range(2 * count - 1, count - 1, -1))]
    for n in range(count):
        following = (n + 1) % count
        faces.append([n, n + count, following + count, following])
    return vertices, [[[first + corner for corner in face]] for face in faces]


def city_json() -> str:
    """The house as CityJSON, in millimetres."""
    objects: dict = {"house": {"type": "Building", "geometry": [], "children": list(PARTS)}}
    vertices: list = []
    for name, (kind, outline) in PARTS.items():
        corners, faces = prism(outline, len(vertices))
        vertices += corners
        objects[name] = {
            "type": kind,
            "parents": ["house"],
            "geometry": [{"type": "Solid", "lod": "3", "boundaries": [faces]}],
        }
    return json.dumps(
        {
            "type": "CityJSON",
            "version": "2.0",
            "transform": {"scale": [0.001, 0.001, 0.001], "translate": [0, 0, 0]},
            "CityObjects": objects,
            "vertices": [[round(1000 * value) for value in vertex] for vertex in vertices],
        }
    )


def run(svt: str, folder: pathlib.Path, *words: str) -> None:
    subprocess.run([svt, *words, "--quiet"], cwd=folder, check=True)


def left_half(svt: str, folder: pathlib.Path) -> dict[str, list]:
    """The polygons of the section left of the middle, by part: lists of (x, z)."""
    run(svt, folder, "section", "logo.city.json", "-o", "section.geojson", "--plane", f"y<{DEPTH / 2}")
    drawn = json.loads((folder / "section.geojson").read_text(encoding="utf-8"))
    polygons: dict[str, list] = {}
    for feature in drawn["features"]:
        for polygon in feature["geometry"]["coordinates"]:
            outline = [(x, z) for x, _, z in polygon[0][:-1]]
            clipped = left_of_middle(outline)
            if clipped:
                polygons.setdefault(feature["properties"]["id"], []).append(clipped)
    return polygons


def left_of_middle(outline: list) -> list:
    """The outline clipped at the middle, without corners on a straight line."""
    clipped: list = []
    for (x, z), (next_x, next_z) in zip(outline, outline[1:] + outline[:1]):
        if x <= MIDDLE:
            clipped.append((x, z))
        if (x < MIDDLE) != (next_x < MIDDLE) and MIDDLE not in (x, next_x):
            clipped.append((MIDDLE, z + (next_z - z) * (MIDDLE - x) / (next_x - x)))
    corners = []
    for n, (x, z) in enumerate(clipped):
        (before_x, before_z), (after_x, after_z) = clipped[n - 1], clipped[(n + 1) % len(clipped)]
        if abs((x - before_x) * (after_z - z) - (z - before_z) * (after_x - x)) > 1e-6:
            corners.append((x, z))
    return corners


def right_half(svt: str, folder: pathlib.Path) -> dict[str, list]:
    """The voxels of the section right of the middle, by part: lists of (x, z) of their lower corners."""
    run(svt, folder, "build", "logo.city.json", "-o", "logo.svt", "--spacing", "1")
    run(svt, folder, "convert", "logo.svt", "logo.nrrd", "--encoding", "raw")
    header, samples = (folder / "logo.nrrd").read_bytes().split(b"\n\n", 1)
    lines = header.decode().splitlines()
    fields = dict(line.split(": ", 1) for line in lines if ": " in line and ":=" not in line)
    width, depth, _ = (int(number) for number in fields["sizes"].split())
    first = [float(number) for number in fields["space origin"].strip("()").split(",")]
    names = {}
    for line in lines:
        if line.startswith("svt_label_") and not line.startswith("svt_label_count"):
            label = json.loads(line.split(":=", 1)[1])
            names[label["first"]] = label["id"]
    voxels: dict[str, list] = {}
    for number, scalar in enumerate(samples):
        i, j, k = number % width, number // width % depth, number // width // depth
        x, z = round(first[0] + i - 0.5), round(first[2] + k - 0.5)
        if scalar and j == depth // 2 and x >= MIDDLE:
            voxels.setdefault(names[scalar], []).append((x, z))
    return voxels


def text_of(number: float) -> str:
    return f"{number:.3f}".rstrip("0").rstrip(".")


def place(x: float, z: float) -> str:
    """A point of the section, in units of the view box."""
    return f"{text_of(UNIT * (x + MARGIN))} {text_of(UNIT * (HEIGHT - z + MARGIN))}"


def svg(polygons: dict, voxels: dict, colors: dict[str, str]) -> str:
    """The mark. A path per part: its polygons, and its voxels in rows."""
    side = UNIT * (WIDTH + 2 * MARGIN)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {side} {side}" width="{side}" height="{side}">',
        "<title>SVT</title>",
        "<!-- Drawn by scripts/make_logo.py with svt section and svt build. -->",
    ]
    for name in PARTS:
        path = ["M" + " L".join(place(x, z) for x, z in outline) + "Z" for outline in polygons.get(name, [])]
        for z in sorted({z for _, z in voxels.get(name, [])}):
            row = sorted(x for x, other in voxels[name] if other == z)
            while row:
                count = next((n for n in range(1, len(row)) if row[n] != row[0] + n), len(row))
                path.append(f"M{place(row[0], z + 1)}h{UNIT * count}v{UNIT}h-{UNIT * count}Z")
                row = row[count:]
        lines.append(f'<path fill="{colors[name]}" d="{"".join(path)}"/>')
    # Every second voxel is a little lighter, so that large pictures show them.
    light = [
        f"M{place(x, z + 1)}h{UNIT}v{UNIT}h-{UNIT}Z" for row in voxels.values() for x, z in sorted(row) if (x + z) % 2
    ]
    lines.append(f'<path fill="#fff" fill-opacity=".14" d="{"".join(light)}"/>')
    return "\n".join(lines + ["</svg>", ""])


def drawings(svt: str) -> dict[pathlib.Path, str]:
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        (folder / "logo.city.json").write_text(city_json(), encoding="utf-8")
        polygons, voxels = left_half(svt, folder), right_half(svt, folder)
    return {
        ROOT / "docs/images/logo.svg": svg(polygons, voxels, BOTH),
        ROOT / "docs/images/logo_light.svg": svg(polygons, voxels, LIGHT),
        ROOT / "docs/images/logo_dark.svg": svg(polygons, voxels, DARK),
        ICONS / "svt.svg": svg(polygons, voxels, BOTH),
        ROOT / "web/viewer/public/icons/svt.svg": svg(polygons, voxels, BOTH),
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--svt", default=str(ROOT / "build/release/bin/svt"))
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    made = drawings(str(pathlib.Path(arguments.svt).resolve()))
    if arguments.check:
        stale = [path for path, text in made.items() if not path.exists() or path.read_text(encoding="utf-8") != text]
        for path in stale:
            print(f"{path.relative_to(ROOT)} differs from the drawing; scripts/make_logo.py renews it", file=sys.stderr)
        return 1 if stale else 0
    ICONS.mkdir(parents=True, exist_ok=True)
    for path, text in made.items():
        path.write_text(text, encoding="utf-8")
    for size in SIZES:
        picture = ICONS / f"svt-{size}.png"
        words = ["rsvg-convert", "-w", str(size), "-h", str(size), "-o", str(picture), str(ICONS / "svt.svg")]
        subprocess.run(words, check=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())

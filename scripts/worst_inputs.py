#!/usr/bin/env python3
"""Writes models on which careless algorithms take for ever, of any size; see docs/dev/limits.md.

  scripts/worst_inputs.py KIND N FILE.json
"""
import json
import math
import random
import sys

TURN = 2 * math.pi
vertices: list = []
numbers: dict = {}
objects: dict = {}


def point(x, y, z):
    key = (round(x * 1000), round(y * 1000), round(z * 1000))
    if key not in numbers:
        numbers[key] = len(vertices)
        vertices.append(key)
    return numbers[key]


def add(name, kind, boundaries):
    objects[name] = {"type": "Building", "geometry": [{"type": kind, "lod": "2", "boundaries": boundaries}]}


def box(x, y, z, size=(1, 1, 1), without=(), inward=False):
    a, b, c = size
    corners = [point(x + a * (i in (1, 2)), y + b * (i in (2, 3)), z + c * k) for k in (0, 1) for i in range(4)]
    faces = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    return [
        [[corners[i] for i in (face[::-1] if inward else face)]] for n, face in enumerate(faces) if n not in without
    ]


def walls(low, high):
    return [[[low[i - 1], low[i], high[i], high[i - 1]]] for i in range(len(low))]


def prism(plan, is_open=False):
    low, high = ([point(x, y, z) for x, y in plan] for z in (0, 3))
    add("a", "Solid", [walls(low, high) + ([] if is_open else [[low[::-1]], [high]])])


def around(n, radius):
    return [(radius(i) * math.cos(TURN * i / n), radius(i) * math.sin(TURN * i / n)) for i in range(n)]


def star(n):
    prism(around(n, lambda i: 30 if i % 2 else 100))


def ring(n):
    prism([(random.random() * 50, random.random() * 50) for _ in range(n)])


def loop(n):
    prism(around(n, lambda i: 100), is_open=True)


def holes(n):
    side = math.ceil(n**0.5)
    shell = box(0, 0, 0, (side, side, 1))
    for i in range(n):
        x, y = i % side + 0.25, i // side + 0.25
        shell[1].append([point(x, y, 1), point(x, y + 0.5, 1), point(x + 0.5, y + 0.5, 1), point(x + 0.5, y, 1)])
    add("a", "Solid", [shell])


def coincident(n):
    for i in range(n):
        add(f"open{i}", "Solid", [box(0, 0, 0, (4, 3, 2), without=(3,))])
        add(f"face{i}", "MultiSurface", [box(0, 0, 0, (4, 3, 2))[3]])


def coincident_in_one(n):
    add("a", "MultiSurface", box(0, 0, 0, (4, 3, 2))[3:4] * n)


def book(n):
    add(
        "a",
        "MultiSurface",
        [[[point(0, 0, 0), point(0, 0, 2), point(5, i * 0.001, 2), point(5, i * 0.001, 0)]] for i in range(n)],
    )


def wall(n):
    side = int(n**0.5)
    add(
        "a",
        "MultiSurface",
        [
            [
                [
                    point(0, 2 * i, 2 * j),
                    point(0, 2 * i + 1, 2 * j),
                    point(0, 2 * i + 1, 2 * j + 1),
                    point(0, 2 * i, 2 * j + 1),
                ]
            ]
            for i in range(side)
            for j in range(side)
        ],
    )


def tjunction(n):
    top = [point(100 * i / n, 0, 2) for i in range(n + 1)] + [point(100, 3, 2), point(0, 3, 2)]
    add("a", "Solid", [box(0, 0, 0, (100, 3, 2), without=(1,)) + [[top]]])


def fan(n):
    faces = []
    for _ in range(n):
        angle = random.random() * TURN
        faces.append(
            [
                [point(0, 0, 0)]
                + [
                    point(50 * math.cos(a), 50 * math.sin(a), z)
                    for a, z in ((angle, random.random()), (angle + 0.001, 1))
                ]
            ]
        )
    add("a", "Solid", [faces])


def cells(n):
    side = math.ceil(n ** (1 / 3))
    return side, [(2 * (i % side), 2 * (i // side % side), 2 * (i // side // side)) for i in range(n)]


def shells(n):
    add(
        "a",
        "MultiSurface",
        [face for i, (x, y, z) in enumerate(cells(n)[1]) for face in box(x, y, z, inward=i % 2 == 1)],
    )


def voids(n):
    side, places = cells(n)
    outside = box(-1, -1, -1, (2 * side + 2,) * 3)
    add("a", "Solid", [outside] + [box(x, y, z, inward=True) for x, y, z in places])


def surface(n):
    side = int(n**0.5)

    def height(i, j):
        return 5 + math.sin(i * 0.7) * math.cos(j * 0.9)

    faces = []
    for i in range(side):
        for j in range(side):
            for top in (True, False):
                a, b, c, d = (
                    point(p, q, height(p, q) if top else 0) for p, q in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
                )
                faces += [[[a, b, c]], [[a, c, d]]] if top else [[[a, c, b]], [[a, d, c]]]
    border = [(i, 0) for i in range(side)] + [(side, i) for i in range(side)]
    border += [(side - i, side) for i in range(side)] + [(0, side - i) for i in range(side)]
    add("a", "Solid", [faces + walls([point(*p, 0) for p in border], [point(*p, height(*p)) for p in border])])


def nest(n):
    for i in range(n):
        objects[f"b{i}"] = {"type": "BuildingPart" if i else "Building", "geometry": []}
        if i:
            objects[f"b{i}"]["parents"] = [f"b{i - 1}"]
            objects[f"b{i - 1}"]["children"] = [f"b{i}"]
    objects[f"b{n - 1}"]["geometry"] = [{"type": "Solid", "lod": "2", "boundaries": [box(0, 0, 0)]}]


def features(n):
    side = math.ceil(n**0.5)
    for i in range(n):
        add(f"b{i}", "Solid", [box(2 * (i % side), 2 * (i // side), 0)])


KINDS = (
    star,
    ring,
    loop,
    holes,
    coincident,
    coincident_in_one,
    book,
    wall,
    tjunction,
    fan,
    shells,
    voids,
    surface,
    nest,
    features,
)


def main():
    kinds = {kind.__name__: kind for kind in KINDS}
    if len(sys.argv) != 4 or sys.argv[1] not in kinds:
        sys.exit(f"{__doc__}\nKIND: {', '.join(kinds)}")
    random.seed(1)
    kinds[sys.argv[1]](int(sys.argv[2]))
    with open(sys.argv[3], "w", encoding="utf-8") as out:
        json.dump(
            {
                "type": "CityJSON",
                "version": "2.0",
                "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/25832"},
                "transform": {"scale": [0.001, 0.001, 0.001], "translate": [0, 0, 0]},
                "CityObjects": objects,
                "vertices": vertices,
            },
            out,
        )


if __name__ == "__main__":
    main()

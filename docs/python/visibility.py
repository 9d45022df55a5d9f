#!/usr/bin/env python3
"""Visibility by rays: the objects that a person in a room sees, their distance, and the share of sky."""
import csv
import os

import numpy as np

import svt
from example import arguments

EYE = 1.58  # metres above the floor
CLEAR = ("BuildingRoom", "Window", "WindowSurface", "ClosureSurface", "BuildingUnit", "Storey")


def is_clear(label):
    """Whether one sees through it: glass and air. A window with panes of their own is its frame, which is opaque."""
    phase = label.attributes.get("phase")
    return label.class_name in CLEAR if phase is None else phase == "glass"


def sphere(count):
    """Directions that are evenly spread: a spiral of equal steps in height."""
    height = 1 - (2 * np.arange(count) + 1) / count
    angle = np.arange(count) * np.pi * (3 - np.sqrt(5))
    ring = np.sqrt(1 - height * height)
    return np.column_stack([ring * np.cos(angle), ring * np.sin(angle), height])


def first_hits(volume, origins, directions):
    """For each ray the index of the label that ends the view (-1: none, open air) and the distance in metres (inf)."""
    clear = np.array([is_clear(label) for label in volume.labels])
    runs = volume.rays(origins, directions)
    label, distance = np.full(len(runs), -1), np.full(len(runs), np.inf)
    opaque = ~clear[runs.all["label"]]
    # Of the opaque runs the first of each ray: np.unique gives the first place of each value.
    rays, first = np.unique(runs.ray[opaque], return_index=True)
    label[rays] = runs.all["label"][opaque][first]
    distance[rays] = runs.all["enter"][opaque][first]
    return label, distance


def plan(volume, height):
    """A plan of the labels at a height (world z) as a picture: light rooms, dark construction."""
    k = int(round(volume.index([[*volume.origin[:2], height]])[0, 2]))
    k = min(max(k, 0), volume.shape[0] - 1)
    labels = volume.labels.of_scalar[volume.dense()[k]]
    shades = np.array(
        [
            [246, 243, 236]
            if is_clear(label)
            else [150, 170, 190]
            if "Window" in label.class_name
            else [196, 164, 120]
            if label.class_name == "BuildingFurniture"
            else [70, 74, 82]
            for label in volume.labels
        ]
        + [[255, 255, 255]],
        np.uint8,
    )
    return shades[labels]


def overlay(volume, picture, eye, distance, directions, height):
    """Colours what is seen in the plane of the eye."""
    rows, columns = picture.shape[:2]
    j, i = np.mgrid[0:rows, 0:columns]
    k = volume.index(eye)[2]
    world = volume.world(np.dstack([i, j, np.full(i.shape, k)]))
    off = world[..., :2] - eye[:2]
    angle = np.arctan2(off[..., 1], off[..., 0]) % (2 * np.pi)
    ray = np.rint(angle / (2 * np.pi) * len(distance)).astype(int) % len(distance)
    seen = np.hypot(off[..., 0], off[..., 1]) < distance[ray]
    picture[seen] = (0.55 * picture[seen] + 0.45 * np.array([255, 196, 40])).astype(np.uint8)
    picture[np.hypot(off[..., 0], off[..., 1]) < 0.12] = (200, 30, 30)


def main():
    volume, folder = arguments(__doc__, spacing=0.05)
    rooms = volume.query("class=BuildingRoom and volume>15")
    rows = []
    for room in rooms:
        lower, upper = room.box
        eye = np.array([*(lower[:2] + upper[:2]) / 2, min(lower[2] + EYE, upper[2] - 0.1)])
        directions = sphere(20000)
        label, distance = first_hits(volume, np.broadcast_to(eye, directions.shape), directions)
        sky = (label < 0) & (directions[:, 2] > 0)
        rows.append((room, eye, sky.mean(), np.median(distance[np.isfinite(distance)]), len(set(label[label >= 0]))))
    with open(os.path.join(folder, "visibility.csv"), "w", newline="") as file:
        out = csv.writer(file)
        out.writerow(("room", "sky_share", "median_distance_m", "components_seen"))
        for room, _, sky, far, count in rows:
            out.writerow((room.name or room.id, f"{sky:.4f}", f"{far:.2f}", count))
            print(
                f"{room.name or room.id:<20} sky {100 * sky:5.2f} % of the view   median {far:5.2f} m   {count:3} components seen"
            )
    # The largest room, in plan: a ray for every tenth of a degree.
    room, eye, *_ = max(rows, key=lambda row: row[0].volume)
    turn = np.arange(3600) / 3600 * 2 * np.pi
    flat = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(3600)])
    _, distance = first_hits(volume, np.broadcast_to(eye, flat.shape), flat)
    picture = plan(volume, eye[2])
    overlay(volume, picture, eye, distance, flat, eye[2])
    svt.write_png(os.path.join(folder, "visibility.png"), picture[::-1].repeat(3, axis=0).repeat(3, axis=1))  # north up
    print(f"visibility.png: from {room.name or room.id}")


if __name__ == "__main__":
    main()

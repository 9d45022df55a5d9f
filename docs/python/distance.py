#!/usr/bin/env python3
"""Distance field with SciPy: how far every point of the rooms is from the nearest wall, piece of furniture or slab."""
import csv
import os

import numpy as np
from scipy import ndimage

import svt
from example import arguments

AIR = ("BuildingRoom", "BuildingUnit", "Storey")

# Dark blue to yellow, even in lightness (points of viridis).
COLORS = np.array([[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]], float)


def clearance(volume):
    """Metres from each sample to the nearest sample that is not air: array [k, j, i], 0 outside of rooms."""
    labels = volume.labels.of_scalar[volume.dense()]
    # Surfaces that bound a room are its outermost voxels.
    is_air = np.array(
        [label.class_name in AIR or label.class_name.endswith("Surface") for label in volume.labels] + [False]
    )
    # Between centres of voxels: half a voxel more than to the face.
    return ndimage.distance_transform_edt(is_air[labels], sampling=volume.spacing[::-1]), labels


def colored(field, most):
    at = np.clip(field / most, 0, 1) * (len(COLORS) - 1)
    low = np.minimum(at.astype(int), len(COLORS) - 2)
    mixed = COLORS[low] + (COLORS[low + 1] - COLORS[low]) * (at - low)[..., None]
    mixed[field == 0] = 235
    return np.rint(mixed).astype(np.uint8)


def main():
    volume, folder = arguments(__doc__, spacing=0.05)
    field, labels = clearance(volume)
    rooms = volume.query("class=BuildingRoom")
    radius = ndimage.maximum(field, labels, [room.index for room in rooms])
    where = ndimage.maximum_position(field, labels, [room.index for room in rooms])
    with open(os.path.join(folder, "distance.csv"), "w", newline="") as file:
        out = csv.writer(file)
        out.writerow(("room", "largest_free_radius_m", "x", "y", "z"))
        for room, metres, (k, j, i) in zip(rooms, radius, where):
            place = volume.world([i, j, k])
            out.writerow((room.name or room.id, f"{metres:.3f}", *(f"{x:.3f}" for x in place)))
            print(
                f"{room.name or room.id:<20} a ball of {metres:.2f} m is free at {place[0]:.2f} {place[1]:.2f} {place[2]:.2f}"
            )
    # A plan one metre above the lowest floor: where a wheelchair of 0.75 m (white line) finds no place.
    floor = min(room.box[0][2] for room in rooms)
    k = int(np.ceil(volume.index([[*volume.origin[:2], floor + 1.0]])[0, 2]))  # the first samples above it
    plane = ndimage.distance_transform_edt(field[k] > 0, sampling=volume.spacing[1::-1])
    picture = colored(plane, plane.max()).repeat(3, axis=0).repeat(3, axis=1)
    wide = (plane > 0.375).repeat(3, axis=0).repeat(3, axis=1)
    picture[wide ^ ndimage.binary_erosion(wide)] = 255
    svt.write_png(os.path.join(folder, "distance.png"), picture[::-1])
    print(f"distance.png: 1 m above the floor; yellow is {plane.max():.2f} m from the nearest object")


if __name__ == "__main__":
    main()

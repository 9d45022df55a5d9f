#!/usr/bin/env python3
"""Wall layers to an energy table: what lies between the rooms and the outside, how thick, and what passes through it.

Rays go through the building along x, y and z. What a ray goes through before its first room are the layers of the envelope
there, from the material attribute of each component. An oblique component, such as a roof, is met along two or three axes: its
area is the length of the vector of what the axes see of it, and its layers are shorter than along the ray by the same angle.
Windows and doors count as a whole. No heat bridges, no ground: a table for a first look.
"""
import collections
import csv
import os

import numpy as np

from example import arguments

# Thermal conductivity in W/(m K), of dense materials as EN ISO 10456 has them; W/(m2 K) for windows and doors.
CONDUCTIVITY = {
    "brick": 0.50,
    "concrete": 2.0,
    "gypsum": 0.25,
    "timber": 0.13,
    "steel": 50.0,
    "insulation": 0.035,
    "tiles": 1.0,
    "roof tiles": 1.0,
}
WHOLE = {"Window": 1.3, "WindowSurface": 1.3, "Door": 1.8, "DoorSurface": 1.8}
THICKEST = 0.7  # metres; a ray that is longer in the envelope goes along a wall, not through it
INSIDE, OUTSIDE = 0.13, 0.04  # resistance of the air at the faces, m2 K / W (EN ISO 6946)


def inside_of(volume):
    """By label whether it is the inside: a room, or one of the surfaces that bound a room and are its outermost voxels."""
    is_inside = np.zeros(len(volume.labels), bool)
    for label in volume.labels:  # parents come first
        is_room = label.class_name == "BuildingRoom"
        is_face = (
            label.parent is not None
            and is_inside[label.parent.index]
            and label.class_name.endswith("Surface")
            and label.class_name not in WHOLE
        )
        is_inside[label.index] = is_room or is_face
    return is_inside


def outermost(runs, is_inside):
    """For each ray that comes into a room from outside its layers: from the last air before that room on, without air."""
    for run in runs:
        rooms = np.flatnonzero(is_inside[run["label"]])
        if rooms.size == 0 or rooms[0] == 0:
            continue
        layers = run[: rooms[0]]
        to_room = run["enter"][rooms[0]] - layers["leave"][-1]
        gaps = np.flatnonzero(layers["enter"][1:] - layers["leave"][:-1] > 1e-6)
        layers = layers[gaps[-1] + 1 :] if gaps.size else layers  # eaves, terraces
        if to_room < 1e-6 and layers["leave"][-1] - layers["enter"][0] < THICKEST:
            yield layers


def envelope(volume, step):
    """{label: [m2 seen along x, y, z; layers along each axis: Counter of ((material, metres), ...)]} of the envelope."""
    is_inside = inside_of(volume)
    found: dict = collections.defaultdict(lambda: (np.zeros(3), [collections.Counter() for _ in range(3)]))
    lower, upper = volume.box
    for axis in range(3):
        across = [a for a in range(3) if a != axis]
        grids = np.meshgrid(*(np.arange(lower[a] + step / 2, upper[a], step) for a in across), indexing="ij")
        for side in (-1, 1):
            origins = np.empty((grids[0].size, 3))
            origins[:, axis] = lower[axis] - 1 if side > 0 else upper[axis] + 1
            origins[:, across[0]], origins[:, across[1]] = grids[0].ravel(), grids[1].ravel()
            for layers in outermost(volume.rays(origins, np.eye(3)[axis] * side), is_inside):
                labels = [object_of(volume.labels[number]) for number in layers["label"]]
                thickness = layers["leave"] - layers["enter"]
                whole = [label for label in labels if label.class_name in WHOLE]
                owner = whole[0] if whole else labels[int(np.argmax(thickness))]
                seen, kinds = found[owner.index]
                seen[axis] += step * step
                kinds[axis][
                    tuple(
                        (label.attributes.get("material", "?"), round(float(metres), 2))
                        for label, metres in zip(labels, thickness)
                    )
                ] += 1
    return found


def object_of(label):
    """The object of a phase: the window of a pane. Another label is an object itself."""
    return label.parent if label.class_name.endswith("Phase") else label


def transmittance(label, layers):
    """U of layers of (material, metres), W/(m2 K); None where a material is not known."""
    if label.class_name in WHOLE:
        return WHOLE[label.class_name]
    if any(material not in CONDUCTIVITY for material, _ in layers):
        return None
    return 1 / (INSIDE + OUTSIDE + sum(metres / CONDUCTIVITY[material] for material, metres in layers))


def table(volume, step=0.1):
    """Rows of (label, area m2, layers, U), the largest loss first."""
    rows = []
    for number, (seen, kinds) in envelope(volume, step).items():
        area, main = float(np.linalg.norm(seen)), int(np.argmax(seen))
        usual = kinds[main].most_common(1)[0][0]
        layers = tuple((material, metres * float(seen[main]) / area) for material, metres in usual)
        label = volume.labels[number]
        rows.append((label, area, layers, transmittance(label, layers)))
    return sorted(rows, key=lambda row: (-(row[3] or 0) * row[1], row[0].id))


def name_of(label):
    """Its name; without a name, its class and the room that it bounds."""
    room = label
    while room.parent is not None and room.class_name != "BuildingRoom":
        room = room.parent
    return label.name or f"{label.class_name} of {room.name or room.id}"


def main():
    volume, folder = arguments(__doc__, spacing=0.05)
    rows = [row for row in table(volume) if row[1] >= 0.25]
    with open(os.path.join(folder, "energy.csv"), "w", newline="") as file:
        out = csv.writer(file)
        out.writerow(("id", "name", "class", "area_m2", "layers", "u_w_m2k", "loss_w_k"))
        for label, area, layers, u in rows:
            text = " + ".join(f"{material} {metres:.2f} m" for material, metres in layers)
            out.writerow(
                (
                    label.id,
                    name_of(label),
                    label.class_name,
                    f"{area:.2f}",
                    text,
                    f"{u:.2f}" if u else "",
                    f"{u * area:.1f}" if u else "",
                )
            )
            print(
                f"{name_of(label):<40}{area:>8.2f} m2  U {u or float('nan'):5.2f}  {u * area if u else float('nan'):7.1f} W/K"
                f"  {text}"
            )
    print(f"transmission in all: {sum(u * area for _, area, _, u in rows if u):.0f} W/K")
    # From green (0.3 and better) over yellow to red (2.5 and worse).
    colors = {}
    for label, _, _, u in rows:
        if u:
            heat = min(max((u - 0.3) / 2.2, 0), 1)
            red, green = min(2 * heat, 1), min(2 - 2 * heat, 1)
            for part in (label, *(phase for phase in label.children if object_of(phase) == label)):
                colors[f"id='{part.id}'"] = f"#{int(40 + 190 * red):02x}{int(40 + 160 * green):02x}28"
    volume.frame(
        size=(960, 600),
        hide="class=BuildingRoom",
        color={"all": "#d8d8d8", **colors},
        opacity={"phase=glass": 1},
        camera="iso-sw",
        title="Envelope by U: green 0.3 to red 2.5 W/(m2 K)",
    ).save(os.path.join(folder, "energy.png"))


if __name__ == "__main__":
    main()

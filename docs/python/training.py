#!/usr/bin/env python3
"""Labels to a training set: pictures with the class of each pixel, and a scan with the class of each point."""
import os

import numpy as np

import svt
from example import arguments

PICTURES, WIDTH, HEIGHT = 8, 256, 192
POINTS = 200_000


def class_of_object(label):
    """Its class; for a phase, such as the panes of a window, that of the object."""
    return label.class_name.removesuffix("Phase")


def class_table(volume):
    """Names of the classes, background first, and the class of each label."""
    names = ["background", *sorted({class_of_object(label) for label in volume.labels if label.voxels})]
    return names, np.array(
        [names.index(class_of_object(label)) if label.voxels else 0 for label in volume.labels] + [0]
    )


def pictures(volume, class_of, random):
    """Views around the building, cut open by planes at random: colours, classes, metres."""
    size = np.array(volume.dimension) * volume.spacing
    colors, classes, depths = [], [], []
    for n in range(PICTURES):
        turn = 2 * np.pi * (n + random.random()) / PICTURES
        away = 1.6 * size.max()
        eye = size / 2 + away * np.array([np.cos(turn), np.sin(turn), 0.3 + 0.5 * random.random()])
        # The half that is nearer to the camera is cut away.
        axis = int(abs(np.sin(turn)) > abs(np.cos(turn)))
        sign = ">" if eye[axis] > size[axis] / 2 else "<"
        plane = f"{'xy'[axis]}{sign}{size[axis] * (0.35 + 0.3 * random.random()):.3f}"
        frame = volume.frame(
            size=(WIDTH, HEIGHT),
            eye=tuple(eye),
            target=tuple(size / 2),
            section=plane,
            hide="class=BuildingRoom",
            samples=4,
        )
        colors.append(frame.color[..., :3].copy())
        classes.append(class_of[volume.labels.of_scalar[frame.scalar]].astype(np.uint8))
        depths.append(frame.depth.copy())
    return np.stack(colors), np.stack(classes), np.stack(depths)


def scan(volume, class_of, random):
    """Points that a laser scanner in each room would see, with class and label."""
    rooms = volume.query("class=BuildingRoom and volume>5")
    is_air = np.array([label.class_name in ("BuildingRoom", "ClosureSurface") for label in volume.labels])
    points, labels = [], []
    for room in rooms:
        eye = room.box.mean(axis=0)
        directions = random.normal(size=(POINTS // len(rooms), 3))
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        runs = volume.rays(np.broadcast_to(eye, directions.shape), directions)
        solid = ~is_air[runs.all["label"]]
        rays, first = np.unique(runs.ray[solid], return_index=True)
        hit = runs.all[solid][first]
        noise = random.normal(scale=0.003, size=len(hit))  # a scanner's, metres
        points.append(eye + directions[rays] * (hit["enter"] + noise)[:, None])
        labels.append(hit["label"].astype(np.int32))
    points, labels = np.concatenate(points), np.concatenate(labels)
    return points, labels, class_of[labels].astype(np.uint8)


def sheet(colors, classes, names):
    """Two rows of pictures with their classes below them."""
    palette = np.random.default_rng(4).integers(40, 230, (len(names), 3)).astype(np.uint8)
    palette[0] = 255
    rows = []
    for begin in (0, PICTURES // 2):
        part = slice(begin, begin + PICTURES // 2)
        rows += [np.hstack(list(colors[part])), np.hstack(list(palette[classes[part]]))]
    return np.vstack(rows)


def main():
    volume, folder = arguments(__doc__, spacing=0.05)
    names, class_of = class_table(volume)
    random = np.random.default_rng(1)  # the same set each time
    colors, classes, depths = pictures(volume, class_of, random)
    points, labels, point_classes = scan(volume, class_of, random)
    np.savez_compressed(
        os.path.join(folder, "training.npz"),
        class_names=names,
        pictures=colors,
        picture_classes=classes,
        picture_depths=depths,
        points=points - volume.origin,
        point_labels=labels,
        point_classes=point_classes,
        volume=class_of[volume.labels.of_scalar[volume.dense(level=1)]].astype(np.uint8),
        volume_spacing=2 * np.array(volume.spacing),
    )
    svt.write_png(os.path.join(folder, "training.png"), sheet(colors, classes, names))
    print(f"training.npz: {len(colors)} pictures, {len(points)} points, {len(names)} classes")
    for number, count in enumerate(np.bincount(point_classes, minlength=len(names))):
        if count:
            print(f"  {names[number]:<28} {count:7} points  {100 * (classes == number).mean():6.2f} % of the pixels")


if __name__ == "__main__":
    main()

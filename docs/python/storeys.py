#!/usr/bin/env python3
"""Volumes by storey: rooms, their exact floor areas and volumes, and the construction around them."""
import csv
import os

from example import arguments


def known_sum(values):
    """The sum of the values that are known; the volume of a room without geometry is not."""
    return sum(value for value in values if value is not None)


def storeys(volume):
    """A row per storey: name, rooms, floor area (m2), volume of the rooms (m3), volume of the construction (m3)."""
    rows = []
    for storey in volume.query("class=Storey"):
        within = f"storey='{storey.name or storey.id}'"
        rooms = volume.query(f"{within} and class=BuildingRoom")
        parts = volume.query(f"{within} and class=BuildingConstructiveElement")
        # A plan one metre above the floor; areas are those of the model, cut exactly.
        plan = volume.section(f"storey={storey.name or storey.id}+1")
        numbers = {room.index for room in rooms}
        area = sum(part.area for part in plan.components if part.label.index in numbers)
        air = known_sum(room.volume for room in rooms)
        # The volume of an element includes its parts, which the query selects, too.
        elements = {part.index for part in parts}
        whole = [part for part in parts if part.parent is None or part.parent.index not in elements]
        rows.append((storey.name, len(rooms), area, air, known_sum(part.volume for part in whole)))
    return rows


def main():
    volume, folder = arguments(__doc__, spacing=0.05)
    rows = storeys(volume)
    if not rows:
        raise SystemExit("the model names no storeys")
    with open(os.path.join(folder, "storeys.csv"), "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(("storey", "rooms", "area_1m_m2", "rooms_m3", "construction_m3"))
        table.writerows((name, count, *(f"{number:.3f}" for number in numbers)) for name, count, *numbers in rows)
    print(f"{'storey':<16}{'rooms':>6}{'m2 at 1 m':>11}{'rooms m3':>10}{'built m3':>10}")
    for name, count, area, air, built in rows:
        print(f"{name:<16}{count:>6}{area:>11.2f}{air:>10.2f}{built:>10.2f}")
    picture = volume.frame(
        size=(960, 600),
        section="y<4.3",
        show="class=BuildingRoom or class=BuildingConstructiveElement",
        color_by="storey",
        look="paper",
        title="Rooms and construction by storey",
    )
    picture.save(os.path.join(folder, "storeys.png"))


if __name__ == "__main__":
    main()

"""The examples of docs/python: they run, print known values of the generated house, and write pictures."""
import csv
import json
import os
import pathlib
import subprocess
import sys
import unittest

import numpy as np

import svt
from common import command, known_volume, path

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent.parent / "docs" / "python"


def run(name):
    """Runs an example on the generated house. Returns its output and the rows of its table."""
    done = subprocess.run(
        [sys.executable, EXAMPLES / f"{name}.py", "-o", path("examples")], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    table = path(f"examples/{name}.csv")
    if not os.path.exists(table):
        return done.stdout, []
    with open(table, newline="", encoding="utf-8") as file:
        return done.stdout, list(csv.DictReader(file))


class Examples(unittest.TestCase):
    def same_picture(self, name):
        mine, shown = svt.read_png(path(f"examples/{name}.png")), svt.read_png(EXAMPLES / "images" / f"{name}.png")
        self.assertEqual(mine.shape, shown.shape)
        # Arithmetic of other versions of numpy and SciPy may differ in the last bit of a colour.
        difference = np.abs(mine.astype(int) - shown)
        self.assertLess(
            difference.mean(), 0.1, f"{name}.png is not the picture of docs/python; look at it, and copy it there"
        )

    def test_storeys(self):
        _, rows = run("storeys")
        self.assertEqual([row["storey"] for row in rows], ["Ground floor", "Upper floor", "Attic"])
        self.assertEqual([int(row["rooms"]) for row in rows], [7, 6, 1])
        volume = svt.build(self.house(), spacing=0.2)
        total = sum(known_volume(room) for room in volume.query("class=BuildingRoom"))
        self.assertAlmostEqual(sum(float(row["rooms_m3"]) for row in rows), total, 2)
        query = (
            "query",
            self.house(),
            "class=BuildingConstructiveElement",
            "--by",
            "storey",
            "--json",
            "--spacing",
            0.05,
        )
        built = json.loads(command(*query))
        self.assertEqual(
            {row["storey"]: float(row["construction_m3"]) for row in rows},
            {row["storey"]: round(row["totalVolume"], 3) for row in built},
        )
        # The ground floor is 11 m x 9 m outside, with walls of 35 cm.
        self.assertLess(float(rows[0]["area_1m_m2"]), (11 - 0.7) * (9 - 0.7))
        self.assertGreater(float(rows[0]["area_1m_m2"]), 0.9 * (11 - 0.7) * (9 - 0.7))
        self.same_picture("storeys")

    def test_energy(self):
        text, rows = run("energy")
        by_name = {row["name"]: row for row in rows}
        wall = by_name["Exterior wall north, ground floor"]
        self.assertEqual(wall["layers"], "brick 0.35 m")
        self.assertAlmostEqual(float(wall["u_w_m2k"]), 1 / (0.17 + 0.35 / 0.5), 2)
        # The roof is 18.5 cm thick across its slope: a model of its own says so, see the test of the normal below.
        roofs = [float(by_name[f"Roof slab {side}"]["area_m2"]) for side in ("north", "south")]
        self.assertAlmostEqual(roofs[0], roofs[1], delta=1)
        self.assertIn("transmission in all", text)
        self.same_picture("energy")

    def test_energy_of_an_oblique_slab_is_that_across_it(self):
        sys.path.insert(0, str(EXAMPLES))
        import energy

        # A room below a slab of 30 cm that rises 3 in 4 (a slope of 5): the ray along z is 0.3 * 5 / 4 in it.
        k, _, i = np.mgrid[0:160, 0:60, 0:80] * 0.05
        height = k - 2 - 0.75 * i
        values = np.where(height < 0, 1, np.where(height < 0.375, 2, 0)).astype(np.uint8)
        volume = svt.Volume.from_dense(
            values,
            {
                1: {"class": "BuildingRoom", "name": "Room"},
                2: {"class": "RoofSurface", "name": "Roof", "attributes": {"material": "timber"}},
            },
            spacing=0.05,
        )
        rows = {label.name: (area, layers, u) for label, area, layers, u in energy.table(volume)}
        area, layers, u = rows["Roof"]
        # 4 m x 3 m in plan, a quarter more on the slope; the x axis sees 3 m of height where the room is behind it.
        self.assertAlmostEqual(area, 4 * 3 * 1.25, delta=1.0)
        self.assertEqual(layers[0][0], "timber")
        self.assertAlmostEqual(layers[0][1], 0.3, delta=0.03)
        self.assertAlmostEqual(u, 1 / (0.17 + 0.3 / 0.13), delta=0.05)

    def test_visibility(self):
        _, rows = run("visibility")
        sky = {row["room"]: float(row["sky_share"]) for row in rows}
        self.assertEqual(sky["Loft"], 0)  # its windows are below the eye, or hidden
        self.assertTrue(all(0.003 < share < 0.2 for room, share in sky.items() if room != "Loft"), sky)
        self.same_picture("visibility")

    def test_visibility_of_a_shoebox_is_known(self):
        sys.path.insert(0, str(EXAMPLES))
        import visibility

        # A cube of air 2 m wide in walls of 20 cm, one of them with a round hole of 60 cm radius. From the middle its outer
        # rim, 1.2 m away, is what bounds the view: a share of (1 - cos a) / 2 with tan a = 1/2.
        k, j, i = np.mgrid[0:120, 0:120, 0:120] * 0.02 - 1.19
        inside = (abs(i) < 1) & (abs(j) < 1) & (abs(k) < 1)
        hole = (i > 0) & (np.hypot(j, k) < 0.6)
        values = np.where(inside, 1, np.where(hole, 0, 2)).astype(np.uint8)
        volume = svt.Volume.from_dense(
            values,
            {1: {"class": "BuildingRoom"}, 2: {"class": "WallSurface"}},
            spacing=0.02,
            origin=(-1.19, -1.19, -1.19),
        )
        directions = visibility.sphere(50000)
        label, distance = visibility.first_hits(volume, np.zeros_like(directions), directions)
        self.assertAlmostEqual((label < 0).mean(), (1 - np.cos(np.arctan(0.5))) / 2, delta=0.001)
        hit = np.isfinite(distance)
        expected = 1 / np.abs(directions[hit]).max(axis=1)
        straight = np.hypot(directions[hit, 1], directions[hit, 2]) > 0.55
        np.testing.assert_allclose(distance[hit][straight], expected[straight], atol=0.03)

    def test_distance(self):
        _, rows = run("distance")
        radius = {row["room"]: float(row["largest_free_radius_m"]) for row in rows}
        # The bath has a free height of 2.4 m or less; no ball is wider than its room is high.
        self.assertTrue(all(0 < metres < 1.5 for metres in radius.values()), radius)
        self.same_picture("distance")

    def test_distance_in_a_box_is_known(self):
        sys.path.insert(0, str(EXAMPLES))
        import distance

        values = np.full((44, 64, 84), 2, np.uint8)
        values[2:-2, 2:-2, 2:-2] = 1
        volume = svt.Volume.from_dense(
            values, {1: {"class": "BuildingRoom"}, 2: {"class": "BuildingConstructiveElement"}}, spacing=0.05
        )
        field, _ = distance.clearance(volume)
        self.assertAlmostEqual(field.max(), 1.0, delta=0.051)  # 2 m high
        self.assertEqual(field[0].max(), 0)

    def test_training_set(self):
        run("training")
        data = np.load(path("examples/training.npz"))
        names = list(data["class_names"])
        self.assertEqual(names[0], "background")
        self.assertEqual(data["pictures"].shape, (8, 192, 256, 3))
        self.assertEqual(data["picture_classes"].shape, (8, 192, 256))
        # Where a pixel shows nothing, its depth is infinite, and the other way round.
        np.testing.assert_array_equal(data["picture_classes"] == 0, np.isinf(data["picture_depths"]))
        self.assertEqual(len(data["points"]), len(data["point_classes"]))
        # A point of the scan lies on what it is labelled with, up to its noise and half a voxel.
        volume = svt.build(self.house(), spacing=0.05)
        origin = np.array(volume.origin)
        random = np.random.default_rng(5)
        some = random.choice(len(data["points"]), 2000, replace=False)
        off = np.stack(np.meshgrid(*[[-0.04, -0.02, 0, 0.02, 0.04]] * 3), -1).reshape(-1, 3)
        near = volume.sample((data["points"][some] + origin)[:, None] + off)
        self.assertGreater((near == data["point_labels"][some][:, None]).any(axis=1).mean(), 0.99)
        self.same_picture("training")

    @staticmethod
    def house():
        if not os.path.exists(path("house.gml")):
            svt.sample("house", path("house.gml"))
        return path("house.gml")


if __name__ == "__main__":
    unittest.main()

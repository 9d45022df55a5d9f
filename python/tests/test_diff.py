"""Two states of a building: the rows of `svt diff` in Python."""
import json
import math
import pathlib
import subprocess
import unittest

import svt
from common import COMMAND, house, house_file, needs, needs_command, path


def box(name, x0, x1):
    """Faces of a box 4 m wide and 3 m high, as an object of CityJSON with its vertices."""
    points = [[x, y, z] for z in (0, 3) for y in (0, 4) for x in (x0, x1)]
    faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]]
    return name, points, faces


def model(file, boxes):
    objects: dict[str, dict] = {}
    vertices: list[list[float]] = []
    for name, points, faces in boxes:
        shell = [[[len(vertices) + corner for corner in face]] for face in faces]
        solid = {"type": "Solid", "lod": "2", "boundaries": [shell]}
        objects[name] = {"type": "Building", "geometry": [solid]}
        vertices += points
    head = {"type": "CityJSON", "version": "2.0", "transform": {"scale": [1, 1, 1], "translate": [0, 0, 0]}}
    pathlib.Path(path(file)).write_text(json.dumps({**head, "CityObjects": objects, "vertices": vertices}))
    return path(file)


@needs_command
class Diff(unittest.TestCase):
    def setUp(self):
        self.old = model("old.city.json", [box("stays", 0, 5), box("grows", 10, 14), box("goes", 20, 25)])
        self.new = model("new.city.json", [box("stays", 0, 5), box("grows", 10, 16)])

    def test_rows_have_the_volumes_of_boxes(self):
        found = svt.diff(self.old, self.new, spacing=0.5)
        self.assertTrue(found.is_different)
        rows = {(row["old"] or row["new"])[0]: row for row in found.rows}
        self.assertEqual(
            {name: row["change"] for name, row in rows.items()},
            {"stays": "same", "grows": "changed", "goes": "removed"},
        )
        self.assertAlmostEqual(rows["grows"]["added"], 2 * 4 * 3, places=4)
        self.assertAlmostEqual(rows["goes"]["removed"], 5 * 4 * 3, places=4)
        self.assertTrue(rows["grows"]["exact"])
        self.assertEqual([row["change"] for row in found.changes], ["changed", "removed"])
        self.assertEqual(found.summary["changes"]["same"], 1)
        self.assertEqual(len(found), 3)
        self.assertIn("1 changed", repr(found))

    def test_rows_are_those_of_the_command(self):
        done = subprocess.run([COMMAND, "diff", self.old, self.new, "--spacing", "0.5", "--json"], capture_output=True)
        found = svt.diff(self.old, self.new, spacing=0.5)
        printed = json.loads(done.stdout)
        self.assertEqual((found.rows, found.summary), (printed["rows"], printed["summary"]))

    def test_volumes_are_states(self):
        found = svt.diff(house(), house())
        self.assertFalse(found.is_different)
        self.assertEqual(found.changes, [])
        self.assertFalse(svt.diff(house_file(), house(), properties="none").is_different)

    def test_outputs_are_written(self):
        svt.diff(self.old, self.new, spacing=0.5, output=path("r.html"))
        self.assertIn("<!doctype html>", pathlib.Path(path("r.html")).read_text(encoding="utf-8"))
        svt.diff(self.old, self.new, spacing=0.5, output=[path("c.bcf"), pathlib.Path(path("c.csv"))])
        self.assertEqual(pathlib.Path(path("c.bcf")).read_bytes()[:2], b"PK")
        self.assertIn("removed", pathlib.Path(path("c.csv")).read_text(encoding="utf-8"))

    @needs("pandas")
    def test_rows_are_a_table(self):
        found = svt.diff(self.old, self.new, spacing=0.5)
        table = found.to_pandas()
        self.assertEqual(list(table["change"]), ["changed", "removed"])
        self.assertAlmostEqual(table["added"].sum(), 24, places=4)
        self.assertTrue(math.isnan(table["dx"].iloc[0]))
        self.assertEqual(len(found.to_pandas(all=True)), 3)
        self.assertEqual(table["added"].dtype, float)
        self.assertEqual(len(svt.diff(self.old, self.old, spacing=0.5).to_pandas()), 0)

    def test_errors_are_those_of_the_command(self):
        with self.assertRaises(svt.Error) as missing:
            svt.diff(path("missing.gml"), self.new)
        self.assertEqual(missing.exception.code, "E101")
        with self.assertRaises(svt.Error) as bad:
            svt.diff(self.old, self.new, tolerance=0)
        self.assertIn("tolerance", bad.exception.message)
        with self.assertRaises(svt.Error):
            svt.diff(self.old, self.new, no_such_option=True)
        with self.assertRaises(svt.Error) as unwritable:
            svt.diff(self.old, self.new, output=path("missing/r.html"))
        self.assertIn("missing", unwritable.exception.message)
        with self.assertRaises(TypeError):
            svt.diff(self.old, self.new, json=True)


if __name__ == "__main__":
    unittest.main()

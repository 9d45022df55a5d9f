"""The code of docs/python/README.md after its first block runs, part by part, on the generated house."""
import importlib.util
import os
import pathlib
import re
import unittest
from typing import Any
from unittest import mock

import svt
from common import COMMAND, house_file, known_volume, path
from test_page import PAGE

PAGE_OF_MANUAL = pathlib.Path(__file__).resolve().parent.parent.parent / "docs" / "python" / "README.md"
# Imports that code of the page may lack, and the functions that need another package.
NEEDED = {
    "pandas": ("pandas",),
    "geopandas": ("geopandas",),
    "xarray": ("xarray", "netCDF4"),
    "to_vtk": ("vtkmodules",),
}


def parts():
    """Heading -> code of the page, without the first block, which test_command.py runs on a real model."""
    text = PAGE_OF_MANUAL.read_text(encoding="utf-8")
    found = {}
    for section in re.split(r"^## ", text, flags=re.M)[1:]:
        blocks = re.findall(r"^```python\n(.*?)^```", section, re.M | re.S)
        if blocks:
            found[section.partition("\n")[0]] = "".join(blocks)
    return found


class Manual(unittest.TestCase):
    def run_part(self, heading) -> dict[str, Any]:
        code = parts()[heading]
        for word, modules in NEEDED.items():
            for module in modules:
                if re.search(rf"\b{word}\b", code) and importlib.util.find_spec(module) is None:
                    self.skipTest(f"no {module} (scripts/setup.sh readers installs it)")
        folder = path("manual-parts")
        os.makedirs(folder, exist_ok=True)
        before = os.getcwd()
        os.chdir(folder)
        try:
            if not os.path.exists("house.svt"):
                svt.build(house_file(), spacing=0.1).save("house.svt")
            names: dict[str, Any] = {}
            exec(compile(code, f"{PAGE_OF_MANUAL}: {heading}", "exec"), names)
        finally:
            os.chdir(before)
        return names

    def test_each_part_with_code_has_a_test(self):
        tested = {"Work with xarray", "Fields", "Tables", "Quantities", "Maps", "Notebook", "VTK and PyVista"}
        self.assertEqual(set(parts()), tested)

    def test_fields(self):
        names = self.run_part("Fields")
        rooms = names["rooms"]
        self.assertGreater(len(rooms), 3)
        self.assertTrue((rooms["share_over"] >= 0).all() and (rooms["share_over"] <= 1).all())
        self.assertEqual(names["image"].shape, (360, 640, 4))
        heights = names["heights"].values
        self.assertTrue((heights[1:] >= heights[:-1]).all())
        self.assertEqual(len(names["v"].fields), 0)

    def test_xarray(self):
        names = self.run_part("Work with xarray")
        self.assertEqual(names["plan"].dims, ("y", "x"))
        self.assertIn("BuildingRoom", names["classes"].values)
        self.assertGreater(float(names["area"].max()), 60)
        self.assertGreater(os.path.getsize(path("manual-parts/house.nc")), 10_000)

    @unittest.skipUnless(os.path.exists(COMMAND), "no command at SVT_COMMAND")
    def test_quantities(self):
        names = self.run_part("Quantities")
        self.assertAlmostEqual(names["sums"].net_volume.sum(), names["found"].total["netVolume"], places=4)
        self.assertGreater(len(names["ground"]), 1)
        self.assertGreater(names["by_room"]["Kitchen"], 10)

    def test_tables(self):
        names = self.run_part("Tables")
        v = svt.open(path("manual-parts/house.svt"))
        self.assertAlmostEqual(names["total"], sum(known_volume(label) for label in v.query("class=BuildingRoom")))
        self.assertIn("attributes.material", names["materials"].columns)
        self.assertGreater(names["by_class"]["BuildingRoom"], 70)
        self.assertGreater(len(names["contacts"]), 100)
        with open(path("manual-parts/rooms.csv"), encoding="utf-8") as file:
            self.assertEqual(len(file.readlines()), len(names["rooms"]) + 1)

    def test_maps(self):
        names = self.run_part("Maps")
        self.assertEqual(names["largest"], "Living room")
        for name in ("rooms.geojson", "plan.geojson"):
            self.assertGreater(os.path.getsize(path(f"manual-parts/{name}")), 1000)

    def test_notebook(self):
        if not (os.path.exists(COMMAND) and PAGE.exists()):
            self.skipTest("the page is not built (make viewer)")
        with mock.patch.dict(os.environ, {"SVT_COMMAND": COMMAND}):
            self.run_part("Notebook")
        size = os.path.getsize(path("manual-parts/house.html"))
        self.assertTrue(3_500_000 < size < 5_000_000, f"the manual states 4 MB, the page has {size}")

    def test_vtk(self):
        names = self.run_part("VTK and PyVista")
        v = svt.open(path("manual-parts/house.svt"))
        self.assertEqual(names["values"].GetNumberOfTuples(), v.dense().size)


if __name__ == "__main__":
    unittest.main()

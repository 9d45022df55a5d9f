"""Take-offs and contacts: those of `svt quantities` in Python."""
import json
import math
import unittest

import svt
from common import command, house, house_svt, needs, needs_command, path

WALLS = "class=BuildingConstructiveElement"


@needs_command
class TakeOff(unittest.TestCase):
    def test_rows_and_sums_are_those_of_the_command(self):
        options = ["--exterior", "--formwork", WALLS, "--by", "class,storey"]
        expected = json.loads(command("quantities", house_svt(), "--json", "-q", *options))
        found = svt.take_off(house_svt(), by=["class", "storey"], exterior=True, formwork=WALLS)
        self.assertEqual(found.rows, expected["rows"])
        self.assertEqual(found.sums, expected["sums"])
        self.assertEqual((found.total, found.exterior), (expected["total"], expected["exterior"]))
        self.assertEqual(found.stated, [])
        self.assertTrue(found.assumptions)
        self.assertEqual(len(found), len(expected["rows"]))
        self.assertIn("m3", repr(found))

    def test_a_volume_is_a_model(self):
        walls = svt.take_off(house(), WALLS)
        self.assertEqual({row["class"] for row in walls.rows}, {"BuildingConstructiveElement"})
        self.assertEqual(walls.rows, svt.take_off(house_svt(), WALLS).rows)

    @needs("pandas")
    def test_tables_have_numbers_and_unknown_ones_are_nan(self):
        found = svt.take_off(house_svt(), by="class", exterior=True, formwork=WALLS)
        table = found.to_pandas()
        self.assertEqual(len(table), len(found.rows))
        row = found.rows[0]
        self.assertEqual(table.loc[0, "class_name"], row["class"])
        self.assertAlmostEqual(table.loc[0, "net_volume"], row["netVolume"], places=6)
        self.assertEqual(table.gross_volume.isna().sum(), sum(each["grossVolume"] is None for each in found.rows))
        self.assertAlmostEqual(table.exterior_top.sum(), found.total["exterior"]["top"], places=4)
        self.assertTrue(math.isnan(table[table.class_name == "BuildingFurniture"].formwork_area.iloc[0]))
        sums = found.sums_to_pandas()
        self.assertEqual(list(sums["class"]), [each["by"]["class"] for each in found.sums])
        self.assertEqual(sums.objects.sum(), len(found.rows))
        self.assertAlmostEqual(sums.net_volume.sum(), found.total["netVolume"], places=4)
        self.assertEqual(sums.unknown_gross_volume.sum(), found.total["unknown"]["grossVolume"])

    @needs("pandas")
    def test_stated_quantities_and_files(self):
        command("sample", "house", "-o", path("stated.ifc"), "--format", "ifc")
        found = svt.take_off(path("stated.ifc"), stated=True, spacing=0.1, output=path("measured.csv"))
        table = found.stated_to_pandas()
        self.assertGreater(len(table), 10)
        self.assertLess(abs(table.difference / table.stated).max(), 1e-3)
        with open(path("measured.csv"), encoding="utf-8") as file:
            self.assertEqual(len(file.readlines()), len(found.stated) + 1)

    def test_contacts_are_pairs_with_the_areas_of_both(self):
        rooms = svt.contact_areas(house_svt(), "class=BuildingRoom", WALLS)
        self.assertGreater(len(rooms), 10)
        self.assertEqual(set(rooms[0]), {"a", "a_name", "b", "b_name", "area", "area_of_b"})
        # The loft has surfaces between its space and the roof, and rafters that take a quarter of the slab.
        roof = [row for row in rooms if row["a_name"] == "Loft" and row["b_name"].startswith("Roof slab")]
        self.assertEqual(len(roof), 2)
        for row in roof:
            self.assertGreater(row["area_of_b"], 0.7 * row["area"])
            self.assertLess(row["area_of_b"], row["area"])
        self.assertEqual(svt.contact_areas(house_svt(), "name=Kitchen", "name=Loft"), [])

    def test_errors_are_those_of_the_library(self):
        with self.assertRaises(svt.Error) as caught:
            svt.take_off(house_svt(), "class=")
        self.assertEqual(caught.exception.code, "E901")
        with self.assertRaises(svt.Error):
            svt.take_off(path("missing.svt"))
        with self.assertRaises(TypeError):
            svt.take_off(house_svt(), json=True)


if __name__ == "__main__":
    unittest.main()

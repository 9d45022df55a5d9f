"""Tables and maps: labels and sections as DataFrames, sections as GeoJSON."""
import json
import math
import subprocess
import unittest
from typing import Any

import numpy as np

import svt
from common import COMMAND, command, house, house_svt, needs, needs_command, path


def bodies_and_surfaces():
    """A room with attributes, and labels without voxels above it."""
    array = np.ones((2, 2, 2), np.uint8)
    array[1] = 2
    return svt.Volume.from_dense(
        array,
        {
            1: {"id": "a", "class": "BuildingRoom", "name": "Küche", "attributes": {"n": 3, "free": True}},
            2: {"id": "b", "class": "WallSurface", "attributes": {"u": 0.25}},
        },
        spacing=0.5,
    )


KINDS = ("roof", "wall", "ground", "window", "door")


class Tables(unittest.TestCase):
    @needs("pandas")
    def test_labels_are_rows_with_the_numbers_of_their_properties(self):
        v = house()
        table = v.labels.to_pandas()
        self.assertEqual(list(table.index), [label.index for label in v.labels])
        self.assertEqual(
            list(table.columns),
            "id class_name name parent voxels volume volume_bound volume_source voxel_volume area outside_area "
            "total_volume total_area filling".split(),
        )
        kitchen = v.labels["Kitchen"]
        row = table.loc[kitchen.index]
        self.assertEqual((row["id"], row["class_name"], row["parent"]), (kitchen.id, "BuildingRoom", kitchen.parent.id))
        self.assertEqual((row["voxels"], row["volume"]), (kitchen.voxels, kitchen.volume))
        self.assertEqual((row["area"], row["outside_area"]), (kitchen.area, kitchen.outside_area))
        self.assertEqual((row["total_volume"], row["total_area"]), (kitchen.total_volume, kitchen.total_area))

    @needs("pandas")
    @needs_command
    def test_quantities_are_those_of_the_command(self):
        table = svt.quantities(house_svt(), exterior=True)
        report = json.loads(command("quantities", house_svt(), "--exterior", "--json", "-q"))
        rows = {row["id"]: row for row in report["rows"]}
        self.assertEqual(sorted(table["id"]), sorted(rows))
        names = {"net_volume": "netVolume", "gross_volume": "grossVolume", "opening_area": "openingArea"}
        unknown = 0
        for _, row in table.iterrows():
            expected = rows[row["id"]]
            for name, key in names.items():
                if expected[key] is None:
                    self.assertTrue(math.isnan(row[name]))
                    unknown += 1
                else:
                    self.assertAlmostEqual(row[name], expected[key], places=6)
            self.assertEqual(row["trust"], expected["trust"])
        self.assertGreater(unknown, 0)
        self.assertAlmostEqual(table["exterior_top"].sum(), report["total"]["exterior"]["top"], places=4)
        walls = svt.quantities(house(), "class=BuildingConstructiveElement")
        self.assertEqual(set(walls["class_name"]), {"BuildingConstructiveElement"})
        with self.assertRaises(TypeError):
            svt.quantities(house(), spacing=0.1)
        with self.assertRaises(svt.Error):
            svt.quantities(house(), "class=")

    @needs("pandas")
    def test_faces_are_those_of_the_model(self):
        v = house()
        table = v.labels.to_pandas("class=Window", faces=True)
        self.assertEqual([name for name in table.columns if name.startswith("faces.")], ["faces." + k for k in KINDS])
        # A frame of 6 cm, bars of 5 cm, 7 cm deep, two by two panes; the panes count no second time.
        across, up = 2.2 - 0.17, 2.3 - 0.17
        frame = 2 * (2.2 * 2.3 - across * up) + 0.07 * 2 * (2.2 + 2.3) + 0.07 * 4 * (across + up)
        terrace = v.labels["Terrace window"]
        self.assertAlmostEqual(table.loc[terrace.index]["faces.window"], frame, places=4)
        self.assertAlmostEqual(terrace.faces["window"], frame, places=4)
        self.assertIsNone(terrace.faces["roof"])
        self.assertTrue(table["faces.roof"].isna().all())
        none = v.labels.to_pandas("class=Window")
        self.assertFalse([name for name in none.columns if name.startswith("faces.")])

    @needs("pandas")
    def test_unknown_numbers_are_nan_and_not_zero(self):
        v = house()
        table = v.labels.to_pandas()
        surfaces = table[table.filling == "surface"]
        self.assertGreater(len(surfaces), 100)
        self.assertTrue(surfaces.volume.isna().all())
        self.assertTrue((surfaces.area > 0).all())
        building = table[table.class_name == "Building"].iloc[0]
        self.assertEqual(building.voxels, 0)
        self.assertTrue(math.isnan(building.area) and math.isnan(building.voxel_volume))
        self.assertGreater(building.volume, 300)  # with its parts
        self.assertIn(building.volume_source, ("meshes", "meshes and voxels"))
        self.assertTrue((surfaces.volume_source == "").all())
        self.assertIsNone(building.parent)
        self.assertGreater(building.total_volume, 300)  # that of its rooms, walls and slabs
        solids = table[table.filling == "solid"]
        self.assertTrue((solids.volume > 0).all())

    @needs("pandas")
    def test_a_query_selects_the_rows(self):
        v = house()
        rooms = v.labels.to_pandas("class=BuildingRoom and volume>20")
        self.assertEqual(list(rooms.index), [label.index for label in v.query("class=BuildingRoom and volume>20")])
        self.assertEqual(len(v.labels.to_pandas("name=nothing")), 0)
        with self.assertRaises(svt.Error) as caught:
            v.labels.to_pandas("class=")
        self.assertEqual(caught.exception.code, "E901")

    @needs("pandas")
    def test_attributes_are_columns(self):
        table = bodies_and_surfaces().labels.to_pandas(attributes=True)
        self.assertEqual(table["attributes.n"].tolist()[0], 3)
        self.assertIs(table["attributes.free"].tolist()[0], True)
        self.assertIsNone(table["attributes.free"].tolist()[1])
        self.assertTrue(math.isnan(table["attributes.u"].tolist()[0]))
        self.assertEqual(table["attributes.u"].tolist()[1], 0.25)
        self.assertEqual(table["name"].tolist(), ["Küche", ""])

    @needs("pandas")
    def test_components_of_a_section_are_rows(self):
        section = house().section("z=1.2")
        table = section.to_pandas()
        self.assertEqual(len(table), len(section.components))
        self.assertAlmostEqual(table.area.sum(), section.area)
        for (index, row), component in zip(table.iterrows(), section.components):
            self.assertEqual((index, row["id"]), (component.label.index, component.label.id))
            self.assertEqual((row["area"], row["polygons"]), (component.area, len(component.polygons)))
        self.assertEqual(len(house().section("z=1.2", show="class=Storey", spaces=False).to_pandas().columns), 8)

    @needs("pandas")
    def test_structured_arrays_are_tables(self):
        import pandas

        v = house()
        contacts = pandas.DataFrame(v.contacts())
        self.assertEqual(list(contacts.columns), ["a", "b", "area"])
        runs = v.rays([v.box.mean(axis=0)], [0, 0, 1])
        self.assertEqual(len(pandas.DataFrame(runs.all)), len(runs.all))


def area_of(ring):
    x, y = np.array(ring)[:, :2].T - np.array(ring)[0, :2, None]
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


class Maps(unittest.TestCase):
    def test_section_is_a_collection_in_the_coordinates_of_the_model(self):
        v = house()
        section = v.section("z=1.2")
        collection = section.__geo_interface__
        self.assertEqual(collection["type"], "FeatureCollection")
        self.assertEqual(collection["crs"]["properties"]["name"], "urn:ogc:def:crs:EPSG::25832")
        self.assertEqual([f["id"] for f in collection["features"]], [c.label.id for c in section.components])
        holes = 0
        for feature, component in zip(collection["features"], section.components):
            geometries = feature["geometry"].get("geometries", [feature["geometry"]])
            total = 0.0
            for polygon in (p for g in geometries if g["type"] == "MultiPolygon" for p in g["coordinates"]):
                for ring in polygon:
                    self.assertEqual(ring[0], ring[-1])
                    low, high = np.array(ring).min(axis=0), np.array(ring).max(axis=0)
                    self.assertTrue((low >= v.box[0]).all() and (high <= v.box[1]).all())
                    self.assertAlmostEqual(low[2], v.origin[2] + 1.2, 6)
                self.assertGreater(area_of(polygon[0]), 0)
                self.assertTrue(all(area_of(hole) < 0 for hole in polygon[1:]))
                total += sum(map(area_of, polygon))
                holes += len(polygon) - 1
            self.assertAlmostEqual(total, component.area, 4)
            self.assertEqual(feature["properties"]["class"], component.label.class_name)
        self.assertGreater(holes, 0)

    @needs_command
    def test_collection_is_that_of_the_command(self):
        subprocess.run(
            [COMMAND, "section", house_svt(), "--plane", "z=1.2", "-o", path("map.geojson")],
            check=True,
            capture_output=True,
        )
        with open(path("map.geojson"), encoding="utf-8") as file:
            self.assertEqual(svt.open(house_svt()).section("z=1.2").__geo_interface__, json.load(file))

    @needs("geopandas")
    def test_geopandas_reads_a_section(self):
        import geopandas

        section = house().section("z=1.2", show="class=BuildingRoom")
        frame = geopandas.GeoDataFrame.from_features(section, crs="EPSG:25832")
        self.assertEqual(len(frame), len(section.components))
        self.assertTrue(frame.is_valid.all())
        np.testing.assert_allclose(frame.geometry.area, [c.area for c in section.components], atol=1e-4)
        inside: Any = frame.geometry.unary_union.representative_point()
        x, y = frame.to_crs(4326).geometry.iloc[0].centroid.coords[0]
        self.assertAlmostEqual(x, 9, 2)  # the house is at the central meridian of zone 32
        self.assertTrue(frame.geometry.contains(inside).any())


if __name__ == "__main__":
    unittest.main()

"""The module against the command: labels, areas, pictures, files."""
import contextlib
import io
import json
import os
import pathlib
import shutil
import unittest

import numpy as np

import svt
from common import DATA, command, house, house_svt, needs_command, path


def read_nrrd(name):
    """A raw NRRD: header as a dict, samples as [k, j, i]. This reader follows the definition of the format."""
    with open(name, "rb") as file:
        head, _, data = file.read().partition(b"\n\n")
    fields = dict(
        line.split(": ", 1)
        for line in head.decode().splitlines()
        if ": " in line and ":=" not in line.split(": ")[0] and not line.startswith("#")
    )
    kinds = {
        "uint8": np.uint8,
        "uint16": "<u2",
        "uint32": "<u4",
        "unsigned char": np.uint8,
        "unsigned short": "<u2",
        "unsigned int": "<u4",
    }
    sizes = [int(n) for n in fields["sizes"].split()]
    assert fields["encoding"] == "raw"
    return fields, np.frombuffer(data, kinds[fields["type"]]).reshape(sizes[::-1])


@needs_command
class Command(unittest.TestCase):
    def same_labels(self, v, name, *options, dense):
        command("convert", name, path("labels.nrrd"), "--encoding", "raw", *options)
        fields, labels = read_nrrd(path("labels.nrrd"))
        self.assertEqual(dense.dtype.itemsize, labels.dtype.itemsize)
        np.testing.assert_array_equal(dense, labels)

    def test_volume_file_has_the_same_bytes(self):
        house().save(path("python.svt"))
        with open(path("python.svt"), "rb") as a, open(house_svt(), "rb") as b:
            self.assertTrue(a.read() == b.read())

    def test_labels_are_those_of_convert_bit_for_bit(self):
        v = svt.open(house_svt())
        self.same_labels(v, house_svt(), dense=v.dense())
        self.same_labels(v, house_svt(), "--level", "2", dense=v.dense(level=2))
        box = np.array([v.world((10, 20, 5)), v.world((70, 50, 40))])
        text = ",".join(repr(float(x)) for x in box.ravel())
        self.same_labels(v, house_svt(), "--box", text, dense=v.dense(box=box))
        self.same_labels(v, house_svt(), "--box", text, "--level", "1", dense=v.dense(box=box, level=1))
        self.same_labels(
            v, house_svt(), "--select", "class=BuildingRoom", dense=v.part(select="class=BuildingRoom").dense()
        )

    def test_written_formats_have_the_same_bytes(self):
        v = svt.open(house_svt())
        for name in ("h.nrrd", "h.vti", "h.nii.gz", "h.tif", "h.glb", "h.csv"):
            v.save(path("python-" + name))
            command("convert", house_svt(), path("command-" + name))
            with open(path("python-" + name), "rb") as a, open(path("command-" + name), "rb") as b:
                self.assertTrue(a.read() == b.read(), name)
        again = svt.open(path("command-h.nrrd"))
        np.testing.assert_array_equal(again.dense(), v.dense())

    def test_options_of_written_formats_are_those_of_the_command(self):
        v = svt.open(house_svt())
        box = (v.world((10, 20, 5)), v.world((70, 50, 40)))
        box_text = ",".join(repr(float(x)) for x in np.ravel(box))
        cases: list[tuple[str, dict, list[str]]] = [
            (
                "o.nrrd",
                {"encoding": "raw", "box": box, "level": 1},
                ["--encoding", "raw", "--box", box_text, "--level", "1"],
            ),
            (
                "o.obj",
                {"select": "class=BuildingRoom", "faces": "voxels"},
                ["--select", "class=BuildingRoom", "--faces", "voxels"],
            ),
            ("o.fds", {"holes": "class=Door", "merge": "class"}, ["--holes", "class=Door", "--merge", "class"]),
            ("o.vdb", {"level_sets": True, "level": 2}, ["--level-sets", "--level", "2"]),
            ("o.x3d", {"texture": "atlas"}, ["--texture", "atlas"]),
        ]
        for name, options, words in cases:
            v.save(path("python-" + name), **options)
            command("convert", house_svt(), path("command-" + name), *words)
            with open(path("python-" + name), "rb") as a, open(path("command-" + name), "rb") as b:
                self.assertTrue(a.read().replace(b"python-o", b"command-o") == b.read(), name)
        cases = [
            ("o.precomputed", {"meshes": True, "sharded": True, "level": 1}, ["--meshes", "--sharded", "--level", "1"]),
            ("o.zarr", {"zarr": 3}, ["--zarr", "3"]),
            ("o.3dtiles", {"place": (49.1, 8.44, 110), "lift": 48.2}, ["--place", "49.1,8.44,110", "--lift", "48.2"]),
        ]
        for name, options, words in cases:
            v.save(path("python-" + name), **options)
            command("convert", house_svt(), path("command-" + name), *words)
            files = sorted(
                os.path.relpath(os.path.join(at, file), path("command-" + name))
                for at, _, found in os.walk(path("command-" + name))
                for file in found
            )
            self.assertGreater(len(files), 1)
            for file in files:
                with open(os.path.join(path("python-" + name), file), "rb") as a, open(
                    os.path.join(path("command-" + name), file), "rb"
                ) as b:
                    self.assertTrue(a.read() == b.read(), file)
        v.save(path("rooms.svt"), select="class=BuildingRoom")
        np.testing.assert_array_equal(svt.open(path("rooms.svt")).dense(), v.part(select="class=BuildingRoom").dense())

    def test_info_is_that_of_the_command(self):
        self.assertEqual(svt.open(house_svt()).info(), json.loads(command("info", house_svt(), "--json")))

    def test_queries_select_the_same(self):
        v = svt.open(house_svt())
        for query in ("class=BuildingRoom and volume>20", "name~Kitchen", "class=Window", "under Kitchen", "all"):
            rows = json.loads(command("query", house_svt(), query, "--json"))
            rows = rows if isinstance(rows, list) else rows["features"]
            self.assertEqual([row["id"] for row in rows], [label.id for label in v.query(query)], query)
            for row, label in zip(rows, v.query(query)):
                self.assertEqual((row["ownVoxels"], row["volume"]), (label.voxels, label.volume))
                self.assertEqual((row["ownVolume"], row["totalVolume"]), (label.own_volume, label.total_volume))
                self.assertEqual(row["totalVoxels"], label.total_voxels)
                self.assertEqual(row["totalVoxels"], sum(part.voxels for part in label.parts))

    def test_areas_are_those_of_section(self):
        v = svt.open(house_svt())
        for plane in ("z=1.2", "y<4", "0.3,1,0,-5", ""):
            arguments = ["--plane", plane] if plane else []
            told = json.loads(command("section", house_svt(), *arguments, "--json"))
            section = v.section(plane)
            self.assertEqual(section.to_dict(), told)
            self.assertEqual(
                [(c.label.id, c.is_exact, len(c.polygons)) for c in section.components],
                [(c["id"], c["exact"], c["polygons"]) for c in told["components"]],
            )
            # The command prints six decimals.
            np.testing.assert_allclose(
                [c.area for c in section.components], [c["area"] for c in told["components"]], atol=5.1e-7
            )
            np.testing.assert_allclose(
                [c.area_bound for c in section.components], [c["areaBound"] for c in told["components"]], atol=5.1e-7
            )
            np.testing.assert_allclose(section.area, told["area"], atol=5.1e-7)
            np.testing.assert_allclose(section.axes.origin, told["plane"]["origin"], atol=5.1e-7)

    def test_polygons_have_the_areas_that_are_told(self):
        section = svt.open(house_svt()).section("z=1.2")

        def shoelace(ring):
            u, v = (ring - ring[0]).T
            return float(u @ np.roll(v, -1) - v @ np.roll(u, -1)) / 2

        holes = 0
        for component in section.components:
            for polygon in component.polygons:
                self.assertGreater(shoelace(polygon.outer), 0)
                self.assertTrue(all(shoelace(hole) < 0 for hole in polygon.holes))
                self.assertAlmostEqual(shoelace(polygon.outer) + sum(map(shoelace, polygon.holes)), polygon.area, 9)
                holes += len(polygon.holes)
            self.assertAlmostEqual(sum(p.area for p in component.polygons), component.area, 9)
        self.assertGreater(holes, 0)
        # Points of the drawing lie in the plane, 1.2 m above the lowest samples.
        v = svt.open(house_svt())
        np.testing.assert_allclose(section.world(section.polygons[0].outer)[:, 2], v.origin[2] + 1.2, atol=1e-9)

    def test_shapely_takes_the_polygons(self):
        try:
            from shapely.geometry import shape
        except ImportError:
            self.skipTest("no shapely")
        for polygon in svt.open(house_svt()).section("z=1.2").polygons:
            other = shape(polygon)
            self.assertTrue(other.is_valid)
            self.assertAlmostEqual(other.area, polygon.area, 9)

    def test_drawings_have_the_same_bytes(self):
        v = svt.open(house_svt())
        command("section", house_svt(), "--plane", "z=1.2", "-o", path("plan.svg"), "--scale", "1:50", "--no-rooms")
        command(
            "section",
            house_svt(),
            "--plane",
            "z=1.2",
            "-o",
            path("plan.dxf"),
            "-o",
            path("plan.geojson"),
            "--table",
            path("plan.csv"),
            "--no-rooms",
        )
        section = v.section("z=1.2", spaces=False)
        section.to_svg(path("python.svg"), scale=50)
        section.to_dxf(path("python.dxf"))
        section.to_geojson(path("python.geojson"))
        section.to_csv(path("python.csv"))
        for ending in ("svg", "dxf", "geojson", "csv"):
            with open(path("plan." + ending), "rb") as one, open(path("python." + ending), "rb") as other:
                self.assertTrue(one.read() == other.read(), ending)

    def test_names_of_any_letters_come_through(self):
        names = ["K\u00fcche", "\u03a9 \u5bb6", "a 'b' \"c\" --d"]
        array = np.ones((4, 4, 4), np.uint8)
        array[:, :2], array[:, :, :2] = 2, 3
        v = svt.Volume.from_dense(
            array, {n: {"name": name, "class": "BuildingRoom"} for n, name in enumerate(names, 1)}
        )
        v.save(path("\u5bb6 names.svt"))
        again = svt.open(path("\u5bb6 names.svt"))
        self.assertEqual([label.name for label in again.labels], names)
        for name in names[:2]:
            self.assertEqual([label.name for label in again.query(f'name="{name}"')], [name])
            self.assertEqual(again.labels[name].name, name)
        command(
            "section", path("\u5bb6 names.svt"), "--plane", "z=1.2", "-o", path("names.dxf"), "-o", path("names.svg")
        )
        section = again.section("z=1.2")
        self.assertIn("K\u00fcche", section.to_dxf(path("python.dxf")))
        section.to_svg(path("python.svg"))
        for ending in ("dxf", "svg"):
            with open(path("names." + ending), "rb") as one, open(path("python." + ending), "rb") as other:
                self.assertTrue(one.read() == other.read(), ending)
        with self.assertRaises(svt.Error) as caught:
            svt.open(path("\u5bb6 missing.svt"))
        self.assertIn("\u5bb6 missing.svt", str(caught.exception))
        # Bytes that are no text, as a file may be called.
        with self.assertRaises(svt.Error) as caught:
            svt.open(path("no text") + "\udcff.svt")
        self.assertIn("no text\ufffd.svt", str(caught.exception))

    def test_pictures_have_the_same_bytes(self):
        v = svt.open(house_svt())
        pairs: list[tuple[dict, list[str]]] = [
            (
                {"size": (320, 180), "section": "y<4", "highlight": "name=Kitchen"},
                ["--size", "320x180", "--section", "y<4", "--highlight", "name=Kitchen"],
            ),
            (
                {
                    "size": "40x30mm",
                    "dpi": 200,
                    "look": "paper",
                    "camera": "top",
                    "ortho": True,
                    "section": "storey='Ground floor'",
                    "hide": ["class=Window", "class=Door"],
                    "scale_bar": True,
                    "names": "class=BuildingRoom",
                },
                [
                    "--size",
                    "40x30mm",
                    "--dpi",
                    "200",
                    "--look",
                    "paper",
                    "--camera",
                    "top",
                    "--ortho",
                    "--section",
                    "storey='Ground floor'",
                    "--hide",
                    "class=Window",
                    "--hide",
                    "class=Door",
                    "--scale-bar",
                    "--names",
                    "class=BuildingRoom",
                ],
            ),
            (
                {
                    "size": (200, 150),
                    "opacity": {"class=BuildingRoom": 0.2},
                    "color": {"name=Kitchen": "red"},
                    "eye": (-5, -8, 9),
                    "target": (5, 5, 2),
                    "color_by": "volume",
                },
                [
                    "--size",
                    "200x150",
                    "--opacity",
                    "class=BuildingRoom:0.2",
                    "--color",
                    "name=Kitchen:red",
                    "--eye=-5,-8,9",
                    "--target",
                    "5,5,2",
                    "--color-by",
                    "volume",
                ],
            ),
            (
                {"size": (200, 150), "section": "y<4.3", "hide": "class=BuildingRoom", "surfaces": "exact"},
                ["--size", "200x150", "--section", "y<4.3", "--hide", "class=BuildingRoom", "--surfaces", "exact"],
            ),
        ]
        for options, arguments in pairs:
            try:
                command("render", house_svt(), "-o", path("command.png"), *arguments)
            except AssertionError as error:
                self.fail(f"the command refuses: {error}")
            v.frame(**options).save(path("python.png"))
            with open(path("command.png"), "rb") as a, open(path("python.png"), "rb") as b:
                self.assertTrue(a.read() == b.read(), options)

    def test_a_city_is_drawn_alike(self):
        command("sample", "district", "--columns", "24", "--rows", "3", "-o", path("town.gml"))
        command("city", "plan", path("town.gml"), "-o", path("town"), "--spacing", "0.4", "--quiet")
        command("city", "run", path("town"), "--quiet")
        city = svt.City(path("town"))
        self.assertEqual(city.buildings, 73, "72 houses, and the ground")
        # Near, and so far away that styles by class are those of mixtures.
        pairs: list[tuple[dict, list[str]]] = [
            ({"look": "dark", "zoom": 6}, ["--look", "dark", "--zoom", "6"]),
            (
                {"zoom": 0.1, "color": {"class=Building": "#c04030"}},
                ["--zoom", "0.1", "--color", "class=Building:#c04030"],
            ),
        ]
        for options, arguments in pairs:
            command("render", path("town"), "-o", path("command.png"), "--size", "200x150", *arguments)
            city.frame(size="200x150", **options).save(path("python.png"))
            with open(path("command.png"), "rb") as a, open(path("python.png"), "rb") as b:
                self.assertTrue(a.read() == b.read(), options)
        found = city.search("class=Building", most=5)
        told = json.loads(command("city", "find", path("town"), "class=Building", "--most", "5", "--json"))
        self.assertEqual(found.count, told["count"])
        self.assertEqual([b.id for b in found.buildings], [b["id"] for b in told["buildings"]])
        with self.assertRaisesRegex(svt.Error, "no words"):
            city.search("...")
        with self.assertRaisesRegex(svt.Error, "for one volume only"):
            city.render(explode=2)
        with self.assertRaisesRegex(svt.Error, "surfaces: exact is for one volume only"):
            city.render(surfaces="exact")
        with self.assertRaises(svt.Error):
            svt.City(path("nowhere"))

    def test_labels_of_pixels_are_those_of_rays(self):
        v = svt.open(house_svt())
        frame = v.frame(size=(160, 120), samples=1)
        self.assertEqual(frame.scalar.shape, (120, 160))
        seen = set(v.labels.of_scalar[frame.scalar].ravel()) - {-1}
        self.assertGreater(len(seen), 5)
        self.assertTrue((np.isinf(frame.depth) == (frame.scalar == 0)).all())

    def test_real_model_is_built_alike(self):
        model = os.path.join(DATA, "fzk_haus_citygml3.gml")
        if not os.path.exists(model):
            self.skipTest("no real models at SVT_DATA_DIR")
        v = svt.build(model, spacing=0.1, axes="building")
        v.save(path("fzk-python.svt"))
        command("build", model, "-o", path("fzk.svt"), "--spacing", "0.1", "--axes", "building")
        with open(path("fzk-python.svt"), "rb") as a, open(path("fzk.svt"), "rb") as b:
            self.assertTrue(a.read() == b.read())
        self.assertGreater(v.labels["Unterzug-1"].volume, 0)


class Manual(unittest.TestCase):
    def test_code_of_the_page_runs(self):
        model = os.path.join(DATA, "fzk_haus_citygml3.gml")
        if not os.path.exists(model):
            self.skipTest("no real models at SVT_DATA_DIR")
        page = pathlib.Path(__file__).resolve().parent.parent.parent / "docs" / "python" / "README.md"
        code = page.read_text(encoding="utf-8").partition("```python\n")[2].partition("```")[0]
        os.makedirs(path("manual"), exist_ok=True)
        shutil.copy(model, path("manual/house.gml"))
        before = os.getcwd()
        os.chdir(path("manual"))
        try:
            names = {
                "points": np.array([[457840.0, 5439090, 112]]),
                "origins": np.array([[457840.0, 5439080, 112]]),
                "directions": np.array([0, 1, 0]),
                "array": np.ones((3, 4, 5), np.uint8),
            }
            with contextlib.redirect_stdout(io.StringIO()) as told:
                exec(compile(code, str(page), "exec"), names)
        finally:
            os.chdir(before)
        self.assertIn("voxelize", told.getvalue())
        self.assertEqual(names["image"].shape, (720, 1280, 4))
        self.assertEqual(svt.open(path("manual/new.svt")).labels["wall"].voxels, 60)
        self.assertTrue(os.path.getsize(path("manual/plan.svg")) > 1000)


if __name__ == "__main__":
    unittest.main()

"""Known answers for a small array and for the generated house."""
import functools
import os
import unittest
import warnings
from typing import Callable

import numpy as np

import svt
from common import house, house_file, path


def small():
    """4 x 3 x 2 samples (x, y, z), turned by 90 degrees about z; values 0, 3, 7, 8."""
    array = np.zeros((2, 3, 4), np.uint16)
    array[0, 0, 1] = 7
    array[1, 2, 3] = 8
    array[:, 1, :] = 3
    return array, svt.Volume.from_dense(
        array,
        {
            3: "Wall",
            7: {"id": "a", "class": "BuildingRoom", "parent": "house", "attributes": {"u": 0.25, "n": 3, "b": True}},
            8: {"id": "b", "color": "#ff8000"},
        },
        spacing=(0.5, 0.25, 1),
        origin=(10, 20, 30),
        axes=((0, 1, 0), (-1, 0, 0), (0, 0, 1)),
    )


class FromDense(unittest.TestCase):
    def test_places_and_measures_are_those_given(self):
        array, v = small()
        self.assertEqual(v.dimension, (4, 3, 2))
        self.assertEqual(v.shape, array.shape)
        self.assertEqual(v.spacing, (0.5, 0.25, 1))
        self.assertEqual(v.origin, (10, 20, 30))
        self.assertEqual(v.voxel_volume, 0.125)
        np.testing.assert_allclose(v.world([[0, 0, 0], [3, 2, 1]]), [[10, 20, 30], [9.5, 21.5, 31]])
        np.testing.assert_allclose(v.index(v.world([1.5, 2, 0.25])), [1.5, 2, 0.25])
        np.testing.assert_allclose(v.box, [[10 - 0.5 - 0.125, 20 - 0.25, 29.5], [10.125, 21.75, 31.5]])

    def test_labels_are_those_of_the_table(self):
        _, v = small()
        # "house" is the parent of a label, but no label of the table.
        self.assertEqual([label.id for label in v.labels], ["label-3", "a", "b"])
        self.assertEqual([label.parent for label in v.labels], [None] * 3)
        wall, room, other = v.labels["Wall"], v.labels["a"], v.labels["b"]
        self.assertEqual((wall.voxels, room.voxels, other.voxels), (8, 1, 1))
        self.assertEqual((wall.volume, room.volume), (1.0, 0.125))
        self.assertEqual(room.class_name, "BuildingRoom")
        self.assertEqual(room.attributes, {"u": 0.25, "n": 3, "b": True})
        self.assertIs(type(room.attributes["b"]), bool)
        np.testing.assert_allclose(other.color, (1, 0x80 / 255, 0), atol=1e-6)
        self.assertEqual(v.query("class=BuildingRoom"), [room])
        self.assertEqual(v.query("class=Window"), [])
        self.assertNotEqual(wall, room)
        self.assertNotEqual(wall, 1)
        self.assertEqual(len({wall, v.labels["Wall"], room}), 2)

    def test_dense_and_sample_say_the_same(self):
        array, v = small()
        dense = v.dense()
        self.assertEqual(dense.dtype, v.dtype)
        self.assertTrue(dense.flags.c_contiguous and dense.flags.writeable)
        expected = np.zeros_like(array)
        for value, name in ((3, "Wall"), (7, "a"), (8, "b")):
            expected[array == value] = v.labels[name].scalars[0]
        np.testing.assert_array_equal(dense, expected)
        k, j, i = np.mgrid[0:2, 0:3, 0:4]
        places = v.world(np.stack([i, j, k], axis=-1))
        self.assertEqual(places.shape, (2, 3, 4, 3))
        np.testing.assert_array_equal(v.sample(places, scalars=True), dense)
        np.testing.assert_array_equal(v.sample(places), v.labels.of_scalar[dense])
        self.assertEqual(v.sample(places).dtype, np.int32)
        self.assertEqual(int(v.sample([0, 0, 0])), -1)
        self.assertEqual(v.sample(np.zeros((0, 3))).shape, (0,))
        np.testing.assert_array_equal(v.sample(places.astype(np.float32)), v.labels.of_scalar[dense])

    def test_arrays_of_any_whole_type_are_taken(self):
        array, _ = small()
        for kind in (np.uint8, np.int8, np.int16, ">u2", np.int32, np.uint32, np.int64, np.uint64):
            v = svt.Volume.from_dense(array.astype(kind))
            self.assertEqual([label.id for label in v.labels], ["label-3", "label-7", "label-8"], kind)
        turned = svt.Volume.from_dense(array.transpose(2, 1, 0))
        self.assertEqual(turned.shape, (4, 3, 2))
        np.testing.assert_array_equal(turned.dense().T, svt.Volume.from_dense(array).dense())
        mask = svt.Volume.from_dense(array == 3, {1: "Wall"})
        self.assertEqual(mask.labels["Wall"].voxels, 8)

    def test_what_is_no_label_array_is_refused(self):
        array, v = small()
        with self.assertRaises(TypeError):
            svt.Volume.from_dense(array.astype(float))
        with self.assertRaises(ValueError):
            svt.Volume.from_dense(array.astype(np.int64) - 1)
        with self.assertRaises(ValueError):
            svt.Volume.from_dense(array[0])
        with self.assertRaises(ValueError):
            svt.Volume.from_dense(array[:, :2], like=v)
        for arguments, code in (
            ({"array": array.astype(np.int16) - 1}, "E904"),
            ({"array": array[:1]}, "E301"),
            ({"array": array, "spacing": 0}, "E301"),
            ({"array": array, "axes": ((1, 0, 0), (0, 1, 0), (0, 0, -1))}, "E301"),
            ({"array": array, "labels": [{"name": "no value"}]}, "E105"),
        ):
            with self.assertRaises(svt.Error) as caught:
                svt.Volume.from_dense(**arguments)
            self.assertEqual(caught.exception.code, code)

    def test_rays_go_through_what_is_there(self):
        _, v = small()
        # Along -x of the world, which is +j: through the row of the wall.
        runs = v.rays([[20, 20, 30], [20, 20, 300]], [-2, 0, 0])
        self.assertEqual(len(runs), 2)
        self.assertEqual(len(runs[1]), 0)
        (run,) = runs[0]
        self.assertEqual(v.labels[run["label"]].name, "Wall")
        self.assertAlmostEqual(run["enter"], 20 - (10 - 0.125))
        self.assertAlmostEqual(run["leave"], 20 - (10 - 0.375))
        np.testing.assert_array_equal(runs.ray, [0])
        with self.assertRaises(svt.Error) as caught:
            v.rays([[0, 0, 0]], [0, 0, 0])
        self.assertIn("ray 0", caught.exception.message)
        with self.assertRaises(ValueError):
            v.rays([[0, 0]], [0, 0, 1])

    def test_file_and_part_keep_what_they_are_asked_to(self):
        _, v = small()
        written = v.save(path("small.svt"))
        again = svt.open(path("small.svt"))
        self.assertGreater(written, 100)
        np.testing.assert_array_equal(again.dense(), v.dense())
        self.assertEqual([label.id for label in again.labels], [label.id for label in v.labels])
        part = v.part(select="name=Wall")
        self.assertEqual(part.labels["Wall"].voxels, 8)
        self.assertEqual(part.labels["a"].voxels, 0)
        box = [v.world([1, 0, 0]), v.world([2, 1, 1])]
        box = [np.min(box, axis=0), np.max(box, axis=0)]
        self.assertEqual(v.samples_in(box), ((1, 0, 0), (3, 2, 2)))
        np.testing.assert_array_equal(v.dense(box=box), v.dense()[0:2, 0:2, 1:3])
        np.testing.assert_array_equal(v.part(box=box).dense(), v.dense(box=box))
        with self.assertRaises(svt.Error) as caught:
            v.save(path("no folder/small.svt"))
        self.assertEqual(caught.exception.code, "E404")


class House(unittest.TestCase):
    def test_every_box_and_level_is_part_of_the_whole(self):
        v = house()
        whole = v.dense()
        self.assertEqual(whole.shape, v.shape)
        random = np.random.default_rng(3)
        for _ in range(20):
            corners = v.box[0] + np.sort(random.random((2, 3)), axis=0) * (v.box[1] - v.box[0])
            try:
                (i0, j0, k0), (i1, j1, k1) = v.samples_in(corners)
            except svt.Error as error:
                self.assertEqual(error.code, "E902")
                continue
            np.testing.assert_array_equal(v.dense(box=corners), whole[k0:k1, j0:j1, i0:i1])
        coarse = v.dense(level=2)
        self.assertEqual(coarse.shape, tuple(-(-n // 4) for n in whole.shape))

    def test_sample_is_dense_at_random_points(self):
        v = house()
        random = np.random.default_rng(1)
        points = v.box[0] - 1 + random.random((50000, 3)) * (v.box[1] - v.box[0] + 2)
        i, j, k = np.floor(v.index(points) + 0.5).astype(int).T
        inside = (i >= 0) & (j >= 0) & (k >= 0) & (i < v.dimension[0]) & (j < v.dimension[1]) & (k < v.dimension[2])
        expected = np.zeros(len(points), np.uint32)
        expected[inside] = v.dense()[k[inside], j[inside], i[inside]]
        np.testing.assert_array_equal(v.sample(points, scalars=True), expected)
        self.assertGreater((expected > 0).sum(), 1000)

    def test_rays_agree_with_samples_along_them(self):
        v = house()
        random = np.random.default_rng(2)
        points = v.box[0] + random.random((2000, 3)) * (v.box[1] - v.box[0])
        directions = random.normal(size=(2000, 3))
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        runs = v.rays(points, directions)
        middle = (runs.all["enter"] + runs.all["leave"]) / 2
        thick = runs.all["leave"] - runs.all["enter"] > 0.3  # faces of rays are up to half a voxel off
        at = points[runs.ray] + middle[:, None] * directions[runs.ray]
        same = v.sample(at)[thick] == runs.all["label"][thick]
        self.assertGreater(same.mean(), 0.999)
        self.assertTrue((runs.all["enter"] < runs.all["leave"]).all())

    def test_voxels_are_counted_as_numpy_counts_them(self):
        v = house()
        counts = np.bincount(v.dense().ravel(), minlength=len(v.labels.of_scalar))
        for label in v.labels:
            self.assertEqual(label.voxels, sum(counts[s] for s in label.scalars), label)
        self.assertEqual(v.labels.of_scalar[0], -1)

    def test_tree_is_a_tree(self):
        v = house()
        (root,) = [label for label in v.labels if label.parent is None and label.class_name == "Building"]
        self.assertGreater(len(root.children), 10)
        for label in v.labels:
            for child in label.children:
                self.assertEqual(child.parent, label)
        kitchen = v.labels["Kitchen"]
        self.assertEqual(v.labels[kitchen.id], kitchen)
        self.assertEqual(v.labels[kitchen.index - len(v.labels)], kitchen)
        self.assertIn("Kitchen", v.labels)
        self.assertNotIn("Kitchenette", v.labels)
        with self.assertRaises(KeyError) as caught:
            v.labels["Kitchn"]
        self.assertIn("Kitchen", str(caught.exception))
        with self.assertRaises(IndexError):
            v.labels[len(v.labels)]
        with self.assertRaises(IndexError):
            v.labels[-len(v.labels) - 1]
        with self.assertRaises(TypeError):
            v.labels[2.5]
        self.assertEqual(v.labels[-1], v.labels[len(v.labels) - 1])
        self.assertEqual(v.labels[np.int32(3)], v.labels[3])

    def test_areas_are_those_of_the_voxels_and_boxes_those_of_meshes(self):
        v = house()
        kitchen = v.labels["Kitchen"]
        k, j, i = np.nonzero(v.labels.of_scalar[v.dense()] == kitchen.index)
        lower = v.world([i.min() - 0.5, j.min() - 0.5, k.min() - 0.5])
        upper = v.world([i.max() + 0.5, j.max() + 0.5, k.max() + 0.5])
        # The corners of its solid in the model. Its boundary surfaces have the outermost layer of voxels.
        solid = [(500007.315, 5400000.167, 100), (500010.833, 5400004.62, 102.76)]
        np.testing.assert_allclose(kitchen.box, solid, rtol=0, atol=1e-5)
        np.testing.assert_allclose([lower, upper], solid, rtol=0, atol=1.5 * 0.1)
        plain = svt.build(house_file(), spacing=0.1, vectors="none")
        np.testing.assert_allclose(plain.labels["Kitchen"].box, [lower, upper])
        contacts = v.contacts()
        mine = contacts[(contacts["a"] == kitchen.index) | (contacts["b"] == kitchen.index)]
        self.assertAlmostEqual(mine["area"].sum(), kitchen.area)

    def test_panes_are_phases_below_their_window(self):
        v = house()
        panes = v.query("phase=glass")
        self.assertEqual({pane.class_name for pane in panes}, {"WindowPhase"})
        self.assertEqual([pane.parent for pane in panes], v.query("class=Window"))
        for pane in panes:
            window = pane.parent
            self.assertEqual((pane.attributes["phase"], window.attributes["phase"]), ("glass", "painted timber"))
            self.assertIn(pane, window.parts)
            self.assertLess(pane.opacity, 1)
            self.assertEqual(window.opacity, 1)
            self.assertEqual(window.total_voxels, window.voxels + pane.voxels)

    def test_model_is_read_and_left_as_it_is(self):
        m = svt.read(house_file())
        count = len(m)
        self.assertEqual(m.format, "CityGML 3.0")
        self.assertEqual([f.index for f in m][:3], [0, 1, 2])
        self.assertEqual(m[0].children[0].parent.id, m[0].id)
        v = svt.build(m, spacing=0.1)
        self.assertEqual(len(m), count)
        np.testing.assert_array_equal(v.dense(), house().dense())
        other = svt.build(m, grid_of=v.part(level=1))
        self.assertEqual(other.spacing, (0.2, 0.2, 0.2))

    def test_memory_of_arrays_is_not_copied_and_outlives_its_source(self):
        v = svt.build(house_file(), spacing=0.2)
        frame = v.frame(size=(64, 48))
        self.assertEqual(frame.color.ctypes.data, frame._native.color.ctypes.data)
        color = frame.color
        ring = v.section("z=1.2").polygons[0].outer
        self.assertFalse(ring.flags.writeable)
        copy, colors = ring.copy(), color.copy()
        del v, frame
        junk = [np.ones(100000) for _ in range(50)]  # would take the memory, were it free
        np.testing.assert_array_equal(ring, copy)
        np.testing.assert_array_equal(color, colors)
        del junk


class Words(unittest.TestCase):
    def test_errors_carry_code_and_place(self):
        with self.assertRaises(svt.Error) as caught:
            svt.read(path("missing.gml"))
        error = caught.exception
        self.assertEqual((error.code, error.name, error.page), ("E101", "CannotOpen", "docs/errors/E101.md"))
        self.assertIn("missing.gml", str(error))
        with open(path("broken.gml"), "w") as file:
            file.write(
                "<?xml version='1.0'?>\n<core:CityModel xmlns:core='http://www.opengis.net/citygml/3.0'>\n<a></b>"
            )
        with self.assertRaises(svt.Error) as caught:
            svt.build(path("broken.gml"))
        self.assertEqual(caught.exception.place.line, 3)
        with self.assertRaises(svt.Error) as caught:
            house().query("class=")
        self.assertEqual(caught.exception.code, "E901")

    def test_a_model_that_was_cut_off_is_read_where_that_is_allowed(self):
        records = [
            "ISO-10303-21;",
            "HEADER;",
            "FILE_SCHEMA(('IFC4'));",
            "ENDSEC;",
            "DATA;",
            "#1=IFCWALL('w',$,'Wall',$,$,$,#2,$,$);",
            "#2=IFCPRODUCTDEFINITIONSHAPE($,$,(#3));",
            "#3=IFCSHAPEREPRESENTATION($,'Body','CSG',(#4));",
            "#4=IFCBLOCK($,1.,2.,3.);",
        ]
        with open(path("cut.ifc"), "w") as file:
            file.write("\n".join(records) + "\n")
        readers: list[Callable[[str], object]] = [svt.read, svt.build]
        for act in readers:
            with self.assertRaises(svt.Error) as caught:
                act(path("cut.ifc"))
            error = caught.exception
            self.assertEqual((error.code, error.name, error.place.line), ("E137", "Truncated", len(records)))
            self.assertIn("allow_truncated", error.message)
        m = svt.read(path("cut.ifc"), allow_truncated=True)
        self.assertEqual([feature.id for feature in m], ["w"])
        self.assertEqual([finding.severity for finding in m.findings if finding.code == "E137"], ["warning"])
        v = svt.build(path("cut.ifc"), allow_truncated=True, spacing=0.5)
        self.assertEqual(v.labels["w"].voxels, 2 * 4 * 6)

    def test_empty_texts_are_no_values(self):
        v = house()
        for act, options in (
            (v.frame, ("look", "size", "camera", "color_by", "names", "highlight")),
            (functools.partial(svt.build, house_file()), ("crs", "spacing", "lod", "style", "axes")),
            (functools.partial(v.save, path("empty.obj")), ("select", "encoding", "faces")),
        ):
            for option in options:
                with self.assertRaises(svt.Error, msg=option) as caught:
                    act(**{option: ""})
                self.assertEqual(caught.exception.code, "E904", option)
                self.assertIn(f"{option}: the value is empty", caught.exception.message)
        self.assertFalse(os.path.exists(path("empty.obj")))

    def test_a_pipe_is_no_file(self):
        os.mkfifo(path("pipe"))
        readers: list[Callable[[str], object]] = [svt.read, svt.build, svt.open]
        for act in readers:
            with self.assertRaises(svt.Error) as caught:
                act(path("pipe"))
            self.assertEqual((caught.exception.code, caught.exception.place.file), ("E101", path("pipe")))
            self.assertIn("a pipe", caught.exception.message)

    def test_keywords_are_held_against_the_declarations_of_the_command(self):
        v = house()
        with self.assertRaisesRegex(TypeError, "did you mean 'section'"):
            v.render(sectoin="z=1")
        with self.assertRaisesRegex(TypeError, "memory"):
            v.render(memory=100)
        with self.assertRaisesRegex(svt.Error, "surfaces exact does not support cells"):
            house().render(surfaces="exact", cells=True)
        voxels = svt.Volume.from_dense(np.ones((4, 4, 4), np.uint8))
        voxels.render(size=(20, 20))
        with self.assertRaisesRegex(svt.Error, "without meshes"):
            voxels.render(size=(20, 20), surfaces="exact")
        with self.assertRaisesRegex(TypeError, "output"):
            v.render(output="x.png")
        for options in (
            {"zoom": 1000},
            {"zoom": "near"},
            {"look": "oil"},
            {"ortho": 1},
            {"size": (0, 5)},
            {"opacity": {"all": 2}},
            {"eye": (1, 2)},
            {"size": [(1, 2), (3, 4)]},
        ):
            with self.assertRaises(svt.Error, msg=options) as caught:
                v.render(**options)
            self.assertIn(caught.exception.code, ("E904", "E502"))
            # In the words of Python, not of the command line.
            self.assertNotIn("--", str(caught.exception))
        with self.assertRaises(svt.Error):
            svt.build(house_file(), spacing=0.1, dimension=(20, 20, 20))
        with self.assertRaisesRegex(TypeError, "did you mean 'meshes'"):
            v.save(path("m.precomputed"), meshs=True)
        for options in ({"zarr": 4}, {"place": (1, 2)}, {"level": 7}, {"meshes": 1}, {"texture": "oil"}):
            with self.assertRaises(svt.Error, msg=options) as caught:
                v.save(path("not.zarr"), **options)
            self.assertEqual(caught.exception.code, "E904")
            self.assertNotIn("--", str(caught.exception))
        self.assertFalse(os.path.exists(path("not.zarr")))
        self.assertEqual(v.render(size=(np.int64(40), 30), ortho=True, hatch=False, zoom=None).shape, (30, 40, 4))

    def test_what_is_told_to_be_typed_stays(self):
        with self.assertRaises(svt.Error) as caught:
            house().render(wireframe="all")
        self.assertIn("'svt build --vectors edges'", caught.exception.message)

    def test_drawings_are_written_whole_or_not_at_all(self):
        section = house().section("z=1.2")
        with self.assertRaises(svt.Error) as caught:
            section.to_svg(path("no folder/plan.svg"))
        self.assertEqual(caught.exception.code, "E404")
        with self.assertRaises(svt.Error) as caught:
            section.to_svg(path("whole.svg"), scale=0)
        self.assertEqual(caught.exception.code, "E904")
        self.assertFalse(os.path.exists(path("whole.svg")))

    def test_a_pdf_warns_of_letters_that_no_font_has(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            pdf = house().section("z=1.2").to_pdf(path("plan.pdf"))
        self.assertEqual([str(w.message) for w in caught if "font" in str(w.message)], [])
        self.assertTrue(pdf.startswith(b"%PDF-"))
        with open(path("plan.pdf"), "rb") as file:
            self.assertEqual(file.read(), pdf)
        room = house().query("class=BuildingRoom")[0]
        with open(house_file(), encoding="utf-8") as file:
            text = file.read().replace(f"<gml:name>{room.name}</gml:name>", "<gml:name>\ue123</gml:name>")
        with open(path("private.gml"), "w", encoding="utf-8") as file:
            file.write(text)  # a letter for private use, which no font has
        section = svt.build(path("private.gml"), spacing=0.1).section("z=1.2")
        with self.assertWarnsRegex(UserWarning, "no font on this machine has the letters '\ue123'"):
            section.to_pdf()

    def test_docstrings_name_every_keyword(self):
        for keyword in ("spacing", "dimension", "lod", "no_bodies", "threads"):
            self.assertIn(f"\n    {keyword} : ", svt.build.__doc__ or "")
        for keyword in ("section", "highlight", "scale_bar", "hidden_lines"):
            self.assertIn(f"\n        {keyword} : ", svt.Volume.render.__doc__ or "")
        for keyword in ("encoding", "meshes", "place", "lift", "zarr", "level_sets", "select", "from_"):
            self.assertIn(f"\n        {keyword} : ", svt.Volume.save.__doc__ or "")

    def test_notebooks_show_volume_picture_and_drawing(self):
        v = house()
        text = v._repr_html_()
        self.assertIn("data:image/png;base64,iVBOR", text)
        self.assertIn("{} x {} x {}".format(*v.dimension), text)
        self.assertTrue(v.frame(size=(8, 8))._repr_png_().startswith(b"\x89PNG"))
        self.assertTrue(v.section("z=1.2")._repr_svg_().startswith("<svg "))


if __name__ == "__main__":
    unittest.main()

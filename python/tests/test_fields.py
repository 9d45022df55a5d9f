"""Fields of a volume: values at points, statistics, files, pictures, datasets."""
import csv
import io
import pathlib
import shutil
import unittest

import numpy as np

import svt
from common import command, house, needs, needs_command, path


def two_rooms():
    """Two rooms of 4 x 4 x 4 m with a wall of 1 m between them; samples 1 m apart, opened from a file."""
    array = np.ones((4, 4, 9), np.uint8)
    array[:, :, 4] = 2
    array[:, :, 5:] = 3
    table = {
        1: {"id": "a", "class": "BuildingRoom"},
        2: {"id": "wall", "class": "BuildingConstructiveElement"},
        3: {"id": "b", "class": "BuildingRoom"},
    }
    svt.Volume.from_dense(array, table, spacing=1, origin=(10, 20, 30)).save(path("rooms.svt"))
    return svt.open(path("rooms.svt"))


def file_bytes():
    return pathlib.Path(path("rooms.svt")).read_bytes()


def warm(v, **options):
    """20 degrees in room a, 30 in room b, none in the wall, warmer by 1 after an hour."""
    values = np.full((2, *v.shape), np.nan, np.float32)
    values[0, :, :, :4], values[0, :, :, 5:] = 20, 30
    values[1] = values[0] + 1
    return v.fields.add("warm", values, unit="Cel", medium="air", times=[0, 3600], **options)


class FieldsOfVolumes(unittest.TestCase):
    def test_values_do_not_cross_a_wall(self):
        field = warm(two_rooms())
        x = np.linspace(9.6, 18.4, 881)
        points = np.stack([x, np.full_like(x, 21.3), np.full_like(x, 31.7)], axis=-1)
        found = field.sample(points)
        self.assertEqual(found.dtype, np.float32)
        np.testing.assert_array_equal(found[x < 13.49], 20)
        np.testing.assert_array_equal(found[x > 14.51], 30)
        self.assertTrue(np.isnan(found[(x > 13.51) & (x < 14.49)]).all())

    def test_values_are_linear_in_time_and_keep_the_shape_of_the_points(self):
        field = warm(two_rooms())
        points = np.broadcast_to([11.0, 21, 31], (2, 5, 3))
        np.testing.assert_allclose(field.sample(points, time=900), np.full((2, 5), 20.25), rtol=1e-6)
        np.testing.assert_array_equal(field.sample(points, time=1e9), np.full((2, 5), 21))

    def test_a_linear_field_is_exact_between_nodes_of_any_spacing(self):
        v = two_rooms()
        nodes: list[list[float]] = [[0, 1.5, 2, 3], [0, 1, 3], [0, 3]]
        k, j, i = np.meshgrid(*nodes[::-1], indexing="ij")
        field = v.fields.add("ramp", 2 * i + 3 * j - k, unit="1", nodes=nodes)
        self.assertEqual([list(axis) for axis in field.nodes], nodes)
        places = np.random.default_rng(1).uniform([0, 0, 0], [3, 3, 3], (1000, 3))
        expected = places @ [2, 3, -1]
        np.testing.assert_allclose(field.sample(v.world(places)), expected, atol=2e-6)

    def test_what_was_added_is_read_again_with_everything_that_is_known_of_it(self):
        v = two_rooms()
        warm(v, quantity="temperature", epoch="2026-01-05T00:00:00Z", by="test", parameters={"outside": -5})
        again = svt.open(path("rooms.svt")).fields
        self.assertEqual(list(again), ["warm"])
        field = again["warm"]
        self.assertEqual((field.name, field.kind, field.unit, field.medium), ("warm", "grid", "Cel", "air"))
        self.assertEqual((field.quantity, field.by, field.parameters), ("temperature", "test", {"outside": -5}))
        self.assertEqual((field.epoch, list(field.times)), ("2026-01-05T00:00:00Z", [0, 3600]))
        self.assertEqual(field.values.shape, (2, 4, 4, 9))
        np.testing.assert_array_equal(field.dense(1)[:, :, 0], 21)
        self.assertTrue(np.isnan(field.dense()[:, :, 4]).all())
        self.assertFalse(field.values.flags.writeable)

    def test_precision_bounds_the_error_of_values(self):
        v = two_rooms()
        values = np.random.default_rng(2).uniform(-5, 25, v.shape).astype(np.float32)
        field = v.fields.add("fine", values, unit="Cel", precision=0.01)
        self.assertLessEqual(np.abs(field.dense() - values).max(), 0.00501)
        self.assertGreater(np.abs(field.dense() - values).max(), 0.004)

    def test_statistics_of_rooms(self):
        field = warm(two_rooms())
        rows = field.stats("class=BuildingRoom", over=25)
        self.assertEqual(list(rows["mean"]), [20, 21, 30, 31])
        self.assertEqual(list(rows["volume"]), [64] * 4)
        self.assertEqual(list(rows["share_over"]), [0, 0, 1, 1])
        whole = field.stats("class=BuildingRoom", over=20.5, by_time=False)
        self.assertEqual(list(whole["mean"]), [20.5, 30.5])
        np.testing.assert_allclose(whole["hours_over"], [0.5, 1])

    def test_labels_and_points_have_values_by_name(self):
        v = two_rooms()
        power = v.fields.add("power", {"a": 500.0, v.labels["wall"]: 0}, unit="W", kind="label")
        self.assertEqual(power.sample([11, 21, 31]), 500)
        self.assertTrue(np.isnan(power.sample([17, 21, 31])))
        at = {"s1": (11, 21, 31), "s2": (17, 21, 31)}
        sensors = v.fields.add(
            "co2",
            {"s2": [400, 450], "s1": [600, 650]},
            unit="[ppm]",
            kind="points",
            points=at,
            times=[0, 60],
            medium="air",
        )
        self.assertEqual(sensors.points, {name: tuple(map(float, place)) for name, place in at.items()})
        self.assertEqual(list(sensors.sample([[12, 22, 32], [16, 20, 30]], time=60)), [650, 450])

    def test_vectors_have_an_axis_of_components(self):
        v = two_rooms()
        values = np.zeros((3, *v.shape), np.float32)
        values[0], values[2] = 3, 4
        flow = v.fields.add("flow", values, unit="m/s", components=3)
        self.assertEqual(list(flow.sample([11, 21, 31])), [3, 0, 4])
        self.assertEqual(flow.dense(0, 2)[0, 0, 0], 4)
        self.assertEqual(flow.stats("id=a")["mean"][0], 5)

    def test_errors_say_what_to_do_and_leave_the_file(self):
        v = two_rooms()
        before = file_bytes()
        with self.assertRaisesRegex(ValueError, r"values: expected an array of shape \(1, 4, 4, 9\), found \(4, 4\)"):
            v.fields.add("bad", np.zeros((4, 4)), unit="1")
        with self.assertRaisesRegex(svt.Error, "E70"):
            v.fields.add("1 bad name", np.zeros(v.shape), unit="1")
        with self.assertRaisesRegex(svt.Error, "E901"):
            v.fields.add("bad", np.zeros(v.shape), unit="1", medium="class=")
        with self.assertRaisesRegex(KeyError, "no field has the name 'warm'; the fields are: none"):
            v.fields["warm"]
        with self.assertRaisesRegex(ValueError, "has no file; save it as .svt"):
            house().fields.add("warm", np.zeros(house().shape), unit="1")
        with self.assertRaisesRegex(ValueError, "has no file; save it as .svt"):
            house().fields.remove("warm")
        self.assertEqual(before, file_bytes())
        self.assertEqual(len(house().fields), 0)

    def test_remove_restores_the_bytes_of_the_file(self):
        v = two_rooms()
        before = file_bytes()
        warm(v)
        self.assertNotEqual(before, file_bytes())
        v.fields.remove("warm")
        self.assertEqual(before, file_bytes())

    @needs_command
    def test_command_and_module_agree(self):
        field = warm(two_rooms(), output=path("warm.svt"))
        self.assertEqual(list(two_rooms().fields), [])
        printed = command("field", "stats", path("warm.svt"), "warm", "--by", "class=BuildingRoom", "--csv", "-q")
        rows = [row for row in csv.DictReader(io.StringIO(printed)) if row["time"]]
        table = field.stats("class=BuildingRoom")
        self.assertEqual([float(row["mean"]) for row in rows], list(table["mean"]))
        self.assertEqual([float(row["volume"]) for row in rows], list(table["volume"]))

    @needs_command
    def test_pictures_with_a_field_are_those_of_the_command(self):
        warm(two_rooms(), output=path("warm.svt"))
        options = ("--size", "160x120", "--section", "z<2", "--field", "warm")
        command("render", path("warm.svt"), "-o", path("warm.png"), "-q", *options)
        image = svt.open(path("warm.svt")).render(size=(160, 120), section="z<2", field="warm")
        np.testing.assert_array_equal(image, svt.read_png(path("warm.png")))
        with self.assertRaisesRegex(svt.Error, "warm"):
            two_rooms().render(size=(160, 120), field="warm")

    @needs("xarray")
    def test_arrays_of_xarray_have_coordinates_units_and_dates(self):
        array = warm(two_rooms(), epoch="2026-01-05T01:00:00+01:00").to_xarray()
        self.assertEqual(array.dims, ("time", "z", "y", "x"))
        self.assertEqual(array.attrs["units"], "Cel")
        self.assertEqual(str(array["time"].values[1])[:19], "2026-01-05T01:00:00")
        self.assertEqual([float(array[axis][0]) for axis in "xyz"], [10, 20, 30])
        self.assertEqual(float(array.sel(x=17, y=21, z=31).isel(time=1)), 31)

    @needs_command
    def test_a_file_that_was_replaced_by_another_volume_is_refused(self):
        v = two_rooms()
        v.fields.add("power", {"a": 500.0}, unit="W", kind="label")
        array = np.ones((2, 2, 2), np.uint8)
        svt.Volume.from_dense(array, {1: {"id": "x", "class": "BuildingRoom"}}).save(path("other.svt"))
        other = svt.open(path("other.svt"))
        other.fields.add("power", {"x": 1.0}, unit="W", kind="label")
        shutil.copy(path("other.svt"), path("rooms.svt"))
        with self.assertRaises(svt.Error):
            v.fields["power"].sample([11, 21, 31])


if __name__ == "__main__":
    unittest.main()

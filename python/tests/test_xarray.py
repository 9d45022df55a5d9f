"""Volumes in xarray: the entry point, lazy reading, coordinates, CF metadata, netCDF."""
import importlib.util
import os
import pathlib
import pickle
import re
import subprocess
import sys
import unittest
import warnings
from unittest import mock

import numpy as np
import xarray

import svt
from common import house, house_file, needs, path
from svt import cf
from svt.xarray_backend import SvtBackendEntrypoint, VolumeArray


def house_path():
    if not os.path.exists(path("xarray.svt")):
        house().save(path("xarray.svt"))
    return path("xarray.svt")


class Open(unittest.TestCase):
    def test_xarray_opens_a_file_by_its_name(self):
        self.assertIn("svt", xarray.backends.list_engines())
        for name in (house_path(), pathlib.Path(house_path())):
            with xarray.open_dataset(name) as dataset:
                self.assertEqual(dataset.label.dims, ("z", "y", "x"))
                np.testing.assert_array_equal(dataset.label, house().dense())
        self.assertEqual(dataset.encoding["source"], house_path())

    def test_other_names_are_left_to_other_backends(self):
        backend = SvtBackendEntrypoint()
        self.assertTrue(backend.guess_can_open("A.SVT"))
        for name in ("a.nc", "a.svt.zip", b"PK", object()):
            self.assertFalse(backend.guess_can_open(name))
        with self.assertRaises(svt.Error) as caught:
            xarray.open_dataset(path("missing.svt"))
        self.assertEqual(caught.exception.code, "E101")

    def test_a_process_without_svt_opens_a_file(self):
        text = (
            "import sys, xarray; d = xarray.open_dataset(sys.argv[1]); print(int(d.label.max()), 'svt' in sys.modules)"
        )
        done = subprocess.run([sys.executable, "-c", text, house_path()], capture_output=True, text=True)
        self.assertEqual(done.stdout.split(), [str(house().dense().max()), "True"], done.stderr)

    def test_level_box_and_left_out_variables(self):
        v = house()
        box = [v.world((10, 20, 5)), v.world((70, 50, 40))]
        with xarray.open_dataset(house_path(), level=1, box=box, drop_variables=["component_id", "crs"]) as dataset:
            np.testing.assert_array_equal(dataset.label, v.dense(level=1, box=box))
            self.assertNotIn("component_id", dataset)
        np.testing.assert_array_equal(v.to_xarray(box=box).label, v.dense(box=box))
        self.assertEqual(v.to_xarray(level=2).label.shape, v.dense(level=2).shape)

    def test_memory_and_file_give_the_same(self):
        self.assertTrue(house().to_xarray().identical(svt.open(house_path()).to_xarray()))
        with xarray.open_dataset(house_path()) as dataset:
            self.assertTrue(house().to_xarray().identical(dataset))


class Reading(unittest.TestCase):
    def read(self, take):
        """The value of `take(label)`, the same of the dense array, and the sizes of the slabs that are unpacked."""
        slabs = []
        native = svt._native.dense_slab

        def counted(volume, begin, end):
            slabs.append(tuple(int(b - a) for a, b in zip(begin, end)))
            return native(volume, begin, end)

        with mock.patch("svt._native.dense_slab", counted):
            got = take(house().to_xarray().label)
            got = np.asarray(got)
        return got, slabs

    def test_only_the_wanted_slab_is_unpacked(self):
        a = house().dense()
        nx, ny, nz = house().dimension
        for take, slabs in (
            (lambda v: v[3], [(nx, ny, 1)]),
            (lambda v: v[-1], [(nx, ny, 1)]),
            (lambda v: v[:, 5, 7], [(1, 1, nz)]),
            (lambda v: v[10:20, 5:6, ::3], [(nx - (nx - 1) % 3, 1, 10)]),
            (lambda v: v[20:10:-1, ::-1], [(nx, ny, 10)]),
            (lambda v: v[0:21:10, 0, 0], [(1, 1, 1)] * 3),
            (lambda v: v[5:5], []),
            (lambda v: v[2, 3, 4], [(1, 1, 1)]),
            (lambda v: v, [(nx, ny, nz)]),
        ):
            got, unpacked = self.read(take)
            np.testing.assert_array_equal(got, take(a))
            self.assertEqual(unpacked, slabs)
            self.assertEqual(got.dtype, a.dtype)

    def test_indices_of_all_kinds(self):
        label, a = house().to_xarray().label, house().dense()
        np.testing.assert_array_equal(label[[1, 7, 7]], a[[1, 7, 7]])
        np.testing.assert_array_equal(label[:, [2, 1]][[0, 5]], a[:, [2, 1]][[0, 5]])
        points = xarray.DataArray([3, 4, 9], dims="point")
        np.testing.assert_array_equal(label[points, points, points], a[[3, 4, 9], [3, 4, 9], [3, 4, 9]])
        mask = np.arange(a.shape[0]) % 7 == 0
        np.testing.assert_array_equal(label[mask], a[mask])

    def test_opening_unpacks_nothing(self):
        got, unpacked = self.read(lambda label: label.sizes["x"])
        self.assertEqual(unpacked, [])

    def test_slabs_outside_are_refused(self):
        v = house()
        for begin, end in (((0, 0, 0), (1, 1, 10**6)), ((-1, 0, 0), (1, 1, 1)), ((3, 0, 0), (3, 1, 1))):
            with self.assertRaises(IndexError):
                svt._native.dense_slab(v._native, begin, end)

    @needs("dask")
    def test_dask_reads_chunks_in_several_threads(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # chunks are smaller than the default
            dataset = xarray.open_dataset(house_path(), chunks={"z": 16})
        with dataset:
            self.assertEqual(dataset.label.chunks[0][0], 16)
            np.testing.assert_array_equal(dataset.label, house().dense())
            self.assertEqual(int((dataset.label > 0).sum()), int((house().dense() > 0).sum()))
        with xarray.open_dataset(house_path(), chunks={}) as dataset:
            self.assertEqual(dataset.label.chunks[1:], (house().shape[1:2], house().shape[2:3]))

    def test_copies_and_other_processes(self):
        with xarray.open_dataset(house_path()) as dataset:
            np.testing.assert_array_equal(dataset.copy(deep=True).label, house().dense())
            np.testing.assert_array_equal(pickle.loads(pickle.dumps(dataset)).label, house().dense())
        with self.assertRaisesRegex(TypeError, "save it"):
            pickle.dumps(VolumeArray(house(), None))


class Coordinates(unittest.TestCase):
    def test_coordinates_are_metres_of_the_crs(self):
        v = house()
        dataset = v.to_xarray()
        for index in ((0, 0, 0), (7, 3, 5), tuple(size - 1 for size in v.dimension)):
            place = [float(dataset[axis][n]) for axis, n in zip("xyz", index)]
            self.assertEqual(place, v.world(index).tolist())
        kitchen = v.labels["Kitchen"]
        x, y, z = kitchen.box.mean(axis=0)
        value = dataset.label.sel(x=x, y=y, z=z, method="nearest")
        self.assertIn(int(value), kitchen.scalars)
        self.assertEqual(str(dataset.component_name[value].item()), "Kitchen")
        self.assertEqual(dataset.x.attrs["standard_name"], "projection_x_coordinate")
        self.assertEqual({dataset[axis].attrs["units"] for axis in "xyz"}, {"m"})

    def turned(self, axes):
        array = np.arange(24, dtype=np.uint8).reshape(2, 3, 4)
        v = svt.Volume.from_dense(array, spacing=(0.5, 0.25, 1), origin=(10, 20, 30), axes=axes)
        return v, v.to_xarray()

    def test_a_turned_grid_has_places_by_row_and_column(self):
        v, dataset = self.turned(((0.8, 0.6, 0), (-0.6, 0.8, 0), (0, 0, 1)))
        self.assertEqual(set(dataset.coords), {"xc", "yc", "z"})
        self.assertEqual((dataset.xc.dims, dataset.z.dims), (("y", "x"), ("z",)))
        for j, i, k in ((0, 0, 0), (2, 3, 1), (1, 2, 0)):
            place = [float(dataset.xc[j, i]), float(dataset.yc[j, i]), float(dataset.z[k])]
            np.testing.assert_allclose(place, v.world((i, j, k)))
        dataset.to_netcdf(path("turned.nc"), engine="scipy")
        with xarray.open_dataset(path("turned.nc")) as again:
            self.assertEqual(set(again.coords), {"xc", "yc", "z"})

    def test_a_tilted_grid_has_no_coordinates_but_its_axes(self):
        axes = ((1, 0, 0), (0, 0, 1), (0, -1, 0))
        _, dataset = self.turned(axes)
        self.assertEqual(set(dataset.coords), set())
        np.testing.assert_array_equal(np.reshape(dataset.attrs["axes"], (3, 3)), axes)
        self.assertEqual(list(dataset.attrs["origin"]), [10, 20, 30])

    def test_a_grid_along_the_building_is_turned(self):
        v = svt.build(house_file(), spacing=0.3, axes="building")
        dataset = v.to_xarray()
        np.testing.assert_allclose(
            [float(dataset.xc[3, 2]), float(dataset.yc[3, 2])], v.world((2, 3, 0))[:2], rtol=1e-15
        )


class Metadata(unittest.TestCase):
    def test_words_of_flags_are_valid_unique_and_near_the_names(self):
        words = cf.flag_meanings(
            [("Küche", "x"), ("Kuche", "x"), ("Küche", "x"), ("家", "id 7"), ("家", "家"), ("a b/c-1.2", ""), ("Ωé", "w")]
        )
        self.assertEqual(words, ["Kueche", "Kuche", "Kueche_2", "id_7", "component", "a_b_c-1.2", "e"])
        many = cf.flag_meanings([("a", "")] * 3 + [("a_2", ""), ("a", "")])
        self.assertEqual(len(set(many)), 5)

    def test_flags_of_a_volume(self):
        v = house()
        attributes = v.to_xarray().label.attrs
        words = attributes["flag_meanings"].split(" ")
        self.assertEqual(len(words), len(attributes["flag_values"]))
        self.assertEqual(len(set(words)), len(words))
        self.assertTrue(all(re.fullmatch(r"[A-Za-z0-9_\-.+@]+", word) for word in words))
        self.assertEqual(attributes["flag_values"].dtype, v.dtype)
        self.assertEqual(words[0], "background")
        self.assertEqual(words[v.labels["Kitchen"].scalars[0]], "Kitchen")

    def test_columns_are_by_value(self):
        v = house()
        dataset = v.to_xarray()
        for name in ("Kitchen", "Hidden beam"):
            label = v.labels[name]
            row = dataset.isel(component=label.scalars[0])
            found = [row[f"component_{key}"].item() for key in ("label", "id", "class", "name", "parent")]
            self.assertEqual(found, [label.index, label.id, label.class_name, label.name, label.parent.id])
        self.assertEqual(dataset.component_label[0], -1)
        rooms = (dataset.component_class == "BuildingRoom")[dataset.label]
        expected = sum(label.voxels for label in v.labels if label.class_name == "BuildingRoom")
        self.assertEqual(int(rooms.sum()), expected)

    def test_codes_of_names(self):
        for name, codes in (
            ("", (0, 0)),
            ("EPSG:25832", (25832, 0)),
            ("urn:ogc:def:crs:EPSG::25832", (25832, 0)),
            ("urn:ogc:def:crs:EPSG:6.12:3068", (3068, 0)),
            ("urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::7837", (25832, 7837)),
            ("urn:ogc:def:crs,crs:EPSG:6.12:3068,crs:EPSG:6.12:5783", (3068, 5783)),
            ("http://www.opengis.net/def/crs/EPSG/0/25833", (25833, 0)),
            ("EPSG:28992+5109", (28992, 5109)),
            ("urn:adv:crs:ETRS89_UTM32*DE_DHHN92_NH", (0, 0)),
        ):
            self.assertEqual(cf.epsg_codes(name), codes, name)

    def test_unknown_reference_systems_have_no_mapping(self):
        for name in ("", "local", "EPSG:999999", "EPSG:4326", "EPSG:4978"):
            self.assertEqual(cf.grid_mapping(name), {}, name)
            v = svt.Volume.from_dense(np.ones((2, 2, 2), np.uint8), crs=name)
            dataset = v.to_xarray()
            self.assertNotIn("crs", dataset)
            self.assertNotIn("grid_mapping", dataset.label.attrs)
            self.assertNotIn("standard_name", dataset.x.attrs)

    @unittest.skipUnless(svt._native.crs_wkt(25832, 0), "no PROJ")
    def test_heights_that_proj_does_not_know_are_left_out(self):
        self.assertTrue(cf.grid_mapping("EPSG:25832+999999")["crs_wkt"].startswith("PROJCRS["))

    @unittest.skipUnless(svt._native.crs_wkt(25832, 0), "no PROJ")
    @unittest.skipUnless(importlib.util.find_spec("pyproj"), "no pyproj (scripts/setup.sh readers installs it)")
    def test_mapping_is_that_of_pyproj(self):
        import pyproj

        for name in ("EPSG:25832", "EPSG:31467", "EPSG:2154", "EPSG:27700", "EPSG:28992", "EPSG:5555"):
            mapping = cf.grid_mapping(name)
            other = pyproj.CRS.from_user_input(name)
            self.assertTrue(pyproj.CRS.from_wkt(mapping["crs_wkt"]).equals(other, ignore_axis_order=True), name)
            self.assertEqual(mapping["spatial_ref"], mapping["crs_wkt"])
            if "grid_mapping_name" in mapping:
                theirs = (other.sub_crs_list[0] if other.is_compound else other).to_cf()
                self.assertEqual(mapping["grid_mapping_name"], theirs["grid_mapping_name"])
                for key in set(mapping) - {"crs_wkt", "spatial_ref", "grid_mapping_name"}:
                    np.testing.assert_allclose(mapping[key], theirs[key], rtol=1e-12)
        self.assertEqual(cf.grid_mapping("EPSG:2154")["grid_mapping_name"], "lambert_conformal_conic")
        self.assertNotIn("grid_mapping_name", cf.grid_mapping("EPSG:28992"))  # oblique stereographic


class NetCdf(unittest.TestCase):
    def goes_and_comes_back(self, engine):
        dataset = house().to_xarray()
        file = path(f"{engine}.nc")
        dataset.to_netcdf(file, engine=engine)
        with xarray.open_dataset(file, engine=engine) as again:
            np.testing.assert_array_equal(again.label, house().dense())
            np.testing.assert_array_equal(again.component_name, dataset.component_name)
            np.testing.assert_array_equal(again.x, dataset.x)
            for key in ("flag_meanings", "grid_mapping", "long_name"):
                self.assertEqual(again.label.attrs[key], dataset.label.attrs[key])
            np.testing.assert_array_equal(again.label.attrs["flag_values"], dataset.label.attrs["flag_values"])
            self.assertEqual(again.crs.attrs["crs_wkt"], dataset.crs.attrs["crs_wkt"])
            self.assertEqual(again.attrs["Conventions"], "CF-1.10")
        return file

    @needs("netCDF4")
    def test_netcdf4(self):
        file = self.goes_and_comes_back("netcdf4")
        self.assertLess(os.path.getsize(file), house().dense().nbytes / 10)  # compressed

    @needs("scipy")
    def test_netcdf3(self):
        self.goes_and_comes_back("scipy")

    @needs("netCDF4")
    def test_gdal_finds_place_and_reference_system(self):
        from shutil import which

        if which("gdalinfo") is None:
            self.skipTest("no gdalinfo (scripts/setup.sh installs it)")
        house().to_xarray()[["label", "crs"]].to_netcdf(path("gdal.nc"), engine="netcdf4")
        told = subprocess.run(["gdalinfo", path("gdal.nc")], capture_output=True, text=True).stdout
        self.assertIn('ID["EPSG",25832]', told)
        v = house()
        (x, y), pixel = (
            tuple(map(float, re.search(rf"^{word} = \(([-0-9.]+),([-0-9.]+)\)", told, re.M).groups()))  # type: ignore
            for word in ("Origin", "Pixel Size")
        )
        self.assertEqual(np.round(np.abs(pixel), 9).tolist(), [0.1, 0.1])
        self.assertAlmostEqual(x, v.box[0][0], 6)
        self.assertAlmostEqual(y, v.box[1][1] if pixel[1] < 0 else v.box[0][1], 6)


if __name__ == "__main__":
    unittest.main()

"""Options of svt.read: order of the axes, unit of lengths, date; lists of attributes."""
import datetime
import json
import unittest
from typing import Callable

import numpy as np

import svt
from common import path


def write_boxes(name, size, attributes, **more):
    """CityJSON 2.0 with a building of `size` for each entry of `attributes`, one beside the other."""
    vertices: list[list[float]] = []
    objects = {}
    faces = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    for number, (identifier, values) in enumerate(attributes.items()):
        corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
        lower = (2 * number * size[0], 0, 0)
        shell = [[[corner + len(vertices) for corner in face]] for face in faces]
        vertices += [[at + c * s for at, c, s in zip(lower, corner, size)] for corner in corners]
        solid = {"type": "Solid", "lod": "1.2", "boundaries": [shell]}
        objects[identifier] = {"type": "Building", "attributes": values, "geometry": [solid]}
    model = {"type": "CityJSON", "version": "2.0", "transform": {"scale": [1, 1, 1], "translate": [0, 0, 0]}}
    with open(path(name), "w", encoding="utf-8") as file:
        json.dump({**model, "CityObjects": objects, "vertices": vertices, **more}, file)
    return path(name)


def extent(volume, identifier):
    return np.diff(volume.labels[identifier].box, axis=0)[0]


class Read(unittest.TestCase):
    def test_axis_order(self):
        file = write_boxes("order.city.json", (8, 4, 3), {"b": {}})
        np.testing.assert_allclose(extent(svt.build(svt.read(file), spacing=0.5), "b"), (8, 4, 3), atol=1e-5)
        for order, size in (("by-name", (8, 4, 3)), ("east-north", (8, 4, 3)), ("north-east", (4, 8, 3))):
            for v in (
                svt.build(svt.read(file, axis_order=order), spacing=0.5),
                svt.build(file, axis_order=order, spacing=0.5),
            ):
                np.testing.assert_allclose(extent(v, "b"), size, atol=1e-5)
        self.refuses("axis_order", "north", file)

    def test_unit(self):
        file = write_boxes("unit.city.json", (8000, 4000, 3000), {"b": {}})
        for unit, metres in (("mm", 0.001), ("cm", 0.01), ("ft", 0.3048), ("m", 1)):
            v = svt.build(svt.read(file, unit=unit), dimension=(20, 20, 20))
            np.testing.assert_allclose(extent(v, "b"), np.array([8000, 4000, 3000]) * metres, rtol=1e-5)
        findings = [finding for finding in svt.read(file, unit="mm").findings if finding.code == "E120"]
        self.assertEqual(len(findings), 1)
        for read in (lambda: svt.read(file), lambda: svt.build(file, unit="of-file", dimension=(20, 20, 20))):
            with self.assertRaisesRegex(svt.Error, "E127.*3000 units high"):
                read()
        self.refuses("unit", "miles", file)

    def test_date(self):
        buildings = {
            "old": {"creationDate": "2010-01-01", "terminationDate": "2018-03-01"},
            "new": {"creationDate": "2018-03-01"},
        }
        file = write_boxes("versions.city.json", (8, 4, 3), buildings)
        for date, expected in (
            (None, ["new"]),
            ("2017-01-01", ["old"]),
            (datetime.date(2017, 1, 1), ["old"]),
            ("2018-03-01", ["new"]),
            ("all", ["old", "new"]),
        ):
            m = svt.read(file, date=date)
            self.assertEqual([feature.id for feature in m], expected, date)
            ended = [finding for finding in m.findings if finding.code == "E128"]
            self.assertEqual(len(ended), 0 if date == "all" else 1, date)
            for finding in ended:  # in the words of Python, not of the command line
                self.assertNotIn("--", finding.message)
        self.refuses("date", "1 May 2017", file)

    def test_a_record_with_several_values_is_a_list_in_the_list(self):
        noise = [{"source": "road", "levels": [50, 60]}, {"source": "rail"}, {"levels": [70]}]
        file = write_boxes(
            "noise.city.json", (8, 4, 3), {"b": {"use": ["flats", "shop"], "noise": noise, "storeys": 3}}
        )
        expected = {
            "use": ["flats", "shop"],
            "noise/source": ["road", "rail", None],
            "noise/levels": [[50, 60], None, 70],
            "storeys": 3,
        }
        m = svt.read(file)
        for attributes in (m[0].attributes, svt.build(m, spacing=0.5).labels["b"].attributes):
            self.assertEqual({name: attributes.get(name) for name in expected}, expected)

    def refuses(self, keyword, value, file):
        readers: list[Callable[..., object]] = [svt.read, svt.build]
        for act in readers:
            with self.assertRaises(svt.Error) as caught:
                act(file, **{keyword: value})
            self.assertEqual(caught.exception.code, "E904")
            self.assertIn(keyword, caught.exception.message)
            self.assertNotIn("--", caught.exception.message)


if __name__ == "__main__":
    unittest.main()

"""The notebook of examples/python: stored without outputs, it runs and shows tables, pictures and the page."""
import base64
import json
import os
import pathlib
import shutil
import subprocess
import sys
import typing
import unittest

import numpy as np

import svt
from common import needs, path
from test_page import needs_page

NOTEBOOK = pathlib.Path(__file__).resolve().parent.parent.parent / "examples" / "python" / "house.ipynb"


def executed():
    """The outputs of each cell by its id: {id: [{type: data}]}."""
    os.makedirs(path("notebook"), exist_ok=True)
    shutil.copy(NOTEBOOK, path("notebook"))
    done = subprocess.run(
        [sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--inplace", path("notebook/house.ipynb")],
        env={**os.environ, "HOME": path("notebook"), "IPYTHONDIR": path("notebook/ipython")},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    with open(path("notebook/house.ipynb"), encoding="utf-8") as file:
        cells = json.load(file)["cells"]
    return {
        cell["id"]: [{kind: "".join(text) for kind, text in output["data"].items()} for output in cell["outputs"]]
        for cell in cells
        if cell["cell_type"] == "code"
    }


class Stored(unittest.TestCase):
    def test_notebook_has_no_outputs(self):
        for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]:
            if cell["cell_type"] == "code":
                self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None), cell["id"])
        self.assertLess(NOTEBOOK.stat().st_size, 10_000)


@needs("xarray")
@needs("pandas")
class Executed(unittest.TestCase):
    outputs: typing.ClassVar[dict[str, list[dict[str, typing.Any]]]]

    @classmethod
    def setUpClass(cls):
        cls.outputs = executed()

    def shown(self, cell):
        (output,) = self.outputs[cell]
        return output

    def picture(self, data):
        with open(path("notebook.png"), "wb") as file:
            file.write(base64.b64decode(data))
        return svt.read_png(path("notebook.png"))

    def test_volume_and_frame_are_pictures(self):
        self.assertIn("data:image/png;base64,iVBOR", self.shown("build")["text/html"])
        picture = self.picture(self.shown("picture")["image/png"])
        self.assertEqual(picture.shape, (500, 800, 4))
        self.assertGreater(len(np.unique(picture.reshape(-1, 4), axis=0)), 1000)

    def test_tables_have_the_numbers_of_the_house(self):
        text = self.shown("rooms")["text/plain"]
        self.assertEqual(len(text.splitlines()), 16)  # two lines of names, 14 rooms
        self.assertIn("Kitchen", text)
        volume = svt.build(path("notebook/house.gml"), spacing=0.05)
        self.assertIn(f"{volume.labels['Kitchen'].volume:.2f}", text)
        plan = volume.section("z=1.2")
        rooms = sum(c.area for c in plan.components if c.label.class_name == "BuildingRoom")
        self.assertIn(f"{rooms:.2f}", self.shown("areas")["text/plain"])
        lines = self.shown("samples")["text/plain"].splitlines()
        samples = float(lines[1].split()[-1])
        is_room = np.array([label.class_name == "BuildingRoom" for label in volume.labels] + [False])
        index = int(np.round(volume.index((*volume.origin[:2], float(lines[1].split()[0])))[2]))
        counted = is_room[volume.labels.of_scalar[volume.dense()[index]]].sum() * 0.05**2
        self.assertAlmostEqual(samples, counted, 2)
        self.assertTrue(0.9 * rooms < samples < rooms)

    def test_plan_is_a_drawing_and_the_dataset_a_tree(self):
        plan = self.shown("plan")
        self.assertTrue(plan["image/svg+xml"].startswith("<svg "))
        drawing = base64.b64decode(plan["text/html"].partition("base64,")[2].partition('"')[0]).decode()
        self.assertTrue(drawing.endswith(plan["image/svg+xml"]))
        self.assertIn("component_name", self.shown("dataset")["text/html"])

    def test_notebook_becomes_a_web_page(self):
        done = subprocess.run(
            [sys.executable, "-m", "nbconvert", "--to", "html", path("notebook/house.ipynb")],
            env={**os.environ, "HOME": path("notebook")},
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        text = pathlib.Path(path("notebook/house.html")).read_text(encoding="utf-8")
        self.assertIn('src="data:image/svg+xml;base64,', text)
        self.assertIn('src="data:image/png;base64,', text)
        self.assertIn("Kitchen", text)

    @needs_page
    def test_page_is_in_the_notebook(self):
        text = self.shown("viewer")["text/html"]
        self.assertTrue(text.startswith('<iframe srcdoc="'))
        self.assertIn('height="560"', text)
        self.assertLess(len(text), 8_000_000)


if __name__ == "__main__":
    unittest.main()

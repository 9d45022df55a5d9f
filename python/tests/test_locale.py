"""In a process whose locale has a decimal comma, every answer is that of the "C" locale."""
import locale
import os
import pathlib
import subprocess
import unittest


import svt
from common import house, house_file, path

SOURCE = pathlib.Path(__file__).resolve().parents[2] / "tests" / "locale" / "comma.locale"


def answers():
    """Results of numbers in texts, and texts with numbers."""
    volume = house()
    section = volume.section("z=1.25")
    picture = volume.render(
        size="96x64",
        section=["y<2.5"],
        opacity=["class=BuildingRoom:0.22"],
        cut="box(0.5, 0.5, 0.5, 2.5, 2.5, 2.5)",
        hatch_spacing=0.15,
    )
    built = svt.build(house_file(), spacing=(0.5, 0.25, 0.5))
    volume.save(path("house.nrrd"))
    return {
        "svg": section.to_svg(),
        "dxf": section.to_dxf(),
        "geojson": section.to_geojson(),
        "csv": section.to_csv(),
        "area": section.area,
        "pixels": picture.tobytes(),
        "spacing": built.spacing,
        "query": [label.id for label in volume.query("volume>0.75")],
        "nrrd": pathlib.Path(path("house.nrrd")).read_bytes(),
        "attributes": [label.attributes for label in volume.labels],
    }


class CommaLocale(unittest.TestCase):
    def test_no_answer_changes(self):
        expected = answers()
        folder = path("locales")
        os.makedirs(folder, exist_ok=True)
        subprocess.run(
            ["localedef", "-c", "--no-archive", "-i", str(SOURCE), os.path.join(folder, "comma")],
            capture_output=True,
            check=False,
        )  # warns of the categories that are missing
        os.environ["LOCPATH"] = folder
        locale.setlocale(locale.LC_NUMERIC, "comma")
        try:
            self.assertEqual(locale.localeconv()["decimal_point"], ",")
            found = answers()
        finally:
            locale.setlocale(locale.LC_NUMERIC, "C")
            del os.environ["LOCPATH"]
        self.assertEqual(expected.keys(), found.keys())
        for name, answer in expected.items():
            self.assertEqual(answer, found[name], name)


if __name__ == "__main__":
    unittest.main()

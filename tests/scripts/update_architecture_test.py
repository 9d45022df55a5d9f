#!/usr/bin/env python3
"""scripts/update_architecture.py writes the sub-folders of the tree, and finds folders without a row."""
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True  # write no cache files into scripts/
sys.path.insert(0, str(ROOT / "scripts"))
import update_architecture

PAGE = """| folder | holds | inside |
|---|---|---|
| [svt/core](../../svt/core) | results | `gone` |
| [svt/mesh](../../svt/mesh) | triangles | |
"""
FILES = [
    "svt/core/text/text.cpp",
    "svt/core/error/error.cpp",
    "svt/core/only/only_test.cpp",
    "svt/core/vec.hpp",
    "svt/mesh/mesh.cpp",
]


class UpdateArchitecture(unittest.TestCase):
    def updated(self, files):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name in files:
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text("")
            return update_architecture.updated(root, PAGE)

    def test_the_column_is_that_of_the_tree(self):
        page, problems = self.updated(FILES)
        self.assertEqual(problems, [])
        self.assertIn("| [svt/core](../../svt/core) | results | `error`, `text` |\n", page)
        self.assertIn("| [svt/mesh](../../svt/mesh) | triangles | |\n", page)

    def test_a_folder_without_a_row_and_a_row_without_a_folder_are_found(self):
        self.assertIn("svt/crs has no row", self.updated(FILES + ["svt/crs/crs.hpp"])[1][0])
        self.assertIn("the row of svt/mesh has no folder", self.updated(FILES[:-1])[1][0])

    def test_the_page_is_that_of_the_tree(self):
        page = (ROOT / update_architecture.PAGE).read_text(encoding="utf-8")
        self.assertEqual(update_architecture.updated(ROOT, page), (page, []))


if __name__ == "__main__":
    unittest.main()

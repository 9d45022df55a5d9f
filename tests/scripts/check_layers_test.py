#!/usr/bin/env python3
"""scripts/check_layers.py refuses each kind of wrong include, and takes a right tree."""
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True  # write no cache files into scripts/
sys.path.insert(0, str(ROOT / "scripts"))
import check_layers

RIGHT = {
    "svt/layers.txt": "core:\nvolume: core\nrender: core volume\napps/cli: core volume render\n"
    "test tests: volume\ninside tests/fuzz: volume\n",
    "svt/core/vec.hpp": "#pragma once\n",
    "svt/volume/grid.hpp": "#pragma once\n#include <svt/core/vec.hpp>\nnamespace svt::volume {}\n",
    "svt/volume/bricks/coder.hpp": "#pragma once\n#include <svt/volume/grid.hpp>\n",
    "svt/volume/file/zip.cpp": "#include <svt/volume/bricks/coder.hpp>\n",
    "svt/render/caster.hpp": "#pragma once\n#include <svt/core/vec.hpp>\n#include <svt/volume/grid.hpp>\n",
    "svt/core/file/file.cpp": "#include <unistd.h>\n",
    "apps/cli/main.cpp": "#include <apps/cli/commands/build.hpp>\n",
    "apps/cli/commands/build.hpp": "#pragma once\n#include <svt/render/caster.hpp>\n",
    "apps/cli/commands/build.cpp": "#include <svt/core/vec.hpp>\n#include <svt/volume/grid.hpp>\n",
    "tests/cli/volume_test.cpp": "#include <svt/volume/grid.hpp>\n",
    "tests/fuzz/zip_fuzz.cpp": "#include <svt/volume/bricks/coder.hpp>\n",
}


class CheckLayers(unittest.TestCase):
    def problems(self, files=None):
        """Problems of the right tree with other or further files."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in {**RIGHT, **(files or {})}.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return check_layers.check_tree(root)[0]

    def refused(self, file, text, reason):
        problems = self.problems(files={file: text})
        self.assertEqual(len(problems), 1, problems)
        self.assertIn(reason, problems[0])

    def test_a_right_tree_passes(self):
        self.assertEqual(self.problems(), [])

    def test_a_folder_above_is_refused(self):
        self.refused("svt/volume/bad.cpp", "#include <svt/render/caster.hpp>\n", "volume may not include render")

    def test_what_the_table_gives_is_used(self):
        self.refused(
            "apps/cli/commands/build.cpp", "#include <svt/volume/grid.hpp>\n", "apps/cli does not include core"
        )
        self.assertEqual(
            self.problems({"tests/cli/volume_test.cpp": "", "tests/fuzz/zip_fuzz.cpp": ""}),
            ["layers.txt: test tests does not include volume"],
        )

    def test_the_inside_of_another_folder_is_refused(self):
        self.refused("svt/render/bad.cpp", "#include <svt/volume/bricks/coder.hpp>\n", "is the inside of volume")
        self.refused("apps/cli/bad.cpp", "#include <svt/volume/bricks/coder.hpp>\n", "is the inside of volume")

    def test_a_public_header_may_not_leak_the_inside(self):
        self.refused(
            "svt/volume/bad.hpp", "#pragma once\n#include <svt/volume/bricks/coder.hpp>\n", "includes its inside"
        )

    def test_sub_folders_in_a_circle_are_refused(self):
        self.refused("svt/volume/bricks/bad.cpp", "#include <svt/volume/file/zip.hpp>\n", "in a circle")

    def test_an_application_s_sub_folder_may_not_include_its_top(self):
        self.refused("apps/cli/commands/bad.cpp", "#include <apps/cli/main.hpp>\n", "in a circle")

    def test_a_folder_that_the_table_lacks_is_refused(self):
        self.refused("svt/other/new.cpp", "", "not in svt/layers.txt")

    def test_a_table_that_goes_back_up_is_refused(self):
        problems = self.problems(files={"svt/layers.txt": RIGHT["svt/layers.txt"].replace("core:", "core: volume")})
        self.assertIn("stands above core", problems[0])

    def test_third_party_in_a_public_header_is_refused(self):
        self.refused("svt/volume/bad.hpp", "#pragma once\n#include <png.h>\n", "third-party")

    def test_a_header_without_guard_is_refused(self):
        self.refused("svt/volume/bad.hpp", "", "no #pragma once")

    def test_another_folder_s_namespace_is_refused(self):
        self.refused("svt/volume/bad.cpp", "namespace svt::render {}\n", "namespace svt::render")

    def test_calls_of_one_operating_system_are_refused(self):
        self.refused("svt/volume/bad.cpp", "#include <sys/stat.h>\n", "of one operating system")

    def test_a_crowded_folder_is_refused(self):
        crowd = {f"svt/render/file{n}.cpp": "" for n in range(check_layers.MAX_FILES)}
        self.assertIn("want sub-folders", self.problems(files=crowd)[0])

    def test_a_sub_folder_of_a_sub_folder_is_refused(self):
        self.refused("svt/volume/bricks/deep/bad.cpp", "", "sub-folder of a sub-folder")


if __name__ == "__main__":
    unittest.main()

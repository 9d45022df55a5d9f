"""How the package starts: `python -m svt`, the place of the command, and packages that are missing."""
import os
import subprocess
import sys
import textwrap
import unittest
from unittest import mock

import svt
from common import COMMAND, house, needs_command, path
from svt import command


def run(*arguments, **environment):
    return subprocess.run(
        [sys.executable, *arguments], capture_output=True, text=True, env={**os.environ, **environment}
    )


class Command(unittest.TestCase):
    @needs_command
    def test_module_is_the_command(self):
        for words in (
            ["--version"],
            ["info", path("missing.svt")],
            ["nonsense"],
            ["sample", "house", "-o", "/dev/stdout"],
        ):
            mine = run("-m", "svt", *words)
            other = subprocess.run([COMMAND, *words], capture_output=True, text=True)
            self.assertEqual(
                (mine.returncode, mine.stdout, mine.stderr), (other.returncode, other.stdout, other.stderr), words
            )

    def test_missing_command_is_an_error_with_a_remedy(self):
        done = run("-m", "svt", "--version", SVT_COMMAND="", PATH="")
        self.assertEqual((done.returncode, done.stdout), (127, ""))
        self.assertIn("svt: error E101 CannotOpen: the command svt is missing; install", done.stderr)
        done = run("-m", "svt", "--version", SVT_COMMAND=path("no such command"))
        self.assertEqual(done.returncode, 127)
        self.assertIn("no such command: No such file or directory; set SVT_COMMAND", done.stderr)

    def test_command_of_the_wheel_goes_before_others(self):
        folder = path("prefix/bin")
        os.makedirs(folder, exist_ok=True)
        program = os.path.join(folder, "svt")
        with open(program, "w") as file:
            file.write("#!/bin/sh\n")

        class File:
            name = "svt"
            parent = mock.Mock()

            def locate(self):
                return program

        File.parent.name = "bin"
        with mock.patch.dict(os.environ, {"PATH": ""}), mock.patch("importlib.metadata.files", return_value=[File()]):
            os.environ.pop("SVT_COMMAND", None)
            self.assertEqual(command.find_command(), program)
            with mock.patch.dict(os.environ, {"SVT_COMMAND": "/mine"}):
                self.assertEqual(command.find_command(), "/mine")
            os.remove(program)
            with self.assertRaises(svt.Error):
                command.find_command()


class Optional(unittest.TestCase):
    def test_import_needs_only_numpy(self):
        done = run(
            "-c",
            textwrap.dedent(
                """
                import sys
                before = set(sys.modules)
                import numpy
                of_numpy = set(sys.modules)
                import svt
                added = {name.partition(".")[0] for name in set(sys.modules) - of_numpy}
                print(sorted(added - sys.stdlib_module_names - {"svt"}))
                """
            ),
        )
        self.assertEqual((done.stdout, done.stderr), ("[]\n", ""))

    def test_missing_packages_are_errors_with_a_remedy(self):
        v = house()
        for module, call, remedy in (
            ("xarray", v.to_xarray, "'semantic-volume-texture[xarray]', or apt install python3-xarray"),
            ("pandas", v.labels.to_pandas, "'semantic-volume-texture[tables]', or apt install python3-pandas"),
            ("pandas", v.section("z=1.2").to_pandas, "'semantic-volume-texture[tables]'"),
            ("vtkmodules", v.to_vtk, "'semantic-volume-texture[vtk]', or apt install python3-vtk9"),
            ("pyvista", v.to_pyvista, "'semantic-volume-texture[pyvista]'"),
        ):
            with mock.patch.dict(sys.modules, {module: None}), self.assertRaises(ImportError) as caught:
                call()
            self.assertIn(f"pip install {remedy}", str(caught.exception))


if __name__ == "__main__":
    unittest.main()

"""The wheel that make python packs: whole, the same each time, and imported from where it is unpacked."""
import base64
import csv
import hashlib
import io
import os
import pathlib
import subprocess
import sys
import unittest
import zipfile

import svt
from common import FOLDER, path

PACKER = pathlib.Path(__file__).resolve().parent.parent / "pack_wheel.py"
BUILD = pathlib.Path(svt.__file__).resolve().parent.parent.parent


def pack(folder):
    done = subprocess.run(
        [sys.executable, PACKER, BUILD, path(folder), svt.__version__], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return pathlib.Path(done.stdout.strip())


class Wheel(unittest.TestCase):
    def test_record_is_that_of_the_contents_and_bytes_are_the_same_again(self):
        wheel = pack("wheel")
        self.assertEqual(wheel.read_bytes(), pack("again").read_bytes())
        with zipfile.ZipFile(wheel) as archive:
            names = set(archive.namelist())
            for name in ("svt/__init__.py", "svt/py.typed", "svt/_native.pyi"):
                self.assertIn(name, names)
            self.assertFalse([name for name in names if "__pycache__" in name])
            (record,) = [name for name in names if name.endswith("/RECORD")]
            rows = list(csv.reader(io.StringIO(archive.read(record).decode())))
            self.assertEqual({row[0] for row in rows}, names)
            for name, checksum, size in rows:
                if name != record:
                    data = archive.read(name)
                    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
                    self.assertEqual((f"sha256={digest}", str(len(data))), (checksum, size))

    def test_unpacked_wheel_is_the_module(self):
        with zipfile.ZipFile(pack("wheel")) as archive:
            archive.extractall(path("site"))
        environment = {**os.environ, "PYTHONPATH": path("site")}  # and not the folder of the test
        done = subprocess.run(
            [sys.executable, "-c", "import svt; print(svt.__file__, svt.__version__)"],
            env=environment,
            cwd=FOLDER.name,
            capture_output=True,
            text=True,
        )
        self.assertEqual(
            done.stdout.split(), [os.path.join(path("site"), "svt", "__init__.py"), svt.__version__], done.stderr
        )

    def test_pip_takes_it(self):
        if subprocess.run([sys.executable, "-m", "pip", "--version"], capture_output=True).returncode != 0:
            self.skipTest("no pip")
        done = subprocess.run(
            [
                sys.executable,
                "-m",
                "pip",
                "install",
                "--no-index",
                "--no-deps",
                "--disable-pip-version-check",
                "--target",
                path("pip"),
                str(pack("wheel")),
            ],
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(os.path.exists(path("pip/svt/__init__.py")))


if __name__ == "__main__":
    unittest.main()

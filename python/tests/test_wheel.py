"""The wheel that make python packs: whole, the same each time, and used from where it is installed."""
import base64
import configparser
import csv
import email
import hashlib
import io
import os
import pathlib
import shutil
import subprocess
import sys
import tarfile
import unittest
import zipfile

import svt
from common import FOLDER, path

PACKER = pathlib.Path(__file__).resolve().parent.parent / "pack_wheel.py"
ROOT = PACKER.parent.parent
BUILD = pathlib.Path(svt.__file__).resolve().parent.parent.parent
STEM = f"semantic_volume_texture-{svt.__version__}"
has_pip = subprocess.run([sys.executable, "-m", "pip", "--version"], capture_output=True).returncode == 0
needs_pip = unittest.skipUnless(has_pip, "no pip")


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
            for name in (
                "svt/__init__.py",
                "svt/py.typed",
                "svt/_native.pyi",
                "svt/page_loader.js",
                f"{STEM}.data/scripts/svt",
            ):
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

    def test_metadata_are_those_of_the_project(self):
        wheel = pack("wheel")
        self.assertTrue(wheel.name.startswith(STEM + "-cp"))
        with zipfile.ZipFile(wheel) as archive:
            metadata = email.message_from_bytes(archive.read(f"{STEM}.dist-info/METADATA"))
            points = configparser.ConfigParser()
            points.read_string(archive.read(f"{STEM}.dist-info/entry_points.txt").decode())
            scripts = [entry for entry in archive.infolist() if entry.filename.endswith(".data/scripts/svt")]
        self.assertEqual((metadata["Name"], metadata["Version"]), ("semantic-volume-texture", svt.__version__))
        required = metadata.get_all("Requires-Dist")
        self.assertEqual([line for line in required if "extra ==" not in line], ["numpy"])
        self.assertIn('xarray; extra == "xarray"', required)
        self.assertIn("import svt", str(metadata.get_payload()))
        module, _, name = points["xarray.backends"]["svt"].partition(":")
        self.assertIn(
            f"class {name}(", (PACKER.parent / (module.replace(".", "/") + ".py")).read_text(encoding="utf-8")
        )
        self.assertEqual(scripts[0].external_attr >> 16, 0o100755)

    def test_version_is_that_of_cmake(self):
        sys.path.insert(0, str(PACKER.parent))
        try:
            import pack_wheel
        finally:
            sys.path.pop(0)
        self.assertEqual(pack_wheel.project_version(), svt.__version__)

    def test_manual_states_the_needed_libraries(self):
        if shutil.which("objdump") is None:
            self.skipTest("no objdump (binutils)")
        module = next((BUILD / "python" / "svt").glob("_native*.so"))
        done = subprocess.run(
            [sys.executable, PACKER, "--needs", module, BUILD / "bin" / "svt"], capture_output=True, text=True
        )
        libraries, symbols = done.stdout.splitlines()
        page = (ROOT / "docs" / "dev" / "python-wheel.md").read_text(encoding="utf-8")
        for word in libraries.split()[1:]:
            if not word.startswith("ld-linux"):
                self.assertIn(f"`{word}`", page)
        self.assertEqual([part in page for part in symbols.partition(": ")[2].split(", ")], [True, True], symbols)


def pip(*words):
    """Runs pip without an index. Returns what it prints on errors."""
    done = subprocess.run(
        [sys.executable, "-m", "pip", "--disable-pip-version-check", *map(str, words)], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@needs_pip
class Pip(unittest.TestCase):
    def test_installed_wheel_is_module_command_and_backend(self):
        pip("install", "--no-index", "--no-deps", "--target", path("pip"), pack("wheel"))
        environment = {**os.environ, "PYTHONPATH": path("pip"), "PATH": ""}
        environment.pop("SVT_COMMAND", None)

        def run(*words):
            done = subprocess.run(
                [sys.executable, *words], env=environment, cwd=FOLDER.name, capture_output=True, text=True
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout

        self.assertEqual(run("-c", "import svt; print(svt.__file__)").strip(), path("pip/svt/__init__.py"))
        self.assertTrue(run("-m", "svt", "--version").startswith(f"svt {svt.__version__}\n"))
        text = "import importlib.metadata as m; print(m.version('semantic-volume-texture'), m.entry_points(name='svt'))"
        self.assertTrue(run("-c", text).startswith(f"{svt.__version__} "))
        self.assertIn("svt.xarray_backend:SvtBackendEntrypoint", run("-c", text))
        if (BUILD / "share" / "svt" / "viewer" / "index.html").exists():
            # The command finds its page beside itself.
            svt.sample("house", path("pip.gml"))
            run("-m", "svt", "publish", path("pip.gml"), "-o", path("pip-site"), "--spacing", "0.5")
            self.assertTrue(os.path.exists(path("pip-site/index.html")))

    def test_pip_installs_the_checkout_by_its_backend(self):
        built = f"--config-settings=built={BUILD}"
        pip("wheel", "--no-index", "--no-deps", "--wheel-dir", path("built"), built, ROOT)
        (wheel,) = pathlib.Path(path("built")).iterdir()
        self.assertEqual(wheel.name, pack("wheel").name)
        self.assertEqual(wheel.read_bytes(), pack("wheel").read_bytes())
        with self.assertRaisesRegex(AssertionError, "is missing; 'make python' builds it"):
            pip("wheel", "--no-index", "--no-deps", "--wheel-dir", path("none"), "--config-settings=built=/none", ROOT)

    def test_source_archive_has_the_files_of_git_and_the_same_bytes_again(self):
        if not (ROOT / ".git").exists() or shutil.which("git") is None:
            self.skipTest("no checkout of git")
        text = "import sys, build_backend as b; print(b.build_sdist(sys.argv[1]))"
        for folder in ("source", "source-again"):
            os.makedirs(path(folder), exist_ok=True)
            done = subprocess.run(
                [sys.executable, "-c", text, path(folder)],
                env={**os.environ, "PYTHONPATH": str(PACKER.parent)},
                capture_output=True,
                text=True,
            )
            self.assertEqual(done.stdout.strip(), f"{STEM}.tar.gz", done.stderr)
        archive = pathlib.Path(path("source"), f"{STEM}.tar.gz")
        self.assertEqual(archive.read_bytes(), pathlib.Path(path("source-again"), archive.name).read_bytes())
        with tarfile.open(archive) as files:
            names = set(files.getnames())
        for name in ("PKG-INFO", "pyproject.toml", "CMakeLists.txt", "python/build_backend.py", "python/svt/volume.py"):
            self.assertIn(f"{STEM}/{name}", names)
        self.assertFalse([name for name in names if name.startswith(f"{STEM}/build/")])


if __name__ == "__main__":
    unittest.main()

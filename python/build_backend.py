"""Builds wheels and source archives for pip (PEP 517), with the tools of the system: `pip install .`.

The backend runs CMake and python/pack_wheel.py, and needs no package of an index. Setting (`--config-settings`):

    built=FOLDER    pack this finished build folder, such as build/release, instead of compiling
"""
from __future__ import annotations

import gzip
import io
import os
import pathlib
import subprocess
import sys
import tarfile
from typing import Any, Mapping, Optional

import pack_wheel
from pack_wheel import ROOT

Settings = Optional[Mapping[str, Any]]


def compile_all() -> pathlib.Path:
    """Compiles module and command for this interpreter; returns the build folder, which later calls reuse."""
    build = ROOT / "build" / f"python-{sys.version_info.major}.{sys.version_info.minor}"
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DSVT_TESTS=OFF", f"-DSVT_PYTHON_EXECUTABLE={sys.executable}"]
    subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), "-G", "Ninja", *options], check=True)
    subprocess.run(["cmake", "--build", str(build), "--target", "svt_python_package", "svt"], check=True)
    return build


def build_wheel(wheel_directory: str, config_settings: Settings = None, metadata_directory: str | None = None) -> str:
    built = (config_settings or {}).get("built")
    build = ROOT / built if built else compile_all()
    try:
        return pack_wheel.pack(build, pathlib.Path(wheel_directory), pack_wheel.project_version()).name
    except SystemExit as missing:  # pip shows the message of an exception
        raise RuntimeError(str(missing)) from None


def prepare_metadata_for_build_wheel(metadata_directory: str, config_settings: Settings = None) -> str:
    version = pack_wheel.project_version()
    pack_wheel.write_information(pathlib.Path(metadata_directory), version)
    return pack_wheel.stem(version) + ".dist-info"


def build_sdist(sdist_directory: str, config_settings: Settings = None) -> str:
    """An archive of all files that git knows. Equal files give equal bytes."""
    version = pack_wheel.project_version()
    stem = pack_wheel.stem(version)
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True).stdout
    names = sorted(name for name in listed.decode().split("\0") if name and (ROOT / name).is_file())
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for name in names:
            mode = 0o755 if os.access(ROOT / name, os.X_OK) else 0o644
            add(archive, f"{stem}/{name}", (ROOT / name).read_bytes(), mode)
        add(archive, f"{stem}/PKG-INFO", pack_wheel.metadata(version).encode(), 0o644)
    path = pathlib.Path(sdist_directory, f"{stem}.tar.gz")
    path.write_bytes(gzip.compress(packed.getvalue(), mtime=0))
    return path.name


def add(archive: tarfile.TarFile, name: str, data: bytes, mode: int) -> None:
    entry = tarfile.TarInfo(name)
    entry.size, entry.mode = len(data), mode
    archive.addfile(entry, io.BytesIO(data))

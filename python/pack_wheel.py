#!/usr/bin/env python3
"""Packs the built module, the command and its page as a wheel, without other tools and without the network (PEP 427).
Equal contents give equal bytes. Name, description and dependencies are those of pyproject.toml.

    python/pack_wheel.py BUILD_FOLDER OUTPUT_FOLDER VERSION    writes the wheel, prints its path
    python/pack_wheel.py --information FOLDER VERSION          writes only the folder NAME-VERSION.dist-info
    python/pack_wheel.py --needs FILE...                       prints the libraries and symbol versions of ELF files
"""
from __future__ import annotations

import base64
import hashlib
import importlib
import pathlib
import re
import shutil
import stat
import subprocess
import sys
import sysconfig
import zipfile
from typing import Any, Iterable

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Endings of the files of the package; the extension module is named in full.
PACKAGED = (".py", ".pyi", ".js")
PAGE = pathlib.PurePath("share", "svt", "viewer")


def project() -> dict[str, Any]:
    """The table [project] of pyproject.toml."""
    name = "tomllib" if sys.version_info >= (3, 11) else "tomli"
    try:
        toml = importlib.import_module(name)
    except ImportError:
        raise SystemExit(
            "wheel: Python before 3.11 needs tomli to read pyproject.toml; install python3-tomli"
        ) from None
    return toml.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def project_version() -> str:
    """The version in CMakeLists.txt, the only place that states it."""
    found = re.search(r"^project\(svt VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M)
    if found is None:
        raise SystemExit("wheel: CMakeLists.txt has no version")
    return found.group(1)


def stem(version: str) -> str:
    """The first part of the names of wheel and information, such as "semantic_volume_texture-0.1.0"."""
    return re.sub(r"[-_.]+", "_", project()["name"]).lower() + "-" + version


def tag() -> str:
    """The tag of this interpreter and machine, such as "cp311-cp311-linux_x86_64"."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def metadata(version: str) -> str:
    """The file METADATA (core metadata 2.1)."""
    about = project()
    lines = [
        "Metadata-Version: 2.1",
        f"Name: {about['name']}",
        f"Version: {version}",
        f"Summary: {about['description']}",
        f"License: {about['license']['text']}",
        f"Requires-Python: {about['requires-python']}",
        f"Keywords: {','.join(about['keywords'])}",
        *(f"Classifier: {classifier}" for classifier in about["classifiers"]),
        *(f"Project-URL: {name}, {url}" for name, url in about.get("urls", {}).items()),
        *(f"Requires-Dist: {requirement}" for requirement in about["dependencies"]),
    ]
    for extra, requirements in about["optional-dependencies"].items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f'Requires-Dist: {requirement}; extra == "{extra}"' for requirement in requirements]
    lines += ["License-File: LICENSE", "Description-Content-Type: text/markdown", ""]
    return "\n".join(lines) + "\n" + (ROOT / about["readme"]).read_text(encoding="utf-8")


def information(version: str) -> dict[str, bytes]:
    """Name in the folder *.dist-info -> bytes: the files that describe the package wherever it is installed."""
    groups = project()["entry-points"]
    points = "\n".join(
        f"[{group}]\n" + "".join(f"{name} = {place}\n" for name, place in points.items())
        for group, points in groups.items()
    )
    return {
        "METADATA": metadata(version).encode(),
        "entry_points.txt": points.encode(),
        "LICENSE": (ROOT / "LICENSE").read_bytes(),
    }


def write_information(folder: pathlib.Path, version: str) -> None:
    """Writes *.dist-info into the folder of the package, and removes that of another version."""
    for old in folder.glob(stem("*") + ".dist-info"):
        shutil.rmtree(old)
    place = folder / (stem(version) + ".dist-info")
    place.mkdir(parents=True)
    for name, data in information(version).items():
        (place / name).write_bytes(data)


def package_files(package: pathlib.Path) -> Iterable[pathlib.Path]:
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    if not (package / f"_native{suffix}").is_file():
        raise SystemExit(f"wheel: {package}/_native{suffix} is missing; 'make python' builds it")
    return [
        path
        for path in sorted(package.iterdir())
        if path.suffix in PACKAGED or path.name in ("py.typed", f"_native{suffix}")
    ]


def contents(build: pathlib.Path, version: str) -> dict[str, bytes]:
    """Name in the wheel -> bytes, without RECORD."""
    files = {f"svt/{path.name}": path.read_bytes() for path in package_files(build / "python" / "svt")}
    command = build / "bin" / "svt"
    if not command.is_file():
        raise SystemExit(f"wheel: {command} is missing; 'make python' builds it")
    files[f"{stem(version)}.data/scripts/svt"] = command.read_bytes()
    # The command looks for its page in share/svt/viewer next to its own folder. `make viewer` builds it in build/release.
    pages = [folder for folder in (build, ROOT / "build" / "release") if (folder / PAGE / "index.html").is_file()]
    for path in sorted((pages[0] / PAGE).rglob("*")) if pages else []:
        if path.is_file():
            files[f"{stem(version)}.data/data/{path.relative_to(pages[0]).as_posix()}"] = path.read_bytes()
    folder = stem(version) + ".dist-info"
    files.update({f"{folder}/{name}": data for name, data in information(version).items()})
    files[f"{folder}/WHEEL"] = (
        f"Wheel-Version: 1.0\nGenerator: pack_wheel\nRoot-Is-Purelib: false\nTag: {tag()}\n"
    ).encode()
    return files


def pack(build: pathlib.Path, output: pathlib.Path, version: str) -> pathlib.Path:
    """Writes the wheel of a build folder; returns its path."""
    files = contents(build, version)
    record = f"{stem(version)}.dist-info/RECORD"
    rows = [
        f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}\n"
        for name, data in files.items()
    ]
    files[record] = "".join([*rows, f"{record},,\n"]).encode()
    output.mkdir(parents=True, exist_ok=True)
    wheel = output / f"{stem(version)}-{tag()}.whl"
    temporary = wheel.with_suffix(".part")
    with zipfile.ZipFile(temporary, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            is_program = name.endswith(".so") or ".data/scripts/" in name
            # pip makes a file executable only if its mode states the kind of the file too.
            entry.external_attr = (stat.S_IFREG | (0o755 if is_program else 0o644)) << 16
            archive.writestr(entry, data)
    temporary.replace(wheel)
    return wheel


def needs(paths: Iterable[pathlib.Path]) -> tuple[list[str], dict[str, str]]:
    """The shared libraries of ELF files, and the newest version of each family of symbols, such as {"GLIBC": "2.35"}."""
    libraries: set[str] = set()
    newest: dict[str, str] = {}
    for path in paths:
        text = subprocess.run(["objdump", "-p", path], check=True, capture_output=True, text=True).stdout
        libraries.update(re.findall(r"^ +NEEDED +(\S+)$", text, re.M))
        for family, version in re.findall(r"\b(GLIBC|GLIBCXX)_([0-9.]+)$", text, re.M):
            newest[family] = max(newest.get(family, "0"), version, key=lambda v: [int(n) for n in v.split(".")])
    return sorted(libraries), newest


def main(words: list[str]) -> None:
    if len(words) == 3 and words[0] == "--information":
        write_information(pathlib.Path(words[1]), words[2])
    elif len(words) >= 2 and words[0] == "--needs":
        libraries, newest = needs(map(pathlib.Path, words[1:]))
        print("libraries:", " ".join(libraries))
        print("symbols:", ", ".join(f"{family} {version}" for family, version in sorted(newest.items())))
    elif len(words) == 3:
        print(pack(pathlib.Path(words[0]), pathlib.Path(words[1]), words[2]))
    else:
        raise SystemExit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])

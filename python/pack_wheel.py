#!/usr/bin/env python3
"""Packs the built module as a wheel, without other tools and without the network: a ZIP with the package and three text
files about it (PEP 427). Equal contents give equal bytes.

    python/pack_wheel.py BUILD_FOLDER OUTPUT_FOLDER VERSION
"""
import base64
import hashlib
import pathlib
import sys
import sysconfig
import zipfile


def tag() -> str:
    """The tag of this interpreter and machine, such as "cp311-cp311-linux_x86_64"."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def contents(package: pathlib.Path, version: str) -> dict[str, bytes]:
    """Name in the wheel -> bytes, without RECORD."""
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    if not (package / f"_native{suffix}").is_file():
        raise SystemExit(f"wheel: {package}/_native{suffix} is missing; 'make python' builds it")
    files = {
        f"svt/{path.name}": path.read_bytes()
        for path in sorted(package.iterdir())
        if path.suffix in (".py", ".pyi") or path.name == "py.typed" or path.name == f"_native{suffix}"
    }
    information = f"svt-{version}.dist-info"
    files[f"{information}/METADATA"] = (
        f"Metadata-Version: 2.1\nName: svt\nVersion: {version}\n"
        "Summary: Semantic volume textures of building models: read, build, ask, cut and draw\n"
        "License: Apache-2.0\nRequires-Python: >=3.9\nRequires-Dist: numpy\n"
    ).encode()
    files[f"{information}/WHEEL"] = (
        f"Wheel-Version: 1.0\nGenerator: pack_wheel\nRoot-Is-Purelib: false\nTag: {tag()}\n"
    ).encode()
    return files


def main() -> None:
    if len(sys.argv) != 4:
        raise SystemExit(__doc__)
    build, output, version = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
    files = contents(build / "python" / "svt", version)
    record = f"svt-{version}.dist-info/RECORD"
    rows = [
        f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}\n"
        for name, data in files.items()
    ]
    files[record] = "".join([*rows, f"{record},,\n"]).encode()
    output.mkdir(parents=True, exist_ok=True)
    wheel = output / f"svt-{version}-{tag()}.whl"
    temporary = wheel.with_suffix(".part")
    with zipfile.ZipFile(temporary, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
            archive.writestr(entry, data)
    temporary.replace(wheel)
    print(wheel)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""The bill of materials of the command as Debian packages deliver it, as CycloneDX 1.5: the libraries that it links, those that
it loads on first use, and those that are compiled into it. The same packages give the same bytes.

    scripts/release/sbom.py build/release/bin/svt > svt.cdx.json

The page and the npm package have lists of their own (web/viewer/sbom.mjs).
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
from typing import NamedTuple

import version

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Library(NamedTuple):
    licence: str
    use: str  # linked, loaded (on first use), compiled (into the program), system


# By Debian's source package, so that a new version needs no change here.
LIBRARIES = {
    "fmtlib": Library("MIT", "linked"),
    "fontconfig": Library("HPND", "linked"),
    "freetype": Library("FTL", "linked"),
    "gcc-12": Library("GPL-3.0-or-later WITH GCC-exception-3.1", "system"),
    "glibc": Library("LGPL-2.1-or-later", "system"),
    "highway": Library("Apache-2.0", "linked"),
    "libglu": Library("SGI-B-2.0", "linked"),
    "libglvnd": Library("MIT", "linked"),
    "libjpeg-turbo": Library("IJG AND BSD-3-Clause AND Zlib", "linked"),
    "libpng1.6": Library("libpng-2.0", "linked"),
    "libzstd": Library("BSD-3-Clause", "linked"),
    "onetbb": Library("Apache-2.0", "linked"),
    "pugixml": Library("MIT", "linked"),
    "simdjson": Library("Apache-2.0", "linked"),
    "zlib": Library("Zlib", "linked"),
    "brotli": Library("MIT", "loaded"),
    "cairo": Library("LGPL-2.1-only OR MPL-1.1", "loaded"),
    "curl": Library("curl", "loaded"),
    "fribidi": Library("LGPL-2.1-or-later", "loaded"),
    "libxlsxwriter": Library("BSD-2-Clause", "loaded"),
    "proj": Library("MIT", "loaded"),
    "qpdf": Library("Apache-2.0", "loaded"),
    "sqlite3": Library("blessing", "loaded"),
    "cli11": Library("BSD-3-Clause", "compiled"),
    "fonts-dejavu": Library("Bitstream-Vera", "compiled"),
    "nlohmann-json3": Library("MIT", "compiled"),
}
# Names of SPDX that a single identifier may have; all others are expressions.
EXPRESSION = re.compile(r" (?:OR|AND|WITH) ")
LOADED = r'"(lib[a-z0-9_+-]+\.so(?:\.\d+)+)"'  # names of libraries in the sources
COMPILED = ["libcli11-dev", "fonts-dejavu-core", "nlohmann-json3-dev"]


def output_of(*words: str) -> str:
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


def linked(program: pathlib.Path) -> list[str]:
    """The files of the libraries that the program names itself."""
    names = re.findall(r"\(NEEDED\).*\[(.+)\]", output_of("readelf", "--dynamic", str(program)))
    found = dict(re.findall(r"^\s*(\S+)(?: => (\S+))? \(0x", output_of("ldd", str(program)), re.M))
    files = [found.get(name) or name for name in names if "ld-linux" not in name]
    for file in files:
        if not pathlib.Path(file).exists():
            sys.exit(f"sbom: the library {file} of {program} is missing on this machine")
    return files


def loaded() -> list[str]:
    """The files of the libraries that the sources name and this machine has."""
    names = set()
    for path in (ROOT / "svt").rglob("*.cpp"):
        if not path.stem.endswith("_test"):
            names |= set(re.findall(LOADED, path.read_text(encoding="utf-8")))
    for path in (ROOT / "cmake").glob("*.cmake"):
        names |= set(re.findall(r"set\(SVT_[A-Z]+_LIBRARY (lib\S+\.so\.\d+)\)", path.read_text(encoding="utf-8")))
    known = dict(re.findall(r"^\s*(\S+) \(.*x86-64.*\) => (\S+)", output_of("/sbin/ldconfig", "-p"), re.M))
    proj = [name for name in known if re.fullmatch(r"libproj\.so\.\d+", name)]
    return [known[name] for name in sorted(names | set(proj)) if name in known]


def package_of(file: str) -> str:
    """The Debian package that has installed a file."""
    for path in (file, str(pathlib.Path(file).resolve()), file.removeprefix("/usr"), "/usr" + file):
        done = subprocess.run(["dpkg-query", "--search", path], capture_output=True, text=True)
        if done.returncode == 0:
            return done.stdout.split(": ")[0].split(",")[0]
    sys.exit(f"sbom: no Debian package has installed {file}; build the release on Debian")


def component(package: str) -> dict:
    form = "${binary:Package}\t${source:Package}\t${Version}\t${Architecture}"
    name, source, number, architecture = output_of("dpkg-query", "--show", f"--showformat={form}", package).split("\t")
    name = name.split(":")[0]
    library = LIBRARIES.get(source)
    if library is None:
        sys.exit(f"sbom: the licence of {source} ({name}) is unknown; add it to LIBRARIES in scripts/release/sbom.py")
    purl = f"pkg:deb/debian/{name}@{number.replace('+', '%2B').replace(':', '%3A')}?arch={architecture}"
    licence: dict = {"expression": library.licence}
    if not EXPRESSION.search(library.licence):
        licence = {"license": {"id": library.licence}}
    return {
        "type": "data" if source == "fonts-dejavu" else "library",
        "bom-ref": purl,
        "name": name,
        "version": number,
        "scope": "optional" if library.use == "loaded" else "required",
        "licenses": [licence],
        "purl": purl,
        "properties": [{"name": "svt:use", "value": library.use}],
    }


def bill(program: pathlib.Path) -> dict:
    packages = {package_of(file) for file in linked(program) + loaded()} | set(COMPILED)
    components = {each["purl"]: each for each in map(component, packages)}
    own = f"pkg:generic/svt@{version.version(ROOT)}"
    return {
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {
            "component": {
                "type": "application",
                "bom-ref": own,
                "name": "svt",
                "version": version.version(ROOT),
                "licenses": [{"license": {"id": "Apache-2.0"}}],
                "purl": own,
            }
        },
        "components": [components[purl] for purl in sorted(components)],
        "dependencies": [{"ref": own, "dependsOn": sorted(components)}],
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    arguments = parser.parse_args()
    print(json.dumps(bill(arguments.program), indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main())

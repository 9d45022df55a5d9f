#!/usr/bin/env python3
"""The version number, which several files repeat. CMakeLists.txt has the number that counts.

    scripts/release/version.py                     prints it
    scripts/release/version.py --check [--root R]  exit code 1 if another file has another number
    scripts/release/version.py --set 0.2.0         writes it into all files

Programs, manual pages, packages and the wheel take the number from CMakeLists.txt when they are built.
"""
import argparse
import json
import pathlib
import re
import sys
from typing import NamedTuple

ROOT = pathlib.Path(__file__).resolve().parents[2]
NUMBER = r"\d+\.\d+\.\d+"


class Place(NamedTuple):
    path: str
    pattern: str  # with one group, the number
    isShort: bool = False  # only the first two parts: "0.2"


SOURCE = Place("CMakeLists.txt", rf"^project\(svt VERSION ({NUMBER})")
PLACES = [
    SOURCE,
    Place("CITATION.cff", rf"^version: ({NUMBER})$"),
    Place("codemeta.json", rf'^  "version": "({NUMBER})"'),
    Place("Containerfile", rf"\bsvt:({NUMBER})"),
    Place("docs/user/city-run.md", rf"/svt:({NUMBER})"),
    Place("docs/user/doctor.md", rf"^program +ok +svt ({NUMBER}),"),
    Place("docs/dev/releasing.md", rf"\bVERSION=({NUMBER})"),
    Place("README.md", r"find_package\(svt (\d+\.\d+) ", isShort=True),
    Place("scripts/docs_site/cpp_api.py", r"find_package\(svt (\d+\.\d+) ", isShort=True),
    Place("examples/cpp/CMakeLists.txt", r"find_package\(svt (\d+\.\d+) ", isShort=True),
]


def npm_places(root: pathlib.Path) -> list[Place]:
    """The package.json of each package that is published."""
    places = []
    for path in sorted(root.glob("web/*/package.json")) + sorted(root.glob("web/npm/*/package.json")):
        if not json.loads(path.read_text(encoding="utf-8")).get("private", False):
            places.append(Place(str(path.relative_to(root)), rf'^  "version": "({NUMBER})"'))
    return places


def numbers_of(root: pathlib.Path, place: Place) -> list[str]:
    text = (root / place.path).read_text(encoding="utf-8")
    return re.findall(place.pattern, text, re.M)


def version(root: pathlib.Path) -> str:
    return numbers_of(root, SOURCE)[0]


def wanted(place: Place, number: str) -> str:
    return number.rpartition(".")[0] if place.isShort else number


def findings(root: pathlib.Path) -> list[str]:
    number = version(root)
    found = []
    for place in PLACES + npm_places(root):
        if not (root / place.path).exists():
            found.append(f"{place.path}: missing, and it states the version")
            continue
        numbers = numbers_of(root, place)
        if not numbers:
            found.append(f"{place.path}: no version as '{place.pattern}'")
        found += [
            f"{place.path}: {other}, and CMakeLists.txt has {number}"
            for other in numbers
            if other != wanted(place, number)
        ]
    return found


def write(root: pathlib.Path, number: str) -> None:
    for place in PLACES + npm_places(root):
        path = root / place.path
        text = path.read_text(encoding="utf-8")

        def replaced(match: re.Match, place: Place = place) -> str:
            begin, end = match.start(1) - match.start(), match.end(1) - match.start()
            return match[0][:begin] + wanted(place, number) + match[0][end:]

        path.write_text(re.sub(place.pattern, replaced, text, flags=re.M), encoding="utf-8")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--set", metavar="NUMBER")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT)
    arguments = parser.parse_args()
    if arguments.set:
        if not re.fullmatch(NUMBER, arguments.set):
            sys.exit(f"version: '{arguments.set}' is not a version; expected three numbers such as 0.2.0")
        write(arguments.root, arguments.set)
    if arguments.check or arguments.set:
        found = findings(arguments.root)
        for finding in found:
            print(f"{finding}; scripts/release/version.py --set {version(arguments.root)} writes it", file=sys.stderr)
        return 1 if found else 0
    print(version(arguments.root))
    return 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Writes the badges of README.md as SVG, from facts in the tree: the licence, the version, and the last recorded result of
`make test` (tests/checks.json). No page of another host is needed to show them.

    scripts/release/badges.py            writes docs/images/badges
    scripts/release/badges.py --check    exit code 1 if a badge differs from the facts
"""
import argparse
import json
import pathlib
import sys

import version

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "docs/images/badges"
GREEN, BLUE, RED = "#2e7d32", "#1f6fb2", "#b3261e"
CHARACTER = 6.6  # mean width of a letter of 11 pixels


def licence() -> str:
    words = (ROOT / "LICENSE").read_text(encoding="utf-8").split()[:4]
    if words[:3] != ["Apache", "License", "Version"]:
        sys.exit("badges: LICENSE does not begin as the Apache License does")
    return f"Apache-{words[3].rstrip(',')}"


def tests() -> tuple[str, str]:
    """The last result of the tests, and its colour."""
    results = json.loads((ROOT / "tests/checks.json").read_text(encoding="utf-8"))
    result = results.get("test")
    if result is None:
        return "not run", RED
    return f"{result['result']} {result['date'][:10]}", GREEN if result["result"] == "passed" else RED


def badge(name: str, value: str, color: str) -> str:
    left, right = (round(CHARACTER * len(text) + 12) for text in (name, value))
    width = left + right
    texts = "".join(
        f'<text x="{x}" y="14" textLength="{length - 12}" lengthAdjust="spacingAndGlyphs">{text}</text>'
        for x, length, text in ((left / 2, left, name), (left + right / 2, right, value))
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="20" role="img" aria-label="{name}: {value}">'
        f"<title>{name}: {value}</title>"
        f'<clipPath id="r"><rect width="{width}" height="20" rx="3"/></clipPath>'
        f'<g clip-path="url(#r)"><rect width="{left}" height="20" fill="#4a4f55"/>'
        f'<rect x="{left}" width="{right}" height="20" fill="{color}"/></g>'
        f'<g fill="#fff" text-anchor="middle" font-family="DejaVu Sans,Verdana,sans-serif" font-size="11">{texts}</g>'
        "</svg>\n"
    )


def badges() -> dict[pathlib.Path, str]:
    result, color = tests()
    return {
        FOLDER / "licence.svg": badge("licence", licence(), BLUE),
        FOLDER / "version.svg": badge("version", version.version(ROOT), BLUE),
        FOLDER / "tests.svg": badge("tests", result, color),
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    made = badges()
    if arguments.check:
        stale = [path for path, text in made.items() if not path.exists() or path.read_text(encoding="utf-8") != text]
        for path in stale:
            print(f"{path.relative_to(ROOT)} is out of date; scripts/release/badges.py renews it", file=sys.stderr)
        return 1 if stale else 0
    FOLDER.mkdir(parents=True, exist_ok=True)
    for path, text in made.items():
        path.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())

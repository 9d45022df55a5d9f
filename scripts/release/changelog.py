#!/usr/bin/env python3
"""The sections of CHANGELOG.md. A released version has the heading `## 0.2.0 - 2026-11-28`.

    scripts/release/changelog.py --notes 0.2.0              prints the section; exit code 1 if it is missing or empty
    scripts/release/changelog.py --close 0.2.0 2026-11-28   makes "Unreleased" the section of this version and day
"""
import argparse
import datetime
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
OPEN = "## Unreleased\n"


def section(text: str, version: str) -> tuple[str, str]:
    """Day and content of a version; empty where they are missing."""
    found = re.search(rf"^## {re.escape(version)} - (\S+)\n(.*?)(?=^## |\Z)", text, re.M | re.S)
    return (found[1], found[2].strip()) if found else ("", "")


def closed(text: str, version: str, day: str) -> str:
    datetime.date.fromisoformat(day)
    if text.count(OPEN) != 1:
        raise ValueError("CHANGELOG.md has no section 'Unreleased', or several")
    if section(text, version)[0]:
        raise ValueError(f"CHANGELOG.md has a section {version} already")
    return text.replace(OPEN, f"{OPEN}\n## {version} - {day}\n")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--notes", metavar="VERSION")
    parser.add_argument("--close", nargs=2, metavar=("VERSION", "DAY"))
    parser.add_argument("--file", type=pathlib.Path, default=ROOT / "CHANGELOG.md")
    arguments = parser.parse_args()
    text = arguments.file.read_text(encoding="utf-8")
    try:
        if arguments.close:
            arguments.file.write_text(closed(text, *arguments.close), encoding="utf-8")
            return 0
        day, notes = section(text, arguments.notes or "")
        datetime.date.fromisoformat(day)
    except ValueError as fault:
        print(f"changelog: {fault}; expected '## {arguments.notes or 'VERSION'} - YEAR-MONTH-DAY'", file=sys.stderr)
        return 1
    if not notes:
        print(f"changelog: the section {arguments.notes} is empty; list the changes", file=sys.stderr)
        return 1
    print(f"# SVT {arguments.notes}\n\n{day}\n\n{notes}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

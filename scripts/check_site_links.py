#!/usr/bin/env python3
"""Follows every link, picture, script and anchor of a static site, without a network. Prints those that lead nowhere.

  scripts/check_site_links.py FOLDER

Links to other hosts are not followed, but scripts, styles, pictures and frames of other hosts are findings.
"""
import argparse
import pathlib
import sys
import urllib.parse
from html.parser import HTMLParser
from typing import Iterator, NamedTuple, Optional

# Attributes that load something while a page opens, and those that a reader follows.
LOADS = {
    ("img", "src"),
    ("script", "src"),
    ("iframe", "src"),
    ("source", "src"),
    ("video", "src"),
    ("link", "href"),
    ("form", "action"),
}
FOLLOWS = {("a", "href"), ("area", "href")}


class Reference(NamedTuple):
    line: int
    address: str
    is_loaded: bool


class Page(HTMLParser):
    """The references and anchors of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.references: list[Reference] = []
        self.anchors: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, Optional[str]]]) -> None:
        for name, value in attrs:
            if value is None:
                continue
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)
            elif (tag, name) in LOADS and dict(attrs).get("rel") != "canonical":
                self.references.append(Reference(self.getpos()[0], value, True))
            elif (tag, name) in FOLLOWS:
                self.references.append(Reference(self.getpos()[0], value, False))


def findings(folder: pathlib.Path) -> Iterator[str]:
    """The broken references of all pages."""
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in sorted(folder.rglob("*.html"))}
    for path, page in pages.items():
        for reference in page.references:
            problem = _problem(folder, pages, path, reference)
            if problem:
                yield f"{path.relative_to(folder)}:{reference.line}: {reference.address}: {problem}"


def _problem(folder: pathlib.Path, pages: dict[pathlib.Path, Page], path: pathlib.Path, reference: Reference) -> str:
    parts = urllib.parse.urlsplit(reference.address)
    if parts.scheme or parts.netloc:
        is_harmless = parts.scheme in ("data", "blob", "about", "javascript", "mailto")
        return "" if is_harmless or not reference.is_loaded else "is loaded from another host"
    target = path
    if parts.path:
        base = folder if parts.path.startswith("/") else path.parent
        target = (base / urllib.parse.unquote(parts.path).lstrip("/")).resolve()
        if target.is_dir():
            target = target / "index.html"
        if folder.resolve() not in target.parents or not target.is_file():
            return "leads nowhere"
    fragment = urllib.parse.unquote(parts.fragment)
    known = pages.get(target) or pages.get(folder / target.relative_to(folder.resolve())) if fragment else None
    if known and not _is_state(fragment) and fragment not in known.anchors:
        return "has no such anchor"
    return ""


def _is_state(fragment: str) -> bool:
    """The viewer has its state in the fragment; browsers know '#top'."""
    return fragment == "top" or fragment.startswith(("view=", "scene="))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    folder = parser.parse_args().folder.resolve()
    if not list(folder.rglob("*.html")):
        print(f"site: {folder} has no pages; 'make site' builds them", file=sys.stderr)
        return 1
    found = list(findings(folder))
    print("\n".join(found[:200]), end="\n" if found else "")
    print(f"site: {len(found)} broken links in {len(list(folder.rglob('*.html')))} pages")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Tests of scripts/check_site_links.py: it finds planted links that lead nowhere, and accepts those that work."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))

import check_site_links  # noqa: E402


def findings_of(**pages: str) -> list[str]:
    """Findings of a site of these pages: name with _ for /, and the body."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for page, body in pages.items():
            path = folder / page.replace("_", "/") / "index.html"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f"<!doctype html><title>{page}</title><body>{body}</body>", encoding="utf-8")
        (folder / "picture.webp").write_bytes(b"")
        return list(check_site_links.findings(folder))


class CheckSiteLinks(unittest.TestCase):
    def test_accepts_links_that_work(self) -> None:
        body = """<h2 id="here">Here</h2> <a href="../b_c/#there">b</a> <a href="#here">here</a> <a href="#">top</a>
          <a href="/a/">a</a> <img src="../picture.webp"> <a href="https://example.org/x">other host</a>
          <a href="../live/?model=house#view=abc">live</a> <img src="data:image/png;base64,">"""
        body = body.replace("../b_c/", "../b/c/")
        self.assertEqual(findings_of(a=body, b_c='<h2 id="there">There</h2>', live="<p id='x'>"), [])

    def test_finds_a_page_that_is_not_there(self) -> None:
        found = findings_of(a='\n<a href="../gone/">gone</a>')
        self.assertEqual(found, ["a/index.html:2: ../gone/: leads nowhere"])

    def test_finds_an_anchor_that_is_not_there(self) -> None:
        found = findings_of(a='<a href="../b/#gone">b</a> <a href="#lost">a</a>', b="<p id='there'>")
        self.assertEqual(
            found,
            ["a/index.html:1: ../b/#gone: has no such anchor", "a/index.html:1: #lost: has no such anchor"],
        )

    def test_finds_a_picture_that_is_not_there(self) -> None:
        self.assertEqual(findings_of(a='<img src="gone.webp">'), ["a/index.html:1: gone.webp: leads nowhere"])

    def test_finds_what_is_loaded_from_another_host(self) -> None:
        found = findings_of(a='<script src="https://cdn.example.org/x.js"></script>')
        self.assertEqual(found, ["a/index.html:1: https://cdn.example.org/x.js: is loaded from another host"])

    def test_finds_links_out_of_the_site(self) -> None:
        self.assertEqual(len(findings_of(a='<a href="../../etc/">out</a>')), 1)


if __name__ == "__main__":
    unittest.main()

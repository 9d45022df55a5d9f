"""The page in one HTML text: its parts, its limits, and the page in Chromium."""
import base64
import gzip
import hashlib
import html
import json
import os
import pathlib
import re
import shutil
import subprocess
import unittest
from unittest import mock

import numpy as np

import svt
from common import COMMAND, house, needs_command, path
from svt import page

PAGE = pathlib.Path(COMMAND).resolve().parent.parent / "share" / "svt" / "viewer" / "index.html"
needs_page = unittest.skipUnless(os.path.exists(COMMAND) and PAGE.exists(), "the page is not built (make viewer)")


def part(pattern, text):
    """The group of a pattern in a text that has it."""
    found = re.search(pattern, text, re.S)
    assert found is not None, pattern
    return found.group(1)


def published():
    """A folder as `svt publish` writes it, with a page of few letters."""
    folder = pathlib.Path(path("published"))
    for name, text in {
        "index.html": '<script type="module" crossorigin src="./assets/index-1.js"></script>\n'
        '<link rel="stylesheet" crossorigin href="./assets/index-2.css">',
        "assets/index-1.js": 'console.log("</script>")',
        "assets/index-2.css": "body { color: red }",
        "assets/svt_threads-3.wasm": "threads",
        "assets/svt_view_threads-3.js": "threads",
        "assets/svt-4.wasm": "wasm",
        "assets/svt_reports-5.wasm": "comparison",
        "assets/svt-4.wasm.br": "brotli",
        "assets/svt-4.wasm.gz": "gzip",
        "models.json": '{"models": []}',
        "models/volume.svt": "volume",
        "preview.png": "picture",
        "sbom.cdx.json": "{}",
        "languages/template.json": "{}",
    }.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


class Text(unittest.TestCase):
    def test_text_has_all_that_the_page_needs(self):
        text = page._one_text(published())
        packed = json.loads(part(r'id="svt-files">(.*?)</script>', text))
        self.assertEqual(packed["main"], "assets/index-1.js")
        files = {name: gzip.decompress(base64.b64decode(data)).decode() for name, data in packed["files"].items()}
        self.assertEqual(
            files,
            {
                "assets/index-1.js": 'console.log("</script>")',
                "assets/svt-4.wasm": "wasm",
                "models.json": '{"models": []}',
                "models/volume.svt": "volume",
            },
        )
        self.assertEqual(text, page._one_text(published()))  # the same bytes again

    def test_policy_permits_only_the_two_inline_texts(self):
        text = page._one_text(published())
        policy = part(r'Content-Security-Policy" content="([^"]*)"', text)
        for tag, rule in (("script", "script-src"), ("style", "style-src")):
            (inline,) = re.findall(rf"<{tag}>(.*?)</{tag}>", text, re.S)
            digest = base64.b64encode(hashlib.sha256(inline.encode()).digest()).decode()
            self.assertIn(f"{rule} 'sha256-{digest}'", policy)
        self.assertIn("default-src 'none'", policy)
        self.assertNotIn("http", policy)

    def test_another_structure_is_an_error(self):
        folder = published()
        (folder / "index.html").write_text("<html></html>")
        with self.assertRaises(svt.Error) as caught:
            page._one_text(folder)
        self.assertIn("another structure", caught.exception.message)


class Frame(unittest.TestCase):
    def with_command(self, text):
        program = path("publish.sh")
        with open(program, "w") as file:
            file.write(f"#!/bin/sh\n{text}\n")
        os.chmod(program, 0o755)
        return mock.patch.dict(os.environ, {"SVT_COMMAND": program})

    def caption_of(self, shown):
        """The text below the picture that stands for the page."""
        return part(
            r"^<figure style='margin:0'><img [^>]* src='data:image/png;base64,iVBOR[A-Za-z0-9+/=]+'>"
            r"<figcaption>([^<]*)</figcaption></figure>$",
            shown._repr_html_(),
        )

    def test_frame_is_sandboxed_and_of_the_wanted_height(self):
        with self.with_command(f'cp -r "{published()}" "$4"'):
            shown = house().page(height=321)
            text = shown._repr_html_()
            self.assertRegex(text, r'^<iframe srcdoc="[^"<>]*" sandbox="allow-scripts allow-downloads" ')
            self.assertIn('height="321"', text)
            content = html.unescape(part(r'srcdoc="([^"]*)"', text))
            self.assertEqual(content, page._one_text(published()))
            written = shown.save(path("page.html"))
            self.assertEqual(os.path.getsize(path("page.html")), written)
            self.assertIn("<title>Sample house</title>", shown.html)
        self.assertEqual(shown._repr_html_(), text)  # made once

    def test_a_picture_with_the_reason_stands_for_a_page_that_cannot_be_made(self):
        cases = (
            ('echo "svt: error E101 CannotOpen: no page here" >&2; exit 3', "E101 CannotOpen: no page here"),
            ("exit 1", "E101 CannotOpen: svt publish ended without a message"),
        )
        for program, reason in cases:
            with self.with_command(program):
                self.assertEqual(self.caption_of(house().page()), f"No interactive page: {reason}")
                with self.assertRaises(svt.Error):
                    house().page().html
                with self.assertRaises(svt.Error):
                    house().page().save(path("none.html"))
                self.assertFalse(os.path.exists(path("none.html")))
        with mock.patch.dict(os.environ, {"SVT_COMMAND": "", "PATH": ""}):
            self.assertIn("the command svt is missing", self.caption_of(house().page()))
        with mock.patch.dict(os.environ, {"SVT_COMMAND": "/no/svt"}):
            reason = "E101 CannotOpen: /no/svt: No such file or directory; set SVT_COMMAND"
            self.assertEqual(self.caption_of(house().page()), f"No interactive page: {reason}")

    def test_a_page_over_the_limit_is_a_picture(self):
        with self.with_command(f'cp -r "{published()}" "$4"'):
            self.assertIn("over the limit of 0.0 MB", self.caption_of(house().page(limit=1000)))

    def test_failed_writing_keeps_the_file(self):
        with self.with_command(f'cp -r "{published()}" "$4"'):
            shown = house().page()
            with self.assertRaises(OSError):
                shown.save(path("no folder/page.html"))
            os.makedirs(path("taken.html"), exist_ok=True)
            with self.assertRaises(OSError):
                shown.save(path("taken.html"))
        self.assertFalse(os.path.exists(path("taken.html.part")))


@needs_command
@needs_page
class Browser(unittest.TestCase):
    def opens(self, name):
        if shutil.which("node") is None:
            self.skipTest("no node (scripts/setup.sh node installs it)")
        script = pathlib.Path(__file__).with_name("page.mjs")
        done = subprocess.run(["node", script, path(name), path(f"{name}.png")], capture_output=True, text=True)
        if done.returncode == 77:
            self.skipTest(done.stdout.strip())
        self.assertEqual(done.returncode, 0, done.stderr)
        seen = json.loads(done.stdout)
        self.assertEqual((seen["name"], tuple(seen["dimension"])), ("Sample house", house().dimension))
        self.assertEqual(seen["errors"], [])
        self.assertEqual(len(seen["requests"]), 1, "the page loads only its file")
        self.assertEqual((seen["origin"], seen["isClosed"], seen["reach"]), ("null", True, False))
        # The middle of the picture shows the house: many colours, and not those of the empty page.
        picture = svt.read_png(path(f"{name}.png"))
        middle = picture[150:550, 400:900, :3].reshape(-1, 3)
        self.assertGreater(len(np.unique(middle, axis=0)), 500)
        self.assertGreater((middle.max(axis=1) - middle.min(axis=1) > 60).mean(), 0.05)

    def test_file_shows_the_volume_without_a_server(self):
        size = house().page().save(path("file.html"))
        self.assertLess(size, 8_000_000)
        self.opens("file.html")

    def test_frame_of_a_notebook_shows_the_volume(self):
        with open(path("frame.html"), "w", encoding="utf-8") as file:
            file.write(f"<!doctype html><title>notebook</title><body>{house().page()._repr_html_()}</body>")
        self.opens("frame.html")


if __name__ == "__main__":
    unittest.main()

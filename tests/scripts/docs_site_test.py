#!/usr/bin/env python3
"""Tests of scripts/docs_site: how Markdown of the tree becomes pages of the site."""

import base64
import json
import pathlib
import sys
import unittest
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))

from docs_site import live, markdown_text, runs  # noqa: E402


class MarkdownText(unittest.TestCase):
    def test_anchors_are_those_of_the_plain_tree(self) -> None:
        self.assertEqual(markdown_text.slug("Two words, here"), "two-words-here")
        self.assertEqual(markdown_text.slug("Existing folders: --force"), "existing-folders---force")
        self.assertEqual(markdown_text.slug("Größe & Maß_1"), "größe--maß_1")

    def test_links_change_outside_of_code_only(self) -> None:
        text = "[a](b.md) `[c](d.md)` ![e](f.png)\n```sh\n[g](h.md)\n```\n[`i` j](k.md#l)\n"
        seen = []

        def change(is_picture: bool, target: str) -> str:
            seen.append((is_picture, target))
            return "X"

        changed = markdown_text.change_links(text, change)
        self.assertEqual(seen, [(False, "b.md"), (True, "f.png"), (False, "k.md#l")])
        self.assertEqual(changed, "[a](X) `[c](d.md)` ![e](X)\n```sh\n[g](h.md)\n```\n[`i` j](X)\n")

    def test_lists_and_tables_after_a_paragraph_get_an_empty_line(self) -> None:
        self.assertEqual(markdown_text.for_mkdocs("Text:\n- a\n- b\n"), "Text:\n\n- a\n- b\n")
        self.assertEqual(markdown_text.for_mkdocs("Text\n| a |\n|---|\n"), "Text\n\n| a |\n|---|\n")
        self.assertEqual(markdown_text.for_mkdocs("- a\n  - b\n"), "- a\n  - b\n")

    def test_files_show_their_names_and_comments_disappear(self) -> None:
        self.assertEqual(
            markdown_text.for_mkdocs("```csv owners.csv\na,b\n```\n"), '```csv title="owners.csv"\na,b\n```\n'
        )
        self.assertEqual(markdown_text.for_mkdocs("<!-- BEGIN options -->\n| a |\n"), "| a |\n")

    def test_titles_and_descriptions_are_plain_text(self) -> None:
        text = "# `svt build`\n\n| a |\n\nBuilds a [volume](v.md)\nfrom *models*.\n"
        self.assertEqual(markdown_text.title_of(text), "svt build")
        self.assertEqual(markdown_text.description_of(text), "Builds a volume from models.")


class Runs(unittest.TestCase):
    def test_steps_are_files_and_commands_in_order(self) -> None:
        text = "```sh\nsvt info a \\\n  --tree\nls\nsvt view a\n```\n```csv t.csv\nx\n```\n```\nsvt no\n```\n"
        text += "```sh\npython3 p.py\n```\n"
        expected = [("", "svt info a \\\n  --tree"), ("t.csv", "x\n"), ("", "python3 p.py")]
        self.assertEqual(runs.steps_of(text), expected)


class Live(unittest.TestCase):
    def test_an_address_has_the_state_as_the_viewer_reads_it(self) -> None:
        address = live.address("house", {"hide": ["a"], "sections": [{"axis": "y", "at": 4}]})
        begin, packed = address.split("#view=")
        self.assertEqual(begin, "live/?model=house")
        state = json.loads(zlib.decompress(base64.urlsafe_b64decode(packed + "=" * (-len(packed) % 4)), -15))
        section = {"axis": "y", "at": 4, "flip": False, "turn": 0, "tilt": 0}
        self.assertEqual(state, {"hide": ["a"], "sections": [section]})

    def test_a_comment_after_a_picture_becomes_a_link(self) -> None:
        text = '![A *house*](a.webp)\n\n<!-- live: house {"hide": ["x"]} -->\n'
        page = live.with_live_pictures(text, "gallery.md")
        self.assertIn('<div class="svt-live" markdown="1">\n\n![A *house*](a.webp)', page)
        self.assertIn('href="../live/?model=house#view=', page)
        self.assertIn('href="live/?model=house#view=', live.with_live_pictures(text, "index.md"))
        with self.assertRaises(SystemExit):
            live.with_live_pictures(text.replace("live: house", "live: castle"), "gallery.md")


if __name__ == "__main__":
    unittest.main()

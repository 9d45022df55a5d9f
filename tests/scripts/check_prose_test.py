#!/usr/bin/env python3
"""Tests of scripts/check_prose.py: sentences that it must catch, their rewrites, and how it reads files."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))

import check_prose  # noqa: E402

# Sentences of earlier comments, messages and commits, each of which a reader has to translate.
DIALECT = [
    "walls split into their layers by wish",
    "One label a root of the tree, and below it one a class of what it is made of ... of the root that "
    "fills most of what is filled of a cell the class that fills most",
    "What covers the columns of a label of detail 3 or up",
    "so many of the finest detail have voxels wider than kNearPixels",
    "What refers to other features is told (LinkedFeature)",
    "Puts parts of a city together on its lattice. Of buildings by id, the samples around them and their "
    "labels alone.",
    "Of a file that is no longer than what was asked for, all is as good as a range.",
    "beside which nothing is in the same member",
    "the pack is not as long as when the city was merged",
    "What a reader of the whole file would tell is told, but for features far away from all others.",
    "what cannot be written is told before the work, not after it",
    "A thread that finds another one reporting goes on without.",
    "Stays loaded until the process ends: what others keep of it stays valid.",
    "More threads than a small machine has cores, so that a race between them can show.",
    "since lists that grow are there twice at times",
    "small objects need no rule of their own by that",
    "are turned with the shells that they bound, for a sheet lies behind its face",
    "Looked for from the same end by both cells that share the side.",
    "or, where the inset shows most of that and more, in the inset",
    "a query that selects nothing is no error: it is told in `nothing`",
    "which part of what belongs to which storey",
    "what has most is named first",
    "so many rows at the end are sums",
    "what is written, as the manual says it",
    "so thick may be the layer of samples left open by an error",
    "which no plane of a set explains: no cut across the axis explains both",
    "Changes the view by what is no choice of the user: no step to take back.",
    "Fitting is no wish of the user, whose own choice meanwhile stays.",
    "but with what no step counts as it is now",
    "Has the open city, too, and prepares what of it is seen next.",
    "What the model is like",
    "leave solids be that overlap by up to twice this",
    "only so many",
    "Say what of this machine can be used, and what to do about what is missing",
    "draw the storeys apart, each so much higher above the one below",
    "samples of the type '{}' are no labels",
    "and the input is none; leave it out",
    "names: {} of what is not seen are left out",
    "of each, the coarsest detail whose voxels are at most a pixel, of those alone that the camera sees",
    "Of each product it is told what of it could not be read",
    "told apart by colour-blind eyes",
    "is left out, for what it does hangs on how faces are triangulated",
    "web components of 6 kB and a kept set with labels, keys and themes done",
    "who takes all planes",
    "what the module's compiler refuses",
    "what was written side by side fits together",
    "what the validator says of voxels",
    "what is narrow divides no dimension",
]

PLAIN = [
    "walls optionally split into material layers",
    "Coarsens to one label per building and one per part class. Each cell takes the dominant building, "
    "then that building's dominant class.",
    "Coverage of a mixture label (detail 3 and up): classes with their share in eighths, largest first.",
    "number of finest-detail tiles whose voxels exceed kNearPixels",
    "Features that reference others are reported (LinkedFeature).",
    "Merges the selected parts into one volume. With ids: only those buildings, cropped to their bounding box.",
    "A complete response is fine if the file is not longer than the requested range.",
    "that have no neighbour in the same tile",
    "the size of the pack changed since the merge",
    "Reports the same findings as reading the whole file, except for outlying features.",
    "unwritable outputs are reported before work starts",
    "Skips the report if another thread is reporting.",
    "Never unloaded, so pointers into it stay valid.",
    "Oversubscribe small machines so that data races can surface.",
    "growing would temporarily hold two copies",
    "so small objects need no special case",
    "are flipped together with their shell, because a sheet is laid behind its face",
    "Both cells sharing this side search from the same end, so they find the same point.",
    "or inside the inset, if the inset shows a larger area than the picture",
    "a query without matches is not an error; a message is appended to `nothing`",
    "assigns each component to a storey",
    "labels with the largest clearance are placed first",
    "number of total rows at the end",
    "description for the manual",
    "maximum thickness of the undecided layer, voxels",
    "Two changes along one axis that no plane of the set explains and a single cut cannot explain both.",
    "Changes the view without an undo step.",
    "Automatic fitting must not override a view chosen meanwhile.",
    "keeping members that undo does not track",
    "Second worker on the same city; prepares the next tiles.",
    "Findings in the model",
    "tolerate overlaps up to twice this distance",
    "maximum number of rows",
    "Check this machine and suggest fixes",
    "vertical gap between storeys",
    "sample type '{}' cannot hold labels",
    "but the input is a model; omit --labels",
    "names: {} hidden features not labelled",
    "Only tiles in view (or casting shadows into it) are read, each at the coarsest detail whose voxels "
    "stay below one pixel.",
    "Unreadable parts are reported per product",
    "safe for colour-blind readers",
    "is excluded because it depends on the triangulation",
    "a 6 kB web-component library, and a maintained widget set with accessibility and themes",
    "There is no storey of this name.",
    "A tile takes up to 20 bytes per voxel.",
    "The value is no longer than 20 characters.",
]


def rules(text: str) -> list[str]:
    return [finding.rule for finding in check_prose.findings_of(check_prose.Passage(1, text))]


class Rules(unittest.TestCase):
    def test_dialect_is_found(self) -> None:
        for text in DIALECT:
            self.assertTrue(rules(text), text)

    def test_plain_english_passes(self) -> None:
        for text in PLAIN:
            self.assertEqual(rules(text), [], text)

    def test_long_sentences_are_found(self) -> None:
        sentence = "The grid " + "has one more sample " * 8
        self.assertEqual(rules(sentence + "here."), [])
        self.assertEqual(rules(sentence + "here and there and there."), ["long"])


class Files(unittest.TestCase):
    def lines(self, name: str, text: str) -> list[int]:
        path = Path(name)
        return [
            finding.line
            for passage in check_prose.passages_of(path, text)
            for finding in check_prose.findings_of(passage)
        ]

    def test_markdown_without_code_and_generated_tables(self) -> None:
        text = """# What is drawn

Of each wall the area.
`what it is` is code.

```
what is drawn
```

<!-- BEGIN options -->
| what is drawn |
<!-- END options -->
| cell | stone alone |
"""
        self.assertEqual(self.lines("page.md", text), [1, 3, 13])

    def test_comments_and_strings(self) -> None:
        text = """// What others keep of it stays.
int a;  // stone alone
/// \\return what is drawn
const char* b = "samples of this type "
                "are no labels";
const char* c = "stone alone";
"""
        self.assertEqual(self.lines("code.cpp", text), [1, 2, 3, 4])


if __name__ == "__main__":
    unittest.main()

"""An extension of Python-Markdown: two blanks nest a list, as on GitHub, instead of four."""
from typing import Any

from markdown import Markdown
from markdown.extensions import Extension


class NestedLists(Extension):
    def extendMarkdown(self, md: Markdown) -> None:  # noqa: N802, the name of the interface
        md.tab_length = 2


def makeExtension(**options: Any) -> NestedLists:  # noqa: N802, the name of the interface
    return NestedLists(**options)

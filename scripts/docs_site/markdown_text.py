"""Reads and adapts Markdown: text apart from code, links, headings, and the differences between GitHub's Markdown and MkDocs'."""
import re
from typing import Callable, Iterator

FENCE = re.compile(r"^( *)(```+|~~~+)(.*)$")
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\[\]]*\])*)\]\(([^()\s]+)\)")
LIST_ITEM = re.compile(r"^ *(?:[-*+]|\d+\.) ")
COMMENT = re.compile(r"<!--(?! live:).*?-->\n?", re.DOTALL)


def slug(text: str, separator: str = "-") -> str:
    """The anchor of a heading as GitHub makes it, so that links work in the plain tree and on the site."""
    kept = "".join(c for c in text.strip() if c in " -_" or c.isalnum())
    return kept.replace(" ", separator).lower()


def blocks(text: str) -> Iterator[tuple[bool, str]]:
    """Alternates text and fenced code, with their fences: (is code, lines)."""
    lines: list[str] = []
    fence = ""
    for line in text.splitlines(keepends=True):
        found = FENCE.match(line)
        if found and not fence:
            if lines:
                yield False, "".join(lines)
            lines, fence = [line], found[2]
        elif found and found[2].startswith(fence) and not found[3].strip():
            yield True, "".join([*lines, line])
            lines, fence = [], ""
        else:
            lines.append(line)
    if lines:
        yield bool(fence), "".join(lines)


def outside_code(line: str, change: Callable[[str], str]) -> str:
    """Changes text but not the code in backticks. A link may contain code."""
    kept: list[str] = []

    def hide(found: re.Match) -> str:
        kept.append(found[0])
        return f"\0{len(kept) - 1}\0"

    hidden = re.sub(r"(`+)(?!`).*?(?<!`)\1(?!`)", hide, line, flags=re.DOTALL)
    return re.sub(r"\0(\d+)\0", lambda found: kept[int(found[1])], change(hidden))


def change_links(text: str, change: Callable[[bool, str], str]) -> str:
    """Replaces the target of each link and picture outside of code; change(is a picture, target)."""

    def link(found: re.Match) -> str:
        return f"{found[1]}[{nested(found[2])}]({change(bool(found[1]), found[3])})"

    def nested(label: str) -> str:  # a picture that is a link
        return LINK.sub(link, label)

    return "".join(
        block if is_code else outside_code(block, lambda visible: LINK.sub(link, visible))
        for is_code, block in blocks(text)
    )


def title_of(text: str) -> str:
    """The first heading as plain text."""
    for is_code, block in blocks(text):
        found = None if is_code else re.search(r"^# +(.+)$", block, re.MULTILINE)
        if found:
            return re.sub(r"[`*]", "", LINK.sub(r"\2", found[1])).strip()
    return ""


def description_of(text: str) -> str:
    """The first paragraph as plain text, for search engines."""
    for is_code, block in blocks(text):
        if is_code:
            continue
        for paragraph in re.split(r"\n\s*\n", COMMENT.sub("", block)):
            paragraph = paragraph.strip()
            if paragraph and not re.match(r"[#|!<*+-]", paragraph):
                plain = re.sub(r"[`*]", "", LINK.sub(r"\2", paragraph))
                return " ".join(plain.split())[:300]
    return ""


def _fence_of(line: str) -> str:
    """```json NAME``` shows the name of the file above the block."""
    found = FENCE.match(line)
    assert found
    language, _, name = found[3].strip().partition(" ")
    return f'{found[1]}{found[2]}{language} title="{name}"\n' if name and "=" not in name else line


def _separated(block: str) -> str:
    """Empty lines before lists and tables, which MkDocs needs and GitHub does not."""
    lines: list[str] = []
    for line in block.splitlines():
        before = lines[-1] if lines else ""
        starts_list = LIST_ITEM.match(line) and before.strip() and not LIST_ITEM.match(before) and before[0] != " "
        starts_table = line.startswith("|") and before.strip() and not before.startswith("|")
        if starts_list or starts_table:
            lines.append("")
        lines.append(line)
    return "\n".join(lines) + "\n"


def for_mkdocs(text: str) -> str:
    """Markdown of GitHub as MkDocs reads it."""
    parts = []
    for is_code, block in blocks(text):
        if is_code:
            first, _, rest = block.partition("\n")
            parts.append(_fence_of(first) + ("" if _fence_of(first).endswith("\n") else "\n") + rest)
        else:
            parts.append(_separated(COMMENT.sub("", block)))
    return "".join(parts)

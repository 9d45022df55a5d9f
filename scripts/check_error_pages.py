#!/usr/bin/env python3
"""Fails if an error code lacks its page, its row in the index or its name in the program, or if a page lacks its code or
an example. A test of tests/cli runs the commands of the examples.

    scripts/check_error_pages.py [ROOT]
"""
import re
import sys
from pathlib import Path

from findings import report

SECTIONS = ["## Cause", "## Example", "## Remedy"]


def example_findings(text: str, tag: str, name: str) -> list[str]:
    """What an example lacks: commands and the message that they lead to, or the reason why there is none."""
    example = text.partition("\n## Example\n")[2].partition("\n## ")[0]
    if re.search(r"^No message has this code: \S", example, re.M):
        return []
    found = []
    if not re.search(rf"^svt: (error|warning|note) {tag} {name}: \S", example, re.M):
        found.append(f"docs/errors/{tag}.md: no example message 'svt: error {tag} {name}: ...' (or warning, note)")
    if "\n```sh\n" not in example and not re.search(r"^No command is shown: \S", example, re.M):
        found.append(f"docs/errors/{tag}.md: neither commands (```sh) nor 'No command is shown: WHY'")
    return found


def findings(root: Path) -> list[str]:
    header = (root / "svt/core/error.hpp").read_text(encoding="utf-8")
    source = (root / "svt/core/error/error.cpp").read_text(encoding="utf-8")
    folder = root / "docs/errors"
    index = (folder / "README.md").read_text(encoding="utf-8")
    enum = re.search(r"enum class Code[^{]*\{(.*?)\n\};", header, re.S)
    if enum is None:
        return ["svt/core/error.hpp: no 'enum class Code' found"]
    codes = {name: f"E{number}" for name, number in re.findall(r"^\s*(\w+)\s*=\s*(\d{3})\b", enum[1], re.M)}
    found = [] if codes else ["svt/core/error.hpp: no codes found"]
    tags = list(codes.values())
    found += [f"svt/core/error.hpp: {tag} stands for several codes" for tag in sorted(set(tags)) if tags.count(tag) > 1]

    for name, tag in codes.items():
        if f"SVT_CASE({name})" not in source:
            found.append(f"svt/core/error/error.cpp: codeName() does not know {name}")
        rows = re.findall(rf"^\| \[{tag}\]\({tag}\.md\) \| (\w+) \|", index, re.M)
        if rows != [name]:
            found.append(f"docs/errors/README.md: one row '| [{tag}]({tag}.md) | {name} |' expected, found {rows}")
        page = folder / f"{tag}.md"
        if not page.exists():
            found.append(f"docs/errors/{tag}.md: missing, the page of {name}")
            continue
        text = page.read_text(encoding="utf-8")
        if text.splitlines()[:1] != [f"# {tag} {name}"]:
            found.append(f"docs/errors/{tag}.md: the title must be '# {tag} {name}'")
        found += example_findings(text, tag, name)
        found += [f"docs/errors/{tag}.md: no section '{part}'" for part in SECTIONS if f"\n{part}\n" not in text]

    known = {f"{tag}.md" for tag in tags} | {"README.md"}
    found += [
        f"docs/errors/{page.name}: no code has this page" for page in sorted(folder.iterdir()) if page.name not in known
    ]
    found += [
        f"docs/errors/README.md: row {tag} has no code"
        for tag in re.findall(r"^\| \[(E\d+)\]", index, re.M)
        if tag not in tags
    ]
    return found


if __name__ == "__main__":
    sys.exit(report(findings))

#!/usr/bin/env python3
"""Writes the tables of options in docs/user from `svt <command> --help`.

    scripts/update_command_docs.py [--svt build/release/bin/svt] [--check]

A page docs/user/<command>.md has the lines `<!-- BEGIN options -->` and `<!-- END options -->`; what stands between
them is replaced. With --check nothing is written, and the exit code is 1 where a page is stale or missing.
"""
import argparse
import difflib
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BEGIN, END = "<!-- BEGIN options -->", "<!-- END options -->"


def help_of(svt: str, *command: str) -> str:
    result = subprocess.run([svt, *command, "--help"], capture_output=True, text=True, timeout=30)
    if result.returncode != 0:
        sys.exit(f"{svt} {' '.join(command)} --help: exit {result.returncode}: {result.stderr}")
    return result.stdout


def commands_of(svt: str) -> list[str]:
    text = help_of(svt)
    return re.findall(r"^  (\S+)", text[text.index("Subcommands:") :], re.M)


def entries(text: str) -> list[tuple[str, list[tuple[str, str]]]]:
    """Groups of a help text, each with its (option, description) pairs; an indented line goes on with a description."""
    groups: list[tuple[str, list[tuple[str, str]]]] = []
    for line in text.splitlines():
        if re.fullmatch(r"\S.*:", line) and not line.startswith("Usage:"):
            groups.append((line[:-1], []))
        elif line.startswith("   ") and groups and groups[-1][1]:
            option, said = groups[-1][1][-1]
            groups[-1][1][-1] = (option, f"{said} {line.strip()}".strip())
        elif line.startswith("  ") and groups:
            option, _, said = line.strip().partition("  ")
            groups[-1][1].append((option, said.strip()))
    return groups


def split_option(text: str) -> tuple[str, str, str]:
    """`--frame TEXT:{a,b}=a` -> names, value, default."""
    isRequired = text.endswith(" REQUIRED")
    text = text.removesuffix(" REQUIRED")
    names, _, value = text.partition(" ")
    if value == "...":  # a repeated positional without type
        value = ""
    default = "required" if isRequired else ""
    equals = re.search(r"(?<=[}\]A-Za-z])=([^=]*)$", value)
    if equals:
        default = f"`{equals[1]}`"
        value = value[: equals.start()]
    kind, _, allowed = value.partition(":") if re.match(r"(TEXT|FLOAT|U?INT)\b", value) else (value, "", "")
    kind = {"TEXT": "text", "FLOAT": "number", "INT": "whole number", "UINT": "whole number"}.get(kind, kind)
    kind = kind.replace("FLOAT x 3", "X,Y,Z").replace("TEXT ...", "files")
    if allowed.startswith("{"):
        kind = ", ".join(f"`{word}`" for word in allowed.strip("{}").split(","))
    elif match := re.search(r"\[(\S+) - (\S+)\]", allowed):
        kind = f"{kind}, {match[1]} to {match[2]}"
    return names.replace(",", ", "), kind, default


def table(text: str) -> str:
    lines = []
    for group, rows in entries(text):
        rows = [row for row in rows if not row[0].startswith("-h,")]
        if not rows:
            continue
        title = {"Positionals": "Arguments", "Options": "General"}.get(group, group)
        lines += ["", f"### {title}", "", "| option | value | default | what it does |", "|---|---|---|---|"]
        for option, said in rows:
            names, kind, default = split_option(option)
            names = ", ".join(f"`{name}`" for name in names.split(", "))
            lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in (names, kind, default, said)) + " |")
    return "\n".join(lines[1:])


def updated(page: str, text: str, name: str) -> str:
    begin, end = page.find(BEGIN), page.find(END)
    if begin < 0 or end < begin:
        sys.exit(f"{name}: needs the lines '{BEGIN}' and '{END}'")
    return page[: begin + len(BEGIN)] + "\n" + text + "\n" + page[end:]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--svt", default=str(ROOT / "build/release/bin/svt"))
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    stale = 0
    for command in commands_of(arguments.svt):
        path = ROOT / "docs/user" / f"{command}.md"
        if not path.exists():
            print(f"{path.relative_to(ROOT)}: missing, the page of svt {command}", file=sys.stderr)
            stale += 1
            continue
        old = path.read_text(encoding="utf-8")
        new = updated(old, table(help_of(arguments.svt, command)), path.name)
        if new == old:
            continue
        stale += 1
        if arguments.check:
            sys.stderr.writelines(difflib.unified_diff(old.splitlines(True), new.splitlines(True), path.name, "svt --help"))
        else:
            path.write_text(new, encoding="utf-8")
            print(f"updated {path.relative_to(ROOT)}")
    if arguments.check and stale:
        print("docs are stale; run scripts/update_command_docs.py", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

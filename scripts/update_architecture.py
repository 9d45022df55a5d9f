#!/usr/bin/env python3
"""Writes the column "inside" of the table of folders in docs/dev/architecture.md: the sub-folders of each folder that hold
more than tests, in alphabetical order. Fails if a library of svt has no row, or a row has no folder.

    scripts/update_architecture.py [--check] [ROOT]

With --check nothing is written, and the exit code is 1 where the column differs from the tree.
"""
import re
import subprocess
import sys
from pathlib import Path

PAGE = "docs/dev/architecture.md"
ROW = re.compile(r"^\| \[([^\]]+)\]\(\.\./\.\./([^)]+)\) \| (.*) \| ([^|]*)\|$", re.M)
TEST = re.compile(r"_test\.[ch]pp$")


def files_of(root: Path) -> list[str]:
    """The files of the tree that git does not ignore; all files where there is no git."""
    if not (root / ".git").exists():
        return [path.relative_to(root).as_posix() for path in root.rglob("*") if path.is_file()]
    command = ["git", "-C", str(root), "ls-files", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout.splitlines()
    return [name for name in names if (root / name).is_file()]


def inside(files: list[str], folder: str) -> list[str]:
    """The sub-folders of a folder that have a file which is no test; of the folder of tests all."""
    below = (name[len(folder) + 1 :] for name in files if name.startswith(folder + "/"))
    return sorted(
        {name.split("/")[0] for name in below if "/" in name and (folder == "tests" or not TEST.search(name))}
    )


def updated(root: Path, page: str) -> tuple[str, list[str]]:
    """The page with the column as the tree has it, and what rows cannot say."""
    problems, named, files = [], set(), files_of(root)

    def row(match: re.Match) -> str:
        folder = match[2]
        named.add(folder)
        if not any(name.startswith(folder + "/") for name in files):
            problems.append(f"{PAGE}: the row of {folder} has no folder; remove it")
            return match[0]
        cells = ", ".join(f"`{name}`" for name in inside(files, folder))
        return f"| [{match[1]}](../../{folder}) | {match[3]} | {cells}{' ' if cells else ''}|"

    page = ROW.sub(row, page)
    for library in inside(files, "svt"):
        if f"svt/{library}" not in named:
            problems.append(f"{PAGE}: svt/{library} has no row in the table of folders; add one")
    return page, problems


def main() -> int:
    arguments = sys.argv[1:]
    check = "--check" in arguments
    roots = [argument for argument in arguments if argument != "--check"]
    root = Path(roots[0]) if roots else Path(__file__).resolve().parent.parent
    path = root / PAGE
    old = path.read_text(encoding="utf-8")
    new, problems = updated(root, old)
    if check:
        for before, after in zip(old.splitlines(), new.splitlines()):
            if before != after:
                problems.append(f"{PAGE}: run scripts/update_architecture.py; the tree says: {after}")
    elif new != old:
        path.write_text(new, encoding="utf-8")
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())

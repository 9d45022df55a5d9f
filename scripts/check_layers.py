#!/usr/bin/env python3
"""Checks who includes whom. svt/layers.txt is the table; the rules that hold everywhere are below.

  1  A folder includes only what the table gives it; the table goes one way and gives nothing that is not used.
  2  What stands at the top of a folder is public. A sub-folder is its inside: nobody else includes it.
  3  Within a folder, its top and its sub-folders include each other one way. In svt/ the sub-folders include the top and
     the top never them, so no public header leaks the inside; in an application the top includes the sub-folders.
  4  No folder has more than 25 files, and no sub-folder has folders of its own.
  5  Public headers include no third-party header; every header has its guard; the namespace is that of the folder.
  6  Calls of one operating system stand in the few places that are listed here.

  check_layers.py [ROOT]    prints what breaks a rule and exits with 1
"""
import collections
import pathlib
import re
import sys
from typing import Optional

MAX_FILES = 25
PARTS = ("svt", "apps", "web/wasm", "python", "bench", "tests")
# Templates over JSON. Public headers may not include it, so that users of the library need no JSON library. Those of the
# folder that only programs use may.
RECORD = "svt/record/record.hpp"
OF_PROGRAMS = "frontend"
THIRD_PARTY = (
    "pugixml",
    "simdjson",
    "nlohmann",
    "fmt/",
    "tbb/",
    "GL/",
    "png.h",
    "zlib.h",
    "CLI/",
    "zip.h",
    "zstd",
    "ft2build",
    "EGL/",
    "GLES3/",
    "polyclipping",
    "hwy/",
)
POSIX = re.compile(r"(unistd|fcntl|signal|poll|sched|pthread|dlfcn|spawn)\.h$|(sys|netinet|arpa|linux)/")
MAY_CALL_POSIX = ("svt/core/file/", "svt/core/machine/", "svt/core/parallel/", "svt/serve/", "bench/")
INCLUDE = re.compile(r'\s*#\s*include\s*[<"]([^">]+)')


def read_table(path: pathlib.Path) -> tuple[dict[str, set[str]], dict[str, set[str]], dict[str, set[str]], list[str]]:
    """(folder -> what it may include, the same for its tests, folder -> whose inside it may include, problems)"""
    allowed: dict[str, set[str]] = {}
    tests: dict[str, set[str]] = collections.defaultdict(set)
    insides: dict[str, set[str]] = collections.defaultdict(set)
    problems: list[str] = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        line = line.split("#")[0].strip()
        if not line:
            continue
        name, _, names = line.partition(":")
        if name.startswith("test "):
            tests[name[5:]] |= set(names.split())
        elif name.startswith("inside "):
            insides[name[7:]] |= set(names.split())
        else:
            for below in names.split():
                if below not in allowed:
                    problems.append(f"{path.name}:{number}: {below} stands above {name}, or nowhere")
            allowed[name] = set(names.split())
    return allowed, tests, insides, problems


def folder_of(path: str, folders: set[str]) -> Optional[str]:
    """The folder of the table that holds a file: "svt/render/packet/x.hpp" -> "render", "apps/cli/x.hpp" -> "apps/cli"."""
    parts = path.split("/")
    for name in ("/".join(parts[:2]), parts[1] if parts[0] == "svt" and len(parts) > 2 else None, parts[0]):
        if name in folders:
            return name
    return None


def room_of(path: str, folder: str) -> str:
    """The sub-folder of `folder` that holds a file, "" for its top."""
    top = folder if folder.split("/")[0] in ("apps", "web", "python", "bench", "tests") else f"svt/{folder}"
    rest = path[len(top) + 1 :].split("/")
    return rest[0] if len(rest) > 1 else ""


def check_tree(root: pathlib.Path) -> tuple[list[str], int]:
    allowed, in_tests, insides, problems = read_table(root / "svt" / "layers.txt")
    folders = set(allowed) | {"tests"}
    files = sorted(path for part in PARTS for path in (root / part).rglob("*.[ch]pp"))
    # folder -> (room, room) -> a place
    rooms: dict[str, dict[tuple[str, str], str]] = collections.defaultdict(lambda: collections.defaultdict(str))
    used: dict[str, set[str]] = collections.defaultdict(set)
    used_by_tests: dict[str, set[str]] = collections.defaultdict(set)
    for path in files:
        name = str(path.relative_to(root))
        folder = folder_of(name, folders)
        if folder is None:
            problems.append(f"{name}: its folder is not in svt/layers.txt")
            continue
        room = room_of(name, folder)
        text = path.read_text(encoding="utf-8")
        is_test = path.stem.endswith("_test") or folder == "tests"
        is_public = path.suffix == ".hpp" and not room and not is_test
        may = allowed.get(folder, set()) | {folder} | (in_tests[folder] if is_test else set())
        for number, line in enumerate(text.splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            other, place = match.group(1), f"{name}:{number}"
            target = (
                folder_of(other, folders)
                if other.startswith(("svt/", "apps/", "web/", "python/", "bench/", "tests/"))
                else None
            )
            if target is not None:
                inner = room_of(other, target)
                (used_by_tests if is_test else used)[folder].add(target)
                if other == RECORD and is_public and name.startswith("svt/") and folder != OF_PROGRAMS:
                    problems.append(f"{place}: {other} in a public header")
                if target not in may:
                    problems.append(f"{place}: {folder} may not include {target} ({other})")
                elif inner and target != folder and target not in insides.get("/".join(name.split("/")[:2]), ()):
                    problems.append(f"{place}: {other} is the inside of {target}")
                elif inner and target == folder and not room and name.startswith("svt/"):
                    problems.append(f"{place}: the top of {folder} includes its inside ({other})")
                elif target == folder and inner != room:
                    rooms[folder][room, inner] = rooms[folder][room, inner] or place
                if not is_test and other.endswith("_test.hpp"):
                    problems.append(f"{place}: includes a test header ({other})")
            elif name == RECORD:
                pass
            elif is_public and other.startswith(THIRD_PARTY) and folder in allowed and name.startswith("svt/"):
                problems.append(f"{place}: third-party include in a public header ({other})")
            if POSIX.match(other) and not is_test and not name.startswith(MAY_CALL_POSIX):
                problems.append(
                    f"{place}: {other} is of one operating system; it belongs into {', '.join(MAY_CALL_POSIX)}"
                )
        # Highway includes a kernel once for each set of instructions; only that has no guard.
        if path.suffix == ".hpp" and "#pragma once" not in text and "#define HWY_TARGET_INCLUDE" not in text:
            problems.append(f"{name}: no #pragma once")
        named = re.findall(r"^namespace svt(?:::(\w+))?", text, re.M)
        expected = {"", "test"} if folder == "core" else {folder, "test"}
        if name.startswith("svt/") and named and not set(named) <= expected:
            problems.append(f"{name}: namespace svt::{(set(named) - expected).pop()} in the folder {folder}")
    for given, uses, what in ((allowed, used, ""), (in_tests, used_by_tests, "test ")):
        for folder, below in sorted(given.items()):
            problems += [
                f"layers.txt: {what}{folder} does not include {other}" for other in sorted(below - uses[folder])
            ]
    for folder, pairs in sorted(rooms.items()):
        problems += cycles(folder, pairs)
    for directory in sorted({path.parent for path in files}):
        count = sum(1 for path in directory.iterdir() if path.is_file())
        name = str(directory.relative_to(root))
        if count > MAX_FILES:
            problems.append(f"{name}: {count} files; more than {MAX_FILES} want sub-folders")
        if name.startswith("svt/") and name.count("/") > 2:
            problems.append(f"{name}: a sub-folder of a sub-folder")
    return problems, len(allowed)


def cycles(folder: str, pairs: dict[tuple[str, str], str]) -> list[str]:
    """What keeps sub-folders from an order in which each includes only earlier ones."""
    below = collections.defaultdict(set)
    for user, used in pairs:
        below[user].add(used)
    left = set(below) | {used for _, used in pairs}
    while True:
        free = {room for room in left if not below[room] & left}
        if not free:
            break
        left -= free
    places = sorted(
        f"{user or 'the top'} includes {used or 'the top'} ({place})"
        for (user, used), place in pairs.items()
        if {user, used} <= left
    )
    return [f"{folder}: includes in a circle: {'; '.join(places)}"] if left else []


def main() -> int:
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent
    problems, count = check_tree(root)
    for problem in problems:
        print(f"layers: {problem}", file=sys.stderr)
    if not problems:
        print(f"layers: {count} folders, all includes one way, insides private")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())

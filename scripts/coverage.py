#!/usr/bin/env python3
"""Counts the lines and branches of svt/ that tests reach.

    scripts/coverage.py                builds the preset `coverage`, runs its tests, and prints a table by folder
    scripts/coverage.py --record       also writes the table to docs/dev/testing.md
    scripts/coverage.py --list FOLDER  lists the unreached lines of a folder of svt/, from the last run

Each side of a condition is a branch. Folders of the core have goals: 95 % of the lines and 85 % of the branches.
The tests of the page, of the packages and of the npm module run other builds and take no part.
Exit code: 1 if a test failed or a folder of the core misses a goal.
"""
import argparse
import collections
import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "coverage"
PROFILES = BUILD / "profiles"
MERGED = BUILD / "tests.profdata"
TABLE = ROOT / "docs" / "dev" / "testing.md"
BEGIN, END = "<!-- coverage: begin -->\n", "<!-- coverage: end -->\n"
CORE = ("core", "model", "mesh", "voxelize", "volume", "render", "analyze")
GOAL_LINES, GOAL_BRANCHES = 95.0, 85.0


def measure() -> bool:
    """Builds, runs the tests, and merges their counters; true if all tests passed."""
    subprocess.run(["scripts/setup.sh", "checks"], cwd=ROOT, check=True)
    subprocess.run(["scripts/build.sh", "coverage"], cwd=ROOT, check=True)
    shutil.rmtree(PROFILES, ignore_errors=True)
    tests = subprocess.run(
        ["ctest", "--test-dir", str(BUILD), "-j", str(os.cpu_count()), "--timeout", "900", "--no-tests=error"]
        + ["--output-on-failure", "--progress", "-E", "^(Viewer|WebModule|Npm|Package|Python)"],
        cwd=ROOT,
        # %4m: processes of one program add to the same four files.
        env={
            "SVT_DATA_DIR": str(ROOT.parent / "shared" / "data"),
            **os.environ,
            "LLVM_PROFILE_FILE": str(PROFILES / "%4m.profraw"),
        },
    )
    counters = [str(path) for path in sorted(PROFILES.glob("*.profraw"))]
    # A process that is killed while it writes leaves a damaged file; only one that is damaged everywhere is an error.
    subprocess.run(
        ["llvm-profdata", "merge", "-sparse", "--failure-mode=all", "-o", str(MERGED), *counters], check=True
    )
    return tests.returncode == 0


def objects() -> list[str]:
    programs = [str(path) for path in sorted((BUILD / "bin").iterdir()) if os.access(path, os.X_OK)]
    return programs[:1] + [word for path in programs[1:] for word in ("-object", path)]


def exported(*words: str) -> list[dict]:
    """The files of svt/ as llvm-cov describes them, tests left out, with paths below the root."""
    done = subprocess.run(
        ["llvm-cov", "export", f"-instr-profile={MERGED}", *words, *objects()],
        cwd=ROOT,
        check=True,
        stdout=subprocess.PIPE,
    )
    files: dict[str, dict] = {}
    for file in json.loads(done.stdout)["data"][0]["files"]:
        # The compiler names a source from the root, and a header from the build folder; llvm-cov puts the build folder
        # in front of both. A header that has two names counts once, as it is reached most.
        path = os.path.normpath(file["filename"]).removeprefix(f"{ROOT}/").removeprefix("build/coverage/")
        if not path.startswith("svt/") or "_test." in path:
            continue
        before = files.get(path)
        if before is None or before["summary"]["lines"]["covered"] < file["summary"]["lines"]["covered"]:
            files[path] = {**file, "filename": path}
    return list(files.values())


def rate(covered: int, count: int) -> float:
    return 100 * covered / count if count else 100


def table_of(files: list[dict]) -> tuple[str, list[str]]:
    """Markdown table by folder, and the goals that are missed."""
    sums: dict[str, collections.Counter] = collections.defaultdict(collections.Counter)
    for file in files:
        for kind in ("lines", "branches"):
            for key in ("count", "covered"):
                sums[file["filename"].split("/")[1]][f"{kind} {key}"] += file["summary"][kind][key]
    rows = ["| folder | lines | reached | branches | reached |", "|---|---|---|---|---|"]
    missed = []
    for folder, counts in sorted(sums.items(), key=lambda item: (item[0] not in CORE, item[0])):
        lines = rate(counts["lines covered"], counts["lines count"])
        branches = rate(counts["branches covered"], counts["branches count"])
        rows.append(
            f"| `{folder}` | {counts['lines count']} | {lines:.1f} % | {counts['branches count']} | {branches:.1f} % |"
        )
        if folder in CORE and lines < GOAL_LINES:
            missed.append(f"{folder} reaches {lines:.1f} % of its lines; the goal is {GOAL_LINES:.0f} %")
        if folder in CORE and branches < GOAL_BRANCHES:
            missed.append(f"{folder} reaches {branches:.1f} % of its branches; the goal is {GOAL_BRANCHES:.0f} %")
    return "\n".join(rows) + "\n", missed


def unreached_lines(segments: list[list]) -> list[int]:
    """Lines at which code begins that no test reached. A segment: line, column, count, has count, begins, is a gap."""
    return sorted({s[0] for s in segments if s[3] and s[4] and not s[5] and s[2] == 0})


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--list", metavar="FOLDER")
    arguments = parser.parse_args()
    if arguments.list:
        for file in exported():
            path = ROOT / file["filename"]
            if file["filename"].startswith(f"svt/{arguments.list}/"):
                text = path.read_text(encoding="utf-8").splitlines()
                for line in unreached_lines(file["segments"]):
                    print(f"{file['filename']}:{line}: {text[line - 1].strip()}")
        return 0
    passed = measure()
    table, missed = table_of(exported("-summary-only"))
    print(table, end="")
    for goal in missed:
        print(f"coverage: {goal}")
    if arguments.record:
        text = TABLE.read_text(encoding="utf-8")
        begin, end = text.index(BEGIN) + len(BEGIN), text.index(END)
        TABLE.write_text(text[:begin] + table + text[end:], encoding="utf-8")
    return 0 if passed and not missed else 1


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Runs every check of the tree and writes a report: build/verify/report.md.

    scripts/verify.py [CHECK...]      the checks named, else all; those that passed on the same tree are not run again
    scripts/verify.py --again ...     runs them even if they passed on the same tree
    scripts/verify.py --list          the checks, the last result of each, and the check whose turn is next
    scripts/verify.py --turn --minutes N
                                      heavy checks whose expected time fits into N minutes since the call, those that ran
                                      longest ago first; ends a check that is still running after N minutes and names it
    scripts/verify.py --record        copies the results into tests/checks.json and the table of docs/dev/testing.md

A check is a name of CHECKS below, or a prefix of names: `asan` means all parts of it. A check that cannot run is a failure.
Results are kept beside the tree in build/verify/results.json, and for all checkouts of the user in
$XDG_CACHE_HOME/svt/checks.json, so that turns continue from one clone to the next; on a new machine they continue from
tests/checks.json. Exit code: 1 if a check failed.
"""
import argparse
import ctypes
import dataclasses
import datetime
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
from typing import Optional, TextIO

os.environ["SVT_NO_CONFIG"] = "1"  # files with defaults of the user do not change results
ROOT = pathlib.Path(__file__).resolve().parent.parent
WORK = ROOT / "build" / "verify"
LOCAL = WORK / "results.json"
SHARED = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "svt" / "checks.json"
TRACKED = ROOT / "tests" / "checks.json"
TABLE = ROOT / "docs" / "dev" / "testing.md"
TABLE_BEGIN, TABLE_END = "<!-- checks: begin -->\n", "<!-- checks: end -->\n"

# The folders of the address sanitizer's parts: each part fits into one turn from an empty cache.
FOLDERS = {
    "data": "core http plane record image model crs readers mesh validate",
    "volumes": "volume volume_readers voxelize analyze samples serve",
    "pictures": "quantities render render_gl fields field_readers field_writers simulate drawing compare illustrate writers",
    "chains": "pipeline city frontend",
    "command": "cli",
}


@dataclasses.dataclass(frozen=True)
class Check:
    command: str  # for bash, in the root of the checkout
    minutes: float  # expected on two cores from an empty compiler cache
    is_heavy: bool = True  # takes part in turns


CHECKS = {
    "check": Check("make -s check", 2, False),
    "test": Check("make -s test", 50, False),
    "fuzz": Check("make -s fuzz SECONDS=120", 45, False),
    "slurm": Check("scripts/setup.sh slurm && make -s build && scripts/test_slurm.sh build/release/bin/svt long", 12),
    **{
        f"asan/{part}": Check(f"scripts/setup.sh checks && scripts/sanitize.sh asan {folders}", 25)
        for part, folders in FOLDERS.items()
    },
    "tsan": Check("scripts/setup.sh checks && scripts/sanitize.sh tsan", 25),
    "tidy": Check("make -s tidy", 20),
    **{
        f"analyzer/{part}": Check(f"scripts/setup.sh checks && scripts/tidy.py --analyzer --only '{pattern}'", 20)
        for part, pattern in {
            "library": "/svt/(core|plane|record|image|model|crs|readers|mesh|validate"
            "|volume|volume_readers|voxelize|analyze|quantities|render|fields|field_readers|field_writers|simulate)/",
            "programs": "/svt/(render_gl|drawing|compare|illustrate|writers|samples|serve|pipeline|city|frontend)/"
            "|/(apps|python)/",
        }.items()
    },
    "gcc": Check("scripts/setup.sh && SVT_KEEP_GOING=1 scripts/build.sh gcc", 15),
    "mutants": Check("scripts/setup.sh && scripts/mutants.py --changed --count 10", 25),
    "site": Check("make -s site && scripts/setup.sh web && scripts/test_site.sh", 30),
    "packages": Check(
        "scripts/setup.sh packages && make -s package && scripts/test_deb.sh && scripts/test_package.sh && "
        "make -s npm && scripts/test_npm.sh build/release/bin/svt && scripts/test_reproducible.sh",
        45,
    ),
}


def git(*words: str, **more) -> str:
    return subprocess.run(["git", *words], cwd=ROOT, check=True, capture_output=True, text=True, **more).stdout.strip()


def tree_of_files() -> str:
    """Digest of all files as they are, committed or not; those that git ignores aside."""
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "GIT_INDEX_FILE": f"{folder}/index"}
        git("read-tree", "HEAD", env=environment)
        git("add", "-A", env=environment)
        return git("write-tree", env=environment)


def results_in(path: pathlib.Path) -> dict[str, dict]:
    """Results of a file by the check's name; none where the file is absent or damaged."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return {name: result for name, result in found.items() if name in CHECKS}


def keep(path: pathlib.Path, results: dict[str, dict]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    fresh = path.with_suffix(".new")
    fresh.write_text(json.dumps(results, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    fresh.replace(path)


def newest(*files: pathlib.Path) -> dict[str, dict]:
    """The newest result of each check in all the files."""
    newest_results: dict[str, dict] = {}
    for path in files:
        for name, result in results_in(path).items():
            if name not in newest_results or result["date"] > newest_results[name]["date"]:
                newest_results[name] = result
    return newest_results


def turns() -> list[str]:
    """The heavy checks in the order of their turns: those that failed, then the one whose last run is longest ago."""
    last = newest(SHARED, TRACKED, LOCAL)
    order = list(CHECKS)

    def turn(name: str) -> tuple:
        result = last.get(name, {"result": "not run", "date": ""})
        return result["result"] != "failed", result["date"], order.index(name)

    return sorted((name for name in order if CHECKS[name].is_heavy), key=turn)


def children() -> list[int]:
    """Processes that this one started or adopted."""
    return [int(pid) for path in pathlib.Path("/proc/self/task").glob("*/children") for pid in path.read_text().split()]


def end_children() -> None:
    """Ends all processes below this one, also those that have sessions or groups of their own: each orphan is adopted."""
    while found := children():
        for pid in found:
            os.kill(pid, signal.SIGKILL)
            os.waitpid(pid, 0)


def exit_code_of(command: str, output: TextIO, seconds: Optional[float]) -> Optional[int]:
    """Runs a command of bash; none if it was still running after some seconds and was ended with all its processes."""
    PR_SET_CHILD_SUBREAPER = 36
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    process = subprocess.Popen(
        ["bash", "-euo", "pipefail", "-c", command],
        cwd=ROOT,
        stdin=subprocess.DEVNULL,
        stdout=output,
        stderr=subprocess.STDOUT,
        start_new_session=True,
    )
    try:
        return process.wait(seconds)
    except subprocess.TimeoutExpired:
        end_children()
        return None


def run(name: str, tree: str, seconds: Optional[float] = None) -> Optional[dict]:
    """Runs a check, keeps its result, and returns it; none, and nothing kept, if it was still running after some seconds."""
    log = WORK / f"{name.replace('/', '-')}.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    print(f"verify: {name} (log: {log.relative_to(ROOT)})", flush=True)
    start = time.monotonic()
    with log.open("w", encoding="utf-8") as output:
        code = exit_code_of(CHECKS[name].command, output, seconds)
    if code is None:
        print(f"verify: {name} was ended: it was still running after {round(time.monotonic() - start)} s", flush=True)
        return None
    result = {
        "commit": git("describe", "--always", "--dirty", "--abbrev=12"),
        "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M:%S"),
        "result": "passed" if code == 0 else "failed",
        "seconds": round(time.monotonic() - start),
        "tree": tree,
    }
    for path in (LOCAL, SHARED):
        try:
            keep(path, {**results_in(path), name: result})
        except OSError as error:
            print(f"verify: {path} cannot be written: {error}", file=sys.stderr)
    if code != 0:
        print("".join(log.read_text(encoding="utf-8", errors="replace").splitlines(keepends=True)[-40:]), end="")
    print(f"verify: {name} {result['result']} in {result['seconds']} s", flush=True)
    return result


def rows(results: dict[str, dict]) -> str:
    """Markdown table of results."""
    lines = ["| check | last run over | on | result | time |", "|---|---|---|---|---|"]
    for name in CHECKS:
        result = results.get(name)
        lines.append(
            f"| `{name}` | {result['commit']} | {result['date'][:10]} | {result['result']} | {result['seconds']} s |"
            if result
            else f"| `{name}` | - | - | not run | - |"
        )
    return "\n".join(lines) + "\n"


def report(results: dict[str, dict], tree: str) -> None:
    failed = [name for name, result in results.items() if result["result"] != "passed"]
    stale = [name for name in CHECKS if name not in failed and results.get(name, {}).get("tree") != tree]
    text = ["# Checks\n", f"Tree {tree}, {git('describe', '--always', '--dirty')}.\n", rows(results)]
    text += [f"Failed: {', '.join(failed)}\n" if failed else "No check failed.\n"]
    text += [f"Not run over this tree: {', '.join(stale)}\n" if stale else "All checks ran over this tree.\n"]
    for name in failed:
        log = WORK / f"{name.replace('/', '-')}.log"
        if log.exists():
            end = log.read_text(encoding="utf-8", errors="replace").splitlines()[-60:]
            text.append(f"## {name}\n\n```\n" + "\n".join(end) + "\n```\n")
    (WORK / "report.md").write_text("\n".join(text), encoding="utf-8")
    print(
        f"verify: {(WORK / 'report.md').relative_to(ROOT)}: {len(failed)} failed, {len(stale)} not run over this tree"
    )


def record() -> None:
    """Copies the newest results into the tree, without what only this machine knows."""
    results = {
        name: {key: value for key, value in result.items() if key != "tree"}
        for name, result in newest(TRACKED, SHARED, LOCAL).items()
    }
    keep(TRACKED, results)
    subprocess.run([sys.executable, "scripts/release/badges.py"], cwd=ROOT, check=True)
    text = TABLE.read_text(encoding="utf-8")
    begin, end = text.index(TABLE_BEGIN) + len(TABLE_BEGIN), text.index(TABLE_END)
    TABLE.write_text(text[:begin] + rows(results) + text[end:], encoding="utf-8")


def chosen(names: list[str]) -> list[str]:
    found: list[str] = []
    for wanted in names:
        matches = [name for name in CHECKS if name == wanted or name.startswith(wanted + "/")]
        if not matches:
            sys.exit(f"verify: there is no check '{wanted}'; scripts/verify.py --list names all")
        found += matches
    return found or list(CHECKS)


def take_turns(minutes: float, tree: str) -> bool:
    """Runs the next heavy checks that fit into the time; true if none failed."""
    start, passed, waiting = time.monotonic(), True, []
    for name in turns():
        left = minutes - (time.monotonic() - start) / 60
        last = newest(SHARED, LOCAL).get(name)
        # A check that failed may have ended early.
        expected = last["seconds"] / 60 * 1.3 if last and last["result"] == "passed" else CHECKS[name].minutes
        result = run(name, tree, left * 60) if expected <= left else None
        if result is None:
            waiting.append(name)
        else:
            passed = result["result"] == "passed" and passed
    if waiting:
        print(f"verify: no time was left for {', '.join(waiting)}; --turn runs them first next time")
    return passed


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checks", nargs="*")
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--turn", action="store_true")
    parser.add_argument("--minutes", type=float, default=0)
    parser.add_argument("--record", action="store_true")
    arguments = parser.parse_args()
    if arguments.record:
        record()
        return 0
    if arguments.list:
        results = newest(SHARED, TRACKED, LOCAL)
        width = max(map(len, CHECKS))
        for name in CHECKS:
            last = results.get(name)
            print(
                f"{name:{width}}  "
                + (f"{last['result']} on {last['date'][:10]} over {last['commit']}" if last else "not run")
            )
        print(f"the next turn is {turns()[0]}")
        return 0
    names = chosen(arguments.checks)
    tree = tree_of_files()
    if arguments.turn:
        return 0 if take_turns(arguments.minutes, tree) else 1
    passed = True
    for name in names:
        last = results_in(LOCAL).get(name)
        if not arguments.again and last and last["tree"] == tree and last["result"] == "passed":
            print(f"verify: {name} has passed on this tree")
            continue
        result = run(name, tree)
        passed = result is not None and result["result"] == "passed" and passed
    report(results_in(LOCAL), tree)
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
